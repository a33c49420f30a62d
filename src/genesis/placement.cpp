#include "genesis/placement.hpp"

#include <algorithm>
#include <cmath>

#include "base/rng.hpp"

namespace phy::genesis {

void place_at_random(const SpecimenSize& size, std::int64_t seed, std::vector<Disc>& discs) {
  const auto key = static_cast<std::uint32_t>(seed);
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    Disc& d = discs[i];
    d.x = d.r + uniform(key, Stream::position, i, 0) * (size.width - 2.0 * d.r);
    d.y = d.r + uniform(key, Stream::position, i, 1) * (size.height - 2.0 * d.r);
  }
}

void place_in_rows(const SpecimenSize& size, std::int64_t seed, std::vector<Disc>& discs) {
  const auto key = static_cast<std::uint32_t>(seed);
  const double cell = std::sqrt(size.width * size.height / static_cast<double>(discs.size()));
  const double n_rows = std::max(1.0, std::round(size.height / cell));
  double area = 0.0, before = 0.0;
  for (const Disc& d : discs) area += d.r * d.r;
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    Disc& d = discs[i];
    // The rows laid end to end are a line, of which each disc has a piece: its row, and how far along it.
    const double share = d.r * d.r;
    const double along = (before + uniform(key, Stream::position, i, 0) * share) / area * n_rows;
    const double row = std::min(n_rows - 1.0, std::floor(along));
    d.x = std::clamp((along - row) * size.width, d.r, size.width - d.r);
    d.y = std::clamp((row + uniform(key, Stream::position, i, 1)) / n_rows * size.height, d.r,
                     size.height - d.r);
    before += share;
  }
}

}  // namespace phy::genesis
