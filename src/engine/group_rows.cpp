// What a block leaves behind: energies, cracks, the row of the history, and the check of it by the watchdog.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "engine/group.hpp"

namespace phy::engine::group {
namespace {

constexpr double worst_overlap = 1.0;  // of the smaller radius: beyond it the state is nonsense
constexpr double worst_energy = 0.2;   // of the boundary work: beyond it the step was unstable

bool is_finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

/// Of all that a lane reports.
bool all_numbers(const HistoryRow& row, const LaneBoundary& edge) {
  // Named columns instead of a list of members: a column that is added later is checked too.
  for (const HistoryColumns* columns : {&gauge_columns(), &balance_columns()})
    for (const HistoryColumn& c : *columns)
      if (!std::isfinite(row.*c.value)) return false;
  for (const BodyMotion& t : edge.bodies)
    if (!is_finite(t.state.displacement) || !is_finite(t.state.force)) return false;
  for (const PressedSurface* s : {&edge.sides, &edge.hole})
    if (!is_finite(s->stress) || !std::isfinite(s->swept)) return false;
  return true;
}

}  // namespace

/// Of the axial bodies since the boundary was placed [m].
template <class T>
double Group<T>::travel(std::size_t l) const {
  const LoadAxis& axis = lanes_[l].boundary().axial;
  const LaneBoundary& edge = boundary_.lane(l);
  if (!axis.present() || !edge.placed) return 0.0;
  const auto at = [&](int body) { return edge.bodies[static_cast<std::size_t>(body)].state.displacement; };
  return axis.travel(at(axis.lo), at(axis.hi));
}

template <class T>
void Group<T>::zero_strains(int lane) {
  Lane& info = at(lane);
  HistoryRow& r = info.row;
  info.zero_travel = travel(index(lane));
  // The bases are added to: the row is already relative to the earlier ones.
  info.base_axial += r.axial_strain_gauge, info.base_lateral += r.lateral_strain_gauge;
  r.axial_strain_gauge = r.lateral_strain_gauge = 0.0;
}

/// In the order of steps, contacts, lanes and parts, which no skewing of the loop changes.
template <class T>
void Group<T>::sort_cracks(const GroupView<T>& view) {
  PHY_CHECK(view.n_cracks <= view.max_cracks, "a contact gives no more cracks than its model says");
  // The raw list has room for the most cracks possible; from here on it holds those that occurred.
  raw_cracks_.resize(view.n_cracks);
  std::sort(raw_cracks_.begin(), raw_cracks_.end(), [](const RawCrack& p, const RawCrack& q) {
    return p.step != q.step         ? p.step < q.step
           : p.contact != q.contact ? p.contact < q.contact
           : p.lane != q.lane       ? p.lane < q.lane
                                    : p.part < q.part;
  });
}

template <class T>
void Group<T>::keep_energy(std::size_t l) {
  Lane& lane = lanes_[l];
  boundary_.add_work(l, lane.energy.work);
  double damping = 0.0;
  for (std::size_t s = 0; s < n_steps(); ++s) {
    lane.energy.slip += static_cast<double>(slip_[s * W_ + l]);
    damping += static_cast<double>(damping_[s * W_ + l]);
  }
  // The loop sums force times velocities, which is 2/dt times the work (row_loop.hpp).
  lane.energy.damping += 0.5 * lane.dt * damping;
  for (const RawCrack& raw : raw_cracks_) {
    if (static_cast<std::size_t>(raw.lane) != l) continue;
    lane.energy.released += raw.energy;
    lane.cracks.push_back(breakage(raw, l));
  }
  lane.step += options_.interval;
  lane.time += options_.interval * lane.dt;
}

template <class T>
Breakage Group<T>::breakage(const RawCrack& raw, std::size_t l) const {
  const Lane& lane = lanes_[l];
  const auto c = static_cast<std::size_t>(raw.contact), step = static_cast<std::size_t>(raw.step);
  const std::size_t a = contacts_.grain_a(c), b = contacts_.grain_b(c);
  // Grains as they are at the end of the block, at most one block after the break; time and travel are exact.
  const Vec2 xa = grains_.place(a, l), xb = grains_.place(b, l);
  const std::uint32_t pa = grains_.packing_id(static_cast<std::int32_t>(a)),
                      pb = grains_.packing_id(static_cast<std::int32_t>(b));
  Breakage broken;
  CrackEvent& e = broken.crack;
  // Steps are counted from 1; the lane's counters still stand at the start of the block.
  e.step = lane.step + raw.step + 1;
  e.time = lane.time + (raw.step + 1) * lane.dt;
  if (const LoadAxis& axis = lane.boundary().axial; axis.present() && boundary_.lane(l).placed)
    broken.travel = axis.travel(boundary_.displacement(step, static_cast<std::size_t>(axis.lo), l),
                                boundary_.displacement(step, static_cast<std::size_t>(axis.hi), l));
  e.a = std::min(pa, pb);
  e.b = std::max(pa, pb);
  e.mode = raw.shear != 0 ? CrackMode::shear : CrackMode::tension;
  // Along the branch, on the surface of grain a; a model whose crack lies otherwise overwrites it (an
  // interface: the normal of its plane).
  e.normal = (1.0 / norm(xb - xa)) * (xb - xa);
  e.position = xa + grains_.radius(a) * e.normal;
  contacts_.with(c, l, *lane.specimen, [&](const contact::ContactModel& model, const contact::Standing& now) {
    model.crack(now, static_cast<std::size_t>(raw.part), e);
  });
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
  lane.energy.write(r);
  const double contacts = sample(s_contacts, l), force = sample(s_contact_force, l);
  // Mean resultant force of a grain over mean contact force: 0 in equilibrium, without unit.
  r.unbalanced =
      force > 0.0 ? sample(s_unbalanced, l) / static_cast<double>(grains_.size()) / (force / contacts) : 0.0;
}

/// The pair that the watchdog has met, in words. Interfaces do not count: their grains may slide into each
/// other.
template <class T>
std::string Group<T>::deepest_overlap(std::size_t l) const {
  double deepest = 0.0;
  std::size_t worst = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const double r_min = std::min(grains_.radius(contacts_.grain_a(c)), grains_.radius(contacts_.grain_b(c)));
    const double overlap = contacts_.overlap(c, l) / r_min;
    if (!contacts_.interface(c, l) && overlap > deepest) deepest = overlap, worst = c;
  }
  const PairKey pair = contacts_.pairs()[worst];
  const std::uint32_t a = grains_.packing_id(key_a(pair)), b = grains_.packing_id(key_b(pair));
  const char* bond = !contacts_.original(worst, l)  ? "not bonded"
                     : contacts_.unbroken(worst, l) ? "bonded"
                                                    : "their bond broken";
  return fmt::format("grains {} and {} ({}) overlap by {:.2g} of the smaller radius", std::min(a, b),
                     std::max(a, b), bond, deepest);
}

/// Two grains that overlap unseen; looked for only where a grain has gone beyond what any list allows for.
template <class T>
std::optional<PairKey> Group<T>::missed_pair(std::size_t l, double farthest_way) const {
  // Cheap filter: within usual_range() no pair can have passed beyond the list.
  if (!(farthest_way > list_.usual_range())) return std::nullopt;
  // Bonded pairs may overlap or lie apart without being in a lane's search: they are in the list for good.
  return list_.missed(l, [&](PairKey key) {
    const std::size_t c = contacts_.find(key);
    return c < contacts_.size() && contacts_.original(c, l);
  });
}

template <class T>
void Group<T>::watch(std::size_t l, const HistoryRow& before, double farthest_way) {
  Lane& lane = lanes_[l];
  HistoryRow& r = lane.row;
  const double overlap = sample(s_overlap, l);
  const bool numbers = all_numbers(r, boundary_.lane(l)) && std::isfinite(overlap);
  // NaN first: comparisons with it are false and would let everything pass.
  const std::optional<PairKey> missed = numbers ? missed_pair(l, farthest_way) : std::nullopt;
  std::string& reason = lane.health.reason;
  if (!numbers)
    reason = "energies or forces are no numbers any more";
  else if (missed)
    reason = fmt::format(
        "grains {} and {} have met unseen: one has flown farther within a block than contacts are "
        "looked for",
        grains_.packing_id(key_a(*missed)), grains_.packing_id(key_b(*missed)));
  else if (overlap >= worst_overlap)
    reason = deepest_overlap(l);
  // Before the bodies have travelled `loaded`, the work is too small for a relative error to mean anything.
  else if (std::fabs(travel(l) - lane.zero_travel) > lane.boundary().axial.loaded &&
           std::fabs(r.energy_error) > worst_energy)
    reason = fmt::format("the energy balance is off by {:.2g} of the work", r.energy_error);
  else
    return;
  lane.health.outran = missed.has_value();
  lane.health.ok = false;
  lane.health.reason = fmt::format("at step {} {}", lane.step, lane.health.reason);
  // The rejected row must not enter a history or a result: the last good one stays, with the time of the
  // failure.
  const double step = r.step, time = r.time;
  r = before;
  r.step = step, r.time = time;
}

template class Group<double>;
template class Group<float>;

}  // namespace phy::engine::group
