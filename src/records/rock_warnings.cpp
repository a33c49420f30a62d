#include "records/rock_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "records/calibration.hpp"

namespace phy {
namespace {

// Bounds are wide on purpose: they are there for units off by a thousand and for columns exchanged.
constexpr double least_ratio = 80.0,
                 most_ratio = 2000.0;                    // E/UCS; 200 to 500 is medium (Deere & Miller 1966)
constexpr double least_ucs = 0.25e6, most_ucs = 600e6;   // [Pa] below, the ISRM's grades of rock end
constexpr double least_E = 0.1e9, most_E = 200e9;        // [Pa]
constexpr double least_K_Ic = 0.03e6, most_K_Ic = 10e6;  // [Pa sqrt(m)] 0.1 to 4 of most rocks
constexpr double most_tension = 0.5;                     // of UCS; a tenth is usual
constexpr double replicates_apart = 1.5;                 // factor
constexpr double least_range_of_angles = 20.0;           // [deg]
constexpr double most_scatter = 0.5;                     // SD over the value; a tenth is usual
constexpr double least_intercept = 0.7, most_intercept = 1.6;  // of UCS; envelopes bend down from a line
constexpr double along = 80.0;  // [deg], from which a load runs along the bedding

/// "UCS(45)"; "UCS" of a rock without bedding.
std::string name_at(const Rock& rock, const std::string& name, double theta) {
  return rock.bedded ? fmt::format("{}({:g})", name, theta) : name;
}

const Target* at_angle(const std::vector<Target>& targets, Property p, double theta) {
  for (const Target& t : targets)
    if (t.property == p && t.theta == theta) return &t;
  return nullptr;
}

/// Appends "what, what: why" if there is anything.
void warn(std::vector<std::string>& warnings, const std::vector<std::string>& what, const std::string& why) {
  if (what.empty()) return;
  std::string text = "look again: ";
  for (const std::string& w : what) text += w + (&w == &what.back() ? ": " : ", ");
  warnings.push_back(text + why);
}

void doubt_values(const Rock& rock, const std::vector<Target>& targets, std::vector<std::string>& warnings) {
  std::vector<std::string> moduli, strengths, toughness;
  for (const Target& t : least_confined(targets)) {
    if (t.property == Property::fracture_toughness && (t.mean < least_K_Ic || t.mean > most_K_Ic))
      toughness.push_back(
          fmt::format("{} = {:.3g} MPa sqrt(m)", name_at(rock, "K_Ic", t.theta), t.mean * 1e-6));
    if (t.property == Property::E && (t.mean < least_E || t.mean > most_E))
      moduli.push_back(fmt::format("{} = {:.3g} GPa", name_at(rock, "E", t.theta), t.mean * 1e-9));
    if (t.property == Property::ucs && (t.mean < least_ucs || t.mean > most_ucs))
      strengths.push_back(fmt::format("{} = {:.3g} MPa", name_at(rock, "UCS", t.theta), t.mean * 1e-6));
  }
  warn(warnings, moduli, "hardly any rock lies outside 0.1 to 200 GPa; check the unit in the header");
  warn(warnings, strengths, "hardly any rock lies outside 0.25 to 600 MPa; check the unit in the header");
  warn(warnings, toughness,
       "hardly any rock lies outside 0.03 to 10 MPa sqrt(m); check the unit in the header");
}

void doubt_ratios(const Rock& rock, const std::vector<Target>& targets, std::vector<std::string>& warnings) {
  std::vector<std::string> moduli, tension;
  for (const Target& t : least_confined(targets)) {
    const Target* ucs = at_angle(targets, Property::ucs, t.theta);
    if (ucs == nullptr || t.property == Property::nu || t.property == Property::ucs) continue;
    const double ratio = t.mean / ucs->mean;
    if (t.property == Property::E) {
      if (ratio < least_ratio || ratio > most_ratio)
        moduli.push_back(fmt::format("{} = {:.4g}", name_at(rock, "E/UCS", t.theta), ratio));
    } else if (is_tensile(t.property) && ratio > most_tension) {
      tension.push_back(fmt::format("{} = {:.3g} UCS", name_at(rock, to_string(t.property), t.theta), ratio));
    }
  }
  warn(warnings, moduli,
       "most rocks have 200 to 500 (Deere & Miller 1966), hardly any less than 80 or more than 2000; check "
       "units and columns");
  warn(warnings, tension, "most rocks have about a tenth of UCS in tension; check units and columns");
}

/// Where a straight line through strengths over confining stress meets that of none; NaN: they are too near
/// to each other.
double intercept_of(const std::vector<const Target*>& confined) {
  constexpr double least_range = 2.0;
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Target* t : confined)
    n += 1.0, x += t->confining, y += t->mean, xx += t->confining * t->confining,
        xy += t->confining * t->mean;
  if (confined.size() < 2 || confined.back()->confining < least_range * confined.front()->confining)
    return std::nan("");
  return (y * xx - x * xy) / (n * xx - x * x);
}

/// Strengths under confinement against UCS at the same angle, and against each other.
void doubt_confined(const Rock& rock, const std::vector<Target>& targets,
                    std::vector<std::string>& warnings) {
  constexpr double surely = 2.0;                           // standard errors
  std::map<double, std::vector<const Target*>> at_angles;  // by stress
  for (const Target& t : targets)
    if (t.property == Property::confined) at_angles[t.theta].push_back(&t);
  std::vector<std::string> falls, conflicts;
  for (const auto& [theta, confined] : at_angles) {
    const Target* ucs = at_angle(targets, Property::ucs, theta);
    const Target* below = ucs;
    for (const Target* t : confined) {
      if (below != nullptr && (t->mean - t->confining) - (below->mean - below->confining) <
                                  -surely * std::hypot(t->normal_error(), below->normal_error()))
        falls.push_back(
            fmt::format("sigma_1 - sigma_3 of {} falls from {:.4g} MPa under {:.3g} to {:.4g} MPa "
                        "under {:.3g} MPa",
                        name_at(rock, "sigma_1", theta), (below->mean - below->confining) * 1e-6,
                        below->confining * 1e-6, (t->mean - t->confining) * 1e-6, t->confining * 1e-6));
      below = t;
    }
    const double intercept = intercept_of(confined);
    if (ucs != nullptr && (intercept < least_intercept * ucs->mean || intercept > most_intercept * ucs->mean))
      conflicts.push_back(
          fmt::format("{} = {:.4g} MPa, and {:.4g} MPa by the line through its strengths under "
                      "{:.3g} to {:.3g} MPa",
                      name_at(rock, "UCS", theta), ucs->mean * 1e-6, intercept * 1e-6,
                      confined.front()->confining * 1e-6, confined.back()->confining * 1e-6));
  }
  warn(warnings, falls, "confinement takes no rock's strength away; check pressures and angles");
  warn(
      warnings, conflicts,
      "the two cannot be one rock's unless its envelope is far from straight; check whether c and phi are of "
      "the same angle, and of peaks");
}

/// Angles that hardly differ say nothing of layers, and may be counted in another unit.
void doubt_angles(const Rock& rock, std::vector<std::string>& warnings) {
  std::set<double> angles;
  for (const RockReading& r : rock.readings) angles.insert(r.theta);
  // A bedded rock with fewer angles is refused.
  if (!rock.bedded || angles.size() < 3 || *angles.rbegin() - *angles.begin() >= least_range_of_angles)
    return;
  warn(warnings, {fmt::format("all angles lie between {:g} and {:g} deg", *angles.begin(), *angles.rbegin())},
       "so near to each other they say little about the layers; check their unit and the column");
}

void doubt_replicates(const Rock& rock, std::vector<std::string>& warnings) {
  struct Cell {
    const RockReading *least = nullptr, *most = nullptr;
    bool has_sd = false;
  };
  std::map<std::tuple<Property, double, double, double>, Cell> cells;
  for (const RockReading& r : rock.readings) {
    if (r.property == Property::nu) continue;  // may be anything about zero
    Cell& c = cells[{r.property, r.theta, r.confining, r.diameter}];
    if (c.least == nullptr || r.value < c.least->value) c.least = &r;
    if (c.most == nullptr || r.value > c.most->value) c.most = &r;
    c.has_sd = c.has_sd || std::isfinite(r.sd);
  }
  std::vector<std::string> apart;
  for (const auto& [key, c] : cells)
    if (!c.has_sd && c.most->value > replicates_apart * c.least->value)
      apart.push_back(fmt::format("{} of lines {} and {} differs by a factor {:.2g}",
                                  name_at(rock, to_string(std::get<0>(key)), c.least->theta),
                                  std::min(c.least->line, c.most->line),
                                  std::max(c.least->line, c.most->line), c.most->value / c.least->value));
  warn(warnings, apart, "a slip of the pen, or two rocks?");
}

void doubt_scatter(const Rock& rock, std::vector<std::string>& warnings) {
  std::vector<std::string> wide;
  for (const RockReading& r : rock.readings)
    if (r.property != Property::nu && r.sd > most_scatter * r.value)
      wide.push_back(fmt::format("the SD of {} (line {}) is {:.2g} of the value",
                                 name_at(rock, to_string(r.property), r.theta), r.line, r.sd / r.value));
  warn(warnings, wide, "hardly any rock scatters so much; check the unit and the column");
}

/// What the conversion to plane stress takes for the rock along its bedding, and what it cannot convert.
void report_conversion(const Rock& rock, const std::vector<Target>& targets,
                       std::vector<std::string>& warnings) {
  std::vector<std::string> stand_ins, left;
  std::set<const Target*> taken;
  for (const Target& t : targets) {
    const AlongBedding of = along_bedding(targets, t.confining);
    if (!is_strength(t.property) && of.complete()) taken.insert({of.E, of.nu});
  }
  for (const Target& t : targets)
    if (rock.bedded && t.theta < along && taken.contains(&t)) stand_ins.push_back(cell_name(t));
  for (const Target& t : of_property(targets, Property::nu))
    if (std::none_of(targets.begin(), targets.end(), [&](const Target& other) {
          return other.property == Property::E && other.theta == t.theta && other.confining == t.confining;
        }))
      left.push_back(rock.bedded ? cell_name(t) : name_at(rock, "nu", t.theta) + particulars(t));
  warn(
      warnings, stand_ins,
      "taken for the value along the bedding, which the conversion of plane strain needs; the table has none "
      "nearer to 90 degrees");
  warn(warnings, left, "not converted from plane strain, for want of E at the same angle");
}

}  // namespace

std::vector<std::string> warnings_about(const Rock& rock) {
  Rock as_written = rock;  // a conversion is not the table's doing
  as_written.reading = ElasticReading::plane_stress;
  const std::vector<Target> targets = targets_of(as_written);
  std::vector<std::string> warnings;
  doubt_angles(rock, warnings);
  doubt_values(rock, targets, warnings);
  doubt_ratios(rock, targets, warnings);
  doubt_confined(rock, targets, warnings);
  doubt_replicates(rock, warnings);
  doubt_scatter(rock, warnings);
  const bool moduli = !of_property(targets, Property::E).empty(),
             nu = !of_property(targets, Property::nu).empty();
  if (rock.reading == ElasticReading::plane_strain && moduli && nu)
    report_conversion(rock, targets, warnings);
  return warnings;
}

}  // namespace phy
