#include "calibrate/elastic_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unsupported/Eigen/NonLinearOptimization>

#include "base/lines.hpp"
#include "base/stats.hpp"
#include "calibrate/elastic_limits.hpp"
#include "calibrate/parameters.hpp"
#include "genesis/specimen.hpp"
#include "theory/eq1_fit.hpp"

namespace phy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double z_95 = 1.959964;
constexpr double wall = 20.0;              // per logarithm outside the box: a soft but certain stop
constexpr double usual_overlap = 1.5;      // joint length per plane length, for the first guess only
constexpr double nu_after_conflict = 0.1;  // weight
constexpr double at_edge = 0.01;           // of a logarithm
// what one-sided contacts usually make of E and nu, until it is measured
constexpr double usual_factor = 0.97, usual_addition = 0.05;
constexpr std::size_t n_first_correction = 2;  // packings
constexpr double packing_error = 0.01;         // of mean E: so many packings are taken that it is no larger

std::vector<Target> elastic_targets(const std::vector<Target>& all) {
  std::vector<Target> some;
  for (const Target& t : all)
    if (!is_strength(t.property)) some.push_back(t);
  return some;
}

/// E or nu of one target with derivatives by the logarithms of the parameters, mean over packings.
struct Answer {
  double mean = 0.0, sd = 0.0;
  VectorXd slope;
  std::vector<double> values;  ///< of the packings
};

/// What one-sided contacts make of a bilateral answer: a factor on E, an addition to nu.
struct Correction {
  double factor = 1.0, addition = 0.0;
};

class ElasticProblem {
 public:
  ElasticProblem(const Rock& rock, std::vector<Target> targets, Simulator& simulator)
      : rock_(rock),
        targets_(std::move(targets)),
        simulator_(simulator),
        packing_error_(targets_.size(), 0.0) {
    for (const Target& t : targets_)
      corrections_.push_back(t.property == Property::E ? Correction{usual_factor, 0.0}
                                                       : Correction{1.0, usual_addition});
    for (const Parameter& p : elastic_parameters())
      if (!p.joint || rock.bedded) parameters_.push_back(&p);
    double stiffest = 0.0;
    for (const Target& t : targets_)
      if (t.property == Property::E) stiffest = std::max(stiffest, t.mean);
    const auto n = static_cast<Eigen::Index>(parameters_.size());
    low_.resize(n), high_.resize(n), usual_.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Parameter& p = parameter(i);
      const double scale = p.unit == "Pa"     ? stiffest
                           : p.unit == "Pa/m" ? stiffest / rock.model.bedding.front().spacing
                                              : 1.0;
      low_[i] = std::log(p.low * scale), high_[i] = std::log(p.high * scale);
      usual_[i] = std::log(p.usual * scale);
    }
  }

  Eigen::Index n_parameters() const { return usual_.size(); }
  Eigen::Index n_targets() const { return static_cast<Eigen::Index>(targets_.size()); }
  const Parameter& parameter(Eigen::Index i) const { return *parameters_[static_cast<std::size_t>(i)]; }
  const std::vector<Target>& targets() const { return targets_; }
  double box_low(Eigen::Index i) const { return low_[i]; }
  double box_high(Eigen::Index i) const { return high_[i]; }
  std::int64_t n_solutions = 0;
  double nu_weight = 1.0;
  void use(std::vector<std::int64_t> seeds) { seeds_ = std::move(seeds), x_.resize(0); }
  std::size_t n_packings() const { return seeds_.size(); }

  Recipe recipe_at(const VectorXd& x) const {
    Recipe r = rock_.model;
    for (Eigen::Index i = 0; i < n_parameters(); ++i)
      parameter(i).set(r, std::exp(std::clamp(x[i], low_[i] - 1.0, high_[i] + 1.0)));
    return r;
  }

  /// Bilateral contacts with the corrections; solved anew only where x or packings have changed.
  const std::vector<Answer>& answers(const VectorXd& x) {
    if (x_.size() != x.size() || x_ != x) x_ = x, two_sided_ = solved(x, seeds_, true);
    answers_ = two_sided_;
    for (std::size_t i = 0; i < answers_.size(); ++i) {
      Answer& a = answers_[i];
      const Correction& c = corrections_[i];
      a.mean = a.mean * c.factor + c.addition, a.sd *= c.factor, a.slope *= c.factor;
    }
    return answers_;
  }

  /// One-sided contacts at x on the first `n` packings, over the bilateral ones on the same.
  void correct(const VectorXd& x, std::size_t n) {
    answers(x);
    const auto count = static_cast<std::ptrdiff_t>(n);
    const std::vector<Answer> one_sided = solved(x, {seeds_.begin(), seeds_.begin() + count}, false);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const std::vector<double>& all = two_sided_[i].values;
      const double before = summarise({all.begin(), all.begin() + count}).mean;
      Correction c;
      if (targets_[i].property == Property::E)
        c.factor = one_sided[i].mean / before;
      else
        c.addition = one_sided[i].mean - before;
      if (std::isfinite(c.factor) && std::isfinite(c.addition)) corrections_[i] = c;
    }
  }

  void go_back_to(const ElasticProblem& before) {
    nu_weight = before.nu_weight, corrections_ = before.corrections_;
  }

  /// Scatter of the mean over packings at x, relative for E, becomes part of every unit of misfit.
  void weigh_packings(const VectorXd& x) {
    const std::vector<Answer>& a = answers(x);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double mean = targets_[i].property == Property::E ? a[i].mean : 1.0;
      packing_error_[i] = std::isfinite(a[i].sd) ? a[i].sd / mean / std::sqrt(n_packings()) : 0.0;
    }
  }
  /// Largest relative scatter of E between packings.
  double worst_scatter(const VectorXd& x) {
    double worst = 0.0;
    const std::vector<Answer>& a = answers(x);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (targets_[i].property == Property::E) worst = std::max(worst, a[i].sd / a[i].mean);
    return worst;
  }

  /// Residuals and their derivatives, targets first, then the prior and the walls of the box.
  void evaluate(const VectorXd& x, VectorXd* residuals, MatrixXd* jacobian) {
    const std::vector<Answer>& a = answers(x);
    const Eigen::Index n = n_targets(), m = n_parameters();
    VectorXd r(n + 2 * m);
    MatrixXd J = MatrixXd::Zero(n + 2 * m, m);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Target& t = targets_[static_cast<std::size_t>(i)];
      const Answer& model = a[static_cast<std::size_t>(i)];
      const double s = scale(static_cast<std::size_t>(i));
      r[i] = t.property == Property::E ? std::log(model.mean / t.mean) / s : (model.mean - t.mean) / s;
      J.row(i) = (t.property == Property::E ? 1.0 / model.mean : 1.0) * model.slope.transpose() / s;
      if (!std::isfinite(r[i])) r[i] = 1e3, J.row(i).setZero();  // no answer here: step back
    }
    for (Eigen::Index j = 0; j < m; ++j) {
      const double s = 0.5 * (high_[j] - low_[j]);
      r[n + j] = (x[j] - usual_[j]) / s, J(n + j, j) = 1.0 / s;
      const double out = x[j] - std::clamp(x[j], low_[j], high_[j]);
      r[n + m + j] = wall * out, J(n + m + j, j) = out != 0.0 ? wall : 0.0;
    }
    if (residuals != nullptr) *residuals = r;
    if (jacobian != nullptr) *jacobian = J;
  }

  /// What one unit of misfit is: error of the laboratory's mean and of the mean over packings.
  double scale(std::size_t i) const {
    const Target& t = targets_[i];
    if (t.property == Property::E)
      return std::hypot(std::max(least_error_E, t.standard_error() / t.mean), packing_error_[i]);
    return std::hypot(std::max(least_error_nu, t.standard_error()), packing_error_[i]) / nu_weight;
  }

  bool misses_E(const VectorXd& x) {
    const std::vector<Answer>& a = answers(x);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      Comparison c;
      c.target = targets_[i], c.mean = a[i].mean;
      if (c.target.property == Property::E && misses(c)) return true;
    }
    return false;
  }

  /// Largest relative deviation of E.
  double worst_E(const VectorXd& x) {
    double worst = 0.0;
    const std::vector<Answer>& a = answers(x);
    for (std::size_t i = 0; i < targets_.size(); ++i)
      if (targets_[i].property == Property::E)
        worst = std::max(worst, std::fabs(a[i].mean / targets_[i].mean - 1.0));
    return worst;
  }

 private:
  const Rock& rock_;
  std::vector<Target> targets_;
  Simulator& simulator_;
  std::vector<const Parameter*> parameters_;
  VectorXd low_, high_, usual_, x_;
  std::vector<std::int64_t> seeds_;
  std::vector<Answer> two_sided_, answers_;  // at x_; without and with the corrections
  std::vector<Correction> corrections_;
  std::vector<double> packing_error_;  // per target

  std::vector<Answer> solved(const VectorXd& x, const std::vector<std::int64_t>& seeds, bool bilateral) {
    const Recipe recipe = recipe_at(x);
    std::map<double, std::size_t> angle;
    for (const Target& t : targets_) angle.emplace(t.theta, angle.size());
    std::vector<double> thetas(angle.size());
    for (const auto& [theta, k] : angle) thetas[k] = theta;
    std::vector<Recipe> recipes;
    for (const std::int64_t seed : seeds)
      for (const double theta : thetas) recipes.push_back(single_at(recipe, theta, seed));
    const std::vector<ElasticResult> results = simulator_.elastic(recipes, bilateral);
    n_solutions += static_cast<std::int64_t>(results.size());
    std::vector<Answer> answers;
    for (const Target& t : targets_) {
      std::vector<const ElasticResult*> of_angle;
      for (std::size_t p = 0; p < seeds.size(); ++p)
        of_angle.push_back(&results[p * thetas.size() + angle[t.theta]]);
      answers.push_back(mean_of(of_angle, t.property, recipe));
    }
    return answers;
  }

  Answer mean_of(const std::vector<const ElasticResult*>& results, Property property,
                 const Recipe& recipe) const {
    const bool modulus = property == Property::E;
    Answer a;
    a.slope = VectorXd::Zero(n_parameters());
    std::vector<double> values;
    for (const ElasticResult* r : results) {
      values.push_back(modulus ? r->E_gauge : r->nu_gauge);
      for (Eigen::Index j = 0; j < n_parameters(); ++j)
        for (const Sensitivity& s : r->sensitivities) {
          const bool both = s.parameter == "matrix.E_b" && parameter(j).key == "matrix.E_c";
          const bool ratio = s.parameter == "ks_over_kn" && parameter(j).key == "matrix.ks_over_kn";
          const bool own = s.parameter == parameter(j).key && parameter(j).key != "matrix.ks_over_kn";
          if (own || both || ratio) a.slope[j] += (modulus ? s.dE : s.dnu) * parameter(j).get(recipe);
        }
    }
    a.slope /= static_cast<double>(results.size());
    const Summary s = summarise(values);
    a.mean = s.mean, a.sd = s.sd, a.values = std::move(values);
    return a;
  }
};

/// The face that Eigen's solver wants.
struct Functor {
  ElasticProblem& problem;
  int values() const { return static_cast<int>(problem.n_targets() + 2 * problem.n_parameters()); }
  int operator()(const VectorXd& x, VectorXd& r) const { return problem.evaluate(x, &r, nullptr), 0; }
  int df(const VectorXd& x, MatrixXd& J) const { return problem.evaluate(x, nullptr, &J), 0; }
};

void minimise(ElasticProblem& problem, VectorXd& x, int most, double tolerance) {
  Functor functor{problem};
  Eigen::LevenbergMarquardt<Functor> solver(functor);
  solver.parameters.maxfev = most;
  solver.parameters.ftol = solver.parameters.xtol = tolerance;
  solver.parameters.factor = 10.0;
  solver.minimize(x);
}

/// Eq. 1 by least squares gives K_n delta, K_s delta; one solution of the bare recipe gives E per E_c.
VectorXd first_guess(const Rock& rock, ElasticProblem& problem, Simulator& simulator, std::int64_t seed) {
  std::vector<ModulusReading> readings;
  double stiffest = 0.0;
  for (const Target& t : problem.targets())
    if (t.property == Property::E)
      readings.push_back({t.theta, t.mean}), stiffest = std::max(stiffest, t.mean);
  Eq1Options options;
  options.reference = Eq1Reference::free;
  const Eq1Fit eq1 = fit_eq1(readings, options);
  JointedRock macro{stiffest, 4.0 * stiffest, 2.0 * stiffest, 0.25};
  if (eq1.ok()) macro = eq1.rock;
  Recipe intact = single_at(rock.model, 0.0, seed);
  intact.bedding.clear();
  const double E = simulator.elastic({intact}, true).front().E_gauge;
  ++problem.n_solutions;
  VectorXd x(problem.n_parameters());
  x[0] = std::log(intact.matrix.E_c * macro.E / E);
  x[1] = std::log(0.3);
  if (rock.bedded) {
    const double length = usual_overlap * rock.model.bedding.front().spacing;
    x[2] = std::log(macro.K_n_delta / length), x[3] = std::log(macro.K_s_delta / length);
  }
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = std::clamp(x[i], problem.box_low(i) + 0.1, problem.box_high(i) - 0.1);
  return x;
}

/// As many packings as the scatter of E asks for, the first of them `seeds`.
void take_packings(ElasticProblem& problem, const VectorXd& x, std::vector<std::int64_t> seeds,
                   const std::vector<std::int64_t>& spare) {
  const std::size_t n_first = seeds.size();
  problem.use(seeds);
  const double wanted = std::ceil(std::pow(problem.worst_scatter(x) / packing_error, 2.0));
  for (const std::int64_t seed : spare)
    if (static_cast<double>(seeds.size()) < wanted) seeds.push_back(seed);
  if (seeds.size() > n_first) problem.use(seeds);
  problem.weigh_packings(x);
}

/// On all packings, with the effect of one-sided contacts measured on `n_corrected` of them.
void refine(ElasticProblem& problem, VectorXd& x, std::size_t n_corrected) {
  problem.correct(x, n_corrected);
  minimise(problem, x, 4, 1e-3);
}

/// (J^T J)^-1. A model that misses the table by more than the scatter of laboratory and packings is known no
/// better than it fits: the covariance grows with the misfit per degree of freedom.
MatrixXd covariance_at(ElasticProblem& problem, const VectorXd& x) {
  VectorXd r;
  MatrixXd J;
  problem.evaluate(x, &r, &J);
  const Eigen::Index n = problem.n_targets(), m = problem.n_parameters();
  const double misfit = r.head(n).squaredNorm() / std::max(1.0, static_cast<double>(n - m));
  return (J.transpose() * J).inverse() * std::max(1.0, misfit);
}

/// 95 % interval of the rock's own value, known from two sides: its specimens deviate from the mean over
/// packings by as much as packings do, and the laboratory has measured them. `variance`: of the model's mean.
std::pair<double, double> interval_of(const Answer& model, const Target& t, double variance) {
  const double scatter = std::isfinite(model.sd) ? model.sd * model.sd / std::max(1, t.n) : 0.0;
  const double least = t.property == Property::E ? least_error_E * t.mean : least_error_nu;
  const double lab = std::pow(std::max(least, t.standard_error()), 2.0), share = lab / (lab + scatter);
  const double centre = share * model.mean + (1.0 - share) * t.mean;
  const double half = z_95 * std::sqrt(share * share * variance + share * scatter);
  return {centre - half, centre + half};
}

void report(ElasticFit& fit, ElasticProblem& problem, const VectorXd& x) {
  const MatrixXd covariance = covariance_at(problem, x);
  fit.recipe = problem.recipe_at(x);
  for (Eigen::Index j = 0; j < problem.n_parameters(); ++j) {
    const Parameter& p = problem.parameter(j);
    ParameterEstimate e;
    e.key = p.key, e.symbol = p.symbol, e.unit = p.unit;
    const double sd = std::sqrt(covariance(j, j)), box = problem.box_high(j) - problem.box_low(j);
    e.value = std::exp(x[j]);
    const double edge_low = std::min(problem.box_low(j), x[j]),
                 edge_high = std::max(problem.box_high(j), x[j]);
    e.low = std::exp(std::max(edge_low, x[j] - z_95 * sd));
    e.high = std::exp(std::min(edge_high, x[j] + z_95 * sd));
    if (x[j] < problem.box_low(j) + at_edge || x[j] > problem.box_high(j) - at_edge)
      fit.findings.push_back(fmt::format("{} lies at the edge of its box ({:.4g})", p.symbol, e.value));
    e.box_low = std::exp(problem.box_low(j)), e.box_high = std::exp(problem.box_high(j));
    e.determined = std::log(e.high / e.low) < 0.5 * box;
    fit.parameters.push_back(e);
  }
  for (Eigen::Index i = 0; i < problem.n_targets(); ++i) {
    const Answer& a = problem.answers(x)[static_cast<std::size_t>(i)];
    Comparison c;
    c.target = problem.targets()[static_cast<std::size_t>(i)];
    c.mean = a.mean, c.sd = a.sd, c.n_packings = static_cast<int>(problem.n_packings());
    const double known = a.slope.dot(covariance * a.slope);
    std::tie(c.low, c.high) = interval_of(a, c.target, known);
    fit.comparisons.push_back(c);
  }
}

/// E of one cell beyond what passes without a word. True: the scatter of the packings does not explain it.
bool tell_modulus(ElasticFit& fit, const Comparison& c) {
  const Target& t = c.target;
  const double noise = t.sd_assumed ? 0.0 : t.standard_error() / t.mean;
  const double packings = c.sd / std::sqrt(static_cast<double>(c.n_packings)) / t.mean;
  const double chance = z_seven * std::hypot(noise, packings);
  const bool by_chance = std::fabs(c.error()) <= chance;
  fit.findings.push_back(fmt::format(
      "E({:g}) = {:.2f} GPa, {:+.1f} % from the laboratory's {:.2f}{}", t.theta, c.mean * 1e-9,
      100.0 * c.error(), t.mean * 1e-9,
      by_chance ? fmt::format(": {}packings of this size scatter that much (+-{:.1f} % on the means)",
                              noise > 0.0 ? "laboratory and " : "", 100.0 * chance)
                : ""));
  return !by_chance;
}

/// Why: what the table asks of any body of its kind; what nu had to give for E.
void tell_limit(ElasticFit& fit, const Rock& rock, bool nu_missed) {
  std::vector<Target> targets;
  for (const Comparison& c : fit.comparisons) targets.push_back(c.target);
  if (rock.bedded)
    if (const std::string limit = elastic_limit(targets); !limit.empty()) fit.findings.push_back(limit);
  if (fit.nu_gave_way && nu_missed)
    fit.findings.push_back(
        fmt::format("nu gave way to E: with full weight on both, E missed the table by up to {:.1f} %",
                    100.0 * fit.E_before));
}

void judge(ElasticFit& fit, const Rock& rock) {
  double worst = 0.0;
  bool nu_missed = false;
  for (const Comparison& c : fit.comparisons) {
    const Target& t = c.target;
    if (!c.answered()) {
      fit.out_of_reach = true;
      add_line(fit.findings, cell_name(t),
               "the model has no answer (`phyllite elastic` with calibrated.toml tells why)");
    } else if (misses(c) && t.property == Property::E) {
      if (tell_modulus(fit, c)) worst = std::max(worst, std::fabs(c.error()));
    } else if (misses(c)) {
      nu_missed = true;
      fit.findings.push_back(fmt::format("nu({:g}) = {:.3f} instead of {:.3f}", t.theta, c.mean, t.mean));
    }
  }
  if (worst > 0.0 || nu_missed) tell_limit(fit, rock, nu_missed);
  fit.out_of_reach = fit.out_of_reach || worst > 2.0 * elastic_tolerance;
}

}  // namespace

double modulus_limit(const Target& t) {
  const double noise = t.sd_assumed ? 0.0 : z_seven * t.standard_error();
  return t.property == Property::E ? std::max(elastic_tolerance, noise / t.mean)
                                   : std::max(nu_tolerance, noise);
}

bool misses(const Comparison& c) {
  const double error = c.target.property == Property::E ? c.error() : c.mean - c.target.mean;
  return std::fabs(error) > modulus_limit(c.target);
}

Recipe single_at(const Recipe& recipe, double theta, std::int64_t seed) {
  Recipe one = recipe;
  one.packing.seed = seed;
  one.test.angles.clear();
  one.test.intact = false;
  if (!one.bedding.empty()) one.bedding = turned(recipe.bedding, theta);
  return one;
}

std::vector<Comparison> elastic_response(const Recipe& recipe, const std::vector<Target>& all,
                                         const std::vector<std::int64_t>& seeds, Simulator& simulator) {
  const std::vector<Target> targets = elastic_targets(all);
  std::map<double, std::vector<ElasticResult>> at;
  for (const Target& t : targets) at[t.theta] = {};
  std::vector<Recipe> recipes;
  for (const auto& [theta, none] : at)
    for (const std::int64_t seed : seeds) recipes.push_back(single_at(recipe, theta, seed));
  const std::vector<ElasticResult> results = simulator.elastic(recipes, false);
  auto next = results.begin();
  for (auto& [theta, some] : at)
    some.assign(next, next + static_cast<std::ptrdiff_t>(seeds.size())),
        next += static_cast<std::ptrdiff_t>(seeds.size());
  std::vector<Comparison> rows;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    std::vector<double> values;
    for (const ElasticResult& r : at[targets[i].theta])
      values.push_back(targets[i].property == Property::E ? r.E_gauge : r.nu_gauge);
    const Summary s = summarise(values);
    Comparison c;
    c.target = targets[i], c.mean = s.mean, c.sd = s.sd, c.n_packings = static_cast<int>(seeds.size());
    rows.push_back(c);
  }
  return rows;
}

ElasticFit fit_elastic(const Rock& rock, const std::vector<Target>& all,
                       const std::vector<std::int64_t>& seeds, const std::vector<std::int64_t>& spare,
                       Simulator& simulator, const std::function<void(const std::string&)>& say) {
  ElasticFit fit;
  fit.recipe = rock.model;
  ElasticProblem problem(rock, elastic_targets(all), simulator);
  if (of_property(problem.targets(), Property::E).empty()) return fit;
  problem.use({seeds.front()});
  VectorXd x = first_guess(rock, problem, simulator, seeds.front());
  minimise(problem, x, 20, 1e-3);
  say(fmt::format("elastic search done after {} solutions", problem.n_solutions));
  take_packings(problem, x, seeds, spare);
  refine(problem, x, std::min(n_first_correction, seeds.size()));  // near the answer, then at it
  refine(problem, x, seeds.size());
  const bool has_nu = problem.targets().size() > of_property(problem.targets(), Property::E).size();
  if (has_nu && problem.misses_E(x)) {
    fit.E_before = problem.worst_E(x);
    const ElasticProblem with_nu = problem;
    const VectorXd x_with_nu = x;
    problem.nu_weight = nu_after_conflict;
    minimise(problem, x, 6, 1e-3);
    refine(problem, x, seeds.size());
    fit.nu_gave_way = problem.worst_E(x) < 0.9 * fit.E_before;
    if (!fit.nu_gave_way) x = x_with_nu, problem.go_back_to(with_nu);
  }
  report(fit, problem, x);
  fit.n_solutions = problem.n_solutions;
  judge(fit, rock);
  return fit;
}

}  // namespace phy
