#include "report/opening_figures.hpp"

#include <gtest/gtest.h>

#include "base/check.hpp"
#include "report/figures.hpp"

namespace phy::report {
namespace {

/// An opening that stood, and collapsed later: 36 sectors at either moment.
RunRecord excavated() {
  RunRecord run;
  SpecimenRecord& t = run.tests.emplace_back();
  t.recipe.test.kind = TestKind("opening");
  t.recipe.test.vertical_stress = 20e6;
  for (const WallMoment moment : all_wall_moments)
    for (int k = 0; k < 36; ++k)
      t.result.wall.push_back(
          {moment, 10.0 * k, 20e6, 30e6, 5e6, 0.0, 1e-5, moment == WallMoment::end && k == 0 ? 0.002 : 0.0});
  HistoryRow& row = t.result.history.rows.emplace_back();
  row.closure = 0.01, row.borne_stress = 20e6;
  t.result.numbers = {{"hole_diameter", 0.02, "m", "", ""}, {"hoop_distance", 0.01, "m", "", ""}};
  return run;
}

TEST(OpeningFigures, ShowStressOverClosureAndTheRockAround) {
  const Figure f = opening_figure(excavated());
  ASSERT_EQ(f.panels.size(), 3U);
  EXPECT_EQ(f.panels[0].series[0].points[0].x, 1.0) << "per cent of the radius";
  EXPECT_EQ(f.panels[0].series[0].points[0].y, 20.0);
  const Panel& hoop = f.panels[1];
  EXPECT_EQ(hoop.series[0].points.size(), 36U);
  EXPECT_EQ(hoop.series[0].points[7].y, 30.0);
  // Kirsch at twice the radius under equal stresses: 1 + 1/4.
  EXPECT_NEAR(hoop.series[1].points[3].y, 25.0, 1e-9);
  const Panel& breakout = f.panels[2];
  EXPECT_EQ(breakout.series[0].points[0].y, 0.0);
  EXPECT_EQ(breakout.series[1].points[0].y, 2.0) << "mm";
}

// An untrusted test has no numbers for a reader, but its opening is where it is; without a number there is no
// line.
TEST(OpeningFigures, OfAnUntrustedTestAreDrawn) {
  RunRecord run = excavated();
  run.tests[0].result.outcome.status = Status::untrusted;
  EXPECT_EQ(opening_figure(run).panels[1].series.size(), 2U);
  run.tests[0].result.numbers.clear();
  EXPECT_EQ(opening_figure(run).panels[1].series.size(), 1U);
}

TEST(OpeningFigures, OfOtherTestsAreRefused) {
  EXPECT_TRUE(opening_figure({}).panels.empty());
  FigureData data;
  EXPECT_THROW(figure_kind("opening").make(data), InputError);
}

// One that was never excavated is an opening all the same: its own end says why there is nothing to draw.
TEST(OpeningFigures, WithoutAnExcavationSayWhatEndedTheTest) {
  FigureData data;
  data.run = excavated();
  SpecimenRecord& t = data.run.tests[0];
  t.result.wall.clear();
  t.result.outcome = {Status::not_peaked, "strain 5.0 % before the far-field stress was reached", "lower it"};
  try {
    figure_kind("opening").make(data);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("before the far-field stress was reached; lower it"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace phy::report
