// Do discs lie where they may, and does a packing that began in rows end like one that began at random?
#include "genesis/placement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/exact_math.hpp"
#include "base/rng.hpp"
#include "genesis/settle.hpp"

namespace phy::genesis {
namespace {

constexpr SpecimenSize box{0.030, 0.060};

/// Radii that differ by 1.66, with a share of the box that settles at porosity 0.08.
std::vector<Disc> radii(std::uint32_t n, double porosity = 0.08) {
  std::vector<Disc> discs;
  double area = 0.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    discs.push_back({0.0, 0.0, 1.0 + 0.66 * uniform(9, Stream::radius, i)});
    area += pi * discs.back().r * discs.back().r;
  }
  const double scale = std::sqrt((1.0 - porosity) * box.width * box.height / area);
  for (Disc& d : discs) d.r *= scale;
  return discs;
}

/// Variance of the area of discs whose centres lie in each of 8 x 16 squares, over the square of its mean.
double unevenness(const std::vector<Disc>& discs) {
  constexpr std::size_t across = 8, n = across * 2 * across;
  std::array<double, n> area{};
  for (const Disc& d : discs) {
    const auto x = static_cast<std::size_t>(d.x / box.width * across);
    const auto y = static_cast<std::size_t>(d.y / box.height * 2 * across);
    area.at(y * across + x) += d.r * d.r;
  }
  double sum = 0.0, squares = 0.0;
  for (const double a : area) sum += a, squares += a * a;
  return squares * n / (sum * sum) - 1.0;
}

TEST(Placement, EveryDiscLiesInTheBox) {
  for (const auto place : {place_at_random, place_in_rows})
    for (const std::uint32_t n : {17U, 100U, 4000U}) {
      std::vector<Disc> discs = radii(n);
      place(box, 1, discs);
      for (const Disc& d : discs) {
        EXPECT_TRUE(d.x >= d.r && d.x <= box.width - d.r) << n;
        EXPECT_TRUE(d.y >= d.r && d.y <= box.height - d.r) << n;
      }
    }
}

TEST(Placement, RowsFillEveryPartOfTheBoxAlike) {
  std::vector<Disc> random = radii(8000), rows = random;
  place_at_random(box, 1, random), place_in_rows(box, 1, rows);
  // Poisson's: 1/62.5 discs per square, a little more as they differ. In rows only discs at the rims differ.
  EXPECT_GT(unevenness(random), 0.012);
  EXPECT_LT(unevenness(rows), 0.25 * unevenness(random));
}

TEST(Placement, SeedsTellPlacesApart) {
  std::vector<Disc> one = radii(100), again = one, other = one;
  place_in_rows(box, 1, one), place_in_rows(box, 1, again), place_in_rows(box, 2, other);
  int n_alike = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].x, again[i].x);
    EXPECT_EQ(one[i].y, again[i].y);
    n_alike += one[i].x == other[i].x && one[i].y == other[i].y;
  }
  EXPECT_LE(n_alike, 4) << "all but those in corners, which touch two walls";
}

TEST(Placement, RowsSettleToTheSamePackingInTheMean) {
  const auto settled = [](const auto& place, std::int64_t seed) {
    std::vector<Disc> discs = radii(2000);
    place(box, seed, discs);
    return settle({box.width, box.height}, discs, 1e-4, 0.0, 100000);
  };
  double pressure = 0.0, contacts = 0.0;
  constexpr int n = 4;
  for (int seed = 1; seed <= n; ++seed) {
    const Equilibrium random = settled(place_at_random, seed), rows = settled(place_in_rows, seed);
    pressure += rows.pressure / random.pressure / n;
    contacts += static_cast<double>(rows.n_contacts) / static_cast<double>(random.n_contacts) / n;
  }
  EXPECT_NEAR(pressure, 1.0, 0.03);
  EXPECT_NEAR(contacts, 1.0, 0.01);
}

}  // namespace
}  // namespace phy::genesis
