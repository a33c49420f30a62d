#include "calibrate/posterior_ensemble.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "base/rng.hpp"
#include "calibrate/elastic_response.hpp"

namespace phy::calibrate {
namespace {

constexpr std::uint32_t most_tries = 1000;  // for a draw inside the box

bool inside(const Eigen::VectorXd& x, const std::vector<LogBox>& boxes) {
  for (std::size_t j = 0; j < boxes.size(); ++j)
    if (const double v = x[static_cast<Eigen::Index>(j)]; v < boxes[j].low || v > boxes[j].high) return false;
  return true;
}

}  // namespace

std::vector<Point> gaussian_draws(const Point& mean, const std::vector<double>& covariance,
                                  const std::vector<LogBox>& boxes, std::size_t n, std::uint32_t seed) {
  const auto m = static_cast<Eigen::Index>(mean.size());
  const Eigen::Map<const Eigen::VectorXd> centre(mean.data(), m);
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Map(covariance.data(), m, m);
  const Eigen::LLT<Eigen::MatrixXd> root(matrix);
  std::vector<Point> draws;
  // Without a root there is no joint distribution: no draws say more than draws along the axes would.
  if (!matrix.allFinite() || root.info() != Eigen::Success) return draws;
  for (std::uint32_t k = 0; k < n; ++k) {
    Eigen::VectorXd x(m);
    for (std::uint32_t attempt = 0; attempt < most_tries; ++attempt) {
      for (Eigen::Index j = 0; j < m; ++j)
        x[j] = normal(seed, Stream::calibration, k, attempt, static_cast<std::uint32_t>(j));
      x = (centre + root.matrixL() * x).eval();
      if (inside(x, boxes)) break;
    }
    Point& draw = draws.emplace_back(x.begin(), x.end());
    for (std::size_t j = 0; j < boxes.size(); ++j) draw[j] = std::clamp(draw[j], boxes[j].low, boxes[j].high);
  }
  return draws;
}

std::vector<Point> evenly_taken(const std::vector<Point>& draws, std::size_t n) {
  std::vector<Point> taken;
  // The stride is no multiple of the number of walkers: the draws come from all of them.
  for (std::size_t k = 0; k < n; ++k) taken.push_back(draws[k * (draws.size() - 1) / (n - 1)]);
  return taken;
}

std::vector<Recipe> posterior_ensemble(const Recipe& estimate, const std::vector<Recipe>& moduli,
                                       const std::vector<Recipe>& strengths, std::int64_t first_seed) {
  std::vector<Recipe> ensemble;
  for (std::size_t k = 0; k < ensemble_size; ++k) {
    Recipe r = strengths.empty() ? estimate : strengths[k];
    // Behind the strengths, whose draws carry the estimate's moduli.
    if (!moduli.empty()) r = with_moduli(std::move(r), moduli[k]);
    // Draws come with the settings of the search's tests; what a user runs should be the same test as the
    // estimate's.
    r.test = estimate.test;
    take_packing(r, first_seed + static_cast<std::int64_t>(k));
    r.name = fmt::format("{}, draw {} of {}", estimate.name, k + 1, ensemble_size);
    ensemble.push_back(std::move(r));
  }
  return ensemble;
}

}  // namespace phy::calibrate
