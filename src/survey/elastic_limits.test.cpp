// What a table of E and nu says by itself. Tables made from one tensor must pass without a word, whatever
// their anisotropy; one changed value must be named.
#include "survey/elastic_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "theory/goodman.hpp"
#include "theory/transverse_isotropy.hpp"

namespace phy::survey {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;
using Kind = FindingKind;

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
  EXPECT_THAT(elastic_limits(table_of(jointed)), IsEmpty());
  std::vector<Target> noisy = table_of(jointed);
  double sign = 1.0;
  for (Target& t : noisy) t.mean += 0.8 * sign * t.sd, sign = -sign;
  EXPECT_THAT(elastic_limits(noisy), IsEmpty());
  noisy.resize(1);
  EXPECT_THAT(elastic_limits(noisy), IsEmpty());
  EXPECT_THAT(elastic_limits({}), IsEmpty());
}

TEST(ElasticLimit, TheOneCellThatBelongsToNoBodyIsNamedWithWhatTheOthersWant) {
  std::vector<Target> targets = table_of(jointed);
  Target& changed = targets[7];  // nu(0)
  ASSERT_EQ(changed.property, Property::nu);
  const double right = changed.mean;
  changed.mean *= 0.4;
  const std::vector<Finding> found = elastic_limits(targets);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, Kind::one_cell_of_no_body);
  EXPECT_EQ(found[0].cells.front(), (Cell{Property::nu, 0.0}));
  EXPECT_THAT(found[0].cells, Not(Contains(Cell{Property::nu, 45.0})));
  EXPECT_THAT(found[0].cells, Not(Contains(Cell{Property::E, 45.0})));
  EXPECT_NEAR(found[0].number("wanted"), right, 0.002);
  EXPECT_NEAR(found[0].number("errors"), (found[0].number("wanted") - changed.mean) / 0.01, 1e-6);
  EXPECT_GT(found[0].number("chi_square"), found[0].number("limit"));
}

TEST(ElasticLimit, SeveralCellsThatBelongToNoBodyAreNamedByTheNearest) {
  std::vector<Target> targets = table_of(jointed);
  targets[7].mean *= 0.4, targets[10].mean *= 0.4, targets[3].mean *= 1.4;
  ASSERT_EQ(elastic_limits(targets).size(), 1U);
  EXPECT_EQ(elastic_limits(targets)[0].kind, Kind::no_layered_body);
}

// In four cells any one may be the wrong one.
TEST(ElasticLimit, EndsThatContradictEachOtherAreAllNamed) {
  const std::vector<Target> ends = {{Property::E, 0.0, 20e9, 0.4e9, 1, false},
                                    {Property::E, 90.0, 40e9, 0.8e9, 1, false},
                                    {Property::nu, 0.0, 0.15, 0.01, 1, false},
                                    {Property::nu, 90.0, 0.15, 0.01, 1, false}};
  const std::vector<Finding> found = elastic_limits(ends);
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].cells.size(), 4U);
  std::vector<double> wanted;
  for (const NamedNumber& q : found[0].numbers)
    if (q.name == "wanted") wanted.push_back(q.value);
  ASSERT_EQ(wanted.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    if (found[0].cells[i] == Cell{Property::nu, 0.0}) {
      EXPECT_NEAR(wanted[i], 0.075, 5e-4);
    }
    if (found[0].cells[i] == Cell{Property::nu, 90.0}) {
      EXPECT_NEAR(wanted[i], 0.300, 5e-4);
    }
  }
}

// A laboratory that reads nu around the circumference measures another number, and its table may be a body's.
TEST(ElasticLimit, HowNuIsReadIsAskedWhereNuTakesPart) {
  std::vector<Target> targets = table_of(jointed);
  targets[7].mean *= 0.4, targets[3].mean *= 1.4;
  ASSERT_EQ(elastic_limits(targets).size(), 1U);
  EXPECT_EQ(elastic_limits(targets)[0].advice, Advice::check_nu);
  targets.resize(7);  // E alone
  ASSERT_EQ(elastic_limits(targets).size(), 1U);
  EXPECT_EQ(elastic_limits(targets)[0].advice, Advice::none);
}

TEST(ElasticLimit, ALayeredBodyThatNoPlanesMakeIsAKindOfItsOwn) {
  const std::vector<Finding> found = elastic_limits(table_of(reversed));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, Kind::no_planes_in_isotropic_rock);
  EXPECT_THAT(found[0].cells, Contains(Cell{Property::E, 0.0}));
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
  const std::vector<Finding> found = confinement_limits(table(1.2), ModulusReading::tangent_50);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].number("change"), 0.2, 1e-12);
  EXPECT_EQ(found[0].cells.at(0).confining, 0.0);
  EXPECT_EQ(found[0].cells.at(1).confining, 20e6);
  EXPECT_THAT(confinement_limits(table(1.05), ModulusReading::tangent_50), IsEmpty())
      << "within what E may miss";
  EXPECT_THAT(confinement_limits(table(1.2), ModulusReading::secant_at_peak), IsEmpty())
      << "cracks have a say there";
  std::vector<Target> bedded = table(1.1);  // and, at 90 degrees, a table that grows by more
  for (Target t : table(1.3)) t.theta = 90.0, bedded.push_back(t);
  ASSERT_EQ(confinement_limits(bedded, ModulusReading::tangent_50).size(), 1U);
  EXPECT_EQ(confinement_limits(bedded, ModulusReading::tangent_50)[0].cells.at(1),
            (Cell{Property::E, 90.0, 20e6}));
  std::vector<Target> coarse = table(1.2);
  for (Target& t : coarse) t.sd *= 10.0;
  EXPECT_THAT(confinement_limits(coarse, ModulusReading::tangent_50), IsEmpty()) << "chance";
  coarse.resize(1);
  EXPECT_THAT(confinement_limits(coarse, ModulusReading::tangent_50), IsEmpty());
}

}  // namespace
}  // namespace phy::survey
