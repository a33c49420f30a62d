// Misses that pass by themselves, against hand calculations with tabulated quantiles of Student's t.
#include "verdict/cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace phy::verdict {
namespace {

/// A row of UCS of mean 100: `packings` of the model with an SD of their own.
Comparison row(double sd, int n, int degrees, double of_packings, int packings) {
  Comparison c;
  c.target.property = Property::ucs, c.target.mean = 100.0, c.target.sd = sd, c.target.n = n,
  c.target.degrees = degrees;
  c.mean = 100.0, c.sd = of_packings, c.n_packings = packings;
  return c;
}

/// What passes by itself, from a miss of a fifth.
double passes(Comparison c) {
  c.mean *= 1.2, c.sd *= 1.2;
  return 0.2 / judge_cells({c}).front().scaled_miss();
}

TEST(MissThatPasses, IsStudentsOfBothMeansTogether) {
  // variances 6.25 (known) and 5 (four degrees of freedom): 11.25^2/(5^2/4) = 20.25, t_20 = 2.086
  EXPECT_NEAR(passes(row(5.0, 4, 0, 5.0, 5)), 0.02086 * std::sqrt(11.25), 1e-5);
  // 3.7^2 of 12 degrees and 2.4^2 of four: 19.45^2/(13.69^2/12 + 5.76^2/4) = 15.84, t_15 = 2.131
  EXPECT_NEAR(passes(row(7.4, 4, 12, 2.4 * std::sqrt(5.0), 5)), 0.02131 * std::sqrt(19.45), 1e-4);
  EXPECT_NEAR(passes(row(10.0, 1, 4, 0.0, 5)), 0.2776, 1e-4);  // t_4
  EXPECT_NEAR(passes(row(10.0, 1, 0, 0.0, 5)), 0.1960, 1e-4);
}

// A quarter of 6 % is 1.5 %: 3 % over the root of five packings is 1.3, 4 % 1.8, over that of ten 1.3.
TEST(UnseenPackings, ThatDifferMuchAskForMoreOfThem) {
  EXPECT_FALSE(wants_packings({row(5.0, 3, 0, 3.0, 5)}));
  EXPECT_TRUE(wants_packings({row(5.0, 3, 0, 4.0, 5)}));
  EXPECT_FALSE(wants_packings({row(5.0, 3, 0, 4.0, 10)}));
  EXPECT_FALSE(wants_packings({row(5.0, 3, 0, 4.0, 5), row(5.0, 3, 0, 1.0, 5)}));  // taken together
  Comparison split = row(5.0, 3, 0, 5.0, 5);
  split.target.property = Property::brazilian;  // of 10 %
  EXPECT_FALSE(wants_packings({split}));
  split.sd = 6.0;
  EXPECT_TRUE(wants_packings({split}));
  split.target.property = Property::E;  // direct solutions are another matter
  EXPECT_FALSE(wants_packings({split}));
  EXPECT_FALSE(wants_packings({}));
}

TEST(MissThatPasses, IsNeverBelowTheTolerance) {
  const std::pair<Property, double> tolerances[] = {{Property::E, 0.03},
                                                    {Property::ucs, 0.06},
                                                    {Property::direct_tension, 0.10},
                                                    {Property::brazilian, 0.10}};
  for (const auto& [property, part] : tolerances) {
    Comparison c = row(1.0, 5, 0, 0.0, 5);
    c.target.property = property;
    EXPECT_NEAR(passes(c), part, 1e-12);
  }
  Comparison c = row(1.0, 5, 0, 0.0, 5);
  c.target.property = Property::nu, c.target.mean = 0.2, c.target.sd = 0.001, c.mean = 0.2 - 0.03;
  EXPECT_NEAR(judge_cells({c}).front().scaled_miss(), -1.0, 1e-12);
}

}  // namespace
}  // namespace phy::verdict
