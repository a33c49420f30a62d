// Every case of `phyllite verify` is a test.
#include <gtest/gtest.h>

#include "verification/cases.hpp"

namespace phy {
namespace {

class Verification : public testing::TestWithParam<std::size_t> {};

TEST_P(Verification, AgreesWithTheClosedForm) {
  const VerificationCase& c = verification_cases()[GetParam()];
  const std::vector<Check> checks = c.run();
  ASSERT_FALSE(checks.empty());
  for (const Check& k : checks)
    EXPECT_TRUE(k.passed()) << c.id << ": " << k.what << ": expected " << k.expected << ", measured "
                            << k.measured << ", tolerance " << k.tolerance;
}

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  return verification_cases()[info.param].id + "_" + std::to_string(info.param);
}
INSTANTIATE_TEST_SUITE_P(All, Verification, testing::Range<std::size_t>(0, verification_cases().size()),
                         name_of);

}  // namespace
}  // namespace phy
