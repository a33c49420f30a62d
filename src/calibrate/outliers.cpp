#include "calibrate/outliers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/nan.hpp"
#include "calibrate/margin.hpp"
#include "records/calibration.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::calibrate {
namespace {

constexpr double level = 0.05;         // of a whole table
constexpr int least_degrees = 4;       // behind a scatter that may accuse
constexpr std::size_t least_cell = 3;  // of two specimens either may be the odd one
constexpr double prediction = 0.12;    // that UCS of the maps deviate from the prediction by their neighbours
constexpr double many_errors = 3.0;

using Cell = std::vector<const RockReading*>;

double mean_of(const Cell& cell) {
  double sum = 0.0;
  for (const RockReading* r : cell) sum += r->value;
  return sum / static_cast<double>(cell.size());
}

double unit_of(Property p, double mean) { return p == Property::nu ? 1.0 : mean; }

/// Cells of single specimens, by property.
std::map<Property, std::vector<Cell>> cells_of(const Rock& rock) {
  std::map<std::tuple<Property, double, double, double>, Cell> found;
  for (const RockReading& r : rock.readings)
    if (r.n == 1 && !r.derived) found[{r.property, r.theta, r.diameter, r.confining}].push_back(&r);
  std::map<Property, std::vector<Cell>> cells;
  for (auto& [key, cell] : found)
    if (cell.size() > 1) cells[std::get<0>(key)].push_back(std::move(cell));
  return cells;
}

/// The specimen of a property that lies farthest out.
struct Suspect {
  const RockReading* reading = nullptr;
  Cell* cell = nullptr;
  double t = 0.0;
  int degrees = 0;
  /// Of a |t| as large by chance, in one specimen.
  double chance() const {
    const boost::math::students_t distribution(degrees);
    return 2.0 * boost::math::cdf(boost::math::complement(distribution, std::fabs(t)));
  }
};

Suspect farthest_out(Property p, std::vector<Cell>& cells) {
  double squares = 0.0;
  int degrees = -1;  // one is lost with the specimen that is looked at
  for (const Cell& cell : cells) {
    const double mean = mean_of(cell);
    for (const RockReading* r : cell) squares += std::pow((r->value - mean) / unit_of(p, mean), 2.0);
    degrees += static_cast<int>(cell.size()) - 1;
  }
  const double least = 0.2 * tolerance(p);  // replicates that are rounded, or alike by chance
  Suspect worst;
  worst.degrees = degrees;
  if (degrees < least_degrees) return worst;
  for (Cell& cell : cells) {
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

std::string name_of(const Rock& rock, const RockReading& r) {
  return rock.bedded ? fmt::format("{}({:g})", to_string(r.property), r.theta) : to_string(r.property);
}

std::string value_of(Property p, double value) {
  const ShownUnit unit = shown_unit(p);
  return fmt::format("{:.3g}{}{}", value * unit.factor, *unit.name != 0 ? " " : "", unit.name);
}

std::string accusation(const Rock& rock, const Suspect& s, double mean, double chance) {
  const RockReading& r = *s.reading;
  return fmt::format(
      "outlier? line {}: {} = {} among {} others with a mean of {} (t = {:.1f} by the scatter inside all "
      "cells "
      "of {}; chance shows one like it in {:.1g} % of tables)",
      r.line, name_of(rock, r), value_of(r.property, r.value), s.cell->size(), value_of(r.property, mean),
      s.t, to_string(r.property), 100.0 * chance);
}

}  // namespace

std::vector<std::string> outlying_specimens(const Rock& rock) {
  std::map<Property, std::vector<Cell>> all = cells_of(rock);
  double specimens = 0.0;
  for (const auto& [p, cells] : all)
    for (const Cell& cell : cells)
      specimens += cell.size() < least_cell ? 0.0 : static_cast<double>(cell.size());
  std::vector<std::string> lines;
  for (auto& [p, cells] : all)
    for (Suspect s = farthest_out(p, cells); s.reading != nullptr; s = farthest_out(p, cells)) {
      const double chance = specimens * s.chance();
      if (chance > level) break;
      const RockReading* out = s.reading;
      std::erase(*s.cell, out);  // the next is looked for without it
      const double mean = mean_of(*s.cell);
      if (std::fabs(out->value - mean) / unit_of(p, mean) > tolerance(p))
        lines.push_back(accusation(rock, s, mean, chance));
    }
  return lines;
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

std::vector<std::string> outlying_cells(const std::vector<Target>& targets) {
  const std::vector<Target> ucs = of_property(targets, Property::ucs);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < ucs.size(); ++i) {
    const double off = out_of_line(ucs, i), relative = ucs[i].normal_error() / ucs[i].mean;
    // the prediction has about the error of one cell more
    const double error = std::sqrt(2.0 * relative * relative + prediction * prediction);
    if (!(std::fabs(off) > many_errors * error)) continue;
    lines.push_back(fmt::format(
        "out of line? {} = {} lies {:+.0f} % off what the other angles make of it, by a straight line "
        "between "
        "its neighbours or by Jaeger's plane ({:.1f} standard errors)",
        cell_name(ucs[i]), value_of(Property::ucs, ucs[i].mean), 100.0 * off, std::fabs(off) / error));
  }
  return lines;
}

}  // namespace phy::calibrate
