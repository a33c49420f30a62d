// By which tension is a Brazilian test read? Numbers of docs/theory/brazilian.md.
#include "lab/brazilian/reading.hpp"

#include <gtest/gtest.h>

namespace phy::lab {
namespace {

TEST(BrazilianArcFactor, IsOneForPointLoadsAndFallsWithTheArc) {
  EXPECT_EQ(brazilian_arc_factor(0.0), 1.0);
  EXPECT_NEAR(brazilian_arc_factor(1e-4), 1.0, 1e-9);
  EXPECT_NEAR(brazilian_arc_factor(2.0), 0.9986, 5e-5);
  EXPECT_NEAR(brazilian_arc_factor(5.0), 0.9911, 5e-5);
  EXPECT_NEAR(brazilian_arc_factor(10.0), 0.9645, 5e-5);
  EXPECT_NEAR(brazilian_arc_factor(15.0), 0.9203, 5e-5);
}

}  // namespace
}  // namespace phy::lab
