// What lies ahead of a calibration, against what it then does.
#include "calibrate/outlook.hpp"

#include <gtest/gtest.h>

#include "calibrate/calibration.hpp"
#include "calibrate/plan.hpp"
#include "calibrate/strength_rocks_fixture.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

/// Planes, whose model nobody has to choose.
Evidence evidence_of(std::int64_t n_grains) {
  Rock rock;
  rock.layers = LayerModel::planes, rock.model.bedding.resize(1), rock.model.packing.n_grains = n_grains;
  return {rock, laboratory(truth(1), 1)};
}

TEST(Outlook, ACalibrationTakesTestsWithinWhatWasAhead) {
  for (const std::int64_t n_grains : {1197, 7481})
    for (const double scatter : {0.002, 0.2}) {
      const Evidence evidence = evidence_of(n_grains);
      const CalibrationOptions options;
      const Ahead ahead = outlook_of(evidence, options).ahead();
      PaperPress press;
      press.packing_scatter = scatter;
      const Calibration c = calibrate(evidence, options, press);
      EXPECT_LE(ahead.least_tests, c.counts.tests) << n_grains << " " << scatter;
      EXPECT_GE(ahead.most_tests, c.counts.tests) << n_grains << " " << scatter;
    }
}

// Strongest where every layered model is weakest: no search is long enough.
TEST(Outlook, ATableForecastOutOfReachGetsAShortSearchFirst) {
  const Evidence within = evidence_of(1197);
  std::vector<Target> table = within.targets;
  for (Target& t : table)
    if (t.property == Property::ucs && t.theta > 0.0 && t.theta < 90.0) t.mean *= 4.0, t.sd *= 4.0;
  const Evidence beyond(within.rock, table);
  CalibrationOptions options;
  options.effort = auto_effort;
  EXPECT_EQ(settled(options, within).effort.name, normal_effort.name);
  const Effort first = settled(options, beyond).effort;
  EXPECT_EQ(first.name, quick_effort.name);
  EXPECT_TRUE(first.foreseen);
  options.effort = normal_effort;  // asked for
  EXPECT_EQ(settled(options, beyond).effort.name, normal_effort.name);

  options.effort = auto_effort;
  PaperPress press;
  const Calibration c = calibrate(beyond, options, press);
  EXPECT_EQ(c.effort, "quick");
  EXPECT_GT(c.shortage.tests, 0);
}

TEST(Outlook, NoMoreTestsLieAheadThanAreAllowed) {
  CalibrationOptions options;
  options.max_tests = 200;
  EXPECT_LE(outlook_of(evidence_of(1197), options).ahead().most_tests, 200);
  EXPECT_GT(outlook_of(evidence_of(1197), {}).ahead().most_tests, 200);
}

TEST(Outlook, ModelsThatMayFollowCountInTheUpperEndAlone) {
  const Evidence evidence = evidence_of(1197);
  const Ahead one = outlook_of(evidence, 1, {}, {}).ahead(),
              three = outlook_of(evidence, 1, {evidence, evidence}, {}).ahead();
  EXPECT_EQ(one.least_tests + 7, three.least_tests) << "specimens are shown when the model is known";
  EXPECT_GT(three.most_cost, 2.0 * one.most_cost);
  EXPECT_EQ(outlook_of(evidence, 1, {evidence, evidence}, {}).first.most_cost, one.most_cost);
}

// Highest over lowest of tests and of cost, by one model: 1.3 to either side makes 3 of 1.8.
TEST(Outlook, OneModelIsForeseenWithinAFactorOfTwo) {
  for (const std::int64_t n_grains : {1197, 7481}) {
    const Ahead first = outlook_of(evidence_of(n_grains), {}).first;
    EXPECT_LT(first.most_cost, 2.0 * first.least_cost) << n_grains;
    EXPECT_LT(static_cast<double>(first.most_tests), 2.0 * static_cast<double>(first.least_tests))
        << n_grains;
  }
}

TEST(Outlook, ModuliAloneTakeNoTest) {
  CalibrationOptions options;
  options.elastic_only = true;
  Evidence evidence = evidence_of(1197);
  evidence.rock.readings = {reading(Property::E, 0.0, 20e9), reading(Property::E, 90.0, 40e9)};
  const Ahead ahead = outlook_of(Evidence(evidence.rock), options).ahead();
  EXPECT_EQ(ahead.most_tests, 0);
  EXPECT_GT(ahead.least_cost, 0.0);
}

}  // namespace
}  // namespace phy::calibrate
