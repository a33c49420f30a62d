#include "calibrate/best_estimate.hpp"

#include <Eigen/Core>
#include <cmath>

#include "maps/nearest.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

using verdict::tolerance;

using Eigen::VectorXd;

// Half a tolerance counts as one: a fiftieth of a coordinate outside the box costs as much.
constexpr double box_wall = 50.0;    // back into the box
constexpr double slope_step = 1e-4;  // of the derivatives

struct Misfit {
  const StrengthPosterior& posterior;
  VectorXd mean;          ///< of the draws
  VectorXd sd;            ///< before any data
  Eigen::Index n_misses;  ///< of strengths, and of moduli as they are read
  std::size_t left_out;

  int inputs() const { return static_cast<int>(mean.size()); }
  int values() const { return static_cast<int>(2 * n_misses + 2 * mean.size()); }
  /// Errors, ignorance, distances from the draws, and from the box.
  void operator()(const VectorXd& x, VectorXd& r) const {
    const Point held = posterior.held(Point(x.begin(), x.end()));
    const Eigen::Index n = n_misses, m = mean.size();
    // The surrogates know nothing outside the box, and their prior grows there without bound: they are asked
    // at its edge.
    const std::vector<StrengthPosterior::Miss> misses = posterior.misses(held);
    for (Eigen::Index i = 0; i < n; ++i) {
      const StrengthPosterior::Miss& miss = misses[static_cast<std::size_t>(i)];
      const double unit = 0.5 * tolerance(miss.property);
      const bool counts = static_cast<std::size_t>(i) != left_out;
      r[i] = counts ? maps::softened(miss.error / unit) : 0.0;
      r[n + i] = counts ? std::sqrt(miss.variance) / unit : 0.0;
    }
    for (Eigen::Index j = 0; j < m; ++j) {
      r[2 * n + j] = (x[j] - mean[j]) / sd[j];
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
  double at(const VectorXd& x) const {
    VectorXd r(values());
    operator()(x, r);
    return r.squaredNorm();
  }
  /// The nearest point of the box.
  VectorXd clamped(const VectorXd& x) const {
    const Point inside = posterior.held(Point(x.begin(), x.end()));
    return Eigen::Map<const VectorXd>(inside.data(), x.size());
  }
};

Misfit misfit_of(const StrengthPosterior& posterior, const std::vector<Point>& draws, std::size_t left_out) {
  const auto m = static_cast<Eigen::Index>(draws.front().size());
  const auto n_misses = static_cast<Eigen::Index>(posterior.misses(draws.front()).size());
  Misfit misfit{posterior, VectorXd::Zero(m), VectorXd::Zero(m), n_misses, left_out};
  const double n = static_cast<double>(draws.size());
  // The distance is measured from the draws, but in the units of the prior. In those of the draws a
  // determined parameter would be held where the draws are, not where the table is.
  for (const Point& x : draws) misfit.mean += Eigen::Map<const VectorXd>(x.data(), m) / n;
  for (Eigen::Index j = 0; j < m; ++j) misfit.sd[j] = posterior.prior_spread(static_cast<std::size_t>(j));
  return misfit;
}

}  // namespace

Point best_estimate(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                    std::size_t left_out) {
  // Strengths of several valleys may fit alike: no single start finds the deepest.
  std::vector<VectorXd> starts;
  for (const Point& x : draws)
    starts.emplace_back(Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())));
  const VectorXd x = maps::nearest(misfit_of(posterior, draws, left_out), starts);
  return {x.begin(), x.end()};
}

}  // namespace phy::calibrate
