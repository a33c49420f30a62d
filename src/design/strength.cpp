#include "design/strength.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/exact_math.hpp"
#include "base/stats.hpp"
#include "theory/angles.hpp"
#include "theory/envelope_fit.hpp"
#include "theory/fabric.hpp"
#include "theory/hoek_brown.hpp"

namespace phy::design {
namespace {

using enum Constant;

constexpr double least_log_m = -4.6;  // m of 0.01
constexpr std::size_t fewest_stresses = 3;
constexpr double across_planes = 15.0;  // [deg] m_i is that of planes within this of across the load

Eigen::VectorXd vector_of(std::initializer_list<double> values) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), x.begin());
  return x;
}

/// Misfits of sigma_1 at all points.
template <class Sigma1>
Law law_of(const StrengthPoints& points, const Sigma1& sigma_1) {
  return {points.size(), [&points, sigma_1](const Eigen::VectorXd& x, Eigen::VectorXd& misfits) {
            for (std::size_t i = 0; i < points.size(); ++i)
              misfits[static_cast<Eigen::Index>(i)] = std::log(sigma_1(x, points[i]) / points[i].ucs);
          }};
}

std::size_t n_stresses(const StrengthPoints& points) {
  std::set<double> stresses;
  for (const StrengthPoint& p : points) stresses.insert(p.sigma_3);
  return stresses.size();
}

/// The points of one inclination.
StrengthPoints at_angle(const StrengthPoints& points, double theta) {
  StrengthPoints of;
  std::copy_if(points.begin(), points.end(), std::back_inserter(of),
               [&](const StrengthPoint& p) { return p.theta == theta; });
  return of;
}

std::set<double> angles_of(const StrengthPoints& points) {
  std::set<double> angles;
  for (const StrengthPoint& p : points) angles.insert(p.theta);
  return angles;
}

/// Coulomb's constants through a line over the stresses; of a line that falls, those of a common rock.
theory::Coulomb coulomb_through(const StrengthPoints& points) {
  std::vector<theory::EnvelopeReading> readings;
  double mean = 0.0;
  for (const StrengthPoint& p : points) {
    readings.push_back({p.sigma_3, p.ucs});
    mean += (p.ucs - p.sigma_3) / static_cast<double>(points.size());
  }
  const theory::MohrCoulombFit fit = theory::fit_mohr_coulomb(readings);
  return fit.ok ? theory::Coulomb{fit.cohesion.value, fit.friction.value} : theory::Coulomb{0.3 * mean, 30.0};
}

// ---- one plane in an isotropic rock

struct PlaneAndRock {
  theory::Coulomb plane, rock;
};
PlaneAndRock plane_and_rock(const Eigen::VectorXd& x) {
  return {{std::exp(x[0]), x[1]}, {std::exp(x[2]), x[3]}};
}
double jaeger(const PlaneAndRock& of, double theta, double sigma_3) {
  return theory::jaeger_sigma_1(of.plane, theory::coulomb_sigma_1(of.rock, sigma_3), theta, sigma_3);
}

/// Planes through the weakest specimen for several frictions, in rocks through the strongest and through one
/// of both ends: which tests slip is open, and each choice has a minimum of its own.
std::vector<Eigen::VectorXd> starts_of(const StrengthPoints& points) {
  // Relative to others under its stress: strengths of different stresses do not compare.
  const auto weaker = [](const StrengthPoint& a, const StrengthPoint& b) {
    return a.sigma_3 != b.sigma_3 ? a.sigma_3 < b.sigma_3 : a.ucs < b.ucs;
  };
  StrengthPoints oblique;
  // Planes along or across the load do not slip.
  for (const StrengthPoint& p : points)
    if (const double t = theory::folded_theta(p.theta); t > 0.0 && t < 90.0) oblique.push_back(p);
  std::vector<Eigen::VectorXd> starts;
  if (oblique.empty()) return starts;
  const StrengthPoint weakest = *std::min_element(oblique.begin(), oblique.end(), weaker);
  const std::set<double> angles = angles_of(points);
  for (const double end : {*angles.begin(), *angles.rbegin()}) {
    const theory::Coulomb rock = coulomb_through(at_angle(points, end));
    for (const double friction : {5.0, 15.0, 25.0, 40.0}) {
      const double mu = tan_degrees(friction);
      const SinCos t = sin_cos_degrees(weakest.theta);
      const double drive = 2.0 * t.cos * (t.sin - mu * t.cos);
      const double cohesion = 0.5 * (weakest.ucs - weakest.sigma_3) * drive - weakest.sigma_3 * mu;
      if (cohesion > 0.0)
        starts.push_back(vector_of({std::log(cohesion), friction, std::log(rock.cohesion), rock.friction}));
    }
  }
  return starts;
}

/// The best constants from `x` on while every test stays with the branch that it is on, over and over until
/// none changes: the misfits of min(slip, break) have kinks, on which a search downhill sticks.
Eigen::VectorXd with_fixed_branches(const StrengthPoints& points, Eigen::VectorXd x) {
  constexpr int most_rounds = 20;
  std::vector<bool> before;
  for (int round = 0; round < most_rounds; ++round) {
    const PlaneAndRock of = plane_and_rock(x);
    std::vector<bool> slips;
    for (const StrengthPoint& p : points)
      slips.push_back(theory::weak_plane_sigma_1(of.plane, p.theta, p.sigma_3) <
                      theory::coulomb_sigma_1(of.rock, p.sigma_3));
    if (slips == before) break;
    before = slips;
    const Law law = law_of(points, [&](const Eigen::VectorXd& at, const StrengthPoint& p) {
      const PlaneAndRock now = plane_and_rock(at);
      return slips[static_cast<std::size_t>(&p - points.data())]
                 ? theory::weak_plane_sigma_1(now.plane, p.theta, p.sigma_3)
                 : theory::coulomb_sigma_1(now.rock, p.sigma_3);
    });
    const Fit fit = fit_law(law, {{c_j}, {phi_j}, {c}, {phi}}, {x});
    // A branch without tests has nothing that holds its constants.
    if (!fit.ok()) break;
    x = fit.x;
  }
  return x;
}

/// Why one of the branches rests on nothing.
Refusal branch_unseen(const StrengthPoints& points, const PlaneAndRock& of) {
  StrengthPoints slipping, breaking;
  for (const StrengthPoint& p : points) {
    const double rock = theory::coulomb_sigma_1(of.rock, p.sigma_3);
    (theory::weak_plane_sigma_1(of.plane, p.theta, p.sigma_3) < rock ? slipping : breaking).push_back(p);
  }
  if (n_stresses(slipping) < 2) return Refusal::no_plane;
  return n_stresses(breaking) < 2 ? Refusal::no_matrix : Refusal::none;
}

// ---- Hoek-Brown at every inclination

double hoek_brown(double sigma_ci, double m, double sigma_3) {
  // Steps of the search may leave the range of the curve: there it ends, and the misfit says so.
  const double inside = m * sigma_3 / sigma_ci + 1.0;
  return inside > 0.0 ? sigma_3 + sigma_ci * std::sqrt(inside) : nan;
}

/// sigma_ci and m of one inclination.
Fit fit_angle(const StrengthPoints& points) {
  const double theta = points.front().theta;
  std::vector<theory::EnvelopeReading> readings;
  for (const StrengthPoint& p : points) readings.push_back({p.sigma_3, p.ucs});
  const theory::HoekBrownFit start = theory::fit_hoek_brown(readings);
  if (!start.ok) return refused(Refusal::falling);
  const Law law = law_of(points, [](const Eigen::VectorXd& x, const StrengthPoint& p) {
    return hoek_brown(std::exp(x[0]), std::exp(x[1]), p.sigma_3);
  });
  const Fit fit = fit_law(law, {{sigma_ci, theta}, {m, theta}},
                          {vector_of({std::log(start.ucs.value), std::log(start.m_i.value)})});
  // m may run to zero, where no test says how far.
  return fit.ok() && !(fit.x[1] > least_log_m) ? refused(Refusal::falling) : fit;
}

/// Side by side: what one inclination has says nothing of another.
Fit joined(const std::vector<Fit>& fits) {
  // Blocks of a diagonal.
  Fit all{.refusal = Refusal::none};
  double squares = 0.0;
  for (const Fit& f : fits) {
    all.keys.insert(all.keys.end(), f.keys.begin(), f.keys.end());
    squares += f.error * f.error * static_cast<double>(f.n), all.n += f.n;
  }
  const auto n = static_cast<Eigen::Index>(all.keys.size());
  all.x = Eigen::VectorXd::Zero(n), all.covariance = Eigen::MatrixXd::Zero(n, n);
  Eigen::Index at = 0;
  for (const Fit& f : fits) {
    all.x.segment(at, f.x.size()) = f.x;
    all.covariance.block(at, at, f.x.size(), f.x.size()) = f.covariance;
    at += f.x.size();
  }
  all.error = std::sqrt(squares / static_cast<double>(all.n));
  return all;
}

/// sigma_ci and m of a fit at an inclination; between two of them by a straight line.
double hoek_brown_sigma_1(const Fit& fit, double theta, double sigma_3) {
  std::vector<double> angles;
  for (const Key& k : fit.keys)
    if (k.constant == sigma_ci) angles.push_back(k.theta);
  std::sort(angles.begin(), angles.end());
  if (angles.empty() || theta < angles.front() || theta > angles.back()) return nan;
  const auto above = std::lower_bound(angles.begin(), angles.end(), theta);
  const double b = *above, a = above == angles.begin() ? b : *(above - 1);
  const auto at = [&](double angle) {
    return hoek_brown(fit.value({sigma_ci, angle}), fit.value({m, angle}), sigma_3);
  };
  return a == b ? at(b) : at(a) + (theta - a) / (b - a) * (at(b) - at(a));
}

// ---- fabric

theory::Fabric fabric_of(const Eigen::VectorXd& x) { return {std::exp(x[0]), x[1], x[2], x[3]}; }

/// Inclinations with fewer stresses have no curve.
Fit hoek_brown_of(const StrengthPoints& points, std::size_t fewest) {
  std::vector<Fit> fits;
  Refusal why = Refusal::too_few;
  for (const double theta : angles_of(points)) {
    const StrengthPoints of = at_angle(points, theta);
    if (n_stresses(of) < fewest) continue;
    Fit fit = fit_angle(of);
    fit.ok() ? fits.push_back(std::move(fit)) : void(why = fit.refusal);
  }
  if (fits.empty()) return refused(why);
  const Fit all = joined(fits);
  // k is over the m of planes across the load, which somebody has to have tested.
  if (all.keys.front().theta > across_planes) return all;
  std::vector<Key> keys = all.keys;
  for (const Fit& f : fits) keys.push_back({k_beta, f.keys.front().theta});
  return transformed(all, keys, [](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    y.head(x.size()) = x;
    // Two numbers per inclination; the m of the first is m_i.
    for (Eigen::Index i = 0; i < x.size() / 2; ++i) y[x.size() + i] = x[2 * i + 1] - x[1];
  });
}

constexpr std::array<StrengthLaw, 3> laws = {{
    {Part::ubiquitous_joint, fit_ubiquitous_joint, fit_ubiquitous_joint,
     [](const Fit& f, double theta, double sigma_3) { return jaeger(plane_and_rock(f.x), theta, sigma_3); }},
    {Part::hoek_brown, fit_hoek_brown,
     [](const StrengthPoints& points) { return hoek_brown_of(points, fewest_stresses - 1); },
     hoek_brown_sigma_1},
    {Part::fabric, fit_fabric, fit_fabric,
     [](const Fit& f, double theta, double sigma_3) {
       return theory::fabric_sigma_1(fabric_of(f.x), theta, sigma_3);
     }},
}};

}  // namespace

Fit fit_ubiquitous_joint(const StrengthPoints& points) {
  if (points.size() < 4) return refused(Refusal::too_few);
  const Law law = law_of(points, [](const Eigen::VectorXd& x, const StrengthPoint& p) {
    return jaeger(plane_and_rock(x), p.theta, p.sigma_3);
  });
  std::vector<Eigen::VectorXd> starts = starts_of(points);
  if (starts.empty()) return refused(Refusal::no_plane);
  for (std::size_t i = 0, n = starts.size(); i < n; ++i)
    starts.push_back(with_fixed_branches(points, starts[i]));
  const Fit fit = fit_law(law, {{c_j}, {phi_j}, {c}, {phi}}, starts);
  // A plane that no test slips on has no slopes, and is found by that.
  if (fit.refusal == Refusal::undetermined || fit.refusal == Refusal::no_agreement)
    return refused(Refusal::no_plane);
  if (!fit.ok()) return fit;
  if (const Refusal why = branch_unseen(points, plane_and_rock(fit.x)); why != Refusal::none)
    return refused(why);
  return fit.x[1] < 0.0 || fit.x[3] < 0.0 ? refused(Refusal::falling) : fit;
}

Fit fit_hoek_brown(const StrengthPoints& points) { return hoek_brown_of(points, fewest_stresses); }

Fit fit_fabric(const StrengthPoints& points) {
  if (points.size() < 4) return refused(Refusal::too_few);
  const Law law = law_of(points, [](const Eigen::VectorXd& x, const StrengthPoint& p) {
    return theory::fabric_sigma_1(fabric_of(x), p.theta, p.sigma_3);
  });
  // Begins with a rock that is the same in all directions.
  const theory::Coulomb mean = coulomb_through(points);
  const Fit fit = fit_law(law, {{c_0}, {phi_0}, {omega}, {omega_2}},
                          {vector_of({std::log(mean.cohesion), mean.friction, 0.0, 0.0})});
  return fit.ok() && fit.x[1] < 0.0 ? refused(Refusal::falling) : fit;
}

Fit fit_tension(const StrengthPoints& points) {
  std::vector<double> across, along;
  for (const StrengthPoint& p : points) {
    if (p.theta == 0.0) across.push_back(std::log(p.ucs));
    if (p.theta == 90.0) along.push_back(std::log(p.ucs));
  }
  // In between planes open or rock tears: the law of both needs no third number.
  if (across.empty() || along.empty()) return refused(Refusal::too_few);
  Fit fit{.refusal = Refusal::none, .keys = {{sigma_tj}, {sigma_t}}, .error = 0.0, .n = points.size()};
  fit.x = vector_of({summarise(across).mean, summarise(along).mean});
  fit.covariance = Eigen::MatrixXd::Zero(2, 2);
  return fit;
}

std::span<const StrengthLaw> strength_laws() { return laws; }

double left_out_error(const StrengthLaw& law, const StrengthPoints& points) {
  if (n_stresses(points) < 3) return nan;
  std::set<double> stresses;
  for (const StrengthPoint& p : points) stresses.insert(p.sigma_3);
  double squares = 0.0;
  std::size_t n = 0;
  for (const double left_out : stresses) {
    StrengthPoints others;
    std::copy_if(points.begin(), points.end(), std::back_inserter(others),
                 [&](const StrengthPoint& p) { return p.sigma_3 != left_out; });
    const Fit fit = law.fit_without(others);
    // A mean over the stresses that could be predicted would flatter the law.
    if (!fit.ok()) return nan;
    for (const StrengthPoint& p : points) {
      const double miss = std::log(law.sigma_1(fit, p.theta, p.sigma_3) / p.ucs);
      // Inclinations without a curve of their own are predicted by none.
      if (p.sigma_3 == left_out && std::isfinite(miss)) squares += miss * miss, ++n;
    }
  }
  return n > 0 ? std::sqrt(squares / static_cast<double>(n)) : nan;
}

const char* word_of(Part part) {
  switch (part) {
    case Part::elasticity: return "elasticity";
    case Part::ubiquitous_joint: return "ubiquitous joint";
    case Part::tension: return "tension";
    case Part::hoek_brown: return "Hoek-Brown";
    case Part::fabric: return "fabric";
  }
  return "";
}

}  // namespace phy::design
