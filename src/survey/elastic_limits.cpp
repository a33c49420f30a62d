#include "survey/elastic_limits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/nan.hpp"
#include "maps/layered_table.hpp"
#include "records/evidence.hpp"

namespace phy::survey {
namespace {

constexpr double far_off = 2.0;  // standard errors, from which a cell counts beside the farthest

bool has_modulus(const std::vector<theory::LayeredReading>& readings) {
  return std::any_of(readings.begin(), readings.end(),
                     [](const theory::LayeredReading& r) { return r.is_modulus; });
}

/// A cell and the value that it should have.
struct CellMisfit {
  theory::LayeredReading cell;
  double wanted = 0.0;
  double errors() const { return std::fabs(wanted - cell.value) / cell.error; }
};

double seen(const theory::LayeredFit& fit, const theory::LayeredReading& cell) {
  const theory::PlaneConstants c = fit.at(cell.theta);
  return cell.is_modulus ? c.E : c.nu;
}

/// The numbers stand once for each cell.
Finding finding_of(FindingKind kind, const std::vector<CellMisfit>& misfits, double confining) {
  Finding f{kind};
  for (const CellMisfit& m : misfits) {
    f.cells.push_back({m.cell.is_modulus ? Property::E : Property::nu, m.cell.theta, confining});
    f.numbers.insert(f.numbers.end(),
                     {{"laboratory", m.cell.value}, {"wanted", m.wanted}, {"errors", m.errors()}});
  }
  return f;
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

std::vector<Finding> elastic_limits(const std::vector<Target>& targets) {
  const std::vector<theory::LayeredReading> readings = maps::layered_readings(targets);
  if (!has_modulus(readings)) return {};
  const double confining = of_property(targets, Property::E).front().confining;  // the least
  const theory::LayeredFit any = theory::fit_layered(readings, theory::LayeredBody::any);
  if (!any.met()) {
    const std::vector<CellMisfit> alone = each_alone(readings);
    Finding f = alone.empty() ? finding_of(FindingKind::no_layered_body, farthest(readings, any), confining)
                              : finding_of(FindingKind::one_cell_of_no_body, alone, confining);
    f.numbers.insert(f.numbers.end(), {{"chi_square", any.chi_square}, {"limit", any.limit()}});
    // a laboratory that reads nu around the circumference measures another number
    if (!std::all_of(readings.begin(), readings.end(),
                     [](const theory::LayeredReading& r) { return r.is_modulus; }))
      f.advice = Advice::check_nu;
    return {f};
  }
  const theory::LayeredFit planes =
      theory::fit_layered(readings, theory::LayeredBody::planes_in_isotropic_rock);
  if (planes.met()) return {};
  return {finding_of(FindingKind::no_planes_in_isotropic_rock, farthest(readings, planes), confining)};
}

std::vector<Finding> confinement_limits(const std::vector<Target>& targets, ModulusReading reading) {
  // of the angles that were tested under more than one stress, the one where E changes most
  std::map<double, std::vector<Target>> by_angle;
  for (const Target& t : of_property(targets, Property::E)) by_angle[t.theta].push_back(t);
  std::optional<Finding> most;
  for (const auto& [theta, E] : by_angle) {  // by stress
    const auto change = change_under_confinement(E, reading);
    if (!change || (most && std::fabs(*change) <= std::fabs(most->number("change")))) continue;
    most = Finding{FindingKind::stiffer_under_confinement,
                   {cell_of(E.front()), cell_of(E.back())},
                   {{"change", *change}},
                   {},
                   Advice::one_confinement};
  }
  return most ? std::vector{*most} : std::vector<Finding>();
}

}  // namespace phy::survey
