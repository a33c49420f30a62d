#include "theory/envelope_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/stats.hpp"

namespace phy::theory {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr int newton_rounds = 50;

std::string refusal(const std::vector<EnvelopeReading>& readings) {
  std::set<double> confining;
  for (const EnvelopeReading& r : readings) {
    if (!std::isfinite(r.sigma_1) || !(r.sigma_1 > r.sigma_3))
      return "a strength is not above its confining stress";
    confining.insert(r.sigma_3);
  }
  return confining.size() < 2 ? "fewer than two confining stresses have a strength" : "";
}

double total_squares(const std::vector<EnvelopeReading>& readings) {
  double mean = 0.0, sum = 0.0;
  for (const EnvelopeReading& r : readings) mean += r.sigma_1 / static_cast<double>(readings.size());
  for (const EnvelopeReading& r : readings) sum += (r.sigma_1 - mean) * (r.sigma_1 - mean);
  return sum;
}

/// Unknowns of Hoek-Brown as a = ucs^2 and b = m ucs; sigma_1 = sigma_3 + sqrt(a + b sigma_3).
struct Curve {
  double a = 0.0, b = 0.0;
  double root(double sigma_3) const { return std::sqrt(a + b * sigma_3); }
};

/// Normal equations of Gauss-Newton.
struct Normal {
  double aa = 0.0, ab = 0.0, bb = 0.0, ra = 0.0, rb = 0.0, squares = 0.0;
  Normal(const std::vector<EnvelopeReading>& readings, const Curve& c) {
    for (const EnvelopeReading& r : readings) {
      const double root = c.root(r.sigma_3), residual = r.sigma_1 - r.sigma_3 - root;
      const double da = 0.5 / root, db = 0.5 * r.sigma_3 / root;
      aa += da * da, ab += da * db, bb += db * db;
      ra += da * residual, rb += db * residual, squares += residual * residual;
    }
  }
  double det() const { return aa * bb - ab * ab; }
};

Curve refine(const std::vector<EnvelopeReading>& readings, Curve curve) {
  for (int i = 0; i < newton_rounds; ++i) {
    const Normal n(readings, curve);
    const double da = (n.bb * n.ra - n.ab * n.rb) / n.det(), db = (n.aa * n.rb - n.ab * n.ra) / n.det();
    double step = 1.0;
    const auto moved = [&] { return Curve{curve.a + step * da, curve.b + step * db}; };
    while (step > 1e-6 &&
           (!(moved().a > 0.0) || !(moved().b > 0.0) || Normal(readings, moved()).squares > n.squares))
      step *= 0.5;
    if (step <= 1e-6) break;
    curve = moved();
  }
  return curve;
}

}  // namespace

MohrCoulombFit fit_mohr_coulomb(const std::vector<EnvelopeReading>& readings) {
  MohrCoulombFit fit;
  fit.reason = refusal(readings);
  if (!fit.reason.empty()) return fit;
  std::vector<double> x, y;
  for (const EnvelopeReading& r : readings) x.push_back(r.sigma_3), y.push_back(r.sigma_1);
  const LineFit line = fit_line(x, y);
  const double N = line.slope, u = line.intercept;
  if (!(N >= 1.0) || !(u > 0.0)) {
    fit.reason = N >= 1.0 ? "the line meets the axis below zero" : "the strength grows less than sigma_3";
    return fit;
  }
  fit.ok = true;
  fit.R2 = line.R2;
  fit.ucs = {u, line.intercept_se};
  fit.friction = {std::asin((N - 1.0) / (N + 1.0)) * degrees,
                  line.slope_se / ((N + 1.0) * std::sqrt(N)) * degrees};
  double mean = 0.0;
  for (const double s : x) mean += s / static_cast<double>(x.size());
  const double var_N = line.slope_se * line.slope_se, var_u = line.intercept_se * line.intercept_se;
  const double du = 0.5 / std::sqrt(N), dN = -0.25 * u / (N * std::sqrt(N));
  fit.cohesion = {u * du, std::sqrt(du * du * var_u + dN * dN * var_N - 2.0 * du * dN * mean * var_N)};
  return fit;
}

HoekBrownFit fit_hoek_brown(const std::vector<EnvelopeReading>& readings) {
  HoekBrownFit fit;
  fit.reason = refusal(readings);
  if (!fit.reason.empty()) return fit;
  std::vector<double> x, y;
  for (const EnvelopeReading& r : readings)
    x.push_back(r.sigma_3), y.push_back((r.sigma_1 - r.sigma_3) * (r.sigma_1 - r.sigma_3));
  const LineFit line = fit_line(x, y);
  if (!(line.slope > 0.0) || !(line.intercept > 0.0)) {
    fit.reason = line.slope > 0.0 ? "the curve meets the axis below zero"
                                  : "the strength does not grow faster than sigma_3";
    return fit;
  }
  // (sigma_1 - sigma_3)^2 is linear in sigma_3: that start weights high stresses too much, Gauss-Newton mends
  // it.
  const Curve curve = refine(readings, {line.intercept, line.slope});
  const Normal n(readings, curve);
  fit.ok = true;
  const double ucs = std::sqrt(curve.a), m = curve.b / ucs;
  fit.ucs.value = ucs, fit.m_i.value = m;
  fit.R2 = 1.0 - n.squares / total_squares(readings);
  // Two readings determine two unknowns, and no error.
  if (readings.size() < 3) return fit;
  const double s2 = n.squares / static_cast<double>(readings.size() - 2);
  const double var_a = s2 * n.bb / n.det(), var_b = s2 * n.aa / n.det(), cov = -s2 * n.ab / n.det();
  fit.ucs.se = 0.5 / ucs * std::sqrt(var_a);
  const double m_a = -0.5 * m / curve.a, m_b = 1.0 / ucs;  // derivatives of m = b / sqrt(a)
  fit.m_i.se = std::sqrt(m_a * m_a * var_a + m_b * m_b * var_b + 2.0 * m_a * m_b * cov);
  return fit;
}

}  // namespace phy::theory
