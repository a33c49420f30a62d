#include "theory/layered_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/least_squares.hpp"
#include "base/stats.hpp"

namespace phy::theory {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double step = 1e-5;            // of a logarithm, for derivatives
constexpr double same_direction = 1e-5;  // columns of the Jacobian closer than this are one

/// Compliances in units of 1/`modulus` from four numbers of any size.
PlaneCompliance body_of(const VectorXd& x, LayeredBody kind, double modulus) {
  PlaneCompliance S;
  S.S_xx = std::exp(x[0]);
  if (kind == LayeredBody::any) {
    S.S_yy = std::exp(x[1]), S.S_ss = std::exp(x[2]);
    // |S_xy| below the root of S_xx S_yy: any x gives a body with positive energy.
    S.S_xy = -std::tanh(x[3]) * std::sqrt(S.S_xx * S.S_yy);
  } else {
    // Isotropic rock, softened by planes across and along them, never stiffened.
    S.S_xy = -std::tanh(x[3]) * S.S_xx;
    S.S_yy = S.S_xx + std::exp(x[1]), S.S_ss = 2.0 * (S.S_xx - S.S_xy) + std::exp(x[2]);
  }
  for (double* part : {&S.S_xx, &S.S_yy, &S.S_xy, &S.S_ss}) *part /= modulus;
  return S;
}

VectorXd residuals_of(const PlaneCompliance& body, const std::vector<LayeredReading>& readings) {
  VectorXd r(static_cast<Eigen::Index>(readings.size()));
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const LayeredReading& cell = readings[static_cast<std::size_t>(i)];
    const PlaneConstants seen = seen_at(body, cell.theta);
    // Relative errors of E: a logarithm counts half and twice alike.
    r[i] = cell.is_modulus ? std::log(seen.E / cell.value) * cell.value / cell.error
                           : (seen.nu - cell.value) / cell.error;
  }
  return r;
}

/// At least as many values as unknowns (least_squares.hpp).
struct Misfit {
  const std::vector<LayeredReading>& readings;
  LayeredBody kind;
  double modulus;
  int values() const { return std::max(4, static_cast<int>(readings.size())); }
  void operator()(const VectorXd& x, VectorXd& r) const {
    r = VectorXd::Zero(values());
    r.head(static_cast<Eigen::Index>(readings.size())) = residuals_of(body_of(x, kind, modulus), readings);
  }
  void df(const VectorXd& x, MatrixXd& J) const {
    J.resize(values(), 4);
    VectorXd before, after;
    for (Eigen::Index j = 0; j < 4; ++j) {
      const VectorXd h = step * VectorXd::Unit(4, j);
      (*this)(x - h, before), (*this)(x + h, after);
      J.col(j) = (after - before) / (2.0 * step);
    }
  }
};

}  // namespace

double LayeredFit::limit() const { return chi_square_99(static_cast<std::size_t>(degrees_of_freedom)); }

LayeredFit fit_layered(const std::vector<LayeredReading>& readings, LayeredBody kind) {
  double modulus = 0.0;
  for (const LayeredReading& cell : readings)
    if (cell.is_modulus) modulus = std::max(modulus, cell.value);
  PHY_CHECK(modulus > 0.0, "a modulus among the readings");
  const Misfit misfit{readings, kind, modulus};
  LeastSquaresLimits from_near;
  from_near.first_step = 1.0;
  VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  // Nine starts: the misfit of E and nu together need not have one minimum.
  for (const double normal : {-2.0, 0.0, 2.0})
    for (const double shear : {-2.0, 0.0, 2.0}) {
      VectorXd x(4), r;
      x << 0.0, normal, shear, 0.25;
      x = least_squares(misfits_of(misfit), x, from_near);
      misfit(x, r);
      if (r.squaredNorm() < least) least = r.squaredNorm(), best = x;
    }
  PHY_CHECK(best.size() == 4, "a body with finite misfit");
  LayeredFit fit;
  fit.body = body_of(best, kind, modulus);
  fit.chi_square = least;
  const VectorXd r = residuals_of(fit.body, readings);
  fit.residual.assign(r.data(), r.data() + r.size());
  MatrixXd jacobian;
  misfit.df(best, jacobian);
  Eigen::ColPivHouseholderQR<MatrixXd> qr(jacobian);
  // Columns that act alike count as one unknown: a table of E alone cannot tell all four.
  qr.setThreshold(same_direction);
  fit.degrees_of_freedom = static_cast<int>(readings.size()) - static_cast<int>(qr.rank());
  return fit;
}

}  // namespace phy::theory
