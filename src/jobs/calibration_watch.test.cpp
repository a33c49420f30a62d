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
  EXPECT_TRUE(now()["pressed"].is_null());
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

TEST_F(CalibrationWatchTest, FollowsOneSpecimenFromItsBeginning) {
  CalibrationWatch watch(folder.string());
  Recipe first, second;
  first.test.angles = {30.0}, second.test.angles = {60.0};
  for (int i = 1; i <= 5; ++i) {
    watch.reading(first, 0.001 * i, 1e6 * i);
    watch.reading(second, 0.002 * i, 2e6 * i);  // not this one
  }
  watch.reading(first, 0.0005, 5e5);  // starts over
  watch.estimates({});                // writes
  const Json pressed = now()["pressed"];
  EXPECT_EQ(pressed["specimen"], "theta = 30 deg");
  EXPECT_THAT(pressed["strain"], ElementsAre(0.0005));
}

TEST_F(CalibrationWatchTest, TheNextSpecimenIsShownFromItsBeginning) {
  CalibrationWatch watch(folder.string(), std::chrono::seconds(0));  // who has just been silent is over
  Recipe first, second;
  first.test.angles = {30.0}, second.test.angles = {60.0};
  for (int i = 1; i <= 4; ++i)
    watch.reading(first, 0.001 * i, 1e6 * i), watch.reading(second, 0.002 * i, 1e6);
  watch.estimates({});  // writes
  EXPECT_EQ(now()["pressed"]["specimen"], "theta = 60 deg");
  EXPECT_THAT(now()["pressed"]["strain"], ElementsAre(0.002, 0.004, 0.006, 0.008));
}

TEST_F(CalibrationWatchTest, ATestThatRunsThroughAMessageKeepsItsBeginning) {
  CalibrationWatch watch(folder.string());
  const Recipe test;
  watch.reading(test, 1e-3, 1e6);
  watch.begins("the next batch", {}, {});
  EXPECT_TRUE(now()["pressed"].is_null());
  watch.reading(test, 2e-3, 2e6);
  watch.estimates({});
  EXPECT_THAT(now()["pressed"]["strain"], ElementsAre(1e-3, 2e-3));
}

TEST_F(CalibrationWatchTest, ALongCurveKeepsItsEnds) {
  CalibrationWatch watch(folder.string());
  const Recipe test;
  for (int i = 0; i < 5000; ++i) watch.reading(test, 1e-6 * i, 1.0 * i);
  watch.estimates({});
  const auto strain = now()["pressed"]["strain"].get<std::vector<double>>();
  EXPECT_LE(strain.size(), 401U);
  EXPECT_GE(strain.size(), 200U);
  EXPECT_EQ(strain.front(), 0.0);
  EXPECT_GT(strain.back(), 0.00496);
  EXPECT_TRUE(std::is_sorted(strain.begin(), strain.end()));
}

TEST_F(CalibrationWatchTest, BetweenBatchesNothingIsPressed) {
  CalibrationWatch watch(folder.string());
  const Recipe test;
  watch.reading(test, 1e-3, 1e6);
  watch.begins("elastic search", {}, {});
  EXPECT_TRUE(now()["pressed"].is_null());
}

TEST_F(CalibrationWatchTest, AFolderThatIsGoneStopsNothing) {
  CalibrationWatch watch(at("sub"));
  std::filesystem::remove_all(at("sub"));
  write("sub", "a file in its place");
  EXPECT_NO_THROW(watch.begins("goes on", {}, {}));
}

}  // namespace
}  // namespace phy::jobs
