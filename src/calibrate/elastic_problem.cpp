#include "calibrate/elastic_problem.hpp"

#include <algorithm>
#include <cmath>

#include "base/stats.hpp"
#include "calibrate/elastic_response.hpp"
#include "maps/layered_table.hpp"

namespace phy::calibrate {
namespace {

constexpr double box_stop = 20.0;      // per logarithm outside the box: a soft but certain stop
constexpr double usual_overlap = 1.5;  // joint length per plane length, for the first guess only
// what one-sided contacts usually make of E and nu, until it is measured
constexpr double usual_factor = 0.97, usual_addition = 0.05;

/// dE or dnu by a parameter of the direct solution.
double rate(const Sensitivity& s, Property property) { return property == Property::E ? s.dE : s.dnu; }

/// Eq. 1 by least squares; where it refuses, a guess of usual joints.
theory::JointedRock macro_of(const Evidence& evidence) {
  const theory::Eq1Fit eq1 = maps::eq1_through(evidence);
  const double stiffest = evidence.scales.modulus;
  // Only a place to begin: where Eq. 1 refuses a table, the least squares still find their way from here.
  return eq1.ok() ? eq1.rock : theory::JointedRock{stiffest, 4.0 * stiffest, 2.0 * stiffest, 0.25};
}

}  // namespace

ElasticProblem::ElasticProblem(const Evidence& evidence, Simulator& simulator)
    : evidence_(evidence), simulator_(simulator), parameters_(elastic_parameters(evidence.rock.model)) {
  for (const Parameter* p : parameters_) boxes_.push_back(p->box(evidence.scales));
  for (const Target& t : evidence.moduli) {
    const bool modulus = t.property == Property::E;
    rows_.push_back({t, modulus ? usual_factor : 1.0, modulus ? 0.0 : usual_addition});
  }
}

// Answers are kept by x alone, so that a change of packings has to forget them.
void ElasticProblem::use_packings(std::vector<std::int64_t> seeds) { seeds_ = std::move(seeds), x_.clear(); }

ElasticProblem::Point ElasticProblem::first_guess(std::int64_t seed) {
  const Recipe& model = evidence_.rock.model;
  FirstSight sight;
  const theory::JointedRock macro = macro_of(evidence_);
  sight.macro_E = macro.E, sight.K_n_delta = macro.K_n_delta, sight.K_s_delta = macro.K_s_delta;
  Recipe intact = single_at(model, 0.0, seed);
  // E of the bare matrix over its E_c is one factor for all E_c: a single solution gives the first guess.
  intact.bedding.clear();
  sight.E_c = intact.matrix.E_c, sight.E = simulator_.elastic({intact}, Statics::two_sided).front().E_gauge;
  if (!model.bedding.empty()) sight.joint_length = usual_overlap * model.bedding.front().spacing;
  Point x;
  for (std::size_t j = 0; j < n_parameters(); ++j) {
    auto* const guess = parameter(j).modulus->first_guess;
    x.push_back(std::clamp(guess == nullptr ? box(j).usual : std::log(guess(sight)), box(j).low + 0.1,
                           // Off the walls, whose residuals would turn the first step.
                           box(j).high - 0.1));
  }
  return x;
}

Recipe ElasticProblem::recipe_at(const Point& x) const {
  Recipe r = evidence_.rock.model;
  for (std::size_t j = 0; j < n_parameters(); ++j)
    // A wild trial step beyond the soft wall still meets stiffnesses that can be solved.
    parameter(j).set(r, std::exp(std::clamp(x[j], box(j).low - 1.0, box(j).high + 1.0)));
  return r;
}

const std::vector<ElasticAnswer>& ElasticProblem::answers(const Point& x) {
  if (x_ != x) x_ = x, two_sided_ = solved(x, seeds_, Statics::with_rates);
  // The corrections change without a new solution, so they are applied at every call.
  answers_ = two_sided_;
  for (std::size_t i = 0; i < n_targets(); ++i) {
    ElasticAnswer& a = answers_[i];
    a.mean = a.mean * rows_[i].factor + rows_[i].addition, a.sd *= rows_[i].factor;
    // An addition has no slope: it is taken as constant between two measurements.
    for (double& slope : a.slope) slope *= rows_[i].factor;
  }
  return answers_;
}

Linearised ElasticProblem::linearised(const Point& x) {
  const std::vector<ElasticAnswer>& a = answers(x);
  const std::size_t n = n_targets(), m = n_parameters();
  Linearised at{std::vector<double>(n_residuals()), std::vector<double>(n_residuals() * m)};
  const auto J = [&](std::size_t i, std::size_t j) -> double& { return at.jacobian[j * n_residuals() + i]; };
  for (std::size_t i = 0; i < n; ++i) {
    const double lab = rows_[i].target.mean, s = unit_of_misfit(rows_[i]);
    const bool modulus = rows_[i].is_modulus();
    const double r = modulus ? std::log(a[i].mean / lab) / s : (a[i].mean - lab) / s;
    const bool answered = std::isfinite(r);
    // The row of slopes stays zero, so that no direction is made up from a missing answer.
    at.residuals[i] = answered ? r : 1e3;  // no answer here: step back
    for (std::size_t j = 0; j < m && answered; ++j)
      J(i, j) = (modulus ? 1.0 / a[i].mean : 1.0) * a[i].slope[j] / s;
  }
  for (std::size_t j = 0; j < m; ++j) {
    const double s = 0.5 * (box(j).high - box(j).low);
    at.residuals[n + j] = (x[j] - box(j).usual) / s, J(n + j, j) = 1.0 / s;
    const double out = x[j] - std::clamp(x[j], box(j).low, box(j).high);
    at.residuals[n + m + j] = box_stop * out, J(n + m + j, j) = out != 0.0 ? box_stop : 0.0;
  }
  return at;
}

std::vector<Comparison> ElasticProblem::comparisons(const Point& x) {
  const std::vector<ElasticAnswer>& a = answers(x);
  std::vector<Comparison> list(n_targets());
  for (std::size_t i = 0; i < n_targets(); ++i) {
    list[i].target = rows_[i].target, list[i].mean = a[i].mean, list[i].sd = a[i].sd;
    list[i].n_packings = static_cast<int>(seeds_.size());
  }
  return list;
}

void ElasticProblem::correct(const Point& x, std::size_t n) {
  answers(x);
  const auto count = static_cast<std::ptrdiff_t>(n);
  const std::vector<ElasticAnswer> one_sided =
      solved(x, {seeds_.begin(), seeds_.begin() + count}, Statics::one_sided);
  for (std::size_t i = 0; i < n_targets(); ++i) {
    const std::vector<double>& all = two_sided_[i].values;
    // Over the same packings: these differ in E by ten times what is measured here.
    const double before = summarise(std::span(all).first(n)).mean, after = one_sided[i].mean;
    double& correction = rows_[i].is_modulus() ? rows_[i].factor : rows_[i].addition;
    const double measured = rows_[i].is_modulus() ? after / before : after - before;
    // Where a specimen has no one-sided answer, the usual effect is nearer than none.
    if (std::isfinite(measured)) correction = measured;
  }
}

void ElasticProblem::weigh_packings(const Point& x) {
  const std::vector<ElasticAnswer>& a = answers(x);
  const double root = std::sqrt(seeds_.size());
  for (std::size_t i = 0; i < n_targets(); ++i) {
    const double unit = rows_[i].is_modulus() ? a[i].mean : 1.0;
    // One packing has no scatter: it counts as exact until there are more.
    rows_[i].packing_error = std::isfinite(a[i].sd) ? a[i].sd / unit / root : 0.0;
  }
}

std::vector<ElasticProblem::Unit> ElasticProblem::units(const Point& x) {
  const std::vector<ElasticAnswer>& a = answers(x);
  std::vector<Unit> all;
  for (std::size_t i = 0; i < n_targets(); ++i) {
    // Residuals of E are logarithms. The covariance speaks of answers in SI.
    const double unit = unit_of_misfit(rows_[i]);
    all.push_back({unit * (rows_[i].is_modulus() ? a[i].mean : 1.0), rows_[i].packing_error / unit});
  }
  return all;
}

std::vector<std::vector<double>> ElasticProblem::deviations(const Point& x) {
  const std::vector<ElasticAnswer>& a = answers(x);
  std::vector<std::vector<double>> all(seeds_.size(), std::vector<double>(n_targets()));
  for (std::size_t i = 0; i < n_targets(); ++i) {
    const double mean = summarise(a[i].values).mean;
    for (std::size_t p = 0; p < seeds_.size(); ++p) {
      // The factor hardly differs between packings, so that it scales their deviations as it does the mean.
      const double deviation = (a[i].values[p] - mean) * rows_[i].factor;
      all[p][i] = std::isfinite(deviation) ? deviation : 0.0;
    }
  }
  return all;
}

double ElasticProblem::worst_scatter(const Point& x) {
  double worst = 0.0;
  const std::vector<ElasticAnswer>& a = answers(x);
  for (std::size_t i = 0; i < n_targets(); ++i)
    if (rows_[i].is_modulus()) worst = std::max(worst, a[i].sd / a[i].mean);
  return worst;
}

std::vector<ElasticAnswer> ElasticProblem::solved(const Point& x, const std::vector<std::int64_t>& seeds,
                                                  Statics what) {
  const Recipe recipe = recipe_at(x);
  const auto solutions = solve_angles(recipe, evidence_.moduli, seeds, what, simulator_);
  std::vector<ElasticAnswer> answers;
  for (const Row& row : rows_)
    answers.push_back(mean_of(solutions.at(row.target.theta), row.target.property, recipe));
  return answers;
}

ElasticAnswer ElasticProblem::mean_of(const std::vector<ElasticResult>& results, Property property,
                                      const Recipe& recipe) const {
  ElasticAnswer a;
  a.slope.assign(n_parameters(), 0.0);
  for (const ElasticResult& r : results) {
    a.values.push_back(reading_of(r, property));
    for (std::size_t j = 0; j < n_parameters(); ++j)
      for (const Sensitivity& s : r.sensitivities)
        // One parameter may move contacts and bonds alike: the rates of both add up. Times its value they are
        // those by the logarithm.
        if (const auto& rates = parameter(j).modulus->rates;
            std::find(rates.begin(), rates.end(), s.parameter) != rates.end())
          a.slope[j] += rate(s, property) * parameter(j).get(recipe);
  }
  for (double& slope : a.slope) slope /= static_cast<double>(results.size());
  const Summary s = summarise(a.values);
  a.mean = s.mean, a.sd = s.sd;
  return a;
}

/// Error of the laboratory's mean and of the mean over packings.
double ElasticProblem::unit_of_misfit(const Row& row) const {
  const Target& t = row.target;
  if (row.is_modulus()) return std::hypot(counted_error(t) / t.mean, row.packing_error);
  // Residuals are divided by this: a weight of a tenth is a unit ten times as large.
  return std::hypot(counted_error(t), row.packing_error) / nu_weight_;
}

}  // namespace phy::calibrate
