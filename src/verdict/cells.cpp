#include "verdict/cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/stats.hpp"

namespace phy::verdict {
namespace {

constexpr double level = 0.05;
constexpr double enough_met = 0.9;  // of the values
// As many values are exceptions; beyond, the table as a whole is not met.
constexpr double most_exceptions = 1.0 / 3.0, met_beside_exceptions = 0.5;
/// Of the 5 %, where a table has both: else fourteen moduli would hide a miss among seven strengths, on which
/// every prediction of failure rests. Misses that matter are three to five tolerances in moduli, 2.5 in UCS.
constexpr double share_of_moduli = 0.2;
constexpr double most_degrees = 1e6;  // normal
constexpr int most_specimens = 100;

double unit_of(const Comparison& c, double of) { return measured(c.target.property).absolute ? 1.0 : of; }

/// Packings differ alike at all cells of a property: their variance, of a single one, and its degrees of
/// freedom.
struct Packings {
  std::array<double, n_properties> squares = {};
  std::array<int, n_properties> degrees = {};

  explicit Packings(const std::vector<Comparison>& rows) {
    for (const Comparison& c : rows) {
      if (!c.answered() || !std::isfinite(c.sd) || c.n_packings < 2) continue;
      const auto p = static_cast<std::size_t>(c.target.property);
      squares[p] += (c.n_packings - 1) * std::pow(c.sd / unit_of(c, c.mean), 2.0);
      degrees[p] += c.n_packings - 1;
    }
  }
};

/// Variance of a mean, and its degrees of freedom; 0: it is known.
struct Part {
  double variance = 0.0;
  int degrees = 0;
};

Part laboratory_of(const Target& t, double unit) {
  const bool stated = t.stated_degrees > 0;
  const double sd = (stated ? t.stated_sd : t.sd) / unit;
  return {sd * sd / t.n, stated ? t.stated_degrees : t.degrees};
}

double degrees_of(const Part& a, const Part& b) {
  double inverse = 0.0;
  for (const Part& p : {a, b})
    if (p.degrees > 0) inverse += p.variance * p.variance / p.degrees;
  const double sum = a.variance + b.variance;
  return inverse * most_degrees > sum * sum ? sum * sum / inverse : most_degrees;
}

double bound_of(const Comparison& row, double change, double error, double degrees) {
  const double most = std::fabs(change) + student_t_one_sided_95(degrees) * error;
  return measured(row.target.property).absolute ? most : std::expm1(most);
}

JudgedCell measured_cell(const Comparison& row, const Packings& packings) {
  JudgedCell c{row};
  if (!row.answered()) return c;
  const auto p = static_cast<std::size_t>(row.target.property);
  const double miss = miss_of(row);
  c.change = measured(row.target.property).absolute || miss <= -1.0 ? miss : std::log1p(miss);
  Part model;
  if (packings.degrees[p] > 0 && row.n_packings > 0)
    model = {packings.squares[p] / packings.degrees[p] / row.n_packings, packings.degrees[p]};
  const Part laboratory = laboratory_of(row.target, unit_of(row, row.target.mean));
  c.error = std::sqrt(laboratory.variance + model.variance), c.of_packings = std::sqrt(model.variance);
  c.degrees = degrees_of(laboratory, model);
  c.bound = bound_of(row, c.change, c.error, c.degrees);
  c.outcome = c.bound <= coarsest(row.target.property) ? Outcome::met : Outcome::open;
  return c;
}

double chance_of(const JudgedCell& c) {
  if (c.error > 0.0) return student_t_chance(std::fabs(c.change) / c.error, c.degrees);
  return c.change == 0.0 ? 1.0 : 0.0;
}

/// Of all cells with an answer together 1.
std::vector<double> weights_of(const std::vector<JudgedCell>& cells) {
  const auto n = [&](bool strength) {
    return std::count_if(cells.begin(), cells.end(), [&](const JudgedCell& c) {
      return c.row.answered() && is_strength(c.row.target.property) == strength;
    });
  };
  const auto moduli = static_cast<double>(n(false)), strengths = static_cast<double>(n(true));
  const double of_moduli = strengths == 0.0 ? 1.0 : moduli == 0.0 ? 0.0 : share_of_moduli;
  std::vector<double> weights;
  for (const JudgedCell& c : cells)
    weights.push_back(!c.row.answered()                    ? 0.0
                      : is_strength(c.row.target.property) ? (1.0 - of_moduli) / strengths
                                                           : of_moduli / moduli);
  return weights;
}

/// Steps from the least chance over weight to larger ones; each is compared with what the weights not yet
/// rejected leave of the level, and the first that chance explains ends it.
void step_down(std::vector<JudgedCell>& cells) {
  const std::vector<double> weights = weights_of(cells);
  std::vector<double> chances(cells.size(), 1.0);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].row.answered()) chances[i] = chance_of(cells[i]), order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return chances[a] * weights[b] < chances[b] * weights[a];
  });
  double left = 1.0;
  bool rejects = true;
  for (const std::size_t i : order) {
    JudgedCell& c = cells[i];
    const bool beyond = std::fabs(miss_of(c.row)) > tolerance(c.row.target.property);
    c.alone = beyond && chances[i] <= level;
    rejects = rejects && chances[i] * left <= level * weights[i];
    if (rejects && beyond) c.outcome = Outcome::missed;
    left -= weights[i];
  }
}

}  // namespace

double miss_of(const Comparison& row) { return (row.mean - row.target.mean) / unit_of(row, row.target.mean); }

double JudgedCell::scaled_miss() const {
  const double by_chance = student_t_95(static_cast<std::size_t>(std::max(1.0, degrees))) * error;
  return miss_of(row) / std::max(tolerance(row.target.property), by_chance);
}

std::vector<JudgedCell> judge_cells(const std::vector<Comparison>& rows) {
  const Packings packings(rows);
  std::vector<JudgedCell> cells;
  for (const Comparison& row : rows) cells.push_back(measured_cell(row, packings));
  step_down(cells);
  return cells;
}

VerdictStatus status_of(const std::vector<JudgedCell>& cells) {
  const auto share = [&](Outcome outcome) {
    return static_cast<double>(std::count_if(cells.begin(), cells.end(),
                                             [&](const JudgedCell& c) { return c.outcome == outcome; })) /
           static_cast<double>(cells.size());
  };
  const double met = share(Outcome::met), missed = share(Outcome::missed);
  if (missed > 0.0)
    return missed <= most_exceptions && met >= met_beside_exceptions ? VerdictStatus::calibrated_except
                                                                     : VerdictStatus::not_calibrated;
  return met < enough_met ? VerdictStatus::not_decided : VerdictStatus::calibrated;
}

std::optional<int> specimens_missing(const JudgedCell& c) {
  const double of_table = c.error * c.error - c.of_packings * c.of_packings;
  const Target& t = c.row.target;
  for (int more = 1; t.n + more <= most_specimens; ++more) {
    const double error = std::sqrt(of_table * t.n / (t.n + more) + c.of_packings * c.of_packings);
    if (bound_of(c.row, c.change, error, c.degrees + more) <= coarsest(t.property)) return more;
  }
  return std::nullopt;
}

bool wants_packings(const std::vector<Comparison>& verification) {
  constexpr double enough = 0.25;
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : verification) {
    if (!is_strength(c.target.property) || !std::isfinite(c.sd)) continue;
    squares += std::pow(c.sd / c.mean / tolerance(c.target.property), 2.0) / c.n_packings, ++n;
  }
  return squares > n * enough * enough;
}

}  // namespace phy::verdict
