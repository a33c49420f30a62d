// What closed forms say of tables that were made by them, and of tables that they cannot hold.
#include "calibrate/closed_forms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const double degree = std::acos(-1.0) / 180.0;

Rock bedded() {
  Rock rock;
  rock.model.bedding.resize(1), rock.model.bedding[0].spacing = 4e-3;
  return rock;
}

/// Planes that add cos^4/K_n + sin^2 cos^2/K_s to the compliance of the rock [GPa].
Evidence planes_in_rock(double E, double K_n, double K_s, const std::vector<double>& angles) {
  Rock rock = bedded();
  for (const double theta : angles) {
    const double c2 = std::pow(std::cos(theta * degree), 2.0);
    rock.readings.push_back(
        reading(Property::E, theta, 1e9 / (1.0 / E + c2 * c2 / K_n + c2 * (1.0 - c2) / K_s)));
  }
  return Evidence(rock);
}

/// Slip where the drive on the plane exceeds what holds it, else the shoulders [MPa].
Evidence weak_plane(double cohesion, double tan_phi, double shoulders, const std::vector<double>& angles) {
  Rock rock = bedded();
  for (const double theta : angles) {
    const double s = std::sin(theta * degree), c = std::cos(theta * degree), drive = s * c - tan_phi * c * c;
    rock.readings.push_back(reading(
        Property::ucs, theta, 1e6 * (drive > 1e-9 ? std::min(shoulders, cohesion / drive) : shoulders)));
  }
  return Evidence(rock);
}

TEST(ClosedForms, Eq1TellsThePlanesThatMadeTheTableAndTheirType) {
  EXPECT_THAT(eq1_line(planes_in_rock(50, 100, 20, {0, 15, 30, 45, 60, 75, 90})),
              AllOf(HasSubstr("E = 50"), HasSubstr("K_n delta = 100"), HasSubstr("K_s delta = 20"),
                    HasSubstr("K_n = 25000, K_s = 5000 GPa/m every 4 mm"), HasSubstr("R2 = 1.000"),
                    HasSubstr("shoulder type"), HasSubstr("at 38 degrees")));  // cos^2 = 100/(2 (100 - 20))
  EXPECT_THAT(eq1_line(planes_in_rock(50, 30, 20, {0, 30, 60, 90})),
              AllOf(HasSubstr("incremental type"), Not(HasSubstr("shoulder")), Not(HasSubstr("while"))));
}

TEST(ClosedForms, Eq1ThatGrowsDoesNotSpeakForATableThatDips) {
  Rock rock = bedded();
  const std::vector<double> E = {38.40, 37.32, 38.81, 41.65, 45.77, 49.97, 53.38};  // GPa, the augen gneiss
  for (std::size_t i = 0; i < E.size(); ++i)
    rock.readings.push_back(reading(Property::E, 15.0 * static_cast<double>(i), 1e9 * E[i]));
  EXPECT_THAT(
      eq1_line(Evidence(rock)),
      HasSubstr("E by it grows from 0 to 90 degrees, while that of the table is least at 15 degrees"));
}

TEST(ClosedForms, ThreeAnglesLeaveR2NothingToTell) {
  EXPECT_THAT(eq1_line(planes_in_rock(50, 100, 20, {0, 45, 90})),
              AllOf(HasSubstr("R2 tells nothing"), Not(HasSubstr("R2 ="))));
}

TEST(ClosedForms, WhatEq1CannotHoldIsToldWithItsCause) {
  EXPECT_THAT(eq1_line(planes_in_rock(50, 100, 20, {0, 10, 90})),
              HasSubstr("none, no angle strictly between"));
  Rock rock = bedded();
  for (const double theta : {0.0, 30.0, 60.0, 90.0})
    rock.readings.push_back(reading(Property::E, theta, 40e9 - 2e8 * theta));
  EXPECT_THAT(eq1_line(Evidence(rock)),
              AllOf(HasSubstr("none, across its planes the rock is no softer than the reference E = "),
                    HasSubstr(" GPa, so no K_n follows"), Not(HasSubstr("type")), Not(HasSubstr("1/Pa"))));
}

TEST(ClosedForms, JaegerTellsThePlaneThatMadeTheTable) {
  // tan phi 0.4: 22 degrees, weakest at 45 + 11; 2 c (sqrt(1 + 0.16) + 0.4) = 44.3 MPa
  EXPECT_THAT(jaeger_line(weak_plane(15, 0.4, 100, {0, 15, 30, 45, 60, 75, 90})),
              AllOf(HasSubstr("c_w = 15 MPa"), HasSubstr("phi_w = 22 degrees"), HasSubstr("weakest at 56"),
                    HasSubstr("44.3 MPa"), HasSubstr("shoulders 100 MPa"), HasSubstr("R2 = 1.00"),
                    HasSubstr("misses 0 %"), Not(HasSubstr("no such plane"))));
}

TEST(ClosedForms, ARockThatIsWeakestBelow45IsNoPlane) {
  Rock rock = bedded();
  const double ucs[] = {57, 50, 42, 48, 52, 61, 67};
  for (int i = 0; i < 7; ++i) rock.readings.push_back(reading(Property::ucs, 15.0 * i, 1e6 * ucs[i]));
  EXPECT_THAT(jaeger_line(Evidence(rock)),
              AllOf(HasSubstr("none, the nearest plane has phi_w = 0 degrees, the end of its range"),
                    HasSubstr("weakest at 30 degrees, which no such plane is"), Not(HasSubstr("c_w"))));
}

TEST(ClosedForms, StrengthsThatAreAlikeShowNoPlane) {
  Rock rock = bedded();
  const double ucs[] = {100, 101, 99, 100, 102, 100, 101};
  for (int i = 0; i < 7; ++i) rock.readings.push_back(reading(Property::ucs, 15.0 * i, 1e6 * ucs[i]));
  EXPECT_THAT(jaeger_line(Evidence(rock)),
              AllOf(HasSubstr("no plane shows"), Not(HasSubstr("weakest at 30"))));
}

TEST(ClosedForms, WhatJaegerCannotHoldIsToldWithItsCause) {
  EXPECT_EQ(jaeger_line(weak_plane(15, 0.4, 100, {0, 45, 90})), "");  // three angles are no reason for a word
  EXPECT_THAT(jaeger_line(weak_plane(15, 0.4, 100, {0, 5, 10, 90})),
              HasSubstr("none, no specimen is weaker"));
}

TEST(ClosedForms, AnisotropyNamesTheAnglesOfBothEnds) {
  EXPECT_EQ(anisotropy_line(planes_in_rock(50, 50, 25, {0, 90})),
            "largest over least: E 2.00 (90 over 0 degrees)");
}

TEST(ClosedForms, NothingIsSaidOfLayersWhereThereAreNoneOrTooFewAngles) {
  EXPECT_THAT(closed_forms(planes_in_rock(50, 100, 20, {30})), IsEmpty());
  EXPECT_THAT(closed_forms(planes_in_rock(50, 100, 20, {0, 90})), SizeIs(1));  // the ratio
  Rock rock = bedded();
  rock.bedded = false;
  rock.readings = {reading(Property::E, 0.0, 40e9), reading(Property::ucs, 0.0, 100e6)};
  EXPECT_THAT(closed_forms(Evidence(rock)), IsEmpty());
}

}  // namespace
}  // namespace phy::calibrate
