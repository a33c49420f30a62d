#include "calibrate/nearest.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/least_squares.hpp"
#include "verdict/margin.hpp"

namespace phy::calibrate {
namespace {

using verdict::tolerance;

using Eigen::VectorXd;

constexpr double draws_pull = 0.3, box_wall = 50.0;  // towards the draws; back into the box
constexpr double slope_step = 1e-4;                  // of the derivatives
constexpr std::size_t n_draw_starts = 6;

struct Misfit {
  const StrengthPosterior& posterior;
  VectorXd mean, sd;      ///< of the draws
  Eigen::Index n_misses;  ///< of strengths, and of moduli as they are read
  std::size_t left_out;

  int inputs() const { return static_cast<int>(mean.size()); }
  int values() const { return static_cast<int>(2 * n_misses + 2 * mean.size()); }
  /// Errors, ignorance, distances from the draws, and from the box.
  void operator()(const VectorXd& x, VectorXd& r) const {
    const Point held = posterior.held(Point(x.begin(), x.end()));
    const Eigen::Index n = n_misses, m = mean.size();
    const std::vector<StrengthPosterior::Miss> misses = posterior.misses(held);
    for (Eigen::Index i = 0; i < n; ++i) {
      const StrengthPosterior::Miss& miss = misses[static_cast<std::size_t>(i)];
      const double unit = 0.5 * tolerance(miss.property);
      const bool counts = static_cast<std::size_t>(i) != left_out;
      r[i] = counts ? softened(miss.error / unit) : 0.0;
      r[n + i] = counts ? std::sqrt(miss.variance) / unit : 0.0;
    }
    for (Eigen::Index j = 0; j < m; ++j) {
      r[2 * n + j] = draws_pull * (x[j] - mean[j]) / sd[j];
      r[2 * n + m + j] = box_wall * (x[j] - held[static_cast<std::size_t>(j)]);
    }
  }
  /// By differences of one step: places run from -1 to 1, sigma_c by its logarithm.
  void df(const VectorXd& x, Eigen::MatrixXd& J) const {
    VectorXd ahead(values()), behind(values()), moved = x;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      moved[j] = x[j] + slope_step, operator()(moved, ahead);
      moved[j] = x[j] - slope_step, operator()(moved, behind);
      J.col(j) = (ahead - behind) / (2.0 * slope_step), moved[j] = x[j];
    }
  }
  double at(const Point& x) const {
    VectorXd r(values());
    operator()(Eigen::Map<const VectorXd>(x.data(), inputs()), r);
    return r.squaredNorm();
  }
};

Misfit misfit_of(const StrengthPosterior& posterior, const std::vector<Point>& draws, std::size_t left_out) {
  const auto m = static_cast<Eigen::Index>(draws.front().size());
  const auto n_misses = static_cast<Eigen::Index>(posterior.misses(draws.front()).size());
  Misfit misfit{posterior, VectorXd::Zero(m), VectorXd::Zero(m), n_misses, left_out};
  const double n = static_cast<double>(draws.size());
  for (const Point& x : draws) misfit.mean += Eigen::Map<const VectorXd>(x.data(), m) / n;
  for (const Point& x : draws)
    misfit.sd += (Eigen::Map<const VectorXd>(x.data(), m) - misfit.mean).cwiseAbs2() / n;
  misfit.sd = misfit.sd.cwiseSqrt().cwiseMax(1e-3);
  return misfit;
}

Point downhill(const Misfit& misfit, const Point& from) {
  const VectorXd x = least_squares(misfits_of(misfit),
                                   Eigen::Map<const VectorXd>(from.data(), misfit.inputs()), {60, 1e-4, 1.0});
  return misfit.posterior.held(Point(x.begin(), x.end()));
}

}  // namespace

double softened(double x) {
  constexpr double edge = 2.0;
  return std::copysign(edge * std::sqrt(2.0 * (std::hypot(1.0, x / edge) - 1.0)), x);
}

Point nearest_point(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                    std::size_t left_out) {
  const Misfit misfit = misfit_of(posterior, draws, left_out);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < draws.size(); ++k) order.emplace_back(misfit.at(draws[k]), k);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), n_draw_starts));
  Point best = draws[order.front().second];
  for (const auto& [value, k] : order)
    if (const Point x = downhill(misfit, draws[k]); misfit.at(x) < misfit.at(best)) best = x;
  return best;
}

}  // namespace phy::calibrate
