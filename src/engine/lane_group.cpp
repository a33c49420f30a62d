#include "engine/lane_group.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <new>
#include <optional>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "engine/layout.hpp"
#include "engine/stable_step.hpp"
#include "laws/laws.hpp"

namespace phy {
namespace {

constexpr double skin_factor = 0.25;  // near pairs are listed up to a gap of skin_factor * r_min
constexpr double birth_factor =
    0.02;  // a pair across a plane becomes a joint below a gap of birth_factor * r_min
constexpr double hold_force = 1e30;    // N/m: no strength is reached while breakage is off
constexpr double worst_overlap = 1.0;  // of the smaller radius: beyond it the state is nonsense
constexpr double worst_energy = 0.2;   // of the boundary work: beyond it the step was unstable
constexpr std::uint8_t no_set = 255;

/// Zeroed memory aligned to a cache line.
template <class T>
class Buffer {
 public:
  void assign(std::size_t n) {
    const std::size_t bytes = std::max<std::size_t>(64, (n * sizeof(T) + 63) / 64 * 64);
    data_.reset(static_cast<T*>(std::aligned_alloc(64, bytes)));
    if (!data_) throw std::bad_alloc();
    std::fill_n(data_.get(), bytes / sizeof(T), T(0));
  }
  T* get() { return data_.get(); }
  const T* get() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> data_;
};

/// Everything the group knows about one specimen.
struct Lane {
  std::shared_ptr<const Specimen> specimen;  // null: empty lane
  LaneSetup setup;
  bool fresh = false;  // loaded, states not yet filled in
  bool hold = false, driving = false, platens = false;
  std::optional<FrequencyBound> bound;
  std::map<PairKey, ContactStiffness> born;  // contacts that the bound counts beyond those of the start
  double dt = 0.0, time = 0.0, drive_time = 0.0;
  std::int64_t step = 0;
  double wall[2] = {}, last_force[2] = {};
  double work = 0.0, slip = 0.0, damping = 0.0, released = 0.0;
  double base_energy = 0.0, base_axial = 0.0, base_lateral = 0.0;
  bool settle_books = false;  // the next block's end is the zero of the energy balance (jump start)
  HistoryRow row;
  LaneHealth health;
  std::vector<CrackEvent> cracks;
  std::int64_t n_contacts = 0;
  std::vector<PairKey> near;  // of this lane's last search
  bool searched = false;
};

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

template <class T>
class Group final : public LaneGroup {
 public:
  Group(std::shared_ptr<const Packing> packing, const GroupOptions& options)
      : packing_(std::move(packing)),
        options_(options),
        W_(static_cast<std::size_t>(options.lanes)),
        kernel_(kernel<T>(options.isa, options.lanes)),
        lanes_(W_) {
    PHY_CHECK(kernel_ != nullptr, "no kernel is built for this number of lanes");
    PHY_CHECK(!packing_->discs.empty(), "a packing has grains");
    for (const Disc& d : packing_->discs) r_min_ = r_min_ > 0.0 ? std::min(r_min_, d.r) : d.r;
    skin_ = skin_factor * r_min_;
    layout_ = make_layout(*packing_, skin_);
    for (const std::int32_t i : layout_.order) {
      const Disc& d = packing_->discs[static_cast<std::size_t>(i)];
      x0_.push_back({d.x, d.y});
      radius_.push_back(d.r);
    }
    allocate();
  }

  int lanes() const override { return options_.lanes; }
  void load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) override;
  void clear(int lane) override { reset_lane(lane); }
  void place_platens(int lane) override;
  void hold_bonds(int lane, bool hold) override { at(lane).hold = hold; }
  void drive_platens(int lane, bool on) override { at(lane).driving = on; }
  void jump(int lane, double axial_strain) override;
  bool at_strength(int lane) const override;
  void set_motion(int lane, std::uint32_t id, const GrainState& at, Vec2 velocity, double spin) override;
  void advance() override;

  const HistoryRow& row(int lane) const override { return at(lane).row; }
  const LaneHealth& health(int lane) const override { return at(lane).health; }
  std::vector<CrackEvent>& cracks(int lane) override { return at(lane).cracks; }
  Snapshot snapshot(int lane) const override;
  std::vector<GrainState> grains(int lane) const override;
  double time_step(int lane) const override { return at(lane).dt; }
  std::int64_t n_contacts(int lane) const override { return at(lane).n_contacts; }
  std::int64_t n_rebuilds() const override { return n_rebuilds_; }
  std::int64_t n_listed() const override { return static_cast<std::int64_t>(pairs_.size()); }

 private:
  std::shared_ptr<const Packing> packing_;
  GroupOptions options_;
  std::size_t W_;
  AdvanceBlock<T> kernel_;
  std::vector<Lane> lanes_;
  Layout layout_;
  double r_min_ = 0.0, skin_ = 0.0;
  std::vector<Vec2> x0_;           // sorted reference positions
  std::vector<double> radius_;     // sorted
  std::vector<PairKey> pairs_;     // sorted list of near pairs
  std::vector<std::uint8_t> set_;  // per contact and lane: bedding set of a joint
  std::vector<std::uint8_t> tag_;  // per contact and lane: 1 = bonded or joint since the start
  std::vector<std::int32_t> row_contact_;
  std::vector<std::uint8_t> row_wall_;
  std::vector<GrainConst<T>> grain_const_;
  std::vector<ContactConst<T>> contact_const_;
  Buffer<T> grain_, contact_, lane_table_, joint_table_, wall_gap_[2], wall_shear_[2];
  Buffer<T> wall_u_, wall_force_, slip_, damping_;
  Buffer<double> sample_, wall_du_;
  std::vector<RawCrack> raw_cracks_;
  std::vector<Vec2> built_at_;  // per grain and lane: displacement when the list was built
  bool dirty_ = true;
  bool far_rows_ = false;
  std::int64_t n_rebuilds_ = 0;

  Lane& at(int lane) { return lanes_[static_cast<std::size_t>(lane)]; }
  const Lane& at(int lane) const { return lanes_[static_cast<std::size_t>(lane)]; }
  std::size_t n_grains() const { return x0_.size(); }
  T& grain(std::size_t g, int field, std::size_t lane) {
    return grain_[(g * n_grain_fields + static_cast<std::size_t>(field)) * W_ + lane];
  }
  double grain(std::size_t g, int field, std::size_t lane) const {
    return static_cast<double>(grain_[(g * n_grain_fields + static_cast<std::size_t>(field)) * W_ + lane]);
  }
  T& contact(std::size_t c, int field, std::size_t lane) {
    return contact_[(c * n_contact_fields + static_cast<std::size_t>(field)) * W_ + lane];
  }
  double contact(std::size_t c, int field, std::size_t lane) const {
    return static_cast<double>(
        contact_[(c * n_contact_fields + static_cast<std::size_t>(field)) * W_ + lane]);
  }
  Vec2 displacement(std::size_t g, std::size_t lane) const {
    return {grain(g, g_ux, lane), grain(g, g_uy, lane)};
  }
  std::uint32_t packing_id(std::int32_t sorted) const {
    return static_cast<std::uint32_t>(layout_.order[static_cast<std::size_t>(sorted)]);
  }

  void allocate();
  void reset_lane(int lane);
  void rebuild();
  void search(std::size_t lane);
  std::vector<PairKey> collect_pairs();
  void carry_state(const std::vector<PairKey>& pairs);
  void fill_lane(std::size_t lane);
  void make_constants();
  void assign_joints();
  void mark_walls();
  void births();
  bool birth_of_joint(std::size_t c, std::size_t lane, double gap);
  void tighten_bound(std::size_t lane);
  static void renew_step(Lane& lane) {
    lane.dt = lane.setup.step_safety * 2.0 / (lane.bound->omega() * std::sqrt(1.0 + lane.setup.damping));
  }
  void fill_lane_table();
  void fill_joint_row(std::size_t row, const std::string& sets);
  void plan_platens();
  void keep_books(std::size_t lane);
  void write_row(std::size_t lane);
  void watch(std::size_t lane);
  double moved(std::size_t lane) const;  // the farthest grain since the lane's last search [m]
  void watch_motion();
  double sample(int field, std::size_t lane) const {
    return sample_[static_cast<std::size_t>(field) * W_ + lane];
  }
  ContactState contact_state(std::size_t c, std::size_t lane) const;
};

template <class T>
void Group<T>::allocate() {
  const auto steps = static_cast<std::size_t>(options_.interval);
  grain_.assign(n_grains() * n_grain_fields * W_);
  lane_table_.assign(n_lane_fields * W_);
  sample_.assign(n_sample_fields * W_);
  for (int wall = 0; wall < 2; ++wall) {
    wall_gap_[wall].assign(n_grains() * W_);
    wall_shear_[wall].assign(n_grains() * W_);
    std::fill_n(wall_gap_[wall].get(), n_grains() * W_, T(1));  // a metre away: no platen
  }
  wall_u_.assign(2 * steps * W_);
  wall_du_.assign(2 * steps * W_);
  wall_force_.assign(2 * steps * W_);
  slip_.assign(steps * W_);
  damping_.assign(steps * W_);
  built_at_.assign(n_grains() * W_, Vec2{});
  const GaugeWeights gauge = gauge_weights(*packing_);
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const auto i = static_cast<std::size_t>(layout_.order[g]);
    const double area = pi * radius_[g] * radius_[g];
    grain_const_.push_back({T(1.0 / area), T(2.0 / (area * radius_[g] * radius_[g])), T(radius_[g]),
                            T(gauge.x[i]), T(gauge.y[i])});
  }
}

template <class T>
void Group<T>::reset_lane(int lane) {
  const auto l = static_cast<std::size_t>(lane);
  at(lane) = Lane{};
  for (std::size_t g = 0; g < n_grains(); ++g) {
    for (int f = 0; f < n_grain_fields; ++f) grain(g, f, l) = T(0);
    for (int wall = 0; wall < 2; ++wall) {
      wall_gap_[wall][g * W_ + l] = T(1);
      wall_shear_[wall][g * W_ + l] = T(0);
    }
  }
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    for (int f = 0; f < n_contact_fields; ++f) contact(c, f, l) = T(0);
    set_[c * W_ + l] = no_set;
    tag_[c * W_ + l] = 0;
  }
  dirty_ = true;
}

template <class T>
void Group<T>::load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) {
  PHY_CHECK(specimen->packing->hash == packing_->hash, "lanes of a group share one packing");
  reset_lane(lane);
  Lane& l = at(lane);
  l.setup = setup;
  l.fresh = true;
  l.hold = specimen->matrix.unbreakable;
  l.bound.emplace(*specimen, initial_stiffnesses(*specimen));
  for (const Contact& c : specimen->contacts) {
    const Disc& a = packing_->discs[c.a];
    const Disc& b = packing_->discs[c.b];
    const bool touches = norm(Vec2{b.x - a.x, b.y - a.y}) <= a.r + b.r;
    l.n_contacts += c.kind != ContactKind::touching || touches ? 1 : 0;
  }
  l.specimen = std::move(specimen);
  renew_step(l);
}

// Grains whose packing overlaps the platen's line touch it from the start, stress-free; the others keep their
// gap.
template <class T>
void Group<T>::place_platens(int lane) {
  const auto l = static_cast<std::size_t>(lane);
  Lane& info = at(lane);
  for (int wall = 0; wall < 2; ++wall) {
    const double up = wall == 0 ? 1.0 : -1.0;
    const auto gap_of = [&](std::size_t g) {
      return (wall == 0 ? x0_[g].y : packing_->height - x0_[g].y) - radius_[g];
    };
    double sum = 0.0, count = 0.0;
    for (std::size_t g = 0; g < n_grains(); ++g)
      if (gap_of(g) <= 0.0) sum += up * grain(g, g_uy, l), count += 1.0;
    const double mean = count > 0.0 ? sum / count : 0.0;
    for (std::size_t g = 0; g < n_grains(); ++g) {
      const double u = up * grain(g, g_uy, l);
      const double gap = gap_of(g) <= 0.0 ? -u : std::max(gap_of(g) - mean, -u);
      wall_gap_[wall][g * W_ + l] = T(gap);
      wall_shear_[wall][g * W_ + l] = T(0);
    }
    info.wall[wall] = 0.0;
    info.last_force[wall] = 0.0;
  }
  info.platens = true;
  info.work = info.slip = info.damping = info.released = 0.0;
  info.time = info.drive_time = 0.0;
  info.step = 0;
  const HistoryRow& r = info.row;
  info.base_energy = r.kinetic + r.strain_linear + r.strain_bond + r.strain_joint;
  info.base_axial = r.axial_strain_gauge;
  info.base_lateral = r.lateral_strain_gauge;
  info.cracks.clear();
  info.row = HistoryRow{};
  dirty_ = true;
}

template <class T>
void Group<T>::jump(int lane, double axial_strain) {
  if (dirty_) rebuild();
  const auto l = static_cast<std::size_t>(lane);
  Lane& info = at(lane);
  constexpr double lateral =
      0.25;  // a first guess of Poisson's ratio; the damped cycles that follow correct it
  const auto field = [&](Vec2 x) {
    return Vec2{lateral * axial_strain * (x.x - 0.5 * packing_->width),
                -axial_strain * (x.y - 0.5 * packing_->height)};
  };
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const Vec2 u = field(x0_[g]);
    grain(g, g_ux, l) = T(u.x);
    grain(g, g_uy, l) = T(u.y);
  }
  for (double& w : info.wall) w = 0.5 * axial_strain * packing_->height;
  const MatrixRecipe& m = info.specimen->matrix;
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    const ContactConst<T>& k = contact_const_[c];
    const Vec2 xa = x0_[static_cast<std::size_t>(k.a)], xb = x0_[static_cast<std::size_t>(k.b)];
    const Vec2 du = field(xb) - field(xa);
    if (contact(c, c_side, l) != T(0)) {
      const BeddingRecipe& set = info.specimen->bedding[set_[c * W_ + l]];
      const SinCos sc = sin_cos_degrees(set.theta);
      const double side = static_cast<double>(contact(c, c_side, l));
      const Vec2 n{-sc.sin * side, sc.cos * side};
      contact(c, c_shear, l) =
          T(-set.k_s * set.radius_multiplier * static_cast<double>(k.area) * dot(du, tangent(n)));
      contact(c, c_bond, l) = T(-dot(du, n));
      continue;
    }
    const Vec2 branch = xb - xa;
    const Vec2 n = (1.0 / norm(branch)) * branch;
    const double slide = dot(du, tangent(n));
    const double closure = -dot(du, n) - static_cast<double>(k.gap);
    const double k_n = m.E_c * static_cast<double>(k.f_lin);
    const double limit = (m.unbreakable ? hold_force : m.mu) * k_n * std::max(closure, 0.0);
    contact(c, c_shear, l) = T(std::clamp(-m.ks_over_kn * k_n * slide, -limit, limit));
    if (contact(c, c_capacity, l) > T(0)) {
      const double kb = m.E_b * m.radius_multiplier * static_cast<double>(k.f_bond);
      contact(c, c_bond, l) = T(-m.bond_ks_over_kn * kb * slide);
    }
  }
  info.settle_books = true;
  dirty_ = true;
}

template <class T>
bool Group<T>::at_strength(int lane) const {
  const auto l = static_cast<std::size_t>(lane);
  const Lane& info = at(lane);
  const MatrixRecipe& m = info.specimen->matrix;
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    const double capacity = contact(c, c_capacity, l);
    if (!(capacity > 0.0)) continue;
    const ContactConst<T>& k = contact_const_[c];
    if (contact(c, c_side, l) != 0.0) {
      const BeddingRecipe& set = info.specimen->bedding[set_[c * W_ + l]];
      const double A = set.radius_multiplier * static_cast<double>(k.area);
      const double F_n = set.k_n * A * (contact(c, c_bond, l) + contact(c, c_strength, l));
      const double S = set.cohesion * A + F_n * tan_degrees(set.phi);
      if (-F_n >= capacity || std::fabs(contact(c, c_shear, l)) >= S) return true;
      continue;
    }
    const auto a = static_cast<std::size_t>(k.a), b = static_cast<std::size_t>(k.b);
    const Vec2 d0 = x0_[b] - x0_[a];
    const Vec2 d = d0 + displacement(b, l) - displacement(a, l);
    const double F_n = m.E_b * m.radius_multiplier * static_cast<double>(k.f_bond) * (norm(d0) - norm(d));
    const double lambda3 = m.radius_multiplier * m.radius_multiplier * m.radius_multiplier;
    const double M =
        m.E_b * lambda3 * static_cast<double>(k.f_bend) * std::fabs(grain(b, g_rot, l) - grain(a, g_rot, l));
    const double arm = 3.0 * m.moment_contribution / m.radius_multiplier * static_cast<double>(k.inv_rmin);
    const double tan_phi = m.shear_strength == ShearStrength::constant ? 0.0 : tan_degrees(m.phi);
    const double S = contact(c, c_strength, l) + F_n * tan_phi;
    if (arm * M - F_n >= capacity || std::fabs(contact(c, c_bond, l)) >= S) return true;
  }
  return false;
}

template <class T>
void Group<T>::set_motion(int lane, std::uint32_t id, const GrainState& state, Vec2 velocity, double spin) {
  const auto g = static_cast<std::size_t>(layout_.rank[id]);
  const auto l = static_cast<std::size_t>(lane);
  grain(g, g_ux, l) = T(state.ux);
  grain(g, g_uy, l) = T(state.uy);
  grain(g, g_rot, l) = T(state.rotation);
  grain(g, g_vx, l) = T(velocity.x);
  grain(g, g_vy, l) = T(velocity.y);
  grain(g, g_w, l) = T(spin);
}

// --- the list of near pairs
// -----------------------------------------------------------------------------------------

/// Searches lanes that have moved far enough that their list would not last; the others keep theirs.
template <class T>
void Group<T>::search(std::size_t l) {
  Lane& lane = lanes_[l];
  if (lane.searched && 4.0 * moved(l) < skin_) return;
  lane.near.clear();
  std::vector<Vec2> x(n_grains());
  for (std::size_t g = 0; g < n_grains(); ++g) {
    built_at_[g * W_ + l] = displacement(g, l);
    x[g] = x0_[g] + built_at_[g * W_ + l];
  }
  near_pairs(x, radius_, skin_, lane.near);
  if (lane.fresh)
    for (const Contact& c : lane.specimen->contacts)
      lane.near.push_back(pair_key(static_cast<std::uint32_t>(layout_.rank[c.a]),
                                   static_cast<std::uint32_t>(layout_.rank[c.b])));
  lane.searched = true;
}

template <class T>
std::vector<PairKey> Group<T>::collect_pairs() {
  PairUnion all(n_grains());
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen) continue;
    search(l);
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
void Group<T>::mark_walls() {
  row_wall_.assign(static_cast<std::size_t>(layout_.n_rows()), 0);
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen || !lanes_[l].platens) continue;
    for (std::size_t g = 0; g < n_grains(); ++g) {
      for (int wall = 0; wall < 2; ++wall) {
        const double up = wall == 0 ? 1.0 : -1.0;
        const double closure =
            lanes_[l].wall[wall] - up * grain(g, g_uy, l) - static_cast<double>(wall_gap_[wall][g * W_ + l]);
        if (closure > -skin_)
          row_wall_[static_cast<std::size_t>(layout_.row_of[g])] |= static_cast<std::uint8_t>(1 << wall);
      }
    }
  }
}

template <class T>
void Group<T>::rebuild() {
  std::vector<PairKey> pairs = collect_pairs();
  carry_state(pairs);
  pairs_ = std::move(pairs);
  make_constants();
  for (std::size_t l = 0; l < W_; ++l)
    if (lanes_[l].fresh) fill_lane(l);
  births();
  assign_joints();
  mark_walls();
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

template <class T>
void Group<T>::births() {
  bool joints = false;
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
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
  lane.bound.emplace(*lane.specimen, contacts);
}

// --- one block
// ------------------------------------------------------------------------------------------------------

template <class T>
void Group<T>::fill_lane_table() {
  for (std::size_t l = 0; l < W_; ++l) {
    const auto put = [&](int field, double value) {
      lane_table_[static_cast<std::size_t>(field) * W_ + l] = T(value);
    };
    for (int f = 0; f < n_lane_fields; ++f) put(f, 0.0);
    const Lane& lane = lanes_[l];
    const MatrixRecipe m = lane.specimen ? lane.specimen->matrix : MatrixRecipe{};
    const double lambda = m.radius_multiplier;
    const double k_wall = linear::wall_stiffness_factor * m.E_c;
    put(l_k_n, m.E_c), put(l_k_s, m.ks_over_kn * m.E_c), put(l_inv_k_s, 1.0 / (m.ks_over_kn * m.E_c));
    put(l_mu, m.unbreakable ? hold_force : m.mu);
    put(l_kb_n, m.E_b * lambda), put(l_kb_s, m.bond_ks_over_kn * m.E_b * lambda);
    put(l_kb_m, m.E_b * lambda * lambda * lambda), put(l_arm, 3.0 * m.moment_contribution / lambda);
    put(l_tan_phi, m.shear_strength == ShearStrength::constant ? 0.0 : tan_degrees(m.phi));
    put(l_hold, lane.hold ? hold_force : 0.0);
    put(l_wall_kn, k_wall), put(l_wall_ks, m.ks_over_kn * k_wall),
        put(l_wall_inv_ks, 1.0 / (m.ks_over_kn * k_wall));
    put(l_wall_mu, lane.setup.platen_friction);
    if (!lane.specimen) continue;
    put(l_dt, lane.dt), put(l_accel, lane.dt / m.density), put(l_damping, lane.setup.damping);
  }
}

template <class T>
void Group<T>::plan_platens() {
  for (std::size_t l = 0; l < W_; ++l) {
    Lane& lane = lanes_[l];
    const double ramp = lane.setup.platen_speed > 0.0
                            ? lane.setup.ramp_strain * packing_->height / lane.setup.platen_speed
                            : 0.0;
    for (std::size_t s = 0; s < static_cast<std::size_t>(options_.interval); ++s) {
      double du = 0.0;
      if (lane.driving) {
        const double fraction = ramp > 0.0 ? std::min(1.0, (lane.drive_time + 0.5 * lane.dt) / ramp) : 1.0;
        du = lane.setup.platen_speed * fraction * lane.dt;
        lane.drive_time += lane.dt;
      }
      for (std::size_t wall = 0; wall < 2; ++wall) {
        lane.wall[wall] += du;
        wall_du_[(2 * s + wall) * W_ + l] = du;
        wall_u_[(2 * s + wall) * W_ + l] = T(lane.wall[wall]);
        wall_force_[(2 * s + wall) * W_ + l] = T(0);
      }
      slip_[s * W_ + l] = T(0);
      damping_[s * W_ + l] = T(0);
    }
  }
}

template <class T>
void Group<T>::advance() {
  if (dirty_) rebuild();
  fill_lane_table();
  plan_platens();
  std::fill_n(sample_.get(), n_sample_fields * W_, 0.0);
  GroupView<T> view;
  view.n_rows = layout_.n_rows();
  view.row_grain = layout_.row_grain.data();
  view.row_contact = row_contact_.data();
  view.row_wall = row_wall_.data();
  view.grain_const = grain_const_.data();
  view.contact_const = contact_const_.data();
  view.grain = grain_.get();
  view.contact = contact_.get();
  view.lane = lane_table_.get();
  view.joint = joint_table_.get();
  for (int wall = 0; wall < 2; ++wall)
    view.wall_gap[wall] = wall_gap_[wall].get(), view.wall_shear[wall] = wall_shear_[wall].get();
  view.wall_u = wall_u_.get();
  view.wall_force = wall_force_.get();
  view.slip = slip_.get();
  view.damping = damping_.get();
  view.sample = sample_.get();
  view.cracks = raw_cracks_.data();
  view.skew = far_rows_ ? 1 : options_.skew;
  kernel_(view, options_.interval);
  std::sort(raw_cracks_.begin(), raw_cracks_.begin() + static_cast<std::ptrdiff_t>(view.n_cracks),
            [](const RawCrack& p, const RawCrack& q) {
              return p.step != q.step         ? p.step < q.step
                     : p.contact != q.contact ? p.contact < q.contact
                                              : p.lane < q.lane;
            });
  raw_cracks_.resize(view.n_cracks);
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen) continue;
    keep_books(l);
    write_row(l);
    watch(l);
  }
  raw_cracks_.resize(pairs_.size() * W_);
  births();
  watch_motion();
}

template <class T>
void Group<T>::keep_books(std::size_t l) {
  Lane& lane = lanes_[l];
  double damping = 0.0;
  for (std::size_t s = 0; s < static_cast<std::size_t>(options_.interval); ++s) {
    for (std::size_t wall = 0; wall < 2; ++wall) {
      const double force = static_cast<double>(wall_force_[(2 * s + wall) * W_ + l]);
      lane.work += 0.5 * (lane.last_force[wall] + force) * wall_du_[(2 * s + wall) * W_ + l];
      lane.last_force[wall] = force;
    }
    lane.slip += static_cast<double>(slip_[s * W_ + l]);
    damping += static_cast<double>(damping_[s * W_ + l]);
  }
  lane.damping += 0.5 * lane.dt * damping;
  for (const RawCrack& raw : raw_cracks_) {
    if (static_cast<std::size_t>(raw.lane) != l) continue;
    const auto c = static_cast<std::size_t>(raw.contact);
    const ContactConst<T>& k = contact_const_[c];
    const auto a = static_cast<std::size_t>(k.a), b = static_cast<std::size_t>(k.b);
    const Vec2 xa = x0_[a] + displacement(a, l), xb = x0_[b] + displacement(b, l);
    const Vec2 n = (1.0 / norm(xb - xa)) * (xb - xa);
    const double side = contact(c, c_side, l);
    CrackEvent e;
    e.step = lane.step + raw.step + 1;
    e.time = lane.time + (raw.step + 1) * lane.dt;
    const double wall_0 = static_cast<double>(wall_u_[(2 * static_cast<std::size_t>(raw.step)) * W_ + l]);
    const double wall_1 = static_cast<double>(wall_u_[(2 * static_cast<std::size_t>(raw.step) + 1) * W_ + l]);
    e.strain = (wall_0 + wall_1) / packing_->height;
    e.a = std::min(packing_id(k.a), packing_id(k.b));
    e.b = std::max(packing_id(k.a), packing_id(k.b));
    e.mode = raw.shear != 0 ? CrackMode::shear : CrackMode::tension;
    e.place = side != 0.0 ? CrackPlace::bedding : CrackPlace::matrix;
    e.position = xa + radius_[a] * n;
    e.normal = n;
    double lambda = lane.specimen->matrix.radius_multiplier;
    if (side != 0.0) {
      const BeddingRecipe& set = lane.specimen->bedding[set_[c * W_ + l]];
      const SinCos sc = sin_cos_degrees(set.theta);
      e.normal = {-sc.sin, sc.cos};
      lambda = set.radius_multiplier;
    }
    e.size = 2.0 * lambda * std::min(radius_[a], radius_[b]);
    e.energy = raw.energy;
    lane.released += raw.energy;
    lane.cracks.push_back(e);
  }
  lane.step += options_.interval;
  lane.time += options_.interval * lane.dt;
}

template <class T>
void Group<T>::write_row(std::size_t l) {
  Lane& lane = lanes_[l];
  HistoryRow& r = lane.row;
  r.step = static_cast<double>(lane.step);
  r.time = lane.time;
  r.axial_strain = (lane.wall[0] + lane.wall[1]) / packing_->height;
  r.axial_strain_gauge = sample(s_gauge_axial, l) - lane.base_axial;
  r.lateral_strain_gauge = sample(s_gauge_lateral, l) - lane.base_lateral;
  r.stress_bottom = lane.last_force[0] / packing_->width;
  r.stress_top = lane.last_force[1] / packing_->width;
  r.axial_stress = 0.5 * (r.stress_bottom + r.stress_top);
  r.n_cracks = static_cast<double>(lane.cracks.size());
  r.kinetic = sample(s_kinetic, l);
  r.strain_linear = sample(s_strain_linear, l);
  r.strain_bond = sample(s_strain_bond, l);
  r.strain_joint = sample(s_strain_joint, l);
  r.strain_wall = sample(s_strain_wall, l);
  r.slip = lane.slip;
  r.damping = lane.damping;
  r.released = lane.released;
  const double held =
      r.kinetic + r.strain_linear + r.strain_bond + r.strain_joint + r.strain_wall - lane.base_energy;
  const double spent = held + r.slip + r.damping + r.released;
  if (lane.settle_books) {
    lane.work = spent;
    lane.settle_books = false;
  }
  r.boundary_work = lane.work;
  r.energy_error = lane.work > 0.0 ? (lane.work - spent) / lane.work : 0.0;
  const double contacts = sample(s_contacts, l), force = sample(s_contact_force, l);
  r.unbalanced =
      force > 0.0 ? sample(s_unbalanced, l) / static_cast<double>(n_grains()) / (force / contacts) : 0.0;
}

template <class T>
void Group<T>::watch(std::size_t l) {
  Lane& lane = lanes_[l];
  const HistoryRow& r = lane.row;
  const double sum =
      r.kinetic + r.strain_linear + r.strain_bond + r.strain_joint + r.axial_stress + r.damping;
  const double overlap = sample(s_overlap, l);
  const std::string when = "at step " + std::to_string(lane.step) + " ";
  if (!std::isfinite(sum))
    lane.health = {false, when + "the energy or the platen force is no longer a number"};
  else if (!(overlap < worst_overlap))
    lane.health = {false,
                   when + "two grains overlap by " + std::to_string(overlap) + " of the smaller radius"};
  else if (lane.platens && r.axial_strain > 1e-4 && std::fabs(r.energy_error) > worst_energy)
    lane.health = {false,
                   when + "the energy balance is off by " + std::to_string(r.energy_error) + " of the work"};
}

// A list is renewed before any pair outside it can touch: when twice the largest motion since it was built,
// plus what the fastest grain can do in the next block, exceeds the skin.
template <class T>
double Group<T>::moved(std::size_t l) const {
  double most = 0.0;
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const Vec2 d = displacement(g, l) - built_at_[g * W_ + l];
    most = std::max(most, dot(d, d));
  }
  return std::sqrt(most);
}

template <class T>
void Group<T>::watch_motion() {
  for (std::size_t l = 0; l < W_ && !dirty_; ++l) {
    if (!lanes_[l].specimen) continue;
    double speed = 0.0;
    for (std::size_t g = 0; g < n_grains(); ++g) {
      const Vec2 v{grain(g, g_vx, l), grain(g, g_vy, l)};
      speed = std::max(speed, dot(v, v));
    }
    const double ahead = std::sqrt(speed) * lanes_[l].dt * options_.interval;
    dirty_ = 2.0 * (moved(l) + ahead) > skin_;
  }
}

template <class T>
ContactState Group<T>::contact_state(std::size_t c, std::size_t l) const {
  const ContactConst<T>& k = contact_const_[c];
  const auto a = static_cast<std::size_t>(k.a), b = static_cast<std::size_t>(k.b);
  const MatrixRecipe& m = lanes_[l].specimen->matrix;
  const Vec2 d0 = x0_[b] - x0_[a];
  const Vec2 d = d0 + displacement(b, l) - displacement(a, l);
  const double side = contact(c, c_side, l);
  const double capacity = contact(c, c_capacity, l);
  ContactState s;
  s.a = packing_id(k.a), s.b = packing_id(k.b);
  s.normal = (1.0 / norm(d)) * d;
  if (side != 0.0) {
    const BeddingRecipe& set = lanes_[l].specimen->bedding[set_[c * W_ + l]];
    const SinCos sc = sin_cos_degrees(set.theta);
    const double A = set.radius_multiplier * static_cast<double>(k.area);
    s.kind = ContactKind::joint;
    s.broken = !(capacity > 0.0);
    s.normal = {-sc.sin * side, sc.cos * side};
    const double g = contact(c, c_bond, l) + contact(c, c_strength, l);
    s.F_n = set.k_n * A * (s.broken ? std::max(g, 0.0) : g);
    s.F_s = contact(c, c_shear, l);
  } else {
    const double closure = norm(d0) - norm(d);
    s.kind = tag_[c * W_ + l] != 0 ? ContactKind::bonded : ContactKind::touching;
    s.broken = s.kind == ContactKind::bonded && !(capacity > 0.0);
    s.F_n = m.E_c * static_cast<double>(k.f_lin) * std::max(closure - static_cast<double>(k.gap), 0.0);
    if (capacity > 0.0) s.F_n += m.E_b * m.radius_multiplier * static_cast<double>(k.f_bond) * closure;
    s.F_s = contact(c, c_shear, l) + contact(c, c_bond, l);
  }
  if (s.a > s.b) {  // seen from the other grain: both directions turn, the scalars stay
    std::swap(s.a, s.b);
    s.normal = -1.0 * s.normal;
  }
  return s;
}

template <class T>
Snapshot Group<T>::snapshot(int lane) const {
  const auto l = static_cast<std::size_t>(lane);
  Snapshot shot;
  shot.step = at(lane).row.step;
  shot.axial_strain = at(lane).row.axial_strain;
  shot.axial_stress = at(lane).row.axial_stress;
  shot.grains = grains(lane);
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    const ContactState s = contact_state(c, l);
    if (s.kind != ContactKind::touching || s.F_n != 0.0) shot.contacts.push_back(s);
  }
  return shot;
}

template <class T>
std::vector<GrainState> Group<T>::grains(int lane) const {
  const auto l = static_cast<std::size_t>(lane);
  std::vector<GrainState> all(n_grains());
  for (std::size_t g = 0; g < n_grains(); ++g)
    all[static_cast<std::size_t>(layout_.order[g])] = {grain(g, g_ux, l), grain(g, g_uy, l),
                                                       grain(g, g_rot, l)};
  return all;
}

}  // namespace

std::unique_ptr<LaneGroup> make_group(std::shared_ptr<const Packing> packing, const GroupOptions& options) {
  if (options.precision == Precision::single_precision)
    return std::make_unique<Group<float>>(std::move(packing), options);
  return std::make_unique<Group<double>>(std::move(packing), options);
}

}  // namespace phy
