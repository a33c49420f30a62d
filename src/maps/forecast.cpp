#include "maps/forecast.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "base/embedded.hpp"
#include "base/least_squares.hpp"
#include "lab/brazilian/brazilian.hpp"
#include "maps/candidates.hpp"
#include "maps/forecast_record.hpp"
#include "maps/layered_table.hpp"
#include "maps/nearest.hpp"
#include "study/expected.hpp"
#include "verdict/cells.hpp"

namespace phy::maps {
namespace {

using verdict::miss_of;
using verdict::modulus_limit;
using verdict::strength_limit;

using Eigen::VectorXd;

constexpr double quadratic_limit =
    0.6;  // strengths also by so much of what the quadratics miss of single specimens
constexpr double range_pull = 0.5, range_wall = 50.0;  // towards the middle of the range; back into it
constexpr double edge = 0.99, place_step = 1e-4;       // of places

/// A value of the table and what the model answers.
struct Answer {
  Target target;
  MapRegression known;
};

/// Strengths are fitted where one in compression is among them.
bool is_fitted(const Evidence& evidence, Property p) { return !is_strength(p) || evidence.fits_strength(); }

/// The column of a target; nullptr: it was not mapped, as no test under a confining stress was.
const char* column_of(const Evidence& evidence, const MappedModel& model, const Target& t) {
  return t.confining > 0.0 ? nullptr : map_column(model, t.property, evidence.rock.E_is);
}

std::vector<Answer> answers_of(const Evidence& evidence, const MappedModel& model, int fold) {
  const auto of = [&](const char* column, double theta) -> const MapRegression& {
    return regression_of(model, column_at(model, column, theta), fold);
  };
  std::vector<Answer> answers;
  for (const Target& t : evidence.targets) {
    const char* column = column_of(evidence, model, t);
    if (!is_fitted(evidence, t.property) || column == nullptr) continue;
    const Bracket b = bracket_of(t.property, t.theta);
    answers.push_back({t, MapRegression(of(column, b.low), of(column, b.high), b.share)});
  }
  return answers;
}

/// Does the elastic stage move it?
bool is_elastic(const MapVariable& variable, const Recipe& recipe) {
  const std::vector<const Parameter*> all = elastic_parameters(recipe);
  return std::find(all.begin(), all.end(), variable.parameter) != all.end();
}

/// Unknowns: log E_c, log sigma_c, then the places that are sought. In the form of Eigen's
/// Levenberg-Marquardt.
struct ForecastProblem {
  using Scalar = double;
  std::vector<Answer> answers;
  std::vector<double> places;       // of all variables, as the recipe has them
  std::vector<std::size_t> sought;  // variables
  std::vector<bool> elastic;        // of those

  int inputs() const { return 2 + static_cast<int>(sought.size()); }
  int values() const { return static_cast<int>(answers.size() + 2 * sought.size()); }
  static Eigen::Index place(std::size_t j) { return static_cast<Eigen::Index>(j) + 2; }
  static Eigen::Index scale_of(const Target& t) { return is_strength(t.property) ? 1 : 0; }

  std::vector<double> places_at(const VectorXd& x) const {
    std::vector<double> all = places;
    for (std::size_t j = 0; j < sought.size(); ++j) all[sought[j]] = std::clamp(x[place(j)], -1.0, 1.0);
    return all;
  }
  /// Logarithm of an answer: moduli and strengths have one scale each, by which all of them move.
  double model(const VectorXd& x, const std::vector<double>& at, const Answer& a) const {
    return a.known.at(at) + log_share(a.target.property) +
           (measured(a.target.property).absolute ? 0.0 : x[scale_of(a.target)]);
  }
  void operator()(const VectorXd& x, VectorXd& r) const {
    const std::vector<double> at = places_at(x);
    Eigen::Index n = 0;
    for (const Answer& a : answers) {
      const double log_value = model(x, at, a), mean = a.target.mean;
      const double miss =
          measured(a.target.property).absolute ? std::exp(log_value) - mean : log_value - std::log(mean);
      r[n++] = softened(2.0 * miss / measured(a.target.property).tolerance);
    }
    // what the table leaves open stays in the middle; beyond the range the regressions know nothing
    for (std::size_t j = 0; j < sought.size(); ++j)
      r[n++] = range_pull * x[place(j)], r[n++] = range_wall * (x[place(j)] - at[sought[j]]);
  }
  void df(const VectorXd& x, Eigen::MatrixXd& J) const {
    VectorXd here(values()), ahead(values()), moved = x;
    operator()(x, here);
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      moved[j] = x[j] + place_step, operator()(moved, ahead);
      J.col(j) = (ahead - here) / place_step, moved[j] = x[j];
    }
  }
  double at(const VectorXd& x) const {
    VectorXd r(values());
    operator()(x, r);
    return r.squaredNorm();
  }
  static VectorXd clamped(const VectorXd& x) { return x; }
  /// At the places of a point of the map, with the scales that fit best there.
  VectorXd start(const std::vector<double>& from) const {
    VectorXd x = VectorXd::Zero(inputs());
    // inside the walls, where a step to either side has a slope
    for (std::size_t j = 0; j < sought.size(); ++j) x[place(j)] = std::clamp(from[sought[j]], -0.9, 0.9);
    const std::vector<double> here = places_at(x);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero(), n = sum;
    for (const Answer& a : answers) {
      if (measured(a.target.property).absolute) continue;
      sum[scale_of(a.target)] += std::log(a.target.mean) - log_share(a.target.property) - a.known.at(here);
      n[scale_of(a.target)] += 1.0;
    }
    x.head<2>() = sum.cwiseQuotient(n.cwiseMax(1.0));
    return x;
  }
};

ForecastProblem problem_of(const Evidence& evidence, const MappedModel& model, int fold) {
  ForecastProblem problem{answers_of(evidence, model, fold), {}, {}, {}};
  const Recipe& recipe = evidence.rock.model;
  const std::vector<const Parameter*> ratios = strength_ratios(evidence);
  for (std::size_t l = 0; l < model.variables.size(); ++l) {
    const MapVariable& variable = model.variables[l];
    problem.places.push_back(variable.normalised(variable.get(recipe)));
    const bool elastic = is_elastic(variable, recipe);
    if (!elastic && std::find(ratios.begin(), ratios.end(), variable.parameter) == ratios.end()) continue;
    problem.sought.push_back(l), problem.elastic.push_back(elastic);
  }
  return problem;
}

VectorXd nearest_to(const ForecastProblem& problem, const ResponseMap& table) {
  // points of the loose packing are of another density than the rock's model
  std::vector<VectorXd> starts;
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    if (table.is_dense(row)) starts.push_back(problem.start(table.places(row)));
  return nearest(problem, starts);
}

/// Made once for a column of a map.
double left_out_error(const MappedModel& family, const std::string& column) {
  static std::mutex mutex;  // several models are compared at once

  static std::map<std::pair<std::string, std::string>, double> known;
  const std::scoped_lock lock(mutex);
  const auto [it, fresh] = known.try_emplace({family.name, column}, 0.0);
  if (fresh) it->second = MapRegression::left_out_error(map_of(family), column);
  return it->second;
}

/// What the quadratics miss of a strength, or of E or nu at half of UCS, of specimens that they were not
/// shown, by its logarithm.
double regression_error(const MappedModel& model, const Target& t) {
  const char* column = measured(t.property).map.as_read;
  const Bracket b = bracket_of(t.property, t.theta);
  return std::lerp(left_out_error(model, column_at(model, column, b.low)),
                   left_out_error(model, column_at(model, column, b.high)), b.share);
}

// Between packings of 1,197 discs, rms over the cells of five rocks (measured/forecast.csv): it falls with
// the root of the number of grains. A verification takes at least five.
constexpr double mapped_grains = 1200.0, verification_packings = 5.0;
double scatter_of(Property property) {
  switch (property) {
    case Property::E: return 0.055;
    case Property::nu: return 0.017;
    case Property::ucs: return 0.08;
    default: return 0.145;
  }
}

/// What a quick search misses more than a normal one, in squares, of twenty twins (measured/effort.csv).
double quick_excess(Property property) {
  switch (property) {
    case Property::E: return 0.014;
    case Property::ucs: return 0.042;
    default: return 0.0;  // not measured
  }
}

/// What coarse discs add to an error; of fine ones nothing is promised.
double tension_bias(double grains_across) {
  return grains_across > 0.0 ? std::max(0.0, tension_over_maps(grains_across) - 1.0) : 0.0;
}

/// What the nearest layered elastic body misses of nu, root mean square; 0 where the table has no nu beside
/// E.
double nu_missed_by_bodies(const Evidence& evidence) {
  if (!evidence.rock.bedded || !evidence.has(Property::E) || !evidence.has(Property::nu)) return 0.0;
  const std::vector<theory::LayeredReading> readings = layered_readings(evidence.moduli);
  const theory::LayeredFit body = theory::fit_layered(readings, theory::LayeredBody::any);
  double squares = 0.0;
  int n = 0;
  for (const theory::LayeredReading& r : readings)
    if (!r.is_modulus) squares += std::pow(body.at(r.theta).nu - r.value, 2.0), ++n;
  return n > 0 ? std::sqrt(squares / n) : 0.0;
}

/// Do the strengths miss as a whole, and not only where the quadratics know little?
bool strengths_out_of_reach(const Forecast& f) {
  double squares = 0.0, scaled = 0.0;
  int n = 0;
  for (const Comparison& c : f.rows)
    if (is_strength(c.target.property)) squares += c.error() * c.error(), ++n;
  // as the verdict has it; then whether the regressions know enough to say so
  if (n == 0 || !(std::sqrt(squares / n) > strength_limit)) return false;
  for (const Comparison& c : f.rows) {
    if (!is_strength(c.target.property)) continue;
    const double chance =
        std::hypot(regression_error(*f.model, c.target), c.target.normal_error() / c.target.mean);
    scaled += std::pow(std::log1p(c.error()) / chance, 2.0);
  }
  return std::sqrt(scaled / n) > quadratic_limit;
}

/// As judge() does, with the limits of a forecast.
VerdictStatus status_of(const Forecast& f) {
  if ((!f.beyond_map && f.rms(Property::E) > modulus_limit) || strengths_out_of_reach(f))
    return VerdictStatus::out_of_reach;
  if (f.nu_of_nearest_body > measured(Property::nu).tolerance) return VerdictStatus::calibrated_except;
  std::vector<Comparison> rows = f.rows;
  if (f.beyond_map)  // no miss of the model's
    std::erase_if(rows, [](const Comparison& c) { return c.target.property == Property::E; });
  return verdict::status_of(verdict::judge_cells(rows));
}

/// What of the table was not mapped.
std::vector<Target> unmapped(const Evidence& evidence, const MappedModel& model) {
  std::vector<Target> list;
  for (const Target& t : evidence.targets)
    if (is_fitted(evidence, t.property) && column_of(evidence, model, t) == nullptr) list.push_back(t);
  return list;
}

/// Do planes in an isotropic rock have these E within their errors?
bool planes_may_have(const std::vector<Target>& E) {
  const std::vector<theory::LayeredReading> readings = layered_readings(E);
  if (readings.empty()) return true;
  for (const auto body : {theory::LayeredBody::any, theory::LayeredBody::planes_in_isotropic_rock})
    if (!theory::fit_layered(readings, body).met()) return false;
  return true;
}

std::optional<Forecast> forecast_one(const Evidence& evidence, int fold) {
  const MappedModel* model = mapped_model_of(evidence.rock.model);
  if (model == nullptr) return std::nullopt;
  const ForecastProblem problem = problem_of(evidence, *model, fold);
  if (problem.answers.empty()) return std::nullopt;
  const VectorXd x = nearest_to(problem, map_of(*model));
  Forecast f;
  f.model = model, f.distance = problem.at(x), f.unmapped = unmapped(evidence, *model);
  const Recipe& recipe = evidence.rock.model;
  f.n_grains = study::expected_grains(recipe), f.nu_of_nearest_body = nu_missed_by_bodies(evidence);
  for (const Target& t : evidence.targets)
    if (t.property == Property::brazilian) f.grains_across = grains_across_disc(recipe, t);
  const std::vector<double> at = problem.places_at(x);
  for (const Answer& a : problem.answers) {
    Comparison c;
    c.target = a.target, c.mean = std::exp(problem.model(x, at, a));
    f.rows.push_back(c);
  }
  // stiffnesses at the end of their range: softer or stiffer joints were not mapped, which is no limit of E
  bool at_edge = false;
  for (std::size_t j = 0; j < problem.sought.size(); ++j)
    at_edge = at_edge || (problem.elastic[j] && std::fabs(x[ForecastProblem::place(j)]) > edge);
  f.beyond_map = at_edge && f.rms(Property::E) > modulus_limit &&
                 planes_may_have(of_property(evidence.moduli, Property::E));
  return f;
}

}  // namespace

double grains_across_disc(const Recipe& model, const Target& t) {
  return (t.diameter > 0.0 ? t.diameter : lab::disc_diameter(model)) / grain_size(model);
}

double tension_over_maps(double grains_across) {
  constexpr double of_maps = 24.0, power = 0.21;
  return std::pow(of_maps / grains_across, power);
}

double Forecast::error_of(const Target& t) const { return regression_error(*model, t); }

double Forecast::rms(Property property) const {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : rows)
    if (c.target.property == property) squares += miss_of(c) * miss_of(c), ++n;
  return n > 0 ? std::sqrt(squares / n) : nan;
}

std::optional<ErrorRange> Forecast::expected_error(Property property) const {
  double missed = rms(property), squares = 0.0;
  int n = 0;
  for (const Comparison& c : rows) {
    if (c.target.property != property) continue;
    // the quadratics are of logarithms, also of nu
    const double size = measured(property).absolute ? c.target.mean : 1.0;
    squares += std::pow(size * regression_error(*model, c.target), 2.0), ++n;
  }
  if (n == 0) return {};
  if (property == Property::nu) missed = std::max(missed, nu_of_nearest_body);
  const double packings = scatter_of(property) * std::sqrt(mapped_grains / n_grains / verification_packings),
               bias = property == Property::brazilian ? tension_bias(grains_across) : 0.0;
  const double search = quick ? quick_excess(property) : 0.0;
  return ErrorRange{std::max(missed, packings),
                    std::hypot(std::hypot(missed + bias, std::sqrt(squares / n), packings), search)};
}

bool Forecast::meets() const {
  return std::all_of(rows.begin(), rows.end(), [&](const Comparison& c) {
    return rms(c.target.property) <= measured(c.target.property).tolerance;
  });
}

std::optional<Forecast> forecast_of(const Evidence& evidence, int fold) {
  if (!evidence.has(Property::E) && !evidence.has(Property::ucs)) return std::nullopt;
  // no model was mapped under confinement, and none has what this table asks of it
  if (!evidence.rock.bedded && change_under_confinement(evidence.targets, evidence.rock.E_is))
    return std::nullopt;
  // most of such a table was not mapped
  if (evidence.fits_strength() && !evidence.has(Property::ucs)) return std::nullopt;
  std::optional<Forecast> best;
  for (const Rock& rock : candidates_of(evidence)) {
    std::optional<Forecast> one = forecast_one(Evidence(rock, evidence.targets), fold);
    if (!one) continue;
    // flat joints after all others, as they are chosen: they have to meet what nothing else does
    const bool flat = rock.model.matrix.model == MatrixModel::flat_joint;
    if (!best || (flat ? !best->meets() && one->meets() : one->distance < best->distance))
      best = std::move(one);
  }
  if (best) best->status = status_of(*best), best->quick = best->status == VerdictStatus::out_of_reach;
  return best;
}

namespace {

FindingKind kind_of(VerdictStatus status) {
  switch (status) {
    case VerdictStatus::out_of_reach: return FindingKind::forecast_out_of_reach;
    case VerdictStatus::calibrated_except:
    case VerdictStatus::not_calibrated: return FindingKind::forecast_excepted;
    case VerdictStatus::not_decided: return FindingKind::forecast_unresolved;
    default: return FindingKind::forecast_calibrated;
  }
}

/// The rows farthest beyond what passes.
std::vector<Finding> farthest_rows(const Forecast& f) {
  constexpr std::size_t most_named = 4;
  std::vector<verdict::JudgedCell> cells = verdict::judge_cells(f.rows);
  std::erase_if(cells, [](const auto& c) { return std::fabs(c.scaled_miss()) <= 1.0; });
  std::stable_sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
    return std::fabs(a.scaled_miss()) > std::fabs(b.scaled_miss());
  });
  std::vector<Finding> list;
  for (const verdict::JudgedCell& c : cells) {
    if (list.size() == most_named) break;  // more would hide the farthest
    list.push_back({FindingKind::forecast_missed,
                    {cell_of(c.row.target)},
                    {{"model", c.row.mean}, {"laboratory", c.row.target.mean}}});
  }
  return list;
}

}  // namespace

std::vector<Finding> findings_of(const Forecast& f) {
  Finding end{kind_of(f.status), {}, {}, {f.model->label}};
  for (const MeasuredProperty& p : measured_properties())
    if (const auto error = f.expected_error(p.property))
      end.numbers.insert(end.numbers.end(), {{p.name, error->low}, {p.name, error->high}});
  std::vector<Finding> list = {end};
  const auto add = [&](std::vector<Finding> more) { list.insert(list.end(), more.begin(), more.end()); };
  add(farthest_rows(f));
  if (f.beyond_map) list.push_back({FindingKind::forecast_beyond_map});
  if (!f.unmapped.empty()) {
    Finding silent{FindingKind::forecast_unmapped};
    for (const Target& t : f.unmapped) silent.cells.push_back(cell_of(t));
    list.push_back(silent);
  }
  list.push_back(record_of(*f.model, embedded("data/rocks/synthetic_forecasts.csv")));
  list.push_back(record_on_rocks(embedded("data/rocks/forecasts.csv")));
  return list;
}

}  // namespace phy::maps
