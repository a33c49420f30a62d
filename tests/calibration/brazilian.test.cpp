// Brazilian strengths as targets, with the press itself on small packings: a ratio to UCS that bonded discs
// do not reach is answered with the nearest one. A twin that must be accepted: tests/soak/brazilian.test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "records/reading_fixture.hpp"
#include "twin_trial.hpp"

namespace phy {
namespace {

TEST(BrazilianTargets, FifteenTimesWeakerInTensionIsOutOfReachOfAnIsotropicRock) {
  const auto simulator = calibrate::make_simulator(
      {static_cast<int>(std::max(1U, std::thread::hardware_concurrency())), "", nullptr, nullptr});
  Rock rock;
  rock.bedded = false, rock.model = magnified_model(4.0), rock.model.bedding.clear();
  rock.readings = {reading(Property::E, 0.0, 40e9), reading(Property::ucs, 0.0, 150e6),
                   reading(Property::brazilian, 0.0, 10e6)};
  calibrate::CalibrationOptions options;
  options.max_tests = 25;
  const Calibration c = calibrate::calibrate(Evidence(rock), options, *simulator);
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
  const Finding* ratio = first_of(c.verdict.findings, FindingKind::ratio_missed);
  ASSERT_NE(ratio, nullptr);
  EXPECT_NEAR(ratio->number("laboratory"), 15.0, 1e-9);
  double ucs = 0.0, bts = 0.0;
  for (const Comparison& row : c.verification) {
    if (row.target.property == Property::ucs) ucs = row.mean;
    if (row.target.property == Property::brazilian) bts = row.mean;
  }
  // docs/theory/reach.md
  EXPECT_GT(ucs / bts, 2.5);
  EXPECT_LT(ucs / bts, 11.0);
}

}  // namespace
}  // namespace phy
