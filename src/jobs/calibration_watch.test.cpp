#include "jobs/calibration_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/in_folder_fixture.hpp"

namespace phy::jobs {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;

class CalibrationWatchTest : public InFolder {
 protected:
  Json now() const { return Json::parse(read(at(watch_file))); }
};

ParameterEstimate estimate(const char* symbol, double value) {
  ParameterEstimate e;
  e.key = e.symbol = symbol, e.unit = "Pa";
  e.value = value, e.low = 0.5 * value, e.high = 2.0 * value, e.box_low = 1.0, e.box_high = 1000.0;
  return e;
}

TEST_F(CalibrationWatchTest, SaysWhatIsKnownAfterEveryBatch) {
  CalibrationWatch watch(folder.string());
  EXPECT_EQ(now()["state"], "running");
  watch.begins("strength, batch 1 of 2", {}, {});
  watch.estimates({estimate("sigma_c", 10.0), estimate("mu", 0.5)});
  watch.begins("strength, batch 2 of 2", {}, {});
  watch.estimates({estimate("sigma_c", 12.0)});
  const Json reported = now();
  EXPECT_EQ(reported["stage"], "strength, batch 2 of 2");
  EXPECT_THAT(reported["said"], ElementsAre("strength, batch 1 of 2", "strength, batch 2 of 2"));
  ASSERT_EQ(reported["parameters"].size(), 2U);
  EXPECT_EQ(reported["parameters"][0]["steps"].size(), 2U);
  EXPECT_EQ(reported["parameters"][0]["steps"][1]["value"], 12.0);
  EXPECT_THAT(reported["parameters"][0]["box"], ElementsAre(1.0, 1000.0));
  EXPECT_EQ(reported["parameters"][1]["steps"].size(), 1U);
  watch.end("finished");
  EXPECT_EQ(now()["state"], "finished");
}

TEST_F(CalibrationWatchTest, WithoutAnEndItHasFailed) {
  { const CalibrationWatch watch(folder.string()); }
  EXPECT_EQ(now()["state"], "failed");
  {
    CalibrationWatch watch(folder.string());
    watch.end("stopped");
  }
  EXPECT_EQ(now()["state"], "stopped");
}

TEST_F(CalibrationWatchTest, AFolderThatIsGoneStopsNothing) {
  CalibrationWatch watch(at("sub"));
  std::filesystem::remove_all(at("sub"));
  write("sub", "a file in its place");
  EXPECT_NO_THROW(watch.begins("goes on", {}, {}));
}

}  // namespace
}  // namespace phy::jobs
