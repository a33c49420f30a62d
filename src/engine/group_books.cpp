#include "engine/group.hpp"

#include <fmt/format.h>

namespace phy::group {
namespace {

constexpr double worst_overlap = 1.0;  // of the smaller radius: beyond it the state is nonsense
constexpr double worst_energy = 0.2;   // of the boundary work: beyond it the step was unstable

bool is_finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

/// Of all that a lane reports.
bool all_numbers(const Lane& lane) {
  for (const HistoryColumns& columns : {gauge_columns(), book_columns()})
    for (const HistoryColumn& c : columns)
      if (!std::isfinite(lane.row.*c.value)) return false;
  for (const ToolMotion& t : lane.tools)
    if (!is_finite(t.state.displacement) || !is_finite(t.state.force)) return false;
  return std::isfinite(lane.pressure) && std::isfinite(lane.swept);
}

}  // namespace

/// Work of tools and jacket in the last block.
template <class T>
void Group<T>::book_tools(std::size_t l) {
  Lane& lane = lanes_[l];
  for (ToolMotion& t : lane.tools) t.state.mean_force = {};
  for (std::size_t s = 0; s < n_steps(); ++s) {
    for (std::size_t t = 0; t < lane.tools.size(); ++t) {
      ToolState& state = lane.tools[t].state;
      const Vec2 force = tool_vector(tool_force_, s, t, l);
      const std::size_t i = tool_at(s, t, l);
      lane.work += dot(0.5 * (state.force + force), {tool_du_[i], tool_du_[i + W_]});
      state.force = force;
      state.mean_force = state.mean_force + (1.0 / options_.interval) * force;
    }
  }
  if (!jacket_ || !lane.placed) return;
  const double swept = area_swept(l) - lane.swept_from;
  lane.work += lane.pressure * swept;
  lane.swept += swept;
}

template <class T>
void Group<T>::keep_books(std::size_t l) {
  Lane& lane = lanes_[l];
  book_tools(l);
  double damping = 0.0;
  for (std::size_t s = 0; s < n_steps(); ++s) {
    lane.slip += static_cast<double>(slip_[s * W_ + l]);
    damping += static_cast<double>(damping_[s * W_ + l]);
  }
  lane.damping += 0.5 * lane.dt * damping;
  for (const RawCrack& raw : raw_cracks_) {
    if (static_cast<std::size_t>(raw.lane) != l) continue;
    lane.released += raw.energy;
    lane.cracks.push_back(breakage(raw, l));
  }
  lane.step += options_.interval;
  lane.time += options_.interval * lane.dt;
}

template <class T>
Breakage Group<T>::breakage(const RawCrack& raw, std::size_t l) const {
  const Lane& lane = lanes_[l];
  const auto c = static_cast<std::size_t>(raw.contact), step = static_cast<std::size_t>(raw.step);
  const ContactConst<T>& k = contact_const_[c];
  const auto a = static_cast<std::size_t>(k.a), b = static_cast<std::size_t>(k.b);
  const Vec2 xa = x0_[a] + displacement(a, l), xb = x0_[b] + displacement(b, l);
  const Vec2 n = (1.0 / norm(xb - xa)) * (xb - xa);
  const bool joint = contact(c, c_side, l) != 0.0;
  Breakage broken;
  CrackEvent& e = broken.crack;
  e.step = lane.step + raw.step + 1;
  e.time = lane.time + (raw.step + 1) * lane.dt;
  if (const LoadAxis& axis = lane.rig().axial; axis.present() && lane.placed)
    broken.travel = axis.travel(tool_vector(tool_u_, step, static_cast<std::size_t>(axis.lo), l),
                                tool_vector(tool_u_, step, static_cast<std::size_t>(axis.hi), l));
  e.a = std::min(packing_id(k.a), packing_id(k.b));
  e.b = std::max(packing_id(k.a), packing_id(k.b));
  e.mode = raw.shear != 0 ? CrackMode::shear : CrackMode::tension;
  e.place = joint ? CrackPlace::bedding : CrackPlace::matrix;
  e.position = xa + radius_[a] * n;
  e.normal = n;
  double lambda = lane.specimen->matrix.radius_multiplier;
  if (joint) {
    const BeddingRecipe& set = lane.specimen->bedding[set_[c * W_ + l]];
    const SinCos sc = sin_cos_degrees(set.theta);
    e.normal = {-sc.sin, sc.cos};
    lambda = set.radius_multiplier;
  }
  e.size = 2.0 * lambda * std::min(radius_[a], radius_[b]);
  e.energy = raw.energy;
  return broken;
}

template <class T>
void Group<T>::write_row(std::size_t l) {
  Lane& lane = lanes_[l];
  HistoryRow& r = lane.row;
  r.step = static_cast<double>(lane.step);
  r.time = lane.time;
  r.axial_strain_gauge = sample(s_gauge_axial, l) - lane.base_axial;
  r.lateral_strain_gauge = sample(s_gauge_lateral, l) - lane.base_lateral;
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

/// The pair that the watchdog has met, in words. Joints do not count: their grains may slide into each other.
template <class T>
std::string Group<T>::deepest_overlap(std::size_t l) const {
  double deepest = 0.0;
  std::size_t worst = 0;
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    const ContactConst<T>& k = contact_const_[c];
    const auto a = static_cast<std::size_t>(k.a), b = static_cast<std::size_t>(k.b);
    const Vec2 d0 = x0_[b] - x0_[a], d = d0 + displacement(b, l) - displacement(a, l);
    const double overlap =
        (norm(d0) - norm(d) - static_cast<double>(k.gap)) * static_cast<double>(k.inv_rmin);
    if (contact(c, c_side, l) == 0.0 && overlap > deepest) deepest = overlap, worst = c;
  }
  const std::uint32_t a = packing_id(contact_const_[worst].a), b = packing_id(contact_const_[worst].b);
  const char* bond = tag_[worst * W_ + l] == 0             ? "not bonded"
                     : contact(worst, c_capacity, l) > 0.0 ? "bonded"
                                                           : "their bond broken";
  return fmt::format("grains {} and {} ({}) overlap by {:.2g} of the smaller radius", std::min(a, b),
                     std::max(a, b), bond, deepest);
}

template <class T>
void Group<T>::watch(std::size_t l, const HistoryRow& before, double farthest_way) {
  Lane& lane = lanes_[l];
  HistoryRow& r = lane.row;
  const double overlap = sample(s_overlap, l);
  const bool numbers = all_numbers(lane) && std::isfinite(overlap);
  const bool beyond = numbers && farthest_way > 0.5 * skin_;  // what any list allows for
  const std::optional<PairKey> missed = beyond ? missed_pair(l) : std::nullopt;
  std::string& reason = lane.health.reason;
  if (!numbers)
    reason = "energies or forces are no numbers any more";
  else if (missed)
    reason = fmt::format(
        "grains {} and {} have met unseen: one has flown farther within a block than contacts are "
        "looked for",
        packing_id(key_a(*missed)), packing_id(key_b(*missed)));
  else if (overlap >= worst_overlap)
    reason = deepest_overlap(l);
  else if (std::fabs(lane.travel() - lane.zero_travel) > lane.rig().axial.loaded &&
           std::fabs(r.energy_error) > worst_energy)
    reason = fmt::format("the energy balance is off by {:.2g} of the work", r.energy_error);
  else
    return;
  lane.health.outran = missed.has_value();
  lane.health.ok = false;
  lane.health.reason = fmt::format("at step {} {}", lane.step, lane.health.reason);
  const double step = r.step, time = r.time;
  r = before;
  r.step = step, r.time = time;
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

template class Group<double>;
template class Group<float>;

}  // namespace phy::group
