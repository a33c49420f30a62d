#include "calibrate/reach_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/nan.hpp"
#include "verdict/margin.hpp"

namespace phy::calibrate {
namespace {

using verdict::tolerance;

constexpr int fewest_points = 64;  // of a family that says something by what it does not reach
constexpr double times_nearer = 1.1;

/// A number as models are compared by it: its logarithm, but nu, which may be negative, as it is.
double compared(Property property, double value) {
  return measured(property).absolute ? value : std::log(value);
}

/// The same of a cell between the mapped inclinations of a property, linear. `column`: "UCS/sigma_c".
double compared_at(const ReachTable& table, std::size_t row, const std::string& column, Property property,
                   double theta) {
  const Bracket b = bracket_of(property, theta);
  const auto at = [&](double angle) {
    return compared(property, table.at(row, column_at(table.family(), column, angle)));
  };
  return (b.share < 1.0 ? (1.0 - b.share) * at(b.low) : 0.0) + (b.share > 0.0 ? b.share * at(b.high) : 0.0) +
         log_share(property);
}

/// The column of a target; nullptr: it was not mapped, as no test under a confining stress was. nu was read
/// at half of UCS, as that of a model is only where the table has E as a test reads it.
const char* column_of(const ReachTable& table, const Evidence& evidence, const Target& t) {
  if (t.confining != 0.0 || (t.property == Property::nu && !evidence.has(Property::E))) return nullptr;
  return map_column(table.family(), t.property, evidence.rock.E_is);
}
bool was_mapped(const ReachTable& table, const Evidence& evidence, const Target& t) {
  return column_of(table, evidence, t) != nullptr;
}

/// What a point gives for a target, as compared(), up to a scale but for nu; NaN: it was not mapped, or has
/// no answer.
double answer(const ReachTable& table, std::size_t row, const Evidence& evidence, const Target& t) {
  const char* column = column_of(table, evidence, t);
  return column == nullptr ? nan : compared_at(table, row, column, t.property, t.theta);
}

/// Weighted sum of squares of differences of logarithms about their mean: one scale is free.
struct LogSpread {
  double weights = 0.0, sum = 0.0, squares = 0.0;
  int n = 0;
  void add(double difference, double weight) {
    weights += weight, sum += weight * difference, squares += weight * difference * difference, ++n;
  }
  /// Not below 0 by rounding; NaN where an answer was missing.
  double about_mean() const {
    const double value = n > 0 ? squares - sum * sum / weights : 0.0;
    return value < 0.0 ? 0.0 : value;
  }
};

/// What a difference of logarithms, of nu that of the values, is counted in; NaN: it does not count.
using Unit = double (*)(Property);
double relative(Property property) { return measured(property).absolute ? nan : 1.0; }

/// Of the values of the table that a family has mapped; `answer_to`: of a model, as compared(), up to its two
/// scales.
template <class Answer>
double error_of(const ReachTable& table, const Evidence& evidence, Unit unit, const Answer& answer_to) {
  LogSpread moduli, strengths;
  double squares = 0.0;  // of nu, which has no scale
  int n_nu = 0;
  for (const Target& t : evidence.targets) {
    const double one = unit(t.property);
    if (std::isnan(one) || !was_mapped(table, evidence, t)) continue;
    const double off = compared(t.property, t.mean) - answer_to(t);
    if (measured(t.property).absolute)
      squares += std::pow(off / one, 2.0), ++n_nu;
    else
      (is_strength(t.property) ? strengths : moduli).add(off, 1.0 / (one * one));
  }
  const int free = (moduli.n > 0 ? 1 : 0) + (strengths.n > 0 ? 1 : 0);
  const int n = moduli.n + strengths.n + n_nu - free;
  if (strengths.n == 0 || n < 2) return nan;  // nothing, or hardly anything, to compare
  return std::sqrt((moduli.about_mean() + strengths.about_mean() + squares) / n);
}

/// UCS over tension of sensible points where the table has both at one inclination that was mapped.
std::string ratio_line(const Evidence& evidence, const ModelFamily& family, const Target& tension) {
  const ReachTable& table = reach_of(family);
  double low = 1e300, high = 0.0;
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    if (!table.is_dense(row) || !table.is_sensible(row)) continue;
    const Target ucs{Property::ucs, tension.theta, 1.0, 1.0};
    const double ratio = std::exp(answer(table, row, evidence, ucs) - answer(table, row, evidence, tension));
    if (std::isfinite(ratio)) low = std::min(low, ratio), high = std::max(high, ratio);
  }
  return high > 0.0 ? fmt::format("{:.1f} ... {:.1f} by {}", low, high, family.label) : "";
}

bool is_mapped(double theta, Property property) {
  const Bracket b = bracket_of(property, theta);
  return b.share == 0.0 || b.share == 1.0;
}

void add_ratios(const Evidence& evidence, const std::vector<NearestPoint>& families,
                std::vector<std::string>& lines) {
  for (const Target& t : evidence.strengths)
    for (const Target& u : evidence.strengths) {
      if (!is_tensile(t.property) || u.property != Property::ucs || u.theta != t.theta ||
          (evidence.rock.bedded && !is_mapped(t.theta, t.property)))
        continue;
      std::string reached;
      for (const NearestPoint& p : families)
        if (const std::string one = ratio_line(evidence, *p.family, t); !one.empty())
          reached += (reached.empty() ? "" : "; ") + one;
      if (!reached.empty())
        lines.push_back(
            fmt::format("UCS/{} = {:.1f} in the table; {}", cell_name(t), u.mean / t.mean, reached));
    }
}

std::vector<NearestPoint> nearest_points_in(Unit unit, const Evidence& evidence) {
  std::vector<NearestPoint> list;
  for (const ModelFamily& family : model_families()) {
    if (family.layered != evidence.rock.bedded) continue;
    const ReachTable& table = reach_of(family);
    NearestPoint nearest{&family, 0, nan};
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
      if (!table.is_dense(row) || !table.is_sensible(row)) continue;
      const double error =
          error_of(table, evidence, unit, [&](const Target& t) { return answer(table, row, evidence, t); });
      if (!std::isfinite(error)) continue;
      ++nearest.n_points;
      if (!(error >= nearest.error)) nearest.error = error;
    }
    list.push_back(nearest);
  }
  return list;
}

}  // namespace

std::vector<NearestPoint> nearest_points(const Evidence& evidence) {
  return nearest_points_in(relative, evidence);
}

std::optional<Finding> against_maps(const Evidence& evidence, const std::vector<Recipe>& tried,
                                    const std::vector<Comparison>& found) {
  const auto answer_to = [&](const Target& t) {
    const Comparison* row = row_of(found, t);
    return row != nullptr && row->answered() ? compared(t.property, row->mean) : nan;
  };
  NearestPoint nearest{nullptr, 0, nan};
  double own = nan;
  int n_points = 0, n_families = 0;
  for (const NearestPoint& p : nearest_points_in(tolerance, evidence)) {
    if (p.n_points < fewest_points) continue;
    n_points += p.n_points, ++n_families;
    own = error_of(reach_of(*p.family), evidence, tolerance, answer_to);
    if (!(p.error >= nearest.error)) nearest = p;
  }
  if (nearest.family == nullptr || !std::isfinite(own)) return {};
  const ReachTable& table = reach_of(*nearest.family);
  const bool with_nu = std::any_of(evidence.targets.begin(), evidence.targets.end(), [&](const Target& t) {
    return t.property == Property::nu && was_mapped(table, evidence, t);
  });
  Finding f{FindingKind::nearest_in_maps,
            {},
            {{"model", own},
             {"nearest", nearest.error},
             {"specimens", static_cast<double>(n_points)},
             {"models", static_cast<double>(n_families)},
             {"with_nu", with_nu ? 1.0 : 0.0}},
            {nearest.family->label}};
  if (nearest.error > own / times_nearer) return f;
  const auto is_it = [&](const Recipe& model) { return nearest.family->has(model); };
  f.advice = is_it(tried.front())                             ? Advice::search_again
             : std::any_of(tried.begin(), tried.end(), is_it) ? Advice::search_again_by
                                                              : Advice::try_model;
  return f;
}

std::vector<std::string> place_in_maps(const Evidence& evidence) {
  std::vector<std::string> lines;
  if (evidence.strengths.empty()) return lines;
  std::string text;
  const std::vector<NearestPoint> families = nearest_points(evidence);
  for (const NearestPoint& p : families)
    if (std::isfinite(p.error))
      text += fmt::format("{}{:.0f} % by {} ({} specimens)", text.empty() ? "" : ", ", 100.0 * p.error,
                          p.family->label, p.n_points);
  if (!text.empty())
    lines.push_back("in the maps of what models reach, the nearest sensible specimen misses this table by " +
                    text +
                    " (root mean square over what E and strengths of it were mapped, scales free; a "
                    "search may come nearer)");
  add_ratios(evidence, families, lines);
  return lines;
}

}  // namespace phy::calibrate
