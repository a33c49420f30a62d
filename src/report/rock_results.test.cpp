#include "report/rock_results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "records/test_description.hpp"

namespace phy::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

SpecimenRecord tested(const char* kind, double theta, const char* number, double value) {
  SpecimenRecord s;
  s.recipe.test.kind = TestKind(kind);
  s.result.theta = theta, s.result.intact = false;
  s.result.outcome.status = Status::peaked;
  s.result.numbers = {{number, value, "Pa", "", ""}};
  s.result.history.rows.resize(2);
  s.result.history.rows[1].axial_strain = 1e-3, s.result.history.rows[1].axial_stress = value;
  return s;
}

SpecimenRecord confined(double theta, double stress, double value) {
  SpecimenRecord s = tested("biaxial", theta, "sigma_1", value);
  s.recipe.test.confining_stress = stress;
  return s;
}

std::vector<Target> table() {
  return {{.property = Property::ucs, .theta = 0.0, .mean = 60e6, .sd = 3e6, .n = 3},
          {.property = Property::ucs, .theta = 45.0, .mean = 40e6, .sd = 3e6, .n = 3}};
}

std::vector<std::string> names(const Panel& panel) {
  std::vector<std::string> all;
  for (const Series& s : panel.series)
    if (!s.name.empty() && !s.points.empty() && std::ranges::find(all, s.name) == all.end())
      all.push_back(s.name);
  return all;
}

const Series& named(const Panel& panel, const std::string& name) {
  return *std::ranges::find_if(panel.series, [&](const Series& s) { return s.name == name; });
}

TEST(RockResults, ATestStandsInThePanelOfItsProperty) {
  const auto made = rock_results({}, table(), {{"press", {{tested("uniaxial", 45.0, "ucs", 44e6)}, {}}}});
  ASSERT_THAT(made.over_theta.panels, SizeIs(1));
  const Series& press = named(made.over_theta.panels[0], "press");
  ASSERT_THAT(press.points, SizeIs(1));
  EXPECT_EQ(press.points[0].x, 45.0);
  EXPECT_DOUBLE_EQ(press.points[0].y, 44.0);
  ASSERT_THAT(made.curves.panels, SizeIs(1));
  EXPECT_THAT(names(made.curves.panels[0]), ElementsAre("press"));
}

TEST(RockResults, WhatNoTableHasGetsAPanelOfItsOwn) {
  const auto made = rock_results({}, table(), {{"ten", {{confined(45.0, 10e6, 80e6)}, {}}}});
  ASSERT_THAT(made.over_theta.panels, SizeIs(2));
  EXPECT_EQ(made.over_theta.panels[1].title, "10 MPa");
  EXPECT_THAT(names(made.over_theta.panels[1]), ElementsAre("ten"));
}

TEST(RockResults, SigmaOneNeedsTwoComputedStresses) {
  const NamedRun ten{"ten", {{confined(45.0, 10e6, 80e6)}, {}}},
      press{"press", {{tested("uniaxial", 45.0, "ucs", 44e6)}, {}}};
  EXPECT_THAT(rock_results({}, table(), {ten}).over_sigma_3.panels, IsEmpty());
  const auto made = rock_results({}, table(), {ten, press});
  ASSERT_THAT(made.over_sigma_3.panels, SizeIs(1));
  const Series& model = named(made.over_sigma_3.panels[0], "model, θ = 45°");
  ASSERT_THAT(model.points, SizeIs(2));
  EXPECT_DOUBLE_EQ(model.points[0].x, 10.0);
  EXPECT_DOUBLE_EQ(model.points[1].y, 44.0);
}

TEST(RockResults, NothingComputedIsNothingDrawn) {
  SpecimenRecord failed = tested("uniaxial", 45.0, "ucs", nan);
  failed.result.outcome.status = Status::not_peaked;
  const auto made = rock_results({}, {}, {{"press", {{failed}, {}}}});
  EXPECT_THAT(made.over_theta.panels, IsEmpty());
  EXPECT_THAT(made.over_sigma_3.panels, IsEmpty());
  EXPECT_THAT(rock_results({}, {}, {}).curves.panels, IsEmpty());
}

}  // namespace
}  // namespace phy::report
