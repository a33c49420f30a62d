// What the check of a table says as a whole.
#include "jobs/rock_check.hpp"

#include <gtest/gtest.h>

#include "records/reading_fixture.hpp"

namespace phy::jobs {
namespace {

/// UCS of planes at four angles, and a shear strength of these under 30 MPa.
Rock sheared(double tau) {
  Rock rock;
  rock.bedded = true, rock.layers = LayerModel::planes, rock.model.bedding.resize(1);
  int line = 1;
  for (const auto& [theta, ucs] : {std::pair(0.0, 100e6), {30.0, 80e6}, {60.0, 50e6}, {90.0, 120e6}}) {
    rock.readings.push_back(reading(Property::ucs, theta, ucs));
    rock.readings.back().line = ++line;
  }
  RockReading shear = reading(Property::shear_peak, 0.0, tau);
  shear.confining = 30e6, shear.line = ++line;
  rock.readings.push_back(shear);
  return rock;
}

// At 60 degrees UCS of 50 MPa shears the bedding with 21.7 MPa under 12.5 MPa.
TEST(RockCheck, TheForecastKnowsWhatContradictsItself) {
  const RockCheck sound = check(sheared(30e6)), contradicted = check(sheared(2e6));
  ASSERT_FALSE(sound.forecast.empty());
  EXPECT_EQ(first_of(sound.doubts, FindingKind::unusual_shear), nullptr);
  EXPECT_TRUE(sound.forecast.front().cells.empty());
  const Finding& end = contradicted.forecast.front();
  ASSERT_NE(sound.forecast.front().kind, FindingKind::forecast_out_of_reach);
  EXPECT_EQ(end.kind, FindingKind::forecast_excepted);
  EXPECT_EQ(end.cells.size(), 2U) << "the shear test and the UCS against it";
}

}  // namespace
}  // namespace phy::jobs
