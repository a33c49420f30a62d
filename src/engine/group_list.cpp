#include "engine/group.hpp"

namespace phy::group {
namespace {

constexpr double birth_factor = 0.02;   // a pair meets below a gap of birth_factor * r_min
constexpr double flight_margin = 2.0;   // over what a fast grain does in a block at its present speed
constexpr double farthest_reach = 8.0;  // of r_min: the cells of the search grow with it

/// A union of lists of pairs. The lanes agree on nearly all of them, so a pair is looked for among the few of
/// its upper grain; sorting all lists together takes ten times as long.
class PairUnion {
 public:
  explicit PairUnion(std::size_t n_grains) : of_(n_grains) {}
  void add(PairKey key) {
    std::vector<PairKey>& known = of_[static_cast<std::size_t>(key_b(key))];
    if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(key);
  }
  std::vector<PairKey> sorted() {
    std::vector<PairKey> all;
    for (std::vector<PairKey>& of : of_) {
      std::sort(of.begin(), of.end());
      all.insert(all.end(), of.begin(), of.end());
    }
    return all;
  }

 private:
  std::vector<std::vector<PairKey>> of_;
};

}  // namespace

/// Pairs that may touch before the list is renewed: within the skin, and as much farther as a grain may go in
/// the next block that is too fast for half the skin, or that a jacket drives. A grain at rest that is hit
/// within the block may go farther all the same: what it then meets unseen ends the test (missed_pair).
template <class T>
void Group<T>::search(std::size_t l) {
  Lane& lane = lanes_[l];
  lane.near.clear();
  std::vector<Vec2> x(n_grains());
  std::vector<double> reach = radius_;
  lane.range.assign(n_grains(), 0.5 * skin_);
  const double block = lane.dt * options_.interval;
  if (jacket_) lane.pressed_way.assign(n_grains(), 0.0);
  for (std::size_t g = 0; g < n_grains(); ++g) {
    built_at_[g * W_ + l] = displacement(g, l);
    x[g] = x0_[g] + built_at_[g * W_ + l];
    const double flight = block * norm(Vec2{grain(g, g_vx, l), grain(g, g_vy, l)});
    double more = std::max(0.0, flight_margin * flight - 0.5 * skin_);
    if (const double push = pushed_way(g, l); push > 0.0) more += lane.pressed_way[g] = push + 0.5 * skin_;
    more = std::min(more, farthest_reach * r_min_);
    reach[g] += more, lane.range[g] += more;
  }
  near_pairs(x, reach, skin_, lane.near);
  if (lane.fresh)
    for (const Contact& c : lane.specimen->contacts)
      lane.near.push_back(pair_key(static_cast<std::uint32_t>(layout_.rank[c.a]),
                                   static_cast<std::uint32_t>(layout_.rank[c.b])));
  lane.searched = true;
}

/// Two grains that overlap though this lane's list does not hold them: one of them has gone farther than it
/// reaches. Nothing: all contacts are known. The few fast grains are held against all.
template <class T>
std::optional<PairKey> Group<T>::missed_pair(std::size_t l) const {
  const Lane& lane = lanes_[l];
  const auto listed = [&](PairKey key) {
    if (std::find(lane.near.begin(), lane.near.end(), key) != lane.near.end()) return true;
    const auto c =
        static_cast<std::size_t>(std::lower_bound(pairs_.begin(), pairs_.end(), key) - pairs_.begin());
    return c < pairs_.size() && pairs_[c] == key && tag_[c * W_ + l] != 0;
  };
  for (std::size_t g = 0; g < lane.range.size(); ++g) {
    const Vec2 way = displacement(g, l) - built_at_[g * W_ + l];
    if (dot(way, way) <= lane.range[g] * lane.range[g]) continue;
    for (std::size_t h = 0; h < n_grains(); ++h) {
      const Vec2 d = x0_[h] + displacement(h, l) - x0_[g] - displacement(g, l);
      const double touch = radius_[g] + radius_[h];
      const PairKey key =
          pair_key(static_cast<std::uint32_t>(std::min(g, h)), static_cast<std::uint32_t>(std::max(g, h)));
      if (h != g && dot(d, d) < touch * touch && !listed(key)) return key;
    }
  }
  return std::nullopt;
}

/// Searches lanes that have moved far enough that their list would not last; the others keep theirs.
template <class T>
std::vector<PairKey> Group<T>::collect_pairs() {
  PairUnion all(n_grains());
  const Farthest most = farthest();
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen) continue;
    const double block = lanes_[l].dt * options_.interval;
    if (!lanes_[l].searched || 4.0 * (most.moved[l] + most.speed[l] * block) >= skin_) search(l);
    for (const PairKey key : lanes_[l].near) all.add(key);
  }
  for (std::size_t c = 0; c < pairs_.size(); ++c)
    for (std::size_t l = 0; l < W_; ++l)
      if (tag_[c * W_ + l] != 0 || contact(c, c_side, l) != T(0) || contact(c, c_shear, l) != T(0)) {
        all.add(pairs_[c]);
        break;
      }
  return all.sorted();
}

template <class T>
void Group<T>::carry_state(const std::vector<PairKey>& pairs) {
  Buffer<T> state;
  state.assign(pairs.size() * n_contact_fields * W_);
  std::vector<std::uint8_t> set(pairs.size() * W_, no_set), tag(pairs.size() * W_, 0);
  std::size_t old = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    while (old < pairs_.size() && pairs_[old] < pairs[c]) ++old;
    if (old == pairs_.size() || pairs_[old] != pairs[c]) continue;
    std::copy_n(contact_.get() + old * n_contact_fields * W_, n_contact_fields * W_,
                state.get() + c * n_contact_fields * W_);
    std::copy_n(set_.data() + old * W_, W_, set.data() + c * W_);
    std::copy_n(tag_.data() + old * W_, W_, tag.data() + c * W_);
  }
  contact_ = std::move(state);
  set_ = std::move(set);
  tag_ = std::move(tag);
}

template <class T>
void Group<T>::fill_lane(std::size_t l) {
  Lane& lane = lanes_[l];
  const Specimen& s = *lane.specimen;
  for (const Contact& k : s.contacts) {
    if (k.kind == ContactKind::touching) continue;
    const std::int32_t ra = layout_.rank[k.a], rb = layout_.rank[k.b];
    const PairKey key = pair_key(static_cast<std::uint32_t>(ra), static_cast<std::uint32_t>(rb));
    const auto c =
        static_cast<std::size_t>(std::lower_bound(pairs_.begin(), pairs_.end(), key) - pairs_.begin());
    const double r1 = packing_->discs[k.a].r, r2 = packing_->discs[k.b].r;
    tag_[c * W_ + l] = 1;
    if (k.kind == ContactKind::joint) {
      const BeddingRecipe& set = s.bedding[k.set];
      contact(c, c_side, l) = T(ra < rb ? k.side : -k.side);
      contact(c, c_capacity, l) = T(set.sigma_n * smooth_joint::area(set.radius_multiplier, r1, r2));
      set_[c * W_ + l] = k.set;
    } else {
      const double A = parallel_bond::geometry(s.matrix.radius_multiplier, r1, r2).A;
      contact(c, c_capacity, l) = T(k.sigma_c * A);
      contact(c, c_strength, l) = T(k.tau_c * A);
    }
  }
  lane.fresh = false;
}

template <class T>
void Group<T>::make_constants() {
  const bool pfc5 = [&] {
    for (const Lane& l : lanes_)
      if (l.specimen) return l.specimen->matrix.stiffness_convention == StiffnessConvention::pfc5;
    return false;
  }();
  contact_const_.clear();
  row_contact_.assign(1, 0);
  far_rows_ = false;
  for (const PairKey key : pairs_) {
    const auto a = static_cast<std::size_t>(key_a(key)), b = static_cast<std::size_t>(key_b(key));
    const Vec2 d = x0_[b] - x0_[a];
    const double d0 = norm(d);
    const double gap0 = d0 - radius_[a] - radius_[b];
    const double r_min = std::min(radius_[a], radius_[b]), length = radius_[a] + radius_[b];
    const double factor = linear::stiffness_factor(pfc5, radius_[a], radius_[b]);
    const double gap = gap0 > 0.0 || !packing_->stress_free ? gap0 : 0.0;
    contact_const_.push_back({key_a(key), key_b(key), -1, T(d.x), T(d.y), T(d0), T(gap),
                              T(radius_[a] + 0.5 * gap0), T(radius_[b] + 0.5 * gap0), T(factor),
                              T(1.0 / factor), T(2.0 * r_min / length),
                              T(2.0 / 3.0 * r_min * r_min * r_min / length), T(1.0 / r_min), T(2.0 * r_min)});
    const std::int32_t row = layout_.row_of[b];
    while (static_cast<std::int32_t>(row_contact_.size()) <= row)
      row_contact_.push_back(static_cast<std::int32_t>(contact_const_.size()) - 1);
    far_rows_ = far_rows_ || row - layout_.row_of[a] > 1;
  }
  while (static_cast<int>(row_contact_.size()) <= layout_.n_rows())
    row_contact_.push_back(static_cast<std::int32_t>(contact_const_.size()));
}

template <class T>
void Group<T>::fill_joint_row(std::size_t row, const std::string& sets) {
  for (std::size_t l = 0; l < W_; ++l) {
    const auto put = [&](int field, double value) {
      joint_table_[(row * n_joint_fields + static_cast<std::size_t>(field)) * W_ + l] = T(value);
    };
    const auto number = static_cast<std::uint8_t>(sets[l]);
    if (number == no_set) {  // no joint in this lane: harmless numbers, masked out
      put(j_nx, 0.0), put(j_ny, 1.0), put(j_k_n, 1.0), put(j_k_s, 1.0);
      put(j_mu, 0.0), put(j_S_0, 1.0), put(j_tan_phi, 0.0), put(j_tan_psi, 0.0);
      continue;
    }
    const BeddingRecipe& set = lanes_[l].specimen->bedding[number];
    const SinCos sc = sin_cos_degrees(set.theta);
    put(j_nx, -sc.sin), put(j_ny, sc.cos);
    put(j_k_n, set.k_n * set.radius_multiplier), put(j_k_s, set.k_s * set.radius_multiplier);
    put(j_mu, lanes_[l].specimen->matrix.unbreakable ? hold_force : set.mu);
    put(j_S_0, set.cohesion * set.radius_multiplier);
    put(j_tan_phi, tan_degrees(set.phi)), put(j_tan_psi, tan_degrees(set.psi));
  }
}

// Contacts whose lanes see the same bedding sets share a row of the joint table.
template <class T>
void Group<T>::assign_joints() {
  std::map<std::string, std::int32_t> rows;
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    const std::string sets(reinterpret_cast<const char*>(set_.data()) + c * W_, W_);
    const bool any_joint =
        std::any_of(sets.begin(), sets.end(), [](char s) { return static_cast<std::uint8_t>(s) != no_set; });
    contact_const_[c].joint =
        any_joint ? rows.try_emplace(sets, static_cast<std::int32_t>(rows.size())).first->second : -1;
  }
  joint_table_.assign(std::max<std::size_t>(1, rows.size()) * n_joint_fields * W_);
  for (const auto& [sets, row] : rows) fill_joint_row(static_cast<std::size_t>(row), sets);
}

template <class T>
void Group<T>::rebuild() {
  std::vector<PairKey> pairs = collect_pairs();
  carry_state(pairs);
  pairs_ = std::move(pairs);
  make_constants();
  for (std::size_t l = 0; l < W_; ++l)
    if (lanes_[l].fresh) fill_lane(l);
  list_open();
  births();
  assign_joints();
  list_touches();
  raw_cracks_.resize(pairs_.size() * W_);
  dirty_ = false;
  ++n_rebuilds_;
}

/// A pair that was never bonded and whose grains lie on different sides of a plane meets as a broken smooth
/// joint.
template <class T>
bool Group<T>::birth_of_joint(std::size_t c, std::size_t l, double gap) {
  const Specimen& s = *lanes_[l].specimen;
  const std::size_t n = n_grains();
  for (std::size_t set = 0; set < s.bedding.size(); ++set) {
    const std::int32_t a = s.plane_label[set * n + packing_id(contact_const_[c].a)];
    const std::int32_t b = s.plane_label[set * n + packing_id(contact_const_[c].b)];
    if (a == b) continue;
    contact(c, c_side, l) = T(b > a ? 1 : -1);
    contact(c, c_bond, l) = T(-std::max(gap, 0.0));
    set_[c * W_ + l] = static_cast<std::uint8_t>(set);
    return true;
  }
  return false;
}

/// Pairs that may yet meet in some lane; all others are bonded or joints since the start.
template <class T>
void Group<T>::list_open() {
  open_.clear();
  for (std::size_t c = 0; c < pairs_.size(); ++c)
    for (std::size_t l = 0; l < W_; ++l)
      if (tag_[c * W_ + l] == 0 && lanes_[l].specimen) {
        open_.push_back(c);
        break;
      }
}

template <class T>
void Group<T>::births() {
  bool joints = false;
  for (const std::size_t c : open_) {
    const auto a = static_cast<std::size_t>(contact_const_[c].a),
               b = static_cast<std::size_t>(contact_const_[c].b);
    for (std::size_t l = 0; l < W_; ++l) {
      Lane& lane = lanes_[l];
      if (tag_[c * W_ + l] != 0 || !lane.specimen || lane.fresh || contact(c, c_side, l) != T(0)) continue;
      const Vec2 d = x0_[b] - x0_[a] + displacement(b, l) - displacement(a, l);
      const double gap = norm(d) - radius_[a] - radius_[b];
      if (gap >= birth_factor * r_min_) continue;
      const std::uint32_t pa = packing_id(contact_const_[c].a), pb = packing_id(contact_const_[c].b);
      ContactStiffness k = touching_stiffness(*lane.specimen, pa, pb, (1.0 / norm(d)) * d);
      if (birth_of_joint(c, l, gap)) {
        const BeddingRecipe& set = lane.specimen->bedding[set_[c * W_ + l]];
        const SinCos sc = sin_cos_degrees(set.theta);
        const double A = smooth_joint::area(set.radius_multiplier, radius_[a], radius_[b]);
        const double side = static_cast<double>(contact(c, c_side, l));
        k.k_n = set.k_n * A, k.k_s = set.k_s * A, k.normal = {-sc.sin * side, sc.cos * side};
        joints = true;
      }
      if (lane.born.try_emplace(pairs_[c], k).second) lane.bound->add(k);
    }
  }
  if (joints) assign_joints();
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen || lanes_[l].fresh) continue;
    if (lanes_[l].bound->loose()) tighten_bound(l);
    renew_step(lanes_[l]);
  }
}

/// The bound anew, from the contacts that are there: broken bonds have left only their linear part.
template <class T>
void Group<T>::tighten_bound(std::size_t l) {
  Lane& lane = lanes_[l];
  std::vector<ContactStiffness> contacts = initial_stiffnesses(*lane.specimen);
  for (ContactStiffness& k : contacts) {
    const PairKey key = pair_key(static_cast<std::uint32_t>(layout_.rank[k.a]),
                                 static_cast<std::uint32_t>(layout_.rank[k.b]));
    const auto c =
        static_cast<std::size_t>(std::lower_bound(pairs_.begin(), pairs_.end(), key) - pairs_.begin());
    const bool bond_broken = contact(c, c_side, l) == T(0) && !(contact(c, c_capacity, l) > T(0));
    if (bond_broken) k = touching_stiffness(*lane.specimen, k.a, k.b, k.branch);
  }
  for (const auto& [key, k] : lane.born) contacts.push_back(k);
  lane.bound.emplace(*lane.specimen, contacts, lane.rig());
}

/// Grain by grain and all lanes at once, as they lie in memory.
template <class T>
typename Group<T>::Farthest Group<T>::farthest() const {
  Farthest most{std::vector<double>(W_), std::vector<double>(W_)};
  double *moved = most.moved.data(), *speed = most.speed.data();
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const T* const of = grain_.get() + g * n_grain_fields * W_;
    const Vec2* const from = built_at_.data() + g * W_;
    for (std::size_t l = 0; l < W_; ++l) {
      const Vec2 d{static_cast<double>(of[g_ux * W_ + l]) - from[l].x,
                   static_cast<double>(of[g_uy * W_ + l]) - from[l].y};
      const Vec2 v{static_cast<double>(of[g_vx * W_ + l]), static_cast<double>(of[g_vy * W_ + l])};
      moved[l] = std::max(moved[l], dot(d, d));
      speed[l] = std::max(speed[l], dot(v, v));
    }
  }
  for (std::size_t l = 0; l < W_; ++l) moved[l] = std::sqrt(moved[l]), speed[l] = std::sqrt(speed[l]);
  return most;
}

// A list is renewed before anything outside it can touch: when twice the largest motion since it was built,
// plus what the fastest grain can do in the next block, exceeds the skin; for tools their own motion counts.
// Where one grain alone outruns the skin, the list is renewed in every block and reaches farther (search).
template <class T>
void Group<T>::watch_motion(const Farthest& most) {
  for (std::size_t l = 0; l < W_ && !dirty_; ++l) {
    const Lane& lane = lanes_[l];
    if (!lane.specimen) continue;
    const double block = lane.dt * options_.interval;
    const double grains = most.moved[l] + most.speed[l] * block;
    double tools = 0.0;
    for (const ToolMotion& t : lane.tools)
      tools = std::max(
          tools, norm(t.state.displacement - t.listed_at) + fastest_tool(t.drive, most.speed[l]) * block);
    dirty_ = 2.0 * grains > skin_ - birth_factor * r_min_ || grains + tools > skin_;
  }
}

template class Group<double>;
template class Group<float>;

}  // namespace phy::group
