#include "theory/eq1_fit.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/exact_math.hpp"
#include "base/least_squares.hpp"
#include "base/nan.hpp"
#include "theory/angles.hpp"

namespace phy::theory {
namespace {

constexpr double no_modulus = 1e6;   // over their mean: of a body that would lengthen under pressure
constexpr double same_angle = 1e-6;  // [deg] readings closer than this are repeats of one angle

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", x);
  return buffer;
}

Eq1Fit refused(Eq1Fit fit, Eq1Status status, std::string reason) {
  fit.status = status;
  fit.reason = std::move(reason);
  return fit;
}

// The problem in numbers near 1: moduli are divided by `scale`, the columns of `terms` multiply e, a, b.
struct Setup {
  double scale = 1.0;
  Eigen::MatrixXd terms;  // n x 3: 1, cos^4, sin^2 cos^2
  Eigen::VectorXd compliance;
  bool free_E = false;
  double e = 0.0;  // fixed 1/E when not free
  std::vector<bool> takes_part;
};

std::string check_readings(const std::vector<ModulusReading>& readings, const Eq1Options& options) {
  for (const ModulusReading& r : readings)
    if (!std::isfinite(r.theta) || !std::isfinite(r.E) || r.E <= 0.0)
      return "E = " + text(r.E) + " Pa at theta = " + text(r.theta) +
             " deg: give a positive modulus and an angle";
  if (options.reference == Eq1Reference::given && !(std::isfinite(options.E) && options.E > 0.0))
    return "E of the intact rock = " + text(options.E) +
           " Pa: give a positive modulus or choose another reference";
  return {};
}

int n_distinct_angles(const std::vector<ModulusReading>& readings) {
  std::vector<double> seen;
  for (const ModulusReading& r : readings) {
    const double theta = folded_theta(r.theta);
    bool is_new = true;
    // Laboratories cut at 30 degrees three times: repeats say nothing about the shape of the curve.
    for (double s : seen) is_new = is_new && std::abs(s - theta) > same_angle;
    if (is_new) seen.push_back(theta);
  }
  return static_cast<int>(seen.size());
}

bool has_oblique_angle(const std::vector<ModulusReading>& readings) {
  for (const ModulusReading& r : readings) {
    const double theta = folded_theta(r.theta);
    // sin^2 cos^2, all that K_s acts through, is below 0.11 outside.
    if (theta > 20.0 && theta < 70.0) return true;
  }
  return false;
}

bool is_at_90(const ModulusReading& r) { return std::abs(folded_theta(r.theta) - 90.0) <= same_angle; }

// Mean modulus of the readings at 90 degrees, 0 when there are none.
double mean_at_90(const std::vector<ModulusReading>& readings) {
  double sum = 0.0;
  int n = 0;
  for (const ModulusReading& r : readings)
    if (is_at_90(r)) {
      sum += r.E;
      ++n;
    }
  return n == 0 ? 0.0 : sum / n;
}

Setup set_up(const std::vector<ModulusReading>& readings, const Eq1Options& options, double E_reference) {
  Setup p;
  const auto n = static_cast<Eigen::Index>(readings.size());
  p.terms.resize(n, 3);
  p.compliance.resize(n);
  p.free_E = options.reference == Eq1Reference::free;
  for (const ModulusReading& r : readings) p.scale += r.E;
  // Less the 1 that `scale` began with.
  p.scale = (p.scale - 1.0) / static_cast<double>(n);
  // A compliance that is known is taken off the readings; one that is sought is a column.
  p.e = p.free_E ? 0.0 : p.scale / E_reference;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ModulusReading& r = readings[static_cast<std::size_t>(i)];
    const SinCos angle = sin_cos_degrees(folded_theta(r.theta));
    const double c2 = angle.cos * angle.cos;
    // Eq. 1 is linear in compliances: 1/E(theta) = 1/E + a cos^4 + b sin^2 cos^2.
    p.terms.row(i) << 1.0, c2 * c2, angle.sin * angle.sin * c2;
    p.compliance[i] = p.scale / r.E;
    // The readings that *are* the reference cannot also be evidence about the joints.
    p.takes_part.push_back(!(options.reference == Eq1Reference::measured_90 && is_at_90(r)));
  }
  return p;
}

struct Solution {
  bool converged = true;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();           // e, a, b (scaled)
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // times the residual variance
  double sum_of_squares = 0.0;
};

int n_parameters(const Setup& p) { return p.free_E ? 3 : 2; }

// Least squares of weight_i (compliance_i - terms_i x) over the free parameters.
Solution solve_linear(const Setup& p, const Eigen::VectorXd& weight) {
  const Eigen::Index m = n_parameters(p);
  Eigen::MatrixXd J = p.terms.rightCols(m);
  Eigen::VectorXd rhs = p.free_E ? p.compliance : Eigen::VectorXd(p.compliance.array() - p.e);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    // A weight of zero and not a shorter list, so that residuals keep the places of their readings.
    const double w = p.takes_part[static_cast<std::size_t>(i)] ? weight[i] : 0.0;
    J.row(i) *= w;
    rhs[i] *= w;
  }
  Solution s;
  s.x[0] = p.e;
  s.x.tail(m) = linear_least_squares(J, rhs).x;
  s.covariance.bottomRightCorner(m, m) = inverse_of_squares(J);
  s.sum_of_squares = (rhs - J * s.x.tail(m)).squaredNorm();
  return s;
}

/// On its way the search may pass bodies without a modulus: a large finite misfit turns it back.
double capped_inverse(double compliance) { return compliance > 0.0 ? 1.0 / compliance : no_modulus; }

/// E_i - 1/c_i of the readings that take part.
struct ModulusMisfit {
  const Setup& p;
  Eigen::VectorXd c(const Eigen::VectorXd& x) const {
    return p.terms.rightCols(x.size()) * x + (p.free_E ? 0.0 : p.e) * Eigen::VectorXd::Ones(values());
  }
  double weight(Eigen::Index i) const { return p.takes_part[static_cast<std::size_t>(i)] ? 1.0 : 0.0; }
  int values() const { return static_cast<int>(p.compliance.size()); }
  void operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    const Eigen::VectorXd at = c(x);
    for (Eigen::Index i = 0; i < r.size(); ++i)
      r[i] = weight(i) * (1.0 / p.compliance[i] - capped_inverse(at[i]));
  }
  void df(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const {
    const Eigen::VectorXd at = c(x);
    for (Eigen::Index i = 0; i < J.rows(); ++i)
      // d(-1/c)/dc = 1/c^2.
      J.row(i) = weight(i) / (at[i] * at[i]) * p.terms.row(i).tail(x.size());
  }
};

// Least squares of the moduli themselves, from the solution for compliances weighted by E^2.
Solution solve_modulus(const Setup& p) {
  const Eigen::Index m = n_parameters(p);
  // Weighted so, compliances have the misfits of moduli to first order: a start next to the answer.
  Solution s = solve_linear(p, p.compliance.cwiseInverse().array().square());
  const ModulusMisfit misfit{p};
  LeastSquaresLimits exact;
  // As far as rounding allows: standard errors come from the end of the search.
  exact.tolerance = 1e-15;
  const Eigen::VectorXd x = least_squares(misfits_of(misfit), s.x.tail(m), exact);
  s.x.tail(m) = x;
  Eigen::VectorXd r(misfit.values());
  Eigen::MatrixXd J(misfit.values(), m);
  misfit(x, r), misfit.df(x, J);
  s.sum_of_squares = r.squaredNorm();
  s.covariance.bottomRightCorner(m, m) = inverse_of_squares(J);
  // At a minimum the gradient is nothing beside its terms.
  s.converged = (misfit.c(x).array() > 0.0).all() && (J.transpose() * r).norm() <= 1e-6 * J.norm();
  return s;
}

void fill_quality(Eq1Fit& fit, const std::vector<ModulusReading>& readings) {
  double mean = 0.0;
  for (const ModulusReading& r : readings) mean += r.E / static_cast<double>(readings.size());
  double about_mean = 0.0;
  double about_fit = 0.0;
  for (const ModulusReading& r : readings) {
    const double residual = r.E - goodman_E(fit.rock, folded_theta(r.theta));
    fit.residual.push_back(residual);
    about_fit += residual * residual;
    about_mean += (r.E - mean) * (r.E - mean);
  }
  // Of moduli, whatever was minimised: it is the curve E(theta) that people look at.
  fit.R2 = about_mean > 0.0 ? 1.0 - about_fit / about_mean : nan;
}

void fill_errors(Eq1Fit& fit, const Solution& s, const Setup& p) {
  int n = 0;
  for (bool takes_part : p.takes_part) n += takes_part ? 1 : 0;
  fit.degrees_of_freedom = n - n_parameters(p);
  // With as many readings as unknowns nothing is left to tell the scatter from.
  const double variance = fit.degrees_of_freedom > 0 ? s.sum_of_squares / fit.degrees_of_freedom : nan;
  const auto error_of_inverse = [&](Eigen::Index i) {
    // Of 1/x to first order.
    return p.scale * std::sqrt(variance * s.covariance(i, i)) / (s.x[i] * s.x[i]);
  };
  fit.se_E = p.free_E ? error_of_inverse(0) : 0.0;
  fit.se_K_n_delta = error_of_inverse(1);
  fit.se_K_s_delta = error_of_inverse(2);
}

std::string note_for(Eq1Reference reference) {
  switch (reference) {
    case Eq1Reference::free:
      return "E is free: Eq. 1 is then the general orthotropic law in two dimensions, and a good R2 says "
             "nothing about "
             "joint mechanics";
    case Eq1Reference::measured_90:
      return "E is the mean modulus measured at 90 degrees; those readings are not evidence about the "
             "joints, and the "
             "standard errors take E as exact";
    default: return "E is the given modulus of the intact rock; the standard errors take it as exact";
  }
}

Eq1Fit conclude(Eq1Fit fit, const Solution& s, const Setup& p, const std::vector<ModulusReading>& readings) {
  fit.e = s.x[0] / p.scale;
  fit.a = s.x[1] / p.scale;
  fit.b = s.x[2] / p.scale;
  // Moduli next to zero or without bound: their compliances are no numbers.
  if (!s.converged || !(s.x[0] > 0.0) || !std::isfinite(fit.e + fit.a + fit.b))
    return refused(fit, Eq1Status::not_converged,
                   "the least-squares search did not settle at positive moduli; try the "
                   "compliance loss or look for an outlier");
  const double nothing = 1e-9 * s.x[0];  // a joint that adds less than this is no joint
  if (s.x[1] <= nothing)
    return refused(
        fit, Eq1Status::K_n_not_positive,
        "across its planes the rock is no softer than the reference E = " + text(1e-9 / fit.e) +
            " GPa, so no K_n follows; check E and the angle convention (0 = planes across the load)");
  if (s.x[2] <= nothing)
    return refused(
        fit, Eq1Status::K_s_not_positive,
        "at oblique angles the rock is stiffer than any jointed rock with this K_n and E, so no K_s "
        "follows; check the moduli between 20 and 70 degrees");
  fit.rock = {1.0 / fit.e, 1.0 / fit.a, 1.0 / fit.b, 0.0};
  // Minimum and shoulder follow from the two stiffnesses alone.
  fit.shape = goodman_shape(fit.rock);
  fill_errors(fit, s, p);
  fill_quality(fit, readings);
  return fit;
}

}  // namespace

Eq1Fit fit_eq1(const std::vector<ModulusReading>& readings, const Eq1Options& options) {
  Eq1Fit fit;
  fit.note = note_for(options.reference);
  if (const std::string wrong = check_readings(readings, options); !wrong.empty())
    return refused(fit, Eq1Status::bad_reading, wrong);
  if (const int n = n_distinct_angles(readings); n < 3)
    return refused(fit, Eq1Status::too_few_angles,
                   std::to_string(n) +
                       " distinct angle(s): Eq. 1 needs at least three (theta and 180 - theta count as "
                       "one)");
  if (!has_oblique_angle(readings))
    return refused(
        fit, Eq1Status::no_oblique_angle,
        "no angle strictly between 20 and 70 degrees: K_s acts only at oblique angles; test one near 45");
  const bool measured = options.reference == Eq1Reference::measured_90;
  const double E_reference = measured ? mean_at_90(readings) : options.E;
  if (measured && E_reference == 0.0)
    return refused(fit, Eq1Status::no_reading_at_90, "no reading at 90 degrees to take E from");
  const Setup p = set_up(readings, options, E_reference);
  const Solution s = options.loss == Eq1Loss::modulus
                         ? solve_modulus(p)
                         : solve_linear(p, Eigen::VectorXd::Ones(p.compliance.size()));
  return conclude(fit, s, p, readings);
}

}  // namespace phy::theory
