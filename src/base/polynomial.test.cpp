#include "base/polynomial.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace phy {
namespace {

TEST(Polynomial, HasTheRootsThatItWasMadeOf) {
  // (x - 2)(x + 3)(x^2 - 2x + 5) = x^4 - x^3 - 3x^2 + 17x - 30
  const std::vector<std::complex<double>> found = roots_of_monic({-30.0, 17.0, -3.0, -1.0});
  ASSERT_EQ(found.size(), 4U);
  for (const std::complex<double> root :
       {std::complex(2.0, 0.0), std::complex(-3.0, 0.0), std::complex(1.0, 2.0), std::complex(1.0, -2.0)})
    EXPECT_EQ(std::count_if(found.begin(), found.end(),
                            [&](const std::complex<double>& f) { return std::abs(f - root) < 1e-12; }),
              1)
        << root;
}

TEST(Polynomial, OfTheFirstDegreeHasOne) { EXPECT_DOUBLE_EQ(roots_of_monic({-4.0}).front().real(), 4.0); }

}  // namespace
}  // namespace phy
