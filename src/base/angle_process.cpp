#include "base/angle_process.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace phy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<double, 10> sizes = {0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0};  // usual ones
constexpr std::array<double, 4> lengths = {0.5, 0.7, 1.0, 1.4};  // in radians of 2 theta
// Over which the slope is counted: a rock at a fifth of its strength on the sides breaks in another way.
constexpr double stress_length = 0.2;
constexpr std::size_t no_cell = static_cast<std::size_t>(-1);

double periodic(double angle, double length) {
  const double s = std::sin(0.5 * angle) / length;
  return std::exp(-2.0 * s * s);
}

/// Of a function of the inclination with a standard deviation of one.
double over_angles(double theta, double other, double length) {
  const double a = theta * std::numbers::pi / 90.0, b = other * std::numbers::pi / 90.0;
  const double scale = (1.0 + periodic(2.0 * a, length)) * (1.0 + periodic(2.0 * b, length));
  return (periodic(a - b, length) + periodic(a + b, length)) / std::sqrt(scale);
}

/// Between two sizes a trapezium, so that a fine part of the grid does not count for more.
double width_at(std::size_t i) {
  const double low = sizes[i > 0 ? i - 1 : i], high = sizes[std::min(i + 1, sizes.size() - 1)];
  return 0.5 * (high - low);
}

}  // namespace

double AngleProcess::covariance(const Node& node, const AnglePlace& p, const AnglePlace& q) const {
  const double a = node.slope * (p.stress - middle_) / stress_length,
               b = node.slope * (q.stress - middle_) / stress_length;
  return (node.level * node.level + a * b) * over_angles(p.theta, q.theta, node.length);
}

void AngleProcess::learn(Node& node) const {
  const auto n = static_cast<Eigen::Index>(cells_.size());
  MatrixXd K(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const AngleCell &a = cells_[static_cast<std::size_t>(i)], &b = cells_[static_cast<std::size_t>(j)];
      K(i, j) = covariance(node, a.place, b.place) + (i == j ? a.noise + a.own : 0.0);
    }
  const Eigen::LLT<MatrixXd> cholesky(K);
  node.inverse = cholesky.solve(MatrixXd::Identity(n, n));
  // half of the logarithm of a determinant is the sum over the diagonal of its root
  const VectorXd diagonal = cholesky.matrixLLT().diagonal();
  node.weight += -0.5 * values_.dot(node.inverse * values_) - diagonal.array().log().sum();
}

AngleProcess::AngleProcess(const std::vector<AngleCell>& cells, double usual_size)
    : cells_(cells), values_(static_cast<Eigen::Index>(cells.size())) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    values_[static_cast<Eigen::Index>(i)] = cells[i].value;
    middle_ += cells[i].place.stress / static_cast<double>(cells.size());
  }
  const auto log_prior = [](std::size_t i) { return std::log(width_at(i)) - sizes[i]; };
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (std::size_t j = 0; j < sizes.size(); ++j)
      for (const double length : lengths) {
        nodes_.push_back(
            {sizes[i] * usual_size, sizes[j] * usual_size, length, log_prior(i) + log_prior(j), {}});
        learn(nodes_.back());
      }
  double highest = nodes_.front().weight, sum = 0.0;
  for (const Node& k : nodes_) highest = std::max(highest, k.weight);
  for (Node& k : nodes_) sum += k.weight = std::exp(k.weight - highest);
  for (Node& k : nodes_) k.weight /= sum;
}

AngleProcess::Prediction AngleProcess::predicted(const AnglePlace& place, std::size_t own_of) const {
  // The average over the nodes is linear in the values, as each node is. So one vector of weights serves
  // other values too; the weights of the nodes stay those of the values learnt from.
  Prediction all{VectorXd::Zero(values_.size())};
  double squares = 0.0;
  for (const Node& node : nodes_) {
    VectorXd k(values_.size());
    for (std::size_t j = 0; j < cells_.size(); ++j)
      k[static_cast<Eigen::Index>(j)] =
          covariance(node, place, cells_[j].place) + (j == own_of ? cells_[j].own : 0.0);
    const VectorXd weights = node.inverse * k;
    const double own = own_of == no_cell ? 0.0 : cells_[own_of].own, mean = weights.dot(values_);
    all.weights += node.weight * weights, all.mean += node.weight * mean;
    squares += node.weight * (mean * mean + covariance(node, place, place) + own - k.dot(weights));
  }
  all.variance = std::max(0.0, squares - all.mean * all.mean);
  return all;
}

AngleProcess::Prediction AngleProcess::at(const AnglePlace& place) const { return predicted(place, no_cell); }

AngleProcess::Prediction AngleProcess::of_cell(std::size_t i) const { return predicted(cells_[i].place, i); }

double AngleProcess::size() const {
  double mean = 0.0;
  for (const Node& node : nodes_) mean += node.weight * node.level;
  return mean;
}

}  // namespace phy
