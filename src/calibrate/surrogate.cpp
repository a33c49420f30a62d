#include "calibrate/surrogate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
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

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Eigen::Map<const VectorXd> vector_of(std::span<const double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

double square(double x) { return x * x; }

}  // namespace

/// The parts of the covariance of the runs that the two factors multiply.
struct Surrogate::Shared {
  MatrixXd response, coarse, scatter;
  Shared(const std::vector<SurrogateRun>& runs, const MatrixXd& response_of_runs);
};

Surrogate::Shared::Shared(const std::vector<SurrogateRun>& runs, const MatrixXd& response_of_runs)
    : response(response_of_runs) {
  const auto n = static_cast<Eigen::Index>(runs.size());
  coarse = scatter = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const SurrogateRun &a = runs[static_cast<std::size_t>(i)], &b = runs[static_cast<std::size_t>(j)];
      if (a.coarse && b.coarse)
        coarse(i, j) = square(coarse_constant) + square(coarse_slope) * vector_of(a.z).dot(vector_of(b.z));
      if (a.packing == b.packing && a.coarse == b.coarse)
        scatter(i, j) = square(a.coarse ? packing_coarse : packing_fine);
      if (i == j) scatter(i, j) += square(a.coarse ? run_coarse : run_fine);
    }
}

ArrayXd Surrogate::response_kernel(const Eigen::Ref<const VectorXd>& z) const {
  const ArrayXd dot = (places_ * z).array();
  const auto distance = squares_ + z.squaredNorm() - 2.0 * dot;
  return square(response_) *
         (square(prior_.constant) + square(prior_.slope) * dot + square(prior_.curvature) * dot.square() +
          square(remainder_size) * (distance * (-0.5 / square(length))).exp());
}

double Surrogate::response_variance(double squared_length) const {
  return square(response_) * (square(prior_.constant) + square(prior_.slope) * squared_length +
                              square(prior_.curvature * squared_length) + square(remainder_size));
}

Surrogate::Surrogate(const std::vector<SurrogateRun>& runs, maps::PriorMean prior_mean)
    : prior_(std::move(prior_mean)) {
  if (runs.empty()) return;
  const auto n = static_cast<Eigen::Index>(runs.size());
  places_.resize(n, static_cast<Eigen::Index>(runs.front().z.size()));
  VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SurrogateRun& run = runs[static_cast<std::size_t>(i)];
    places_.row(i) = vector_of(run.z), y[i] = run.y - prior_.value(run.z);
  }
  squares_ = places_.rowwise().squaredNorm();
  MatrixXd response(n, n);
  for (Eigen::Index i = 0; i < n; ++i) response.col(i) = response_kernel(places_.row(i).transpose());
  const Shared shared(runs, response);
  double best = -std::numeric_limits<double>::infinity();
  std::pair<double, double> chosen{1.0, 1.0};
  // A grid over the whole prior: a descent could end in a side maximum, and thirty runs cost next to nothing.
  for (const double factor : {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6})
    for (const double scatter : {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8}) {
      const double prior = -0.5 * square(std::log(factor) / response_spread) -
                           0.5 * square(std::log(scatter) / scatter_spread);
      if (const double density = prior + learn(y, shared, factor, scatter); density > best)
        best = density, chosen = {factor, scatter};
    }
  learn(y, shared, chosen.first, chosen.second);
  // Of fine grains, whatever the runs were on: it is their mean that is predicted.
  scatter_variance_ = square(chosen.second) * (square(packing_fine) + square(run_fine));
  std::set<int> packings;
  for (const SurrogateRun& run : runs)
    if (!run.coarse) packings.insert(run.packing);
  if (!packings.empty())
    packing_variance_ = square(chosen.second * packing_fine) / static_cast<double>(packings.size());
  // The inverse once: walkers ask for the variance hundreds of thousands of times, and products vectorise
  // where substitution does not.
  whitener_ = factor_.triangularView<Eigen::Lower>().solve(MatrixXd::Identity(n, n)).transpose();
}

double Surrogate::learn(const VectorXd& y, const Shared& shared, double response, double scatter) {
  response_ = response;
  const MatrixXd K = square(response) * shared.response + shared.coarse + square(scatter) * shared.scatter;
  // Positive definite, also with the same point twice: every run has its own scatter on the diagonal.
  const Eigen::LLT<MatrixXd> cholesky(K);
  factor_ = cholesky.matrixL();
  weights_ = cholesky.solve(y);
  return -0.5 * y.dot(weights_) - factor_.diagonal().array().log().sum();
}

Surrogate::Value Surrogate::at(std::span<const double> z) const {
  const auto place = vector_of(z);
  const double prior = response_variance(place.squaredNorm());
  if (weights_.size() == 0) return {prior_.value(z), prior};
  const VectorXd k = response_kernel(place);
  double known = 0.0;
  for (Eigen::Index i = 0; i < k.size(); ++i)
    known += square(whitener_.col(i).head(i + 1).dot(k.head(i + 1)));
  // Rounding may leave a little less than nothing.
  return {prior_.value(z) + k.dot(weights_), std::max(0.0, prior - known)};
}

}  // namespace phy::calibrate
