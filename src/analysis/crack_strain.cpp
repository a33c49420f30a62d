#include "analysis/crack_strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/elastic.hpp"
#include "base/nan.hpp"

namespace phy::analysis {
namespace {

constexpr StressRange elastic_range = {0.1, 0.25};  // of the strength
constexpr std::size_t enough_points = 3;
constexpr double errors = 3.0;       // standard errors that noise may reach
constexpr double resolution = 5e-3;  // of gauges, over strength / E

/// Where a row stands: its gauge strain and its crack volumetric strain.
struct Point {
  double strain = 0.0, crack = 0.0;
};

/// What a single value beside a level line does not fall below by noise alone, from the points of a range.
class Level {
 public:
  Level(const std::vector<Point>& points, double least)
      : n_(static_cast<double>(points.size())), least_(least) {
    for (const Point& p : points) mean_ += p.crack / n_, strain_ += p.strain / n_;
    double squares = 0.0;
    for (const Point& p : points) {
      squares += (p.crack - mean_) * (p.crack - mean_);
      spread_ += (p.strain - strain_) * (p.strain - strain_);
    }
    noise_ = std::sqrt(squares / (n_ - 2.0));
  }
  double mean() const { return mean_; }
  double noise() const { return errors * noise_; }
  double band(double strain) const {
    // Prediction interval of a line: wider away from where it was fitted.
    const double far = strain - strain_;
    return std::max(least_, errors * noise_ * std::sqrt(1.0 + 1.0 / n_ + far * far / spread_));
  }

 private:
  double n_, least_, mean_ = 0.0, strain_ = 0.0, spread_ = 0.0, noise_ = 0.0;
};

void place(const LoadingBranch& branch, double E, double nu, Number& n) {
  const auto point = [&](const HistoryRow& r) {
    return Point{r.axial_strain_gauge,
                 r.axial_strain_gauge + 2.0 * r.lateral_strain_gauge - (1.0 - 2.0 * nu) / E * r.axial_stress};
  };
  const auto usable = [](const Point& p) { return std::isfinite(p.strain) && std::isfinite(p.crack); };
  std::vector<Point> elastic;
  const std::span<const HistoryRow> range = first_passage(branch, elastic_range);
  for (const HistoryRow& r : range)
    if (usable(point(r))) elastic.push_back(point(r));
  if (elastic.size() < enough_points) {
    n.note = joined(
        n.note, fmt::format("only {} rows with both gauge strains where E and nu are read", elastic.size()));
    return;
  }
  const Level level(elastic, resolution * branch.largest / E);
  const std::span<const HistoryRow> rows =
      branch.rows.subspan(static_cast<std::size_t>(range.data() - branch.rows.data()));
  double largest = level.mean();
  for (const HistoryRow& r : rows)
    // The level may still rise as pores close; less the noise, which the largest of many rows contains.
    if (usable(point(r))) largest = std::max(largest, point(r).crack - level.noise());
  const HistoryRow *last_on = nullptr, *last = nullptr;
  for (const HistoryRow& r : rows) {
    if (!usable(point(r))) continue;
    last = &r;
    // The last row on the level: what leaves it and comes back has not begun to crack.
    if (point(r).crack >= largest - level.band(point(r).strain)) last_on = &r;
  }
  if (last_on == last)
    n.note = joined(n.note, "the crack volumetric strain does not fall before " + branch.point());
  else
    n.value = last_on->axial_stress;
}

}  // namespace

Number crack_initiation_by_strain(const LoadingBranch& branch) {
  Number n{
      "sigma_ci_strain", nan, "Pa",
      fmt::format("{} where the crack volumetric strain leaves its level for good, before the {}: it falls "
                  "by more than 3 standard errors and 0.5 % of {}/E. It is axial + 2 lateral strain of the "
                  "gauge, less (1 - 2 nu)/E times the stress, with E and nu between 10 and 25 % of {}",
                  branch.stress, branch.turn(), branch.strength, branch.strength),
      branch_note(branch)};
  if (!branch.peaked) return n;
  const Number E = tangent_modulus(branch, elastic_range, StrainFrom::gauge, "E");
  const Number nu = poisson_ratio(branch, elastic_range, StrainFrom::gauge, "nu");
  n.note = joined(n.note, E.note == nu.note ? E.note : joined(E.note, nu.note));
  if (E.value > 0.0 && std::isfinite(nu.value)) place(branch, E.value, nu.value, n);
  return n;
}

}  // namespace phy::analysis
