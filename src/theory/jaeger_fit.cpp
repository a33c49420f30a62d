#include "theory/jaeger_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/nan.hpp"

namespace phy::theory {
namespace {

constexpr double largest_friction = 60.0;  // [deg]
constexpr double at_end = 0.1;             // [deg] from which friction lies at the end of its range
constexpr double no_cohesion = 1e-3;       // of the matrix
constexpr int grid = 60;                   // per direction and round; a step of the last is 4e-7 of the range
constexpr int rounds = 6;
constexpr double narrower = 0.12;  // 3.6 steps of the grid before to either side

using Matrix = std::function<double(double)>;

double misfit(const std::vector<StrengthReading>& readings, const Matrix& matrix, const Coulomb& plane) {
  double sum = 0.0;
  for (const StrengthReading& r : readings) {
    const double d = r.ucs - jaeger_sigma_1(plane, matrix(r.sigma_3), r.theta, r.sigma_3);
    sum += d * d;
  }
  return sum;
}

double spread(const std::vector<StrengthReading>& readings) {
  double mean = 0.0, sum = 0.0;
  for (const StrengthReading& r : readings) mean += r.ucs / static_cast<double>(readings.size());
  for (const StrengthReading& r : readings) sum += (r.ucs - mean) * (r.ucs - mean);
  return sum;
}

constexpr double coarse_step = 0.5, fine_step = 0.01;  // [deg] of friction

/// A reading at one friction angle.
struct Slope {
  double per_cohesion;  ///< strength of a plane with a cohesion of 1; infinite where it does not slip
  double ucs;
};

/// Sum of squares where the plane has a cohesion and the matrix a strength.
double misfit(const std::vector<Slope>& slopes, double cohesion, double matrix) {
  double sum = 0.0;
  for (const Slope& s : slopes) {
    const double d = s.ucs - std::min(matrix, cohesion * s.per_cohesion);
    sum += d * d;
  }
  return sum;
}

/// Takes the fit for a friction angle if it is better than what is known. `best`: sum of squares. Of each
/// number of readings that slip, easiest first: the best cohesion of these and the best matrix of the rest.
void try_friction(const std::vector<StrengthReading>& readings, double friction, JaegerFit& known,
                  double& best) {
  std::vector<Slope> slopes;
  double own = 0.0, product = 0.0, rest = 0.0, strongest = 0.0;
  for (const StrengthReading& r : readings) {
    slopes.push_back({weak_plane_sigma_1({1.0, friction}, r.theta, 0.0), r.ucs});
    rest += r.ucs, strongest = std::max(strongest, r.ucs);
  }
  std::sort(slopes.begin(), slopes.end(),
            [](const Slope& a, const Slope& b) { return a.per_cohesion < b.per_cohesion; });
  for (std::size_t n = 1; n <= slopes.size() && std::isfinite(slopes[n - 1].per_cohesion); ++n) {
    const Slope& s = slopes[n - 1];
    own += s.per_cohesion * s.per_cohesion, product += s.per_cohesion * s.ucs, rest -= s.ucs;
    const double cohesion = product / own;
    const double matrix = n == slopes.size() ? strongest : rest / static_cast<double>(slopes.size() - n);
    if (const double sum = misfit(slopes, cohesion, matrix); sum < best)
      best = sum, known.plane = {cohesion, friction}, known.matrix_ucs = matrix;
  }
}

std::string refusal(const std::vector<StrengthReading>& readings, const Matrix& matrix) {
  std::set<double> angles;
  bool oblique = false, weaker = false;
  for (const StrengthReading& r : readings) {
    if (!(r.ucs > 0.0) || !std::isfinite(r.ucs)) return "a strength is not positive";
    weaker = weaker || r.ucs < matrix(r.sigma_3);
    angles.insert(r.theta);
    const double folded = r.theta > 90.0 ? 180.0 - r.theta : r.theta;
    oblique = oblique || (folded > 20.0 && folded < 80.0);
  }
  if (!(matrix(0.0) > 0.0)) return "the strength of the matrix is not known";
  if (angles.size() < 3) return "fewer than three inclinations";
  if (!weaker) return "no specimen is weaker than the matrix";
  return oblique ? "" : "no inclination between 20 and 80 degrees";
}

}  // namespace

std::string JaegerFit::no_plane() const {
  if (!ok) return reason;
  const std::string nearest = "the nearest plane has ";
  if (plane.friction < at_end) return nearest + "phi_w = 0 degrees, the end of its range";
  if (plane.friction > largest_friction - at_end)
    return nearest + fmt::format("phi_w = {:g} degrees, the end of its range", largest_friction);
  return plane.cohesion < no_cohesion * matrix_ucs ? nearest + "c_w = 0, the end of its range" : "";
}

JaegerFit fit_jaeger(const std::vector<StrengthReading>& readings, double matrix_ucs) {
  return fit_jaeger(readings, [matrix_ucs](double) { return matrix_ucs; });
}

JaegerFit fit_jaeger(const std::vector<StrengthReading>& readings, const Matrix& matrix) {
  JaegerFit fit;
  fit.reason = refusal(readings, matrix);
  if (!fit.reason.empty()) return fit;
  fit.ok = true;
  const double matrix_ucs = fit.matrix_ucs = matrix(0.0);
  double best = std::numeric_limits<double>::infinity();
  Coulomb middle{0.25 * matrix_ucs, 0.5 * largest_friction};
  double half_c = 0.25 * matrix_ucs, half_phi = 0.5 * largest_friction;
  // The minimum of two curves has kinks, on which derivatives mislead: hence a grid that narrows.
  for (int round = 0; round < rounds; ++round) {
    for (int i = 0; i <= grid; ++i) {
      for (int j = 0; j <= grid; ++j) {
        const Coulomb plane{
            std::clamp(middle.cohesion + half_c * (2.0 * i / grid - 1.0), 0.0, 0.5 * matrix_ucs),
            std::clamp(middle.friction + half_phi * (2.0 * j / grid - 1.0), 0.0, largest_friction)};
        const double sum = misfit(readings, matrix, plane);
        if (sum < best) best = sum, fit.plane = plane;
      }
    }
    middle = fit.plane;
    half_c *= narrower, half_phi *= narrower;
  }
  const double total = spread(readings);
  fit.R2 = total > 0.0 ? 1.0 - best / total : nan;
  return fit;
}

JaegerFit fit_jaeger_and_matrix(const std::vector<StrengthReading>& readings) {
  JaegerFit fit;
  std::set<double> angles;
  double strongest = 0.0, best = std::numeric_limits<double>::infinity();
  for (const StrengthReading& r : readings) strongest = std::max(strongest, r.ucs), angles.insert(r.theta);
  fit.reason = refusal(readings, [&](double) { return strongest; });
  if (fit.reason.empty() && angles.size() < 4) fit.reason = "fewer than four inclinations";
  if (!fit.reason.empty()) return fit;
  const auto try_from = [&](double from, double to, double step) {
    for (int i = 0; from + i * step <= to; ++i) try_friction(readings, from + i * step, fit, best);
  };
  // At one friction angle cohesion and matrix follow exactly: only one unknown is searched.
  try_from(0.0, largest_friction, coarse_step);
  const double from = std::max(0.0, fit.plane.friction - coarse_step),
               to = std::min(largest_friction, fit.plane.friction + coarse_step);
  try_from(from, to, fine_step);
  fit.ok = true;
  const double total = spread(readings);
  fit.R2 = total > 0.0 ? 1.0 - best / total : nan;
  return fit;
}

}  // namespace phy::theory
