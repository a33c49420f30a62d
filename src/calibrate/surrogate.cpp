#include "calibrate/surrogate.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <utility>

namespace phy::calibrate {
namespace {

// Amplitudes in units of log(strength); slopes per half box: by maximum likelihood from 240 runs of UCS at
// eight angles, drawn over the box on four coarse packings
// (docs/decisions/0006-calibration-in-two-grain-sizes.md), and, the scatter, from the tests of 48 rocks
// against what others predict (prior_regression.hpp).
constexpr double remainder_size = 0.055;
constexpr double length = 0.8;  // of the remainder, in half boxes
constexpr double coarse_constant = 0.10, coarse_slope = 0.05;
constexpr double packing_coarse = 0.06, run_coarse = 0.085;
constexpr double packing_fine = 0.035, run_fine = 0.04;
// How far the factors on response and scatter lie from one: standard deviations of their logarithms.
constexpr double response_spread = 0.7, scatter_spread = 0.5;

using Vector = Eigen::Map<const Eigen::VectorXd>;

Vector vector_of(std::span<const double> v) { return {v.data(), static_cast<Eigen::Index>(v.size())}; }

double square(double x) { return x * x; }

}  // namespace

/// Covariance of the response of fine grains, mean over packings.
double Surrogate::response_kernel(std::span<const double> of, std::span<const double> other) const {
  const Vector a = vector_of(of), b = vector_of(other);
  const double dot = a.dot(b);
  return square(response_) *
         (square(prior_.constant) + square(prior_.slope) * dot + square(prior_.curvature) * square(dot) +
          square(remainder_size) * std::exp(-0.5 * (a - b).squaredNorm() / square(length)));
}

Surrogate::Surrogate(std::vector<SurrogateRun> runs, PriorMean prior_mean)
    : runs_(std::move(runs)), prior_(std::move(prior_mean)) {
  if (runs_.empty()) return;
  double best = -std::numeric_limits<double>::infinity();
  std::pair<double, double> chosen{1.0, 1.0};
  for (const double response : {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6})
    for (const double scatter : {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8}) {
      const double prior = -0.5 * square(std::log(response) / response_spread) -
                           0.5 * square(std::log(scatter) / scatter_spread);
      if (const double density = prior + learn(response, scatter); density > best)
        best = density, chosen = {response, scatter};
    }
  learn(chosen.first, chosen.second);
}

double Surrogate::learn(double response, double scatter) {
  response_ = response;
  const auto n = static_cast<Eigen::Index>(runs_.size());
  Eigen::MatrixXd K(n, n);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SurrogateRun& a = runs_[static_cast<std::size_t>(i)];
    y[i] = a.y - prior_.value(a.z);
    for (Eigen::Index j = 0; j <= i; ++j) {
      const SurrogateRun& b = runs_[static_cast<std::size_t>(j)];
      double k = response_kernel(a.z, b.z);
      if (a.coarse && b.coarse)
        k += square(coarse_constant) + square(coarse_slope) * vector_of(a.z).dot(vector_of(b.z));
      if (a.packing == b.packing && a.coarse == b.coarse)
        k += square(scatter * (a.coarse ? packing_coarse : packing_fine));
      if (i == j) k += square(scatter * (a.coarse ? run_coarse : run_fine));
      K(i, j) = K(j, i) = k;
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> cholesky(K);
  const Eigen::MatrixXd& factor = cholesky.matrixLLT();
  const Eigen::VectorXd weights = cholesky.solve(y);
  factor_.assign(factor.data(), factor.data() + factor.size());
  weights_.assign(weights.begin(), weights.end());
  double log_determinant = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) log_determinant += std::log(factor(i, i));
  return -0.5 * y.dot(weights) - log_determinant;
}

Surrogate::Value Surrogate::at(std::span<const double> z) const {
  const auto n = static_cast<Eigen::Index>(runs_.size());
  Eigen::VectorXd k(n);
  for (Eigen::Index i = 0; i < n; ++i) k[i] = response_kernel(z, runs_[static_cast<std::size_t>(i)].z);
  const double prior = response_kernel(z, z);
  const Eigen::Map<const Eigen::MatrixXd> factor(factor_.data(), n, n);
  const double known = runs_.empty() ? 0.0 : factor.triangularView<Eigen::Lower>().solve(k).squaredNorm();
  return {prior_.value(z) + k.dot(vector_of(weights_)), std::max(0.0, prior - known)};
}

}  // namespace phy::calibrate
