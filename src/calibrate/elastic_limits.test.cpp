// What a table of E and nu says by itself. Tables made from one tensor must pass without a word, whatever
// their anisotropy; one changed value must be named.
#include "calibrate/elastic_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "theory/goodman.hpp"
#include "theory/transverse_isotropy.hpp"

namespace phy::calibrate {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::vector<double> angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};

/// E and nu of a body at seven angles, known to 2 % and 0.01.
std::vector<Target> table_of(const theory::TransverseIsotropy& m) {
  std::vector<Target> targets;
  for (const Property p : {Property::E, Property::nu})
    for (const double theta : angles) {
      const bool modulus = p == Property::E;
      const double value = modulus ? theory::ti_E(m, theta) : theory::ti_nu(m, theta);
      targets.push_back({p, theta, value, modulus ? 0.02 * value : 0.01, 1, false});
    }
  return targets;
}

/// K_n far from K_s: nu/E differs much between 0 and 45 degrees.
const theory::TransverseIsotropy jointed = theory::ti_from_goodman({60e9, 40e9, 12e9, 0.25});
/// Stiffer across its bedding than along it.
const theory::TransverseIsotropy reversed{22e9, 40e9, 0.2, 0.22, 11e9};

TEST(ElasticLimit, TablesOfOneTensorPassWithoutAWord) {
  ASSERT_GT(std::fabs(theory::ti_nu(jointed, 45.0) / theory::ti_E(jointed, 45.0) / (0.25 / 60e9) - 1.0), 0.5);
  EXPECT_EQ(elastic_limit(table_of(jointed)), "");
  std::vector<Target> noisy = table_of(jointed);
  double sign = 1.0;
  for (Target& t : noisy) t.mean += 0.8 * sign * t.sd, sign = -sign;
  EXPECT_EQ(elastic_limit(noisy), "");
  noisy.resize(1);
  EXPECT_EQ(elastic_limit(noisy), "");
  EXPECT_EQ(elastic_limit({}), "");
}

TEST(ElasticLimit, TheOneCellThatBelongsToNoBodyIsNamedWithWhatTheOthersWant) {
  std::vector<Target> targets = table_of(jointed);
  Target& changed = targets[7];  // nu(0)
  ASSERT_EQ(changed.property, Property::nu);
  const double right = changed.mean;
  changed.mean *= 0.4;
  EXPECT_THAT(elastic_limit(targets),
              AllOf(HasSubstr("no layered elastic body"), HasSubstr("nu(0) = "),
                    HasSubstr(std::to_string(right).substr(0, 5)), HasSubstr("standard errors"),
                    Not(HasSubstr("nu(45)")), Not(HasSubstr("E(45)"))));
}

TEST(ElasticLimit, SeveralCellsThatBelongToNoBodyAreNamedByTheNearest) {
  std::vector<Target> targets = table_of(jointed);
  targets[7].mean *= 0.4, targets[10].mean *= 0.4, targets[3].mean *= 1.4;
  EXPECT_THAT(elastic_limit(targets), AllOf(HasSubstr("no layered elastic body"), HasSubstr("nearest body")));
}

// In four cells any one may be the wrong one.
TEST(ElasticLimit, EndsThatContradictEachOtherAreAllNamed) {
  const std::vector<Target> ends = {{Property::E, 0.0, 20e9, 0.4e9, 1, false},
                                    {Property::E, 90.0, 40e9, 0.8e9, 1, false},
                                    {Property::nu, 0.0, 0.15, 0.01, 1, false},
                                    {Property::nu, 90.0, 0.15, 0.01, 1, false}};
  const std::string text = elastic_limit(ends);
  EXPECT_THAT(text, AllOf(HasSubstr("E(0) = 20"), HasSubstr("E(90) = 40"),
                          HasSubstr("nu(0) = 0.150 (the others want 0.075"),
                          HasSubstr("nu(90) = 0.150 (the others want 0.300")));
}

// A laboratory that reads nu around the circumference measures another number, and its table may be a body's.
TEST(ElasticLimit, HowNuIsReadIsSaidWhereNuTakesPart) {
  std::vector<Target> targets = table_of(jointed);
  targets[7].mean *= 0.4, targets[3].mean *= 1.4;
  EXPECT_THAT(elastic_limit(targets), HasSubstr("circumference"));
  targets.resize(7);  // E alone
  EXPECT_THAT(elastic_limit(targets),
              AllOf(HasSubstr("no layered elastic body"), Not(HasSubstr("circumference"))));
}

TEST(ElasticLimit, ALayeredBodyThatNoPlanesMakeIsToldApart) {
  EXPECT_THAT(elastic_limit(table_of(reversed)),
              AllOf(HasSubstr("a layered elastic body has the E and nu"), HasSubstr("planes add compliance"),
                    HasSubstr("E(0) = 40 GPa"), Not(HasSubstr("no layered"))));
}

// Bonds are as stiff under any stress.
TEST(ConfinementLimit, NamesAChangeThatBondsDoNotHave) {
  const auto table = [](double change) {
    std::vector<Target> targets;
    for (const double confining : {0.0, 5e6, 20e6}) {
      const double E = confining == 20e6 ? change * 30e9 : 30e9;
      targets.push_back({Property::E, 0.0, E, 0.02 * E, 3});
      targets.back().confining = confining;
    }
    return targets;
  };
  EXPECT_THAT(confinement_limit(table(1.2), ModulusReading::tangent_50),
              HasSubstr("E changes by +20 % from 0 to 20 MPa"));
  EXPECT_EQ(confinement_limit(table(1.05), ModulusReading::tangent_50), "") << "within what E may miss";
  EXPECT_EQ(confinement_limit(table(1.2), ModulusReading::secant_at_peak), "") << "cracks have a say there";
  std::vector<Target> coarse = table(1.2);
  for (Target& t : coarse) t.sd *= 10.0;
  EXPECT_EQ(confinement_limit(coarse, ModulusReading::tangent_50), "") << "chance";
  coarse.resize(1);
  EXPECT_EQ(confinement_limit(coarse, ModulusReading::tangent_50), "");
}

}  // namespace
}  // namespace phy::calibrate
