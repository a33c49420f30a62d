#include "analysis/cracks.hpp"

#include <gtest/gtest.h>

#include "analysis/histories_fixture.hpp"

namespace phy::analysis {
namespace {

/// 1 tension matrix, 2 shear matrix, 3 tension bedding, 4 shear bedding; the last of each kind after the peak
/// at 0.002.
std::vector<CrackEvent> ten() {
  std::vector<CrackEvent> cracks;
  const auto add = [&](int n, CrackMode mode, CrackPlace place) {
    for (int i = 1; i <= n; ++i) {
      CrackEvent c;
      c.mode = mode, c.place = place, c.strain = i == n ? 0.0025 : 0.001;
      cracks.push_back(c);
    }
  };
  add(1, CrackMode::tension, CrackPlace::matrix), add(2, CrackMode::shear, CrackPlace::matrix);
  add(3, CrackMode::tension, CrackPlace::bedding), add(4, CrackMode::shear, CrackPlace::bedding);
  return cracks;
}

TEST(Cracks, ByModeAndPlaceAtTheEndAndAtThePeak) {
  const auto numbers = crack_numbers(loading_branch(marble()), ten());
  EXPECT_EQ(value(numbers, "cracks_tension_matrix"), 1.0);
  EXPECT_EQ(value(numbers, "cracks_shear_matrix"), 2.0);
  EXPECT_EQ(value(numbers, "cracks_tension_bedding"), 3.0);
  EXPECT_EQ(value(numbers, "cracks_shear_bedding"), 4.0);
  EXPECT_EQ(value(numbers, "cracks_tension_matrix_at_peak"), 0.0);
  EXPECT_EQ(value(numbers, "cracks_shear_matrix_at_peak"), 1.0);
  EXPECT_EQ(value(numbers, "cracks_tension_bedding_at_peak"), 2.0);
  EXPECT_EQ(value(numbers, "cracks_shear_bedding_at_peak"), 3.0);
}

TEST(Cracks, TheStrainOfTheLimitItselfCounts) {
  EXPECT_EQ(count_cracks(ten(), 0.001).shear_bedding, 3);
  EXPECT_EQ(count_cracks(ten(), 0.00099).shear_bedding, 0);
}

TEST(Cracks, WithoutAPeakTheTotalsRemain) {
  const auto numbers = crack_numbers(loading_branch(unfinished()), ten());
  EXPECT_EQ(value(numbers, "cracks_shear_bedding"), 4.0);
  EXPECT_TRUE(std::isnan(value(numbers, "cracks_shear_bedding_at_peak")));
  EXPECT_TRUE(note(numbers, "cracks_shear_bedding_at_peak").starts_with("no peak"));
}

}  // namespace
}  // namespace phy::analysis
