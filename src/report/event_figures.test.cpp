#include "report/event_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "events/b_value.hpp"
#include "report/figures.hpp"
#include "report/specimen_picture.hpp"

namespace phy::report {
namespace {

/// One event per 0.001 of strain, each tenth of them an implosion.
RunRecord heard(int n) {
  RunRecord run;
  SpecimenRecord& t = run.tests.emplace_back();
  for (int i = 0; i < n; ++i) {
    AcousticEvent& e = t.result.events.emplace_back();
    e.strain = 1e-3 * (i + 1), e.magnitude = -7.0 - 0.01 * i, e.position = {0.004, 0.02};
    e.thickness = 1e-3;
    e.type = i % 10 == 0 ? SourceType::implosion : SourceType::opening;
  }
  t.result.numbers = events::event_numbers(t.result.events, 1e-3);
  t.result.numbers.push_back({"peak_strain", 1e-3 * n, "1", "", ""});
  return run;
}

TEST(EventFigures, CountEventsFromTheLargestOn) {
  const Figure f = events_figure(heard(100), {});
  ASSERT_EQ(f.panels.size(), 1U);
  const Panel& p = f.panels[0];
  EXPECT_TRUE(p.y.logarithmic);
  EXPECT_EQ(p.x.low, -8.0);
  EXPECT_EQ(p.series[0].points.size(), 100U);
  EXPECT_EQ(p.series[0].points[0].x, -7.0);
  EXPECT_EQ(p.series[0].points[0].y, 1.0);
  EXPECT_EQ(p.series[0].points[99].y, 100.0);
  ASSERT_EQ(p.series.size(), 2U) << "with the line of b";
  // The line begins at the completeness with all from there on, and loses a decade per 1/b.
  const std::vector<Point>& line = p.series[1].points;
  EXPECT_NEAR(std::log10(line[0].y / line[1].y) / (line[1].x - line[0].x),
              heard(100).tests[0].result.numbers[6].value, 1e-9);
  EXPECT_EQ(events_figure(heard(5), {}).panels[0].series.size(), 1U) << "too few for b";
}

TEST(EventFigures, CirclesAreBySourceAndTheLargestIsATenthOfTheWidth) {
  const RunRecord run = heard(100);
  const Figure f = event_places_figure(run);
  ASSERT_EQ(f.panels.size(), 1U);
  const std::vector<Series>& s = f.panels[0].series;
  ASSERT_EQ(s.size(), 4U) << "the outline, and three sources";
  EXPECT_EQ(s[1].points.size(), 10U * 18U);
  EXPECT_TRUE(s[2].points.empty());
  EXPECT_EQ(s[3].points.size(), 90U * 18U);
  EXPECT_TRUE(std::isnan(s[1].points[17].y)) << "parts a circle from the next";
  EXPECT_DOUBLE_EQ(event_radius(run.tests[0].result.events[0], -7.0, 0.04), 0.002);
}

TEST(EventFigures, OfAnUntrustedTestKeepPlacesAndThickness) {
  RunRecord run = heard(100);
  run.tests[0].result.outcome.status = Status::untrusted;
  const Panel p = events_figure(run, {}).panels.at(0);
  EXPECT_EQ(p.series.size(), 1U) << "without b";
  EXPECT_EQ(p.caption.find("nan"), std::string::npos) << p.caption;
  const std::vector<Series> s = event_places_figure(run).panels.at(0).series;
  EXPECT_TRUE(std::isfinite(s.at(1).points.at(0).x));
  EXPECT_TRUE(std::isfinite(s.at(1).points.at(0).y));
}

TEST(EventFigures, CountsOfALaboratoryStandBeside) {
  LaboratoryCounts laboratory;
  for (const double part : {0.0, 0.5, 1.0}) {
    HistoryRow& row = laboratory.curve.rows.emplace_back();
    row.axial_strain = 0.01 * part, row.axial_stress = part, row.n_cracks = 8.0 * part;
  }
  const Figure f = events_figure(heard(100), laboratory);
  ASSERT_EQ(f.panels.size(), 2U);
  for (const Series& s : f.panels[1].series) EXPECT_NEAR(s.points[50].y, 50.0, 1e-9) << s.name;
}

TEST(EventFigures, WithoutEventsThereIsNothingToDraw) {
  RunRecord deaf = heard(1);
  deaf.tests[0].result.events.clear();
  EXPECT_TRUE(events_figure(deaf, {}).panels.empty());
  EXPECT_TRUE(event_places_figure(deaf).panels.empty());
  FigureData data;
  data.run = deaf;
  for (const char* kind : {"events", "event_places"})
    EXPECT_THROW(figure_kind(kind).make(data), InputError) << kind;
}

}  // namespace
}  // namespace phy::report
