#include "survey/unusual.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "survey/cells.hpp"

namespace phy::survey {
namespace {

using Findings = std::vector<Finding>;

/// Bounds are wide on purpose: they are there for units off by a thousand and for columns exchanged.
struct Usual {
  Property property;
  double least, most;  // SI
};
constexpr Usual usual_values[] = {
    {Property::E, 0.1e9, 200e9},
    {Property::ucs, 0.25e6, 600e6},                // below, the ISRM's grades of rock end
    {Property::fracture_toughness, 0.03e6, 10e6},  // 0.1 to 4 MPa sqrt(m) of most rocks
};
constexpr double least_ratio = 80.0, most_ratio = 2000.0;  // E/UCS; 200 to 500: medium (Deere & Miller 1966)
constexpr double most_tension = 0.5;                       // of UCS; a tenth is usual
// UCS over I_s(50): 24 of hard rock (Broch & Franklin 1972), 14 of soft rock (Agustawijaya 2007, Civil Eng.
// Dimension 9:9-14); the limits are there for units and columns.
constexpr double least_over_point_load = 8.0, most_over_point_load = 50.0;
// Of a plane in rock: friction at 56 degrees, a cohesion of half of UCS (Coulomb's, without friction).
constexpr double most_friction = 1.5, most_cohesion = 0.5;
constexpr double least_of_bedding = 0.7;  // of what it carried in a test of UCS; specimens scatter
constexpr double replicates_factor = 1.5;
constexpr double least_range_of_angles = 20.0;                 // [deg]
constexpr double least_scatter = 0.003, most_scatter = 0.5;    // SD over the value; a tenth is usual
constexpr double least_intercept = 0.7, most_intercept = 1.6;  // of UCS; envelopes bend down from a line
constexpr double least_range_of_stress = 2.0;                  // factor, of strengths that make a line
constexpr double falls_by = 2.0;                               // standard errors
constexpr double along = 80.0;  // [deg], from which a load runs along the bedding

const Target* find_at(const std::vector<Target>& targets, Property p, double theta) {
  const auto it = std::find_if(targets.begin(), targets.end(),
                               [&](const Target& t) { return t.property == p && t.theta == theta; });
  return it != targets.end() ? &*it : nullptr;
}

void doubt_values(const Rock& rock, const std::vector<Target>& targets, Findings& found) {
  for (const Usual& usual : usual_values) {
    Finding f{FindingKind::unusual_value, {}, {{"least", usual.least}, {"most", usual.most}}};
    f.advice = Advice::check_unit;
    for (const Target& t : of_property(targets, usual.property))
      if (t.mean < usual.least || t.mean > usual.most)
        f.cells.push_back(cell_in(rock, t)), f.numbers.push_back({"value", t.mean});
    if (!f.cells.empty()) found.push_back(std::move(f));
  }
}

/// Ratios to UCS at the same angle.
void doubt_ratios(const Rock& rock, const std::vector<Target>& targets, Findings& found) {
  Finding moduli{FindingKind::unusual_modulus_ratio}, tension{FindingKind::unusual_tension};
  moduli.advice = tension.advice = Advice::check_unit_and_column;
  for (const Target& t : targets) {
    const Target* ucs = find_at(targets, Property::ucs, t.theta);
    const bool is_modulus = t.property == Property::E;
    // what stands in for a test by an empirical relation has another ratio to UCS
    const bool is_tension = is_tensile(t.property) && measured(t.property).share == 1.0;
    if (ucs == nullptr || !(is_modulus || is_tension)) continue;
    const double ratio = t.mean / ucs->mean;
    const bool usual = is_modulus ? ratio >= least_ratio && ratio <= most_ratio : ratio <= most_tension;
    if (usual) continue;
    Finding& f = is_modulus ? moduli : tension;
    f.cells.push_back(cell_in(rock, t)), f.numbers.push_back({"ratio", ratio});
  }
  for (Finding& f : {std::ref(moduli), std::ref(tension)})
    if (!f.cells.empty()) found.push_back(std::move(f));
}

/// UCS over the point load index at the same angle.
void doubt_point_load(const Rock& rock, const std::vector<Target>& targets, Findings& found) {
  Finding f{FindingKind::unusual_point_load};
  f.advice = Advice::check_unit_and_column;
  for (const Target& t : of_property(targets, Property::point_load)) {
    const Target* ucs = find_at(targets, Property::ucs, t.theta);
    if (ucs == nullptr) continue;
    const double ratio = ucs->mean / t.mean;
    if (ratio >= least_over_point_load && ratio <= most_over_point_load) continue;
    f.cells.push_back(cell_in(rock, t)), f.numbers.push_back({"ratio", ratio});
  }
  if (!f.cells.empty()) found.push_back(std::move(f));
}

/// Direct shear of the bedding against UCS. In a test of UCS at theta it carries a shear stress of
/// UCS sin(theta) cos(theta) under UCS cos^2(theta): under more than that it carries no less. And no plane is
/// stronger than the strongest rock.
void doubt_shear(const Rock& rock, const std::vector<Target>& targets, Findings& found) {
  const std::vector<Target> all_ucs = of_property(targets, Property::ucs);
  if (all_ucs.empty()) return;
  const Target& strongest = *std::ranges::max_element(all_ucs, {}, &Target::mean);
  for (const Target& t : of_property(targets, Property::shear_peak)) {
    Finding f{
        FindingKind::unusual_shear, {cell_in(rock, t), cell_in(rock, strongest)}, {{"laboratory", t.mean}}};
    f.advice = Advice::check_unit_and_column;
    if (const double most = most_cohesion * strongest.mean + most_friction * t.confining; t.mean > most) {
      f.numbers.push_back({"most", most});
      found.push_back(f);
      continue;
    }
    double least = 0.0;
    for (const Target& u : all_ucs) {
      const double angle = u.theta * std::acos(-1.0) / 180.0,
                   carried = u.mean * std::sin(angle) * std::cos(angle);
      if (u.mean * std::pow(std::cos(angle), 2.0) <= t.confining && carried > least)
        least = carried, f.cells[1] = cell_in(rock, u);
    }
    if (t.mean >= least_of_bedding * least) continue;
    f.numbers.push_back({"least", least});
    found.push_back(f);
  }
}

/// Where a straight line through strengths over confining stress meets zero stress; NaN: they are too near
/// to each other.
double intercept_of(const std::vector<const Target*>& confined) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Target* t : confined)
    n += 1.0, x += t->confining, y += t->mean, xx += t->confining * t->confining,
        xy += t->confining * t->mean;
  if (confined.size() < 2 || confined.back()->confining < least_range_of_stress * confined.front()->confining)
    return nan;
  return (y * xx - x * xy) / (n * xx - x * x);
}

/// sigma_1 - sigma_3 never falls under confinement, whatever the rock.
void doubt_falling(const Rock& rock, const Target& low, const Target& high, Findings& found) {
  const double from = low.mean - low.confining, to = high.mean - high.confining;
  if (to - from >= -falls_by * std::hypot(high.normal_error(), low.normal_error())) return;
  found.push_back({FindingKind::strength_falls,
                   {cell_in(rock, low), cell_in(rock, high)},
                   {{"from", from}, {"to", to}},
                   {},
                   Advice::check_pressures});
}

void doubt_intercept(const Rock& rock, const Target& ucs, const std::vector<const Target*>& confined,
                     Findings& found) {
  const double intercept = intercept_of(confined);
  // NaN is no doubt
  if (!(intercept < least_intercept * ucs.mean) && !(intercept > most_intercept * ucs.mean)) return;
  found.push_back({FindingKind::off_envelope,
                   {cell_in(rock, ucs)},
                   {{"laboratory", ucs.mean},
                    {"envelope", intercept},
                    {"from", confined.front()->confining},
                    {"to", confined.back()->confining}},
                   {},
                   Advice::check_envelope});
}

/// Strengths under confinement against UCS at the same angle, and against each other.
void doubt_confined(const Rock& rock, const std::vector<Target>& targets, Findings& found) {
  std::map<double, std::vector<const Target*>> at_angles;  // by stress
  for (const Target& t : targets)
    if (t.property == Property::confined) at_angles[t.theta].push_back(&t);
  Findings intercepts;  // after all that fall
  for (const auto& [theta, confined] : at_angles) {
    const Target* ucs = find_at(targets, Property::ucs, theta);
    const Target* below = ucs;
    for (const Target* t : confined) {
      if (below != nullptr) doubt_falling(rock, *below, *t, found);
      below = t;
    }
    if (ucs != nullptr) doubt_intercept(rock, *ucs, confined, intercepts);
  }
  found.insert(found.end(), intercepts.begin(), intercepts.end());
}

/// Angles that hardly differ say nothing of layers, and may be counted in another unit.
void doubt_angles(const Rock& rock, Findings& found) {
  std::set<double> angles;
  for (const RockReading& r : rock.readings) angles.insert(r.theta);
  // a bedded rock with fewer angles is refused
  if (!rock.bedded || angles.size() < 3 || *angles.rbegin() - *angles.begin() >= least_range_of_angles)
    return;
  found.push_back({FindingKind::narrow_angles,
                   {},
                   {{"from", *angles.begin()}, {"to", *angles.rbegin()}},
                   {},
                   Advice::check_unit_and_column});
}

void doubt_replicates(const Rock& rock, Findings& found) {
  std::map<std::tuple<Property, double, double, double>, std::vector<const RockReading*>> cells;
  for (const RockReading& r : rock.readings)
    if (r.property != Property::nu)  // may be anything about zero
      cells[{r.property, r.theta, r.confining, r.diameter}].push_back(&r);
  for (const auto& [key, cell] : cells) {
    // a row with its SD says by itself how far specimens lie apart
    if (std::any_of(cell.begin(), cell.end(), [](const RockReading* r) { return std::isfinite(r->sd); }))
      continue;
    const auto [least, most] =
        std::minmax_element(cell.begin(), cell.end(),
                            [](const RockReading* a, const RockReading* b) { return a->value < b->value; });
    const double factor = (*most)->value / (*least)->value;
    if (!(factor > replicates_factor)) continue;
    const auto [first, last] = std::minmax((*least)->line, (*most)->line);
    found.push_back({FindingKind::replicates_apart,
                     {cell_in(rock, **least)},
                     {{"factor", factor}, {"line", double(first)}, {"line", double(last)}},
                     {},
                     Advice::check_lines});
  }
}

/// Rows that hold the same values of the same tests as a row above, pasted twice: they would count as further
/// specimens.
void doubt_repeated_rows(const Rock& rock, Findings& found) {
  using Value = std::tuple<Property, double, double, double, double, double, int>;
  std::map<int, std::vector<const RockReading*>> rows;
  for (const RockReading& r : rock.readings)
    if (!r.derived) rows[r.line].push_back(&r);
  std::map<std::vector<Value>, int> first;
  Finding f{FindingKind::rows_repeated, {}, {}, {}, Advice::delete_copies};
  for (const auto& [line, row] : rows) {
    std::vector<Value> values;
    for (const RockReading* r : row)  // NaN is no value of a key
      values.emplace_back(r->property, r->theta, r->confining, r->diameter, r->value,
                          std::isfinite(r->sd) ? r->sd : -1.0, r->n);
    const auto [above, fresh] = first.try_emplace(values, line);
    if (fresh) continue;
    f.numbers.insert(f.numbers.end(), {{"line", double(above->second)}, {"copy", double(line)}});
    for (const RockReading* r : row) f.cells.push_back(cell_in(rock, *r));
  }
  if (!f.cells.empty()) found.push_back(std::move(f));
}

void doubt_scatter(const Rock& rock, Findings& found) {
  for (const RockReading& r : rock.readings)
    if (r.property != Property::nu && (r.sd > most_scatter * r.value || r.sd < least_scatter * r.value))
      found.push_back({FindingKind::unusual_scatter,
                       {cell_in(rock, r)},
                       {{"share", r.sd / r.value}, {"line", double(r.line)}},
                       {},
                       Advice::check_unit_and_column});
}

/// A conversion is not the table's doing.
std::vector<Target> as_written(Rock rock) {
  rock.reading = ElasticReading::plane_stress;
  return targets_of(rock);
}

}  // namespace

std::vector<Finding> unusual_values(const Rock& rock) {
  const std::vector<Target> targets = as_written(rock), unconfined = least_confined(targets);
  Findings found;
  doubt_angles(rock, found);
  doubt_values(rock, unconfined, found);
  doubt_ratios(rock, unconfined, found);
  doubt_point_load(rock, unconfined, found);
  doubt_shear(rock, targets, found);
  doubt_confined(rock, targets, found);
  doubt_replicates(rock, found);
  doubt_repeated_rows(rock, found);
  doubt_scatter(rock, found);
  return found;
}

std::vector<Finding> conversion_in_part(const Rock& rock) {
  const std::vector<Target> targets = as_written(rock), of_nu = of_property(targets, Property::nu);
  if (rock.reading != ElasticReading::plane_strain || of_nu.empty() ||
      of_property(targets, Property::E).empty())
    return {};
  std::set<const Target*> taken;
  for (const Target& t : targets) {
    const AlongBedding of = along_bedding(targets, t.confining);
    if (!is_strength(t.property) && of.complete()) taken.insert({of.E, of.nu});
  }
  Finding stand_ins{FindingKind::along_bedding_taken}, left{FindingKind::not_converted};
  for (const Target& t : targets)
    if (rock.bedded && t.theta < along && taken.contains(&t)) stand_ins.cells.push_back(cell_in(rock, t));
  for (const Target& t : of_nu)
    if (std::none_of(targets.begin(), targets.end(), [&](const Target& other) {
          return other.property == Property::E && other.theta == t.theta && other.confining == t.confining;
        }))
      left.cells.push_back(cell_in(rock, t));
  Findings found;
  for (Finding& f : {std::ref(stand_ins), std::ref(left)})
    if (!f.cells.empty()) found.push_back(std::move(f));
  return found;
}

}  // namespace phy::survey
