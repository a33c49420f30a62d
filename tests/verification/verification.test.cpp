// Every case of `phyllite verify` is a test; and what tests are read by is what theory says.
#include <gtest/gtest.h>

#include "lab/brazilian/reading.hpp"
#include "theory/hondros.hpp"
#include "verification/cases.hpp"

namespace phy {
namespace {

class Verification : public testing::TestWithParam<std::size_t> {};

TEST_P(Verification, AgreesWithTheClosedForm) {
  const verification::VerificationCase& c = verification::verification_cases()[GetParam()];
  const std::vector<verification::Check> checks = c.run();
  ASSERT_FALSE(checks.empty());
  for (const verification::Check& k : checks)
    EXPECT_TRUE(k.passed()) << c.id << ": " << k.what << ": expected " << k.expected << ", measured "
                            << k.measured << ", tolerance " << k.tolerance;
}

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  return verification::verification_cases()[info.param].id + "_" + std::to_string(info.param);
}
INSTANTIATE_TEST_SUITE_P(All, Verification,
                         testing::Range<std::size_t>(0, verification::verification_cases().size()), name_of);

TEST(BrazilianReading, IsHondrosTensionAtTheCentre) {
  for (const double alpha : {1.0, 5.0, 8.0, 30.0}) {
    const theory::BrazilianDisc disc{0.05, 0.025, alpha, 9e3};
    const double narrow = theory::brazilian_strength(disc.P, disc.diameter, disc.thickness);
    EXPECT_NEAR(-theory::hondros_loaded_diameter(disc, 0.0).sigma_x / narrow,
                lab::brazilian_arc_factor(alpha), 1e-13);
  }
}

}  // namespace
}  // namespace phy
