#include "calibrate/forecast.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

#include "base/least_squares.hpp"
#include "calibrate/model_choice.hpp"
#include "calibrate/nearest.hpp"
#include "verdict/margin.hpp"

namespace phy::calibrate {
namespace {

using verdict::margin;
using verdict::miss_of;
using verdict::misses;
using verdict::modulus_limit;
using verdict::strength_limit;
using verdict::tolerance;
using verdict::unresolved;

using Eigen::VectorXd;

constexpr double quadratic_limit =
    0.6;  // strengths also by so much of what the quadratics miss of single specimens
constexpr double range_pull = 0.5, range_wall = 50.0;  // towards the middle of the range; back into it
constexpr double edge = 0.99, place_step = 1e-4;       // of places
constexpr std::size_t n_map_starts = 6, most_values_named = 4;

/// A value of the table and what the family answers.
struct Answer {
  Target target;
  ReachRegression known;
};

/// Strengths are fitted where one in compression is among them.
bool is_fitted(const Evidence& evidence, Property p) { return !is_strength(p) || evidence.fits_strength(); }

/// The column of a target; nullptr: it was not mapped, as no test under a confining stress was.
const char* column_of(const Evidence& evidence, const ModelFamily& family, const Target& t) {
  return t.confining > 0.0 ? nullptr : map_column(family, t.property, evidence.rock.E_is);
}

/// What is told of a value that is not foretold.
std::string silent_name(const Target& t) {
  const bool moduli = t.confining > 0.0 && !is_strength(t.property);
  return to_string(t.property) + std::string(moduli ? " under confinement" : "");
}

std::vector<Answer> answers_of(const Evidence& evidence, const ModelFamily& family, int fold) {
  std::map<std::string, ReachRegression> made;
  const auto of = [&](const char* name, double theta) {
    const std::string column = column_at(family, name, theta);
    const auto it = made.find(column);
    if (it != made.end()) return it->second;
    return made.emplace(column, ReachRegression(reach_of(family), column, fold)).first->second;
  };
  std::vector<Answer> answers;
  for (const Target& t : evidence.targets) {
    const char* column = column_of(evidence, family, t);
    if (!is_fitted(evidence, t.property) || column == nullptr) continue;
    const Bracket b = bracket_of(t.property, t.theta);
    answers.push_back({t, ReachRegression(of(column, b.low), of(column, b.high), b.share)});
  }
  return answers;
}

/// Does the elastic stage move it?
bool is_elastic(const Lever& lever, const Recipe& recipe) {
  const std::vector<const ElasticParameter*> all = elastic_parameters(recipe);
  return std::any_of(all.begin(), all.end(), [&](const ElasticParameter* p) {
    Recipe once = recipe, twice = recipe;
    p->set(once, 1.0), p->set(twice, 2.0);
    return lever.get(once) != lever.get(twice);
  });
}

/// Unknowns: log E_c, log sigma_c, then the places that are sought. In the form of Eigen's
/// Levenberg-Marquardt.
struct ForecastProblem {
  using Scalar = double;
  std::vector<Answer> answers;
  std::vector<double> places;       // of all levers, as the recipe has them
  std::vector<std::size_t> sought;  // levers
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
  /// Logarithm of an answer.
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
      r[n++] = softened(2.0 * miss / tolerance(a.target.property));
    }
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
  /// At the places of a point of the map, with the scales that fit best there.
  VectorXd start(const std::vector<double>& from) const {
    VectorXd x = VectorXd::Zero(inputs());
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

ForecastProblem problem_of(const Evidence& evidence, const ModelFamily& family, int fold) {
  ForecastProblem problem{answers_of(evidence, family, fold), {}, {}, {}};
  const Recipe& recipe = evidence.rock.model;
  const std::vector<const StrengthParameter*> ratios = strength_ratios(evidence);
  for (std::size_t l = 0; l < family.levers.size(); ++l) {
    const Lever& lever = family.levers[l];
    problem.places.push_back(lever.place_of(lever.get(recipe)));
    const bool elastic = is_elastic(lever, recipe);
    if (!elastic && std::find(ratios.begin(), ratios.end(), lever.parameter) == ratios.end()) continue;
    problem.sought.push_back(l), problem.elastic.push_back(elastic);
  }
  return problem;
}

VectorXd nearest_of(ForecastProblem& problem, const ReachTable& table) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    if (table.is_dense(row)) order.emplace_back(problem.at(problem.start(table.places(row))), row);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), n_map_starts));
  VectorXd best = problem.start(table.places(order.front().second));
  for (const auto& [value, row] : order) {
    const VectorXd x = least_squares(misfits_of(problem), problem.start(table.places(row)), {60, 1e-4, 1.0});
    if (problem.at(x) < problem.at(best)) best = x;
  }
  return best;
}

/// Made once for a column of a map.
double left_out_error(const ModelFamily& family, const std::string& column) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::string>, double> known;
  const std::scoped_lock lock(mutex);
  const auto [it, fresh] = known.try_emplace({family.name, column}, 0.0);
  if (fresh) it->second = ReachRegression::left_out_error(reach_of(family), column);
  return it->second;
}

/// What the quadratics miss of a strength, or of E or nu at half of UCS, of specimens that they were not
/// shown, by its logarithm.
double ignorance(const ModelFamily& family, const Target& t) {
  const char* column = measured(t.property).map.as_read;
  const Bracket b = bracket_of(t.property, t.theta);
  return std::lerp(left_out_error(family, column_at(family, column, b.low)),
                   left_out_error(family, column_at(family, column, b.high)), b.share);
}

/// Do the strengths miss as a whole, and not only where the quadratics know little?
bool strengths_out_of_reach(const Forecast& f) {
  double squares = 0.0, scaled = 0.0;
  int n = 0;
  for (const Comparison& c : f.rows)
    if (is_strength(c.target.property)) squares += c.error() * c.error(), ++n;
  if (n == 0 || !(std::sqrt(squares / n) > strength_limit)) return false;
  for (const Comparison& c : f.rows) {
    if (!is_strength(c.target.property)) continue;
    const double chance = std::hypot(ignorance(*f.family, c.target), c.target.normal_error() / c.target.mean);
    scaled += std::pow(std::log1p(c.error()) / chance, 2.0);
  }
  return std::sqrt(scaled / n) > quadratic_limit;
}

/// As judge() does, with the limits of a forecast.
VerdictStatus status_of(const Forecast& f) {
  if ((!f.beyond_map && f.rms(Property::E) > modulus_limit) || strengths_out_of_reach(f))
    return VerdictStatus::out_of_reach;
  bool any_missed = false, coarse = false;
  for (const Comparison& c : f.rows) {
    any_missed = any_missed || (misses(c) && !(f.beyond_map && c.target.property == Property::E));
    coarse = coarse || unresolved(c);
  }
  return any_missed ? VerdictStatus::calibrated_except
         : coarse   ? VerdictStatus::not_resolved
                    : VerdictStatus::calibrated;
}

/// Do planes in an isotropic rock have these E within their errors?
bool planes_may_have(const std::vector<Target>& E) {
  const std::vector<theory::LayeredReading> readings = layered_readings(E);
  if (readings.empty()) return true;
  for (const auto body : {theory::LayeredBody::any, theory::LayeredBody::planes_in_isotropic_rock})
    if (!theory::fit_layered(readings, body).met()) return false;
  return true;
}

std::optional<Forecast> foretell_one(const Evidence& evidence, int fold) {
  const ModelFamily* family = family_of(evidence.rock.model);
  if (family == nullptr) return std::nullopt;
  ForecastProblem problem = problem_of(evidence, *family, fold);
  if (problem.answers.empty()) return std::nullopt;
  const VectorXd x = nearest_of(problem, reach_of(*family));
  Forecast f;
  f.family = family, f.distance = problem.at(x);
  const std::vector<double> at = problem.places_at(x);
  for (const Answer& a : problem.answers) {
    Comparison c;
    c.target = a.target, c.mean = std::exp(problem.model(x, at, a));
    f.rows.push_back(c);
  }
  for (const Target& t : evidence.targets)
    if (is_fitted(evidence, t.property) && column_of(evidence, *family, t) == nullptr)
      if (const std::string name = silent_name(t); f.silent.empty() || f.silent.back() != name)
        f.silent.push_back(name);
  bool at_edge = false;
  for (std::size_t j = 0; j < problem.sought.size(); ++j)
    at_edge = at_edge || (problem.elastic[j] && std::fabs(x[ForecastProblem::place(j)]) > edge);
  f.beyond_map = at_edge && f.rms(Property::E) > modulus_limit &&
                 planes_may_have(of_property(evidence.moduli, Property::E));
  return f;
}

std::string percent(double v) { return fmt::format("{:.0f} %", 100.0 * v); }

std::string all_misses(const Forecast& f) {
  std::string text;
  for (int i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    const double v = f.rms(p);
    if (std::isfinite(v))
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(p),
                          p == Property::nu ? fmt::format("{:.2f}", v) : percent(v));
  }
  return text;
}

/// "UCS(90) (-15 %), nu(0) (+0.07)": the rows farthest beyond their margins.
std::string farthest_rows(const Forecast& f) {
  std::vector<const Comparison*> beyond;
  for (const Comparison& c : f.rows)
    if (misses(c)) beyond.push_back(&c);
  const auto over = [](const Comparison* c) { return std::fabs(miss_of(*c)) / margin(*c); };
  std::stable_sort(beyond.begin(), beyond.end(),
                   [&](const Comparison* a, const Comparison* b) { return over(a) > over(b); });
  std::string text;
  for (std::size_t i = 0; i < std::min(beyond.size(), most_values_named); ++i) {
    const Comparison& c = *beyond[i];
    text += (i > 0 ? ", " : "") + cell_name(c.target) +
            (c.target.property == Property::nu ? fmt::format(" ({:+.2f})", miss_of(c))
                                               : fmt::format(" ({:+.0f} %)", 100.0 * miss_of(c)));
  }
  if (beyond.size() > most_values_named)
    text += fmt::format(" and {} more", beyond.size() - most_values_named);
  return text;
}

std::string outcome(const Forecast& f) {
  const std::string rows = farthest_rows(f);
  switch (f.status) {
    case VerdictStatus::out_of_reach: return "out of reach" + (rows.empty() ? "" : "; farthest off " + rows);
    case VerdictStatus::calibrated_except:
      return rows.empty() ? "calibrated with exceptions" : "calibrated except for values like " + rows;
    case VerdictStatus::not_resolved: return "not resolved: met, but by too few specimens to tell";
    case VerdictStatus::calibrated:
    case VerdictStatus::interrupted: break;
  }
  return "calibrated, or with few exceptions";
}

}  // namespace

double Forecast::rms(Property property) const {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : rows)
    if (c.target.property == property) squares += miss_of(c) * miss_of(c), ++n;
  return n > 0 ? std::sqrt(squares / n) : nan;
}

bool Forecast::meets() const {
  return std::all_of(rows.begin(), rows.end(), [&](const Comparison& c) {
    return rms(c.target.property) <= tolerance(c.target.property);
  });
}

std::optional<Forecast> foretell(const Evidence& evidence, int fold) {
  if (!evidence.has(Property::E) && !evidence.has(Property::ucs)) return std::nullopt;
  // no model was mapped under confinement, and none has what this table asks of it
  if (!evidence.rock.bedded && change_under_confinement(evidence.targets, evidence.rock.E_is))
    return std::nullopt;
  // most of such a table was not mapped
  if (evidence.fits_strength() && !evidence.has(Property::ucs)) return std::nullopt;
  std::optional<Forecast> best;
  for (const Rock& rock : candidates_of(evidence)) {
    std::optional<Forecast> one = foretell_one(Evidence(rock, evidence.targets), fold);
    if (!one) continue;
    const bool flat =
        rock.model.matrix.model == MatrixModel::flat_joint;  // after all others, as they are chosen
    if (!best || (flat ? !best->meets() && one->meets() : one->distance < best->distance))
      best = std::move(one);
  }
  if (best) best->status = status_of(*best);
  return best;
}

namespace {

/// "11 to 25 % of UCS": what the quadratics miss at the angles of a property; nothing where it has none.
std::string ignorance_text(const Forecast& f, Property property, const char* name) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Comparison& c : f.rows) {
    if (c.target.property != property) continue;
    const double missed = ignorance(*f.family, c.target);
    least = std::fmin(least, missed), most = std::fmax(most, missed);
  }
  if (most == 0.0) return "";
  const std::string low = fmt::format("{:.0f}", 100.0 * least), high = fmt::format("{:.0f}", 100.0 * most);
  return fmt::format("{}{} % of {}", low == high ? "" : low + " to ", high, name);
}

/// How often such forecasts were wrong (docs/calibration.md).
const char* record_of(const ModelFamily& family) {
  if (family.base.matrix.model == MatrixModel::flat_joint)
    return "forecasts of flat joints have not been tried on tables whose end is known";
  if (family.layered && has_bridges(family.base))
    return "of 200 such forecasts of synthetic rock with bridges, whose share was stated and whose specimens "
           "differ by where they lie, 30 were wrong";
  return family.layered ? "of 220 such forecasts of synthetic layered rock 18 were wrong; the measured rock "
                          "that was tried was "
                          "missed by more than foretold in every run"
                        : "of 60 such forecasts of synthetic rock, with Brazilian strengths of an earlier "
                          "version, one was wrong";
}

}  // namespace

std::string forecast_text(const Forecast& f) {
  std::string text =
      fmt::format("foretold: a calibration will probably end {}. Expected misses by {}, root mean square: {}",
                  outcome(f), f.family->label, all_misses(f));
  if (f.beyond_map) text += "; E lies where nothing was mapped, though planes in an isotropic rock have it";
  if (!f.silent.empty())
    text += fmt::format(". Not foretold, because not mapped: {}", fmt::join(f.silent, ", "));
  std::vector<std::string> missed;
  for (const auto& [property, name] : {std::pair{Property::ucs, "UCS"}, std::pair{Property::brazilian, "BTS"},
                                       std::pair{Property::direct_tension, "DTS"},
                                       std::pair{Property::E, "E50"}, std::pair{Property::nu, "nu50"}})
    if (const std::string one = ignorance_text(f, property, name); !one.empty()) missed.push_back(one);
  return text + fmt::format(
                    ". No test has run: this rests on regressions over the maps, which miss a specimen that "
                    "they were not shown by {}; {}",
                    fmt::join(missed, ", "), record_of(*f.family));
}

}  // namespace phy::calibrate
