#include "calibrate/elastic_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/evidence.hpp"
#include "calibrate/margin.hpp"
#include "theory/layered_fit.hpp"

namespace phy::calibrate {
namespace {

constexpr std::size_t most_cells_named = 4;
constexpr double far_off = 2.0;  // standard errors, from which a cell is named beside the farthest

/// E and nu.
std::vector<theory::LayeredReading> readings_of(const std::vector<Target>& targets) {
  std::vector<theory::LayeredReading> readings;
  for (const Target& t : least_confined(targets)) {
    if (is_strength(t.property)) continue;
    const bool modulus = t.property == Property::E;
    readings.push_back({t.theta, modulus, t.mean, counted_error(t)});
  }
  return readings;
}

bool has_modulus(const std::vector<theory::LayeredReading>& readings) {
  return std::any_of(readings.begin(), readings.end(),
                     [](const theory::LayeredReading& r) { return r.is_modulus; });
}

std::string number(const theory::LayeredReading& r, double value) {
  return r.is_modulus ? fmt::format("{:.3g}", value * 1e-9) : fmt::format("{:.3f}", value);
}

/// A cell and the value that it should have.
struct CellMisfit {
  theory::LayeredReading cell;
  double wanted = 0.0;
  double errors() const { return std::fabs(wanted - cell.value) / cell.error; }
  std::string text(const char* of_wanted) const {
    return fmt::format("{}({:g}) = {}{} ({} {}, {:.1f} standard errors)", cell.is_modulus ? "E" : "nu",
                       cell.theta, number(cell, cell.value), cell.is_modulus ? " GPa" : "", of_wanted,
                       number(cell, wanted), errors());
  }
};

double seen(const theory::LayeredFit& fit, const theory::LayeredReading& cell) {
  const theory::PlaneConstants c = fit.at(cell.theta);
  return cell.is_modulus ? c.E : c.nu;
}

/// "a, b, c" of the first few.
std::string list_of(const std::vector<CellMisfit>& cells, const char* of_wanted) {
  std::string text;
  for (std::size_t i = 0; i < std::min(cells.size(), most_cells_named); ++i)
    text += (i > 0 ? ", " : "") + cells[i].text(of_wanted);
  if (cells.size() > most_cells_named) text += fmt::format(", and {} more", cells.size() - most_cells_named);
  return text;
}

/// Cells without which the others are those of a body, with the value that it has there; the nearest first.
std::vector<CellMisfit> each_alone(const std::vector<theory::LayeredReading>& readings) {
  std::vector<CellMisfit> cells;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    std::vector<theory::LayeredReading> others = readings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (!has_modulus(others)) continue;
    const theory::LayeredFit fit = theory::fit_layered(others, theory::LayeredBody::any);
    if (fit.met()) cells.push_back({readings[i], seen(fit, readings[i])});
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [](const CellMisfit& a, const CellMisfit& b) { return a.errors() < b.errors(); });
  return cells;
}

/// Cells beyond `far_off` of a fit, the farthest in any case; it comes first.
std::vector<CellMisfit> farthest(const std::vector<theory::LayeredReading>& readings,
                                 const theory::LayeredFit& fit) {
  std::vector<CellMisfit> cells;
  for (const theory::LayeredReading& r : readings) cells.push_back({r, seen(fit, r)});
  std::stable_sort(cells.begin(), cells.end(),
                   [](const CellMisfit& a, const CellMisfit& b) { return a.errors() > b.errors(); });
  const auto near = [](const CellMisfit& m) { return m.errors() < far_off; };
  cells.erase(std::find_if(cells.begin() + 1, cells.end(), near), cells.end());
  return cells;
}

}  // namespace

std::string elastic_limit(const std::vector<Target>& targets) {
  const std::vector<theory::LayeredReading> readings = readings_of(targets);
  if (!has_modulus(readings)) return "";
  const theory::LayeredFit any = theory::fit_layered(readings, theory::LayeredBody::any);
  if (!any.met()) {
    const std::string text = fmt::format(
        "no layered elastic body has the E and nu of this table within their errors (chi-square {:.0f}; "
        "chance stays "
        "below {:.0f} in 99 of 100 tables): ",
        any.chi_square, any.limit());
    const bool only_E = std::all_of(readings.begin(), readings.end(),
                                    [](const theory::LayeredReading& r) { return r.is_modulus; });
    const char* const how = only_E ? ""
                                   : ". nu counts as read in the plane of load and dip; a mean over the "
                                     "circumference is another number";
    const std::vector<CellMisfit> alone = each_alone(readings);
    if (alone.empty()) return text + "farthest off " + list_of(farthest(readings, any), "nearest body") + how;
    return text + (alone.size() > 1 ? "the odd one out may be any of " : "the odd one out is ") +
           list_of(alone, "the others want") + how;
  }
  const theory::LayeredFit planes =
      theory::fit_layered(readings, theory::LayeredBody::planes_in_isotropic_rock);
  if (planes.met()) return "";
  return "a layered elastic body has the E and nu of this table within their errors, but an isotropic rock "
         "to which "
         "planes add compliance has not: " +
         list_of(farthest(readings, planes), "nearest") +
         "; joints that take the place of bonds may come nearer";
}

std::string confinement_limit(const std::vector<Target>& targets, ModulusReading reading) {
  const std::vector<Target> E = of_property(targets, Property::E);  // by stress
  if (E.size() < 2 || reading == ModulusReading::secant_at_peak) return "";
  const Target &low = E.front(), &high = E.back();
  const double noise = std::hypot(low.normal_error() / low.mean, high.normal_error() / high.mean);
  const double change = high.mean / low.mean - 1.0;
  if (std::fabs(change) <= std::max(2.0 * tolerance(Property::E), surely * noise)) return "";
  return fmt::format(
      "E changes by {:+.0f} % from {:.3g} to {:.3g} MPa of confining stress; that of bonded grains without "
      "layers changes by 2 % or less (to 20 MPa) and will lie between: `confining` in the rock file takes E "
      "and nu under one stress alone",
      100.0 * change, low.confining * 1e-6, high.confining * 1e-6);
}

}  // namespace phy::calibrate
