#include "maps/placing.hpp"

#include <algorithm>
#include <cmath>

#include "base/nan.hpp"

namespace phy::maps {
namespace {

constexpr int fewest_points = 64;  // of a model that says something by what it does not reach
constexpr double times_nearer = 1.1;

/// A number as models are compared by it: its logarithm, but nu, which may be negative, as it is.
double compared(Property property, double value) {
  return measured(property).absolute ? value : std::log(value);
}

/// The same of a cell between the mapped inclinations of a property, linear. `column`: "UCS/sigma_c".
double compared_at(const ResponseMap& table, std::size_t row, const std::string& column, Property property,
                   double theta) {
  const Bracket b = bracket_of(property, theta);
  const auto at = [&](double angle) {
    return compared(property, table.at(row, column_at(table.model(), column, angle)));
  };
  return (b.share < 1.0 ? (1.0 - b.share) * at(b.low) : 0.0) + (b.share > 0.0 ? b.share * at(b.high) : 0.0) +
         log_share(property);
}

/// The column of a target; nullptr: it was not mapped, as no test under a confining stress was. nu was read
/// at half of UCS, as that of a model is only where the table has E as a test reads it.
const char* column_of(const ResponseMap& table, const Evidence& evidence, const Target& t) {
  if (t.confining != 0.0 || (t.property == Property::nu && !evidence.has(Property::E))) return nullptr;
  return map_column(table.model(), t.property, evidence.rock.E_is);
}
bool was_mapped(const ResponseMap& table, const Evidence& evidence, const Target& t) {
  return column_of(table, evidence, t) != nullptr;
}

/// What a point gives for a target, as compared(), up to a scale but for nu; NaN: it was not mapped, or has
/// no answer.
double answer(const ResponseMap& table, std::size_t row, const Evidence& evidence, const Target& t) {
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
double tolerance_of(Property property) { return measured(property).tolerance; }
double relative(Property property) { return measured(property).absolute ? nan : 1.0; }

/// Of the values of the table that were mapped; `answer_to`: of a model, as compared(), up to its two
/// scales.
template <class Answer>
double error_of(const ResponseMap& table, const Evidence& evidence, Unit unit, const Answer& answer_to) {
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
  // a scale that is free takes one value away from what can be missed
  const int free = (moduli.n > 0 ? 1 : 0) + (strengths.n > 0 ? 1 : 0);
  const int n = moduli.n + strengths.n + n_nu - free;
  if (strengths.n == 0 || n < 2) return nan;  // nothing, or hardly anything, to compare
  return std::sqrt((moduli.about_mean() + strengths.about_mean() + squares) / n);
}

bool is_mapped(double theta, Property property) {
  const Bracket b = bracket_of(property, theta);
  return b.share == 0.0 || b.share == 1.0;
}

/// UCS over tension of plausible points where the table has both at one inclination that was mapped.
struct Ratios {
  double low = infinity, high = 0.0;
  explicit Ratios(const Evidence& evidence, const MappedModel& model, const Target& tension) {
    const ResponseMap& table = map_of(model);
    const Target ucs{Property::ucs, tension.theta, 1.0, 1.0};
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
      if (!table.is_dense(row) || !table.is_plausible(row)) continue;
      // NaN where one of the two tests has no answer there
      const double ratio =
          std::exp(answer(table, row, evidence, ucs) - answer(table, row, evidence, tension));
      if (std::isfinite(ratio)) low = std::min(low, ratio), high = std::max(high, ratio);
    }
  }
};

/// The ratio of the table beside those of all models, with the names of models that reach it.
std::optional<Finding> ratio_in_maps(const Evidence& evidence, const std::vector<const MappedModel*>& models,
                                     const Target& tension, double laboratory) {
  double low = infinity, high = 0.0, flat_joints = 0.0;
  Finding f{FindingKind::map_ratio, {cell_of(tension)}};
  for (const MappedModel* m : models) {
    const Ratios reached(evidence, *m, tension);
    low = std::min(low, reached.low), high = std::max(high, reached.high);
    if (!(reached.low <= laboratory && laboratory <= reached.high)) continue;
    f.names.emplace_back(m->label);
    flat_joints += m->model->matrix == MatrixModel::flat_joint ? 1.0 : 0.0;
  }
  if (high == 0.0) return {};
  f.numbers = {{"laboratory", laboratory},
               {"low", low},
               {"high", high},
               {"models", static_cast<double>(models.size())},
               {"flat_joints", flat_joints}};
  return f;
}

std::vector<ClosestMapped> closest_mapped_in(Unit unit, const Evidence& evidence) {
  std::vector<ClosestMapped> list;
  for (const MappedModel& model : mapped_models()) {
    if (model.layered() != evidence.rock.bedded) continue;
    const ResponseMap& table = map_of(model);
    ClosestMapped nearest{&model, 0, nan};
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
      if (!table.is_dense(row) || !table.is_plausible(row)) continue;
      const double error =
          error_of(table, evidence, unit, [&](const Target& t) { return answer(table, row, evidence, t); });
      if (!std::isfinite(error)) continue;
      ++nearest.n_points;
      if (!(error >= nearest.error)) nearest.error = error;  // also where none was known yet: NaN
    }
    list.push_back(nearest);
  }
  return list;
}

}  // namespace

std::vector<Finding> ratios_in_maps(const Evidence& evidence, const std::vector<const MappedModel*>& models) {
  std::vector<Finding> findings;
  for (const Target& t : evidence.strengths)
    for (const Target& u : evidence.strengths) {
      if (!is_tensile(t.property) || u.property != Property::ucs || u.theta != t.theta ||
          (evidence.rock.bedded && !is_mapped(t.theta, t.property)))
        continue;
      if (auto f = ratio_in_maps(evidence, models, t, u.mean / t.mean)) findings.push_back(std::move(*f));
    }
  return findings;
}

std::vector<ClosestMapped> closest_mapped(const Evidence& evidence) {
  return closest_mapped_in(relative, evidence);
}

std::optional<Finding> against_maps(const Evidence& evidence, const std::vector<Recipe>& tried,
                                    const std::vector<Comparison>& found) {
  const auto answer_to = [&](const Target& t) {
    const Comparison* row = row_of(found, t);
    return row != nullptr && row->answered() ? compared(t.property, row->mean) : nan;
  };
  ClosestMapped nearest{nullptr, 0, nan};
  int n_points = 0, n_models = 0;
  for (const ClosestMapped& p : closest_mapped_in(tolerance_of, evidence)) {
    // a sparse map says little by what is not in it
    if (p.n_points < fewest_points) continue;
    n_points += p.n_points, ++n_models;
    if (!(p.error >= nearest.error)) nearest = p;
  }
  if (nearest.model == nullptr) return {};
  const ResponseMap& table = map_of(*nearest.model);
  const double own = error_of(table, evidence, tolerance_of, answer_to);
  if (!std::isfinite(own)) return {};
  const bool with_nu = std::any_of(evidence.targets.begin(), evidence.targets.end(), [&](const Target& t) {
    return t.property == Property::nu && was_mapped(table, evidence, t);
  });
  Finding f{FindingKind::nearest_in_maps,
            {},
            {{"model", own},
             {"nearest", nearest.error},
             {"specimens", static_cast<double>(n_points)},
             {"models", static_cast<double>(n_models)},
             {"with_nu", with_nu ? 1.0 : 0.0}},
            {nearest.model->label}};
  for (const Target& t : evidence.targets)
    if (!was_mapped(table, evidence, t)) f.cells.push_back(cell_of(t));
  // what is nearer by less may be chance: mapped specimens scatter as all others do
  if (nearest.error > own / times_nearer) return f;
  const auto is_it = [&](const Recipe& model) { return nearest.model->has(model); };
  f.advice = is_it(tried.front())                             ? Advice::search_again
             : std::any_of(tried.begin(), tried.end(), is_it) ? Advice::search_again_by
                                                              : Advice::try_model;
  return f;
}

std::vector<Finding> place_in_maps(const Evidence& evidence) {
  std::vector<Finding> findings;
  if (evidence.strengths.empty()) return findings;  // E alone is met by many a point
  const std::vector<ClosestMapped> models = closest_mapped(evidence);
  for (const ClosestMapped& m : models)
    if (std::isfinite(m.error))
      findings.push_back({FindingKind::map_nearest,
                          {},
                          {{"error", m.error}, {"specimens", static_cast<double>(m.n_points)}},
                          {m.model->label}});
  std::vector<const MappedModel*> all;
  for (const ClosestMapped& m : models) all.push_back(m.model);
  for (Finding& f : ratios_in_maps(evidence, all)) findings.push_back(std::move(f));
  return findings;
}

}  // namespace phy::maps
