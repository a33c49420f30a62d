#include "survey/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/nan.hpp"
#include "base/stats.hpp"
#include "records/calibration.hpp"
#include "survey/cells.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::survey {
namespace {

constexpr double level = 0.05;         // of a whole table
constexpr int least_degrees = 4;       // behind a scatter that may accuse
constexpr std::size_t least_cell = 3;  // of two specimens either may be the odd one
constexpr double prediction = 0.12;    // that UCS of the maps deviate from the prediction by their neighbours
constexpr double many_errors = 3.0;

/// The specimens of one cell.
using Specimens = std::vector<const RockReading*>;

double mean_of(const Specimens& cell) {
  double sum = 0.0;
  for (const RockReading* r : cell) sum += r->value;
  return sum / static_cast<double>(cell.size());
}

double unit_of(Property p, double mean) { return measured(p).absolute ? 1.0 : mean; }

/// Cells of single specimens, by property.
std::map<Property, std::vector<Specimens>> cells_of(const Rock& rock) {
  std::map<std::tuple<Property, double, double, double>, Specimens> all;
  for (const RockReading& r : rock.readings)
    if (r.n == 1 && !r.derived) all[{r.property, r.theta, r.diameter, r.confining}].push_back(&r);
  std::map<Property, std::vector<Specimens>> cells;
  for (auto& [key, cell] : all)
    if (cell.size() > 1) cells[std::get<0>(key)].push_back(std::move(cell));
  return cells;
}

/// The specimen of a property that lies farthest out.
struct Suspect {
  const RockReading* reading = nullptr;
  Specimens* cell = nullptr;
  double t = 0.0;
  int degrees = 0;
  /// Of a |t| as large by chance, in one specimen.
  double chance() const { return student_t_chance(std::fabs(t), degrees); }
};

Suspect farthest_out(Property p, std::vector<Specimens>& cells) {
  double squares = 0.0;
  int degrees = -1;  // one is lost with the specimen that is looked at
  for (const Specimens& cell : cells) {
    const double mean = mean_of(cell);
    for (const RockReading* r : cell) squares += std::pow((r->value - mean) / unit_of(p, mean), 2.0);
    degrees += static_cast<int>(cell.size()) - 1;
  }
  const double least = 0.2 * measured(p).tolerance;  // replicates that are rounded, or alike by chance
  Suspect worst;
  worst.degrees = degrees;
  if (degrees < least_degrees) return worst;
  for (Specimens& cell : cells) {
    if (cell.size() < least_cell) continue;
    const double mean = mean_of(cell), share = 1.0 - 1.0 / static_cast<double>(cell.size());
    for (const RockReading* r : cell) {
      const double d = (r->value - mean) / unit_of(p, mean);
      const double others =
          std::max(0.0, squares - d * d / share) / degrees + least * least;  // variance without it
      if (const double t = d / std::sqrt(others * share); std::fabs(t) > std::fabs(worst.t))
        worst.reading = r, worst.cell = &cell, worst.t = t;
    }
  }
  return worst;
}

Finding finding_of(const Rock& rock, const Suspect& s, double mean, double chance) {
  return {FindingKind::outlying_specimen,
          {cell_in(rock, *s.reading)},
          {{"value", s.reading->value},
           {"mean", mean},
           {"others", double(s.cell->size())},
           {"t", s.t},
           {"chance", chance},
           {"line", double(s.reading->line)}},
          {},
          Advice::check_lines};
}

}  // namespace

std::vector<Finding> outlying_specimens(const Rock& rock) {
  std::map<Property, std::vector<Specimens>> all = cells_of(rock);
  double specimens = 0.0;
  for (const auto& [p, cells] : all)
    for (const Specimens& cell : cells)
      specimens += cell.size() < least_cell ? 0.0 : static_cast<double>(cell.size());
  std::vector<Finding> found;
  for (auto& [p, cells] : all)
    for (Suspect s = farthest_out(p, cells); s.reading != nullptr; s = farthest_out(p, cells)) {
      const double chance = specimens * s.chance();
      if (chance > level) break;
      const RockReading* out = s.reading;
      std::erase(*s.cell, out);  // the next is looked for without it
      const double mean = mean_of(*s.cell);
      if (std::fabs(out->value - mean) / unit_of(p, mean) > measured(p).tolerance)
        found.push_back(finding_of(rock, s, mean, chance));
    }
  return found;
}

double out_of_line(const std::vector<Target>& ucs, std::size_t cell) {
  std::vector<Comparison> rows(ucs.size());
  std::vector<theory::StrengthReading> others;
  for (std::size_t i = 0; i < ucs.size(); ++i) {
    rows[i].target = ucs[i];
    if (i != cell) others.push_back({ucs[i].theta, ucs[i].mean, 0.0});
  }
  const double line = interpolated(rows, ucs[cell]);
  if (!std::isfinite(line)) return nan;
  const double by_line = ucs[cell].mean / line - 1.0;
  const theory::JaegerFit fit = theory::fit_jaeger_and_matrix(others);
  if (!fit.ok) return nan;  // too few angles to tell a weak plane from an outlier
  const double by_plane =
      ucs[cell].mean / theory::jaeger_sigma_1(fit.plane, fit.matrix_ucs, ucs[cell].theta, 0.0) - 1.0;
  return std::fabs(by_plane) < std::fabs(by_line) ? by_plane : by_line;
}

std::vector<Finding> outlying_cells(const std::vector<Target>& targets) {
  const std::vector<Target> ucs = of_property(targets, Property::ucs);
  std::vector<Finding> found;
  for (std::size_t i = 0; i < ucs.size(); ++i) {
    const double off = out_of_line(ucs, i), relative = ucs[i].normal_error() / ucs[i].mean;
    // the prediction has about the error of one cell more
    const double error = std::sqrt(2.0 * relative * relative + prediction * prediction);
    if (!(std::fabs(off) > many_errors * error)) continue;
    found.push_back({FindingKind::outlying_cell,
                     {cell_of(ucs[i])},
                     {{"value", ucs[i].mean}, {"off", off}, {"errors", std::fabs(off) / error}},
                     {},
                     Advice::check_value});
  }
  return found;
}

}  // namespace phy::survey
