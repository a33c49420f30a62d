#include "calibrate/elastic_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/least_squares.hpp"
#include "base/stats.hpp"
#include "calibrate/elastic_problem.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

using verdict::miss_of;
using verdict::tolerance;

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Point = ElasticProblem::Point;

// Weights of nu where it contradicts E, and how much worse E may be fitted for the sake of it: by no more
// than its own errors tell, the likelihood ratio of one number at 5 % (chi-square).
constexpr double nu_weights[] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7};
constexpr double told_apart = 3.84;
constexpr std::size_t n_first_correction = 2;  // packings
constexpr double packing_error = 0.01;         // of mean E: so many packings are taken that it is no larger
constexpr std::size_t scatter_degrees = 4;     // at least, of packings: fits have five, those of tests fewer
constexpr std::uint32_t draws_seed = 20100102;

Eigen::Map<const VectorXd> vector_of(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

struct Functor {
  ElasticProblem& problem;
  Linearised at(const VectorXd& x) const { return problem.linearised(Point(x.begin(), x.end())); }
  int values() const { return static_cast<int>(problem.n_residuals()); }
  void operator()(const VectorXd& x, VectorXd& r) const { r = vector_of(at(x).residuals); }
  void df(const VectorXd& x, MatrixXd& J) const {
    J = vector_of(at(x).jacobian).reshaped(values(), x.size());
  }
};

void minimise(ElasticProblem& problem, Point& x, int most, double tolerance) {
  const Functor functor{problem};
  const VectorXd moved = least_squares(misfits_of(functor), vector_of(x), {most, tolerance, 10.0});
  x.assign(moved.begin(), moved.end());
}

/// As many packings as the scatter of E asks for, the first of them `seeds`, which it has.
void take_packings(ElasticProblem& problem, const Point& x, std::vector<std::int64_t> seeds,
                   const std::vector<std::int64_t>& spare) {
  const std::size_t n_first = seeds.size();
  // The standard error falls with the root of the number.
  const double wanted = std::ceil(std::pow(problem.worst_scatter(x) / packing_error, 2.0));
  for (const std::int64_t seed : spare)
    if (static_cast<double>(seeds.size()) < wanted) seeds.push_back(seed);
  if (seeds.size() > n_first) problem.use_packings(seeds);
  problem.weigh_packings(x);
}

/// On the packings at hand, with the effect of one-sided contacts measured on `n_corrected` of them.
void refine(ElasticProblem& problem, Point& x, std::size_t n_corrected) {
  // First the effect, then four steps: it hardly moves with the parameters, so that one turn is enough.
  problem.correct(x, n_corrected);
  minimise(problem, x, 4, 1e-3);
}

/// What is known at the answer. Errors of the laboratory are independent; a packing's are not, for it serves
/// every angle. So they come in as the packings have them: each moves the answer by G = (J^T J)^-1 J^T times
/// its deviations, and the scatter of these moves over the root of their number is the error of the mean,
/// widened by Student's t. What a packing has in common at all angles moves the parameters, and so is made
/// good where the table has its values: there the model's mean is off by the deviation less what the move
/// takes of it.
struct Spread {
  MatrixXd of_table;    ///< covariance of the parameters by laboratory and prior
  MatrixXd moves;       ///< of the parameters, a column per packing
  MatrixXd deviations;  ///< of the targets, SI, likewise
  MatrixXd covariance() const { return of_table + moves * moves.transpose(); }
  /// Of the model's mean of target i, whose derivatives are `slope`.
  double variance(Eigen::Index i, const VectorXd& slope) const {
    return slope.dot(of_table * slope) + (deviations.row(i) - slope.transpose() * moves).squaredNorm();
  }
};

/// A model that misses the table by more than the scatter of laboratory and packings is known no better than
/// it fits: all variances grow with the misfit per degree of freedom.
Spread spread_at(ElasticProblem& problem, const Point& x) {
  const Linearised at = problem.linearised(x);
  const auto n = static_cast<Eigen::Index>(problem.n_targets()), m = static_cast<Eigen::Index>(x.size());
  const VectorXd r = vector_of(at.residuals);
  const MatrixXd J = vector_of(at.jacobian).reshaped(r.size(), m);
  const double misfit = std::max(1.0, r.head(n).squaredNorm() / std::max(1.0, static_cast<double>(n - m)));
  // `whole` counts packings as if their errors were independent. That part is taken out below, and comes back
  // as the moves of whole packings.
  const MatrixXd whole = inverse_of_squares(J), G = whole * J.topRows(n).transpose();
  VectorXd sizes(n), by_packings(n);
  const std::vector<ElasticProblem::Unit> units = problem.units(x);
  for (Eigen::Index i = 0; i < n; ++i)
    sizes[i] = units[static_cast<std::size_t>(i)].size,
    by_packings[i] = std::pow(units[static_cast<std::size_t>(i)].packings, 2.0);
  const std::vector<std::vector<double>> deviations = problem.deviations(x);
  const std::size_t p = deviations.size(), degrees = std::max(scatter_degrees, p - 1);
  const double of_mean =
      // Everything that follows multiplies by the normal quantile, so the widening by Student is put into the
      // scatter.
      student_t_95(degrees) / z_95 *
      std::sqrt(misfit / std::max(1.0, static_cast<double>(p) * (static_cast<double>(p) - 1.0)));
  Spread s;
  s.of_table = misfit * (whole - G * by_packings.asDiagonal() * G.transpose());
  s.deviations.resize(n, static_cast<Eigen::Index>(p));
  for (std::size_t k = 0; k < p; ++k)
    s.deviations.col(static_cast<Eigen::Index>(k)) = of_mean * vector_of(deviations[k]);
  s.moves = G * sizes.cwiseInverse().asDiagonal() * s.deviations;
  return s;
}

/// 95 % interval of the rock's own value, known from two sides: its specimens deviate from the mean over
/// packings by as much as packings do, and the laboratory has measured them. `variance`: of the model's mean.
std::pair<double, double> interval_of(const Comparison& c, double variance) {
  const Target& t = c.target;
  const double scatter = std::isfinite(c.sd) ? c.sd * c.sd / std::max(1, t.n) : 0.0;
  const double lab = std::pow(counted_error(t), 2.0), share = lab / (lab + scatter);
  const double centre = share * c.mean + (1.0 - share) * t.mean;
  // Two independent sources have the product of their variances over the sum. That is share * scatter.
  const double half = z_95 * std::sqrt(share * share * variance + share * scatter);
  return {centre - half, centre + half};
}

Estimate estimate(const Parameter& p, const LogBox& box, double x, double sd) {
  Estimate e = sought(p);
  e.value = std::exp(x);
  // The walls are soft and x may end a little outside: its interval has to hold it all the same.
  e.low = std::exp(std::max(std::min(box.low, x), x - z_95 * sd));
  e.high = std::exp(std::min(std::max(box.high, x), x + z_95 * sd));
  e.box_low = std::exp(box.low), e.box_high = std::exp(box.high);
  e.determined = box.narrowed_to(std::log(e.high / e.low));
  return e;
}

std::vector<Recipe> draws_of(const ElasticProblem& problem, const Point& x, const MatrixXd& covariance) {
  std::vector<LogBox> boxes;
  for (std::size_t j = 0; j < problem.n_parameters(); ++j) boxes.push_back(problem.box(j));
  const std::vector<double> numbers(covariance.reshaped().begin(), covariance.reshaped().end());
  std::vector<Recipe> draws;
  for (const Point& draw : gaussian_draws(x, numbers, boxes, ensemble_size, draws_seed))
    draws.push_back(problem.recipe_at(draw));
  return draws;
}

void report(ElasticFit& fit, ElasticProblem& problem, const Point& x) {
  const Spread spread = spread_at(problem, x);
  const MatrixXd covariance = spread.covariance();
  fit.recipe = problem.recipe_at(x);
  for (std::size_t j = 0; j < problem.n_parameters(); ++j) {
    const auto d = static_cast<Eigen::Index>(j);
    fit.parameters.push_back(
        estimate(problem.parameter(j), problem.box(j), x[j], std::sqrt(covariance(d, d))));
  }
  // Drawn jointly: E_c and the stiffness of joints trade off, and draws one by one would not have the table's
  // moduli.
  fit.draws = draws_of(problem, x, covariance);
  fit.comparisons = problem.comparisons(x);
  const std::vector<ElasticAnswer>& answers = problem.answers(x);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    Comparison& c = fit.comparisons[i];
    const double variance = spread.variance(static_cast<Eigen::Index>(i), vector_of(answers[i].slope));
    std::tie(c.low, c.high) = interval_of(c, variance);
  }
}

/// Does some E miss by more than the laboratory's scatter explains? An assumed one is no reason to keep nu.
bool misses_E(const std::vector<Comparison>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const Comparison& c) {
    const Target& t = c.target;
    // With the usual scatter of 8 % in its place, nearly every miss of E would be excused.
    const double scatter = t.sd_assumed ? 0.0 : t.half_width() / t.mean;
    return t.property == Property::E && std::fabs(miss_of(c)) > std::max(tolerance(Property::E), scatter);
  });
}

/// Largest relative deviation of E.
double worst_E(const std::vector<Comparison>& rows) {
  double worst = 0.0;
  for (const Comparison& c : rows)
    if (c.target.property == Property::E) worst = std::max(worst, std::fabs(c.error()));
  return worst;
}

/// Misfit of E, chi-square in the laboratory's stated errors. An assumed one is no reason to leave E: half of
/// the tolerance stands for it, as where strengths are sought (best_estimate.hpp).
struct MisfitOfE {
  double chi2 = 0.0;
  int n = 0;

  explicit MisfitOfE(const std::vector<Comparison>& rows) {
    for (const Comparison& c : rows) {
      const Target& t = c.target;
      if (t.property != Property::E) continue;
      const double stated = t.sd_assumed ? 0.0 : t.normal_error() / t.mean;
      chi2 += std::pow(c.error() / std::max(stated, 0.5 * tolerance(Property::E)), 2.0), ++n;
    }
  }
  /// What can be told apart, from the least misfit on: a model that cannot have E knows it no better than it
  /// fits.
  double limit(std::size_t n_parameters) const {
    const double degrees = std::max(1.0, static_cast<double>(n) - static_cast<double>(n_parameters));
    return chi2 + told_apart * std::max(1.0, chi2 / degrees);
  }
};

/// E as well as it can be had; then, of all that E cannot tell apart, the nearest nu.
void find_nearest_nu(ElasticProblem& problem, Point& x) {
  // nu is never dropped: without any weight only its prior would hold k_s/k_n.
  double limit = 0.0, kept = 0.0;
  for (const double weight : nu_weights) {
    Point moved = x;
    problem.weigh_nu(weight);
    minimise(problem, moved, 6, 1e-3);
    const MisfitOfE misfit(problem.comparisons(moved));
    // The first and least weight leaves E all but alone: what it misses there is its best.
    if (weight == nu_weights[0]) limit = misfit.limit(problem.n_parameters());
    if (misfit.chi2 > limit) break;
    x = moved, kept = weight;
  }
  problem.weigh_nu(kept);
}

}  // namespace

ElasticFit fit_elastic(const Evidence& evidence, const std::vector<std::int64_t>& seeds,
                       const std::vector<std::int64_t>& spare, Simulator& simulator,
                       const std::function<void(const Finding&)>& begins) {
  ElasticFit fit;
  fit.recipe = evidence.rock.model;
  if (!evidence.has(Property::E)) return fit;
  begins({FindingKind::course_moduli});
  const std::int64_t first_solution = simulator.count().solutions;
  ElasticProblem problem(evidence, simulator);
  // One packing first: far from the answer five say nothing more, at five times the cost.
  problem.use_packings({seeds.front()});
  Point x = problem.first_guess(seeds.front());
  minimise(problem, x, 20, 1e-3);
  begins({FindingKind::course_moduli_packings,
          {},
          {{"solutions", static_cast<double>(simulator.count().solutions - first_solution)}}});
  problem.use_packings(seeds);
  problem.weigh_packings(x);
  refine(problem, x, std::min(n_first_correction, seeds.size()));  // near the answer, then at it
  take_packings(problem, x, seeds, spare);
  refine(problem, x, seeds.size());
  if (const std::vector<Comparison> rows = problem.comparisons(x);
      evidence.has(Property::nu) && misses_E(rows)) {
    fit.E_before = worst_E(rows);
    // If E gains nothing by it, nu must not have given way: the whole state goes back.
    const ElasticProblem with_nu = problem;
    const Point x_with_nu = x;
    find_nearest_nu(problem, x);
    refine(problem, x, seeds.size());
    fit.nu_gave_way = worst_E(problem.comparisons(x)) < 0.9 * fit.E_before;
    if (!fit.nu_gave_way) x = x_with_nu, problem.go_back_to(with_nu);
  }
  report(fit, problem, x);
  return fit;
}

}  // namespace phy::calibrate
