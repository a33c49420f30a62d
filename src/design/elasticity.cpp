#include "design/elasticity.hpp"

#include <cmath>

namespace phy::design {
namespace {

using theory::PlaneConstants;
using theory::TransverseIsotropy;

/// E, E', nu', G' as the plane shows them.
TransverseIsotropy seen(const Eigen::VectorXd& x) {
  return {.E = std::exp(x[0]), .E_n = std::exp(x[1]), .nu = 0.0, .nu_n = x[2], .G_n = std::exp(x[3])};
}

/// Of the body behind them.
TransverseIsotropy body_behind(const TransverseIsotropy& shown, const ElasticReadingOf2D& reading) {
  TransverseIsotropy body = shown;
  const double lateral =
      shown.nu_n * shown.E / shown.E_n;  // nu of the specimen with its planes along the load
  const bool given = std::isfinite(reading.nu);
  if (reading.state == theory::PlaneState::stress) {
    body.nu = given ? reading.nu : lateral;
    return body;
  }
  // -S_xy/S_xx is nu' E/E' / (1 - nu), in isotropic rock between planes nu/(1 - nu).
  body.nu = given ? reading.nu : lateral / (1.0 + lateral);
  body.E = (1.0 - body.nu * body.nu) * shown.E;
  const double coupling = shown.nu_n / shown.E_n / (1.0 + body.nu);  // nu'/E'
  body.E_n = 1.0 / (1.0 / shown.E_n + coupling * coupling * body.E);
  body.nu_n = coupling * body.E_n;
  return body;
}

Eigen::VectorXd start_of(const std::vector<ElasticPoint>& points) {
  const ElasticPoint *across = &points.front(), *along = &points.front();
  // Loads nearest to across and along the planes show E' and E almost by themselves.
  for (const ElasticPoint& p : points) {
    if (p.theta < across->theta) across = &p;
    if (p.theta > along->theta) along = &p;
  }
  Eigen::VectorXd x(4);
  x << std::log(along->E), std::log(across->E), across->nu,
      std::log(theory::saint_venant_G(along->E, across->E, across->nu));
  return x;
}

}  // namespace

Fit fit_elasticity(const std::vector<ElasticPoint>& all, const ElasticReadingOf2D& reading) {
  std::vector<ElasticPoint> points;
  // A specimen without a solution leaves the others.
  for (const ElasticPoint& p : all)
    if (p.E > 0.0 && std::isfinite(p.nu)) points.push_back(p);
  if (points.size() < 3) return refused(Refusal::too_few);
  const Law law{2 * points.size(), [&](const Eigen::VectorXd& x, Eigen::VectorXd& misfits) {
                  const theory::PlaneCompliance body = plane_compliance(seen(x), theory::PlaneState::stress);
                  for (std::size_t i = 0; i < points.size(); ++i) {
                    const PlaneConstants at = theory::seen_at(body, points[i].theta);
                    const auto row = static_cast<Eigen::Index>(2 * i);
                    misfits[row] = std::log(at.E / points[i].E);
                    misfits[row + 1] = at.nu - points[i].nu;
                  }
                }};
  using enum Constant;
  const Fit shown = fit_law(law, {{E}, {E_n}, {nu_n}, {G_n}}, {start_of(points)});
  const Fit fit = transformed(shown, {{E}, {E_n}, {nu}, {nu_n}, {G_n}},
                              [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
                                const TransverseIsotropy b = body_behind(seen(x), reading);
                                y << std::log(b.E), std::log(b.E_n), b.nu, b.nu_n, std::log(b.G_n);
                              });
  // A given nu may be one that no body with these moduli has.
  return fit.ok() && !is_admissible(body_of(fit)) ? refused(Refusal::not_admissible) : fit;
}

theory::TransverseIsotropy body_of(const Fit& fit) {
  using enum Constant;
  return {.E = fit.value({E}),
          .E_n = fit.value({E_n}),
          .nu = fit.value({nu}),
          .nu_n = fit.value({nu_n}),
          .G_n = fit.value({G_n})};
}

}  // namespace phy::design
