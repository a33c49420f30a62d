#include "calibrate/ensemble.hpp"

#include <cmath>

#include "base/rng.hpp"

namespace phy::calibrate {

std::vector<Point> sample(const LogDensity& density, std::vector<Point> walkers, int steps, int thin,
                          std::uint32_t seed) {
  constexpr double stretch = 2.0;  // Goodman & Weare's a
  const std::size_t n = walkers.size(), half = n / 2;
  const auto dimensions = static_cast<double>(walkers.front().size());
  std::vector<double> log_p(n);
  for (std::size_t i = 0; i < n; ++i) log_p[i] = density(walkers[i]);
  std::vector<Point> draws;
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto u = [&](std::uint32_t k) {
        return uniform(seed, Stream::calibration, static_cast<std::uint32_t>(step),
                       static_cast<std::uint32_t>(i), k);
      };
      // a partner from the other half, so that the two halves leave the density alone
      const std::size_t other = i < half
                                    ? half + static_cast<std::size_t>(u(0) * static_cast<double>(n - half))
                                    : static_cast<std::size_t>(u(0) * static_cast<double>(half));
      const double root = 1.0 + (stretch - 1.0) * u(1), z = root * root / stretch;
      Point moved = walkers[other];
      for (std::size_t d = 0; d < moved.size(); ++d) moved[d] += z * (walkers[i][d] - walkers[other][d]);
      const double p = density(moved);
      if (std::log(u(2)) < (dimensions - 1.0) * std::log(z) + p - log_p[i]) walkers[i] = moved, log_p[i] = p;
    }
    if (step >= steps / 2 && (step + 1) % thin == 0)
      draws.insert(draws.end(), walkers.begin(), walkers.end());
  }
  return draws;
}

}  // namespace phy::calibrate
