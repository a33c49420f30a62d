// What closed forms say of tables that were made by them, and of tables that they cannot hold.
#include "survey/closed_forms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "records/reading_fixture.hpp"

namespace phy::survey {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = FindingKind;

std::vector<Kind> kinds(const std::vector<Finding>& found) {
  std::vector<Kind> list;
  for (const Finding& f : found) list.push_back(f.kind);
  return list;
}

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

TEST(ClosedForms, Eq1FindsThePlanesThatMadeTheTableAndTheirType) {
  const auto found = eq1_through_moduli(planes_in_rock(50, 100, 20, {0, 15, 30, 45, 60, 75, 90}));
  ASSERT_THAT(kinds(found), ElementsAre(Kind::eq1_shoulder));
  EXPECT_NEAR(found[0].number("E"), 50e9, 1e6);
  EXPECT_NEAR(found[0].number("K_n_delta"), 100e9, 1e7);
  EXPECT_NEAR(found[0].number("K_s_delta"), 20e9, 1e6);
  EXPECT_NEAR(found[0].number("R2"), 1.0, 1e-6);
  EXPECT_EQ(found[0].number("spacing"), 4e-3);
  EXPECT_NEAR(found[0].number("theta"), std::acos(std::sqrt(100.0 / 160.0)) / degree, 0.1);  // 38 degrees
  EXPECT_THAT(kinds(eq1_through_moduli(planes_in_rock(50, 30, 20, {0, 30, 60, 90}))),
              ElementsAre(Kind::eq1_incremental));
}

TEST(ClosedForms, Eq1ThatGrowsDoesNotSpeakForATableThatDips) {
  Rock rock = bedded();
  const std::vector<double> E = {38.40, 37.32, 38.81, 41.65, 45.77, 49.97, 53.38};  // GPa, the augen gneiss
  for (std::size_t i = 0; i < E.size(); ++i)
    rock.readings.push_back(reading(Property::E, 15.0 * static_cast<double>(i), 1e9 * E[i]));
  const auto found = eq1_through_moduli(Evidence(rock));
  ASSERT_THAT(kinds(found), ElementsAre(Kind::eq1_incremental, Kind::table_dips));
  EXPECT_THAT(found[1].cells, ElementsAre(Cell{Property::E, 15.0}));
}

TEST(ClosedForms, ThreeAnglesLeaveNoR2) {
  const auto found = eq1_through_moduli(planes_in_rock(50, 100, 20, {0, 45, 90}));
  ASSERT_THAT(kinds(found), ElementsAre(Kind::eq1_shoulder));
  EXPECT_FALSE(found[0].has("R2") || found[0].has("se_E"));
}

TEST(ClosedForms, WhatEq1CannotHoldHasItsCause) {
  const auto none = eq1_through_moduli(planes_in_rock(50, 100, 20, {0, 10, 90}));
  ASSERT_THAT(kinds(none), ElementsAre(Kind::eq1_none));
  EXPECT_FALSE(none[0].names.at(0).empty());
  Rock rock = bedded();
  for (const double theta : {0.0, 30.0, 60.0, 90.0})
    rock.readings.push_back(reading(Property::E, theta, 40e9 - 2e8 * theta));
  const auto falls = eq1_through_moduli(Evidence(rock));
  ASSERT_THAT(kinds(falls), ElementsAre(Kind::eq1_none));
  EXPECT_NE(falls[0].names.at(0), none[0].names.at(0));
}

TEST(ClosedForms, JaegerFindsThePlaneThatMadeTheTable) {
  // tan phi 0.4: 22 degrees, weakest at 45 + 11; 2 c (sqrt(1 + 0.16) + 0.4) = 44.3 MPa
  const auto found = plane_through_strengths(weak_plane(15, 0.4, 100, {0, 15, 30, 45, 60, 75, 90}));
  ASSERT_THAT(kinds(found), ElementsAre(Kind::jaeger_plane));
  const Finding& f = found[0];
  EXPECT_NEAR(f.number("c_w"), 15e6, 0.1e6);
  EXPECT_NEAR(f.number("phi_w"), std::atan(0.4) / degree, 0.3);
  EXPECT_NEAR(f.number("theta"), 45.0 + 0.5 * std::atan(0.4) / degree, 0.2);
  EXPECT_NEAR(f.number("least"), 44.3e6, 0.1e6);
  EXPECT_NEAR(f.number("shoulders"), 100e6, 0.1e6);
  EXPECT_GT(f.number("R2"), 0.995);
  EXPECT_LT(f.number("rms"), 0.005);
}

TEST(ClosedForms, ARockThatIsWeakestBelow45IsNoPlane) {
  Rock rock = bedded();
  const double ucs[] = {57, 50, 42, 48, 52, 61, 67};
  for (int i = 0; i < 7; ++i) rock.readings.push_back(reading(Property::ucs, 15.0 * i, 1e6 * ucs[i]));
  const auto found = plane_through_strengths(Evidence(rock));
  ASSERT_THAT(kinds(found), ElementsAre(Kind::jaeger_none, Kind::weakest_off_plane));
  EXPECT_THAT(found[1].cells, ElementsAre(Cell{Property::ucs, 30.0}));
}

TEST(ClosedForms, StrengthsThatAreAlikeShowNoPlane) {
  Rock rock = bedded();
  const double ucs[] = {100, 101, 99, 100, 102, 100, 101};
  for (int i = 0; i < 7; ++i) rock.readings.push_back(reading(Property::ucs, 15.0 * i, 1e6 * ucs[i]));
  const auto found = plane_through_strengths(Evidence(rock));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].kind, Kind::no_plane_shows);
  EXPECT_LT(found[1].number("R2"), 0.3);
}

TEST(ClosedForms, WhatJaegerCannotHoldHasItsCause) {
  EXPECT_THAT(plane_through_strengths(weak_plane(15, 0.4, 100, {0, 45, 90})), IsEmpty());  // three angles
  EXPECT_THAT(kinds(plane_through_strengths(weak_plane(15, 0.4, 100, {0, 5, 10, 90}))),
              ElementsAre(Kind::jaeger_none));
}

TEST(ClosedForms, AnisotropyNamesTheAnglesOfBothEnds) {
  const auto found = anisotropy(planes_in_rock(50, 50, 25, {0, 90}));
  ASSERT_THAT(kinds(found), ElementsAre(Kind::anisotropy));
  EXPECT_THAT(found[0].cells, ElementsAre(Cell{Property::E, 90.0}, Cell{Property::E, 0.0}));
  EXPECT_NEAR(found[0].number("ratio"), 2.0, 1e-9);
}

TEST(ClosedForms, NothingIsSaidOfLayersWhereThereAreNoneOrTooFewAngles) {
  EXPECT_THAT(closed_forms(planes_in_rock(50, 100, 20, {30})), IsEmpty());
  EXPECT_THAT(kinds(closed_forms(planes_in_rock(50, 100, 20, {0, 90}))), ElementsAre(Kind::anisotropy));
  Rock rock = bedded();
  rock.bedded = false;
  rock.readings = {reading(Property::E, 0.0, 40e9), reading(Property::ucs, 0.0, 100e6)};
  EXPECT_THAT(closed_forms(Evidence(rock)), IsEmpty());
}

}  // namespace
}  // namespace phy::survey
