#include "engine/group.hpp"

namespace phy::group {
namespace {

constexpr double skin_factor = 0.25;  // near pairs are listed up to a gap of skin_factor * r_min

}  // namespace

template <class T>
Group<T>::Group(std::shared_ptr<const Packing> packing, const GroupOptions& options)
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

template <class T>
void Group<T>::allocate() {
  grain_.assign(n_grains() * n_grain_fields * W_);
  lane_table_.assign(n_lane_fields * W_);
  sample_.assign(n_sample_fields * W_);
  slip_.assign(n_steps() * W_);
  damping_.assign(n_steps() * W_);
  built_at_.assign(n_grains() * W_, Vec2{});
  row_touch_.assign(static_cast<std::size_t>(layout_.n_rows()) + 1, 0);
  row_grip_ = row_load_ = row_touch_;
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
  for (std::size_t g = 0; g < n_grains(); ++g)
    for (int f = 0; f < n_grain_fields; ++f) grain(g, f, l) = T(0);
  for (std::size_t p = 0; p < n_tools_ * n_grains(); ++p) {
    touch_gap_[p * W_ + l] = T(far_away);
    touch_shear_[p * W_ + l] = T(0);
  }
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    for (int f = 0; f < n_contact_fields; ++f) contact(c, f, l) = T(0);
    set_[c * W_ + l] = no_set;
    tag_[c * W_ + l] = 0;
  }
  dirty_ = true;
}

/// The constants of a contact are those of all lanes (make_constants).
template <class T>
void Group<T>::check_mate(const Specimen& specimen) const {
  PHY_CHECK(specimen.packing->hash == packing_->hash, "lanes of a group share one packing");
  for (const Lane& l : lanes_)
    PHY_CHECK(!l.specimen || l.specimen->matrix.stiffness_convention == specimen.matrix.stiffness_convention,
              "lanes of a group share one stiffness convention");
}

template <class T>
void Group<T>::load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) {
  reset_lane(lane);
  check_mate(*specimen);
  Lane& l = at(lane);
  l.setup = setup;
  l.fresh = true;
  l.hold = specimen->matrix.unbreakable;
  if (!l.setup.rig) l.setup.rig = std::make_shared<const Rig>();
  adopt_rig(l.rig());
  l.tools.resize(n_tools_);
  l.bound.emplace(*specimen, initial_stiffnesses(*specimen), l.rig());
  for (const Contact& c : specimen->contacts) {
    const Disc& a = packing_->discs[c.a];
    const Disc& b = packing_->discs[c.b];
    const bool touches = norm(Vec2{b.x - a.x, b.y - a.y}) <= a.r + b.r;
    l.n_contacts += c.kind != ContactKind::touching || touches ? 1 : 0;
  }
  l.specimen = std::move(specimen);
  renew_step(l);
}

template <class T>
void Group<T>::set_motion(int lane, std::uint32_t id, const GrainState& state, Vec2 velocity, double spin) {
  const std::size_t g = sorted_id(id);
  const auto l = static_cast<std::size_t>(lane);
  grain(g, g_ux, l) = T(state.ux);
  grain(g, g_uy, l) = T(state.uy);
  grain(g, g_rot, l) = T(state.rotation);
  grain(g, g_vx, l) = T(velocity.x);
  grain(g, g_vy, l) = T(velocity.y);
  grain(g, g_w, l) = T(spin);
}

/// The field's energy is work of the laboratory: it enters the books as such.
template <class T>
void Group<T>::start_moving(int lane, const std::function<Vec2(Vec2)>& velocity) {
  const auto l = static_cast<std::size_t>(lane);
  Lane& info = at(lane);
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const Vec2 v = velocity(x0_[g]);
    grain(g, g_vx, l) = T(v.x);
    grain(g, g_vy, l) = T(v.y);
    info.work += 0.5 * info.specimen->matrix.density * pi * radius_[g] * radius_[g] * dot(v, v);
  }
}

template <class T>
void Group<T>::jump(int lane, double axial_strain) {
  if (dirty_) rebuild();
  const auto l = static_cast<std::size_t>(lane);
  Lane& info = at(lane);
  constexpr double lateral = 0.25;  // Poisson's ratio, a guess; the damped cycles that follow correct it
  const auto field = [&](Vec2 x) {
    return Vec2{lateral * axial_strain * (x.x - 0.5 * packing_->width),
                -axial_strain * (x.y - 0.5 * packing_->height)};
  };
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const Vec2 u = field(x0_[g]);
    grain(g, g_ux, l) = T(u.x);
    grain(g, g_uy, l) = T(u.y);
  }
  const LoadAxis& axis = info.rig().axial;
  const Vec2 closing = 0.5 * axial_strain * packing_->height * axis.direction;
  info.tools[static_cast<std::size_t>(axis.lo)].state.displacement = closing;
  info.tools[static_cast<std::size_t>(axis.hi)].state.displacement = -1.0 * closing;
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
    put(l_wall_mu, lane.setup.tool_friction);
    if (!lane.specimen) continue;
    put(l_grips, lane.placed ? 1.0 : 0.0);
    put(l_dt, lane.dt), put(l_accel, lane.dt / m.density), put(l_damping, lane.setup.damping);
  }
}

template <class T>
GroupView<T> Group<T>::view() {
  GroupView<T> v;
  v.n_rows = layout_.n_rows();
  v.row_grain = layout_.row_grain.data(), v.row_contact = row_contact_.data();
  v.row_touch = row_touch_.data(), v.row_grip = row_grip_.data(), v.row_load = row_load_.data();
  v.grain_const = grain_const_.data(), v.contact_const = contact_const_.data();
  v.grain = grain_.get(), v.contact = contact_.get();
  v.lane = lane_table_.get(), v.joint = joint_table_.get();
  v.n_tools = static_cast<int>(n_tools_), v.n_grains = static_cast<int>(n_grains());
  v.touch = touch_.data(), v.grip = grip_.data(), v.load = load_.data(), v.load_force = load_force_.get();
  v.touch_gap = touch_gap_.get(), v.touch_shear = touch_shear_.get();
  v.tool_u = tool_u_.get(), v.tool_v = tool_v_.get(), v.tool_force = tool_force_.get();
  v.n_balanced = static_cast<int>(balanced_.size()), v.balanced = balanced_.data(),
  v.balanced_touch = balanced_touch_.data();
  v.balance_on = balance_on_.get(), v.balance_force = balance_force_.get();
  v.slip = slip_.get(), v.damping = damping_.get(), v.sample = sample_.get();
  v.cracks = raw_cracks_.data();
  v.skew = far_rows_ ? 1 : options_.skew;
  return v;
}

template <class T>
void Group<T>::advance() {
  fit_jackets();
  if (dirty_) rebuild();
  fill_lane_table();
  plan_tools();
  std::fill_n(sample_.get(), n_sample_fields * W_, 0.0);
  std::fill_n(slip_.get(), n_steps() * W_, T(0));
  std::fill_n(damping_.get(), n_steps() * W_, T(0));
  GroupView<T> v = view();
  kernel_(v, options_.interval);
  read_balance();
  std::sort(raw_cracks_.begin(), raw_cracks_.begin() + static_cast<std::ptrdiff_t>(v.n_cracks),
            [](const RawCrack& p, const RawCrack& q) {
              return p.step != q.step         ? p.step < q.step
                     : p.contact != q.contact ? p.contact < q.contact
                                              : p.lane < q.lane;
            });
  raw_cracks_.resize(v.n_cracks);
  const Farthest most = farthest();
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen) continue;
    keep_books(l);
    const HistoryRow before = lanes_[l].row;
    write_row(l);
    watch(l, before, most.moved[l]);
  }
  raw_cracks_.resize(pairs_.size() * W_);
  births();
  watch_motion(most);
}

template <class T>
Snapshot Group<T>::snapshot(int lane) const {
  const auto l = static_cast<std::size_t>(lane);
  Snapshot shot;
  shot.step = at(lane).row.step;
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

template class Group<double>;
template class Group<float>;

}  // namespace phy::group

namespace phy {

std::unique_ptr<LaneGroup> make_group(std::shared_ptr<const Packing> packing, const GroupOptions& options) {
  if (options.precision == Precision::single_precision)
    return std::make_unique<group::Group<float>>(std::move(packing), options);
  return std::make_unique<group::Group<double>>(std::move(packing), options);
}

}  // namespace phy
