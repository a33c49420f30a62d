// Does the range contain the end? Courses of events are drawn from the outlook of real tables: which stages
// come, how long each takes, and whether other models follow is chance.
#include "jobs/time_left.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "records/reading_fixture.hpp"

namespace phy::jobs {
namespace {

using calibrate::Outlook;
using calibrate::PlannedStage;

constexpr double true_speed = 2e-8;  // [s per cost]

/// Seven angles of E, nu and UCS on small specimens.
Evidence layered() {
  Rock rock;
  rock.layers = LayerModel::planes, rock.bedded = true, rock.model.bedding.resize(1);
  rock.model.packing.n_grains = 1197;
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    rock.readings.push_back(reading(Property::E, theta, 20e9 + 2e8 * theta));
    rock.readings.push_back(reading(Property::nu, theta, 0.25));
    rock.readings.push_back(reading(Property::ucs, theta, 50e6 + 1e5 * theta));
  }
  return Evidence(rock);
}

/// A calibration as it may go: what is shown at its moments, and whether it held the end.
class DrawnCalibration {
 public:
  DrawnCalibration(unsigned seed, double first_speed) : random_(seed), clock_(first_speed) {}

  double share_inside(const Evidence& evidence, int most_models) {
    const calibrate::CalibrationOptions options;
    for (int m = 1; m <= most_models; ++m) {
      const std::vector<Evidence> rivals(static_cast<std::size_t>(most_models - m), evidence);
      run(calibrate::outlook_of(evidence, m, rivals, options));
      if (chance() < 0.5) break;  // within reach
    }
    std::size_t inside = 0;
    for (const auto& [at, left] : shown_) inside += left.low <= now_ - at && now_ - at <= left.high ? 1 : 0;
    return static_cast<double>(inside) / static_cast<double>(shown_.size());
  }

 private:
  std::mt19937 random_;
  TimeLeft clock_;
  double now_ = 0.0;
  std::vector<std::pair<double, SecondsRange>> shown_;

  double chance() { return static_cast<double>(random_()) / 4294967296.0; }
  void show() { shown_.emplace_back(now_, clock_.at(now_).value()); }

  void run(const Outlook& outlook) {
    clock_.outlook(outlook, now_), show();
    for (const PlannedStage& s : outlook.stages)
      if (s.certain || chance() < 0.4) run(s);
  }
  /// Takes from 0.6 to 1.6 times as long as its cost says.
  void run(const PlannedStage& s) {
    clock_.begins(s.kind, now_), show();
    const double whole = true_speed * s.cost * std::pow(1.6 / 0.6, chance()) * 0.6, begin = now_;
    for (int k = 1; k <= 10; ++k) {
      now_ = begin + whole * k / 10.0;
      const auto n = static_cast<std::size_t>(s.tests), done = n * static_cast<std::size_t>(k) / 10;
      if (n > 0) clock_.tests({done, n, done, whole * (1.0 - k / 10.0)});
      show();
    }
  }
};

TEST(TimeLeft, TheRangeContainsTheEnd) {
  const Evidence evidence = layered();
  // the speed measured beforehand is off by up to a factor of two
  for (const double off : {0.5, 1.0, 2.0}) {
    double inside = 0.0;
    constexpr unsigned n = 40;
    for (unsigned seed = 1; seed <= n; ++seed)
      inside += DrawnCalibration(seed, true_speed * off).share_inside(evidence, seed % 3 == 0 ? 3 : 1);
    EXPECT_GE(inside / n, 0.95) << off;
  }
}

TEST(TimeLeft, ALongerCalibrationThanForeseenIsOutside) {
  EXPECT_LT(DrawnCalibration(1, 0.01 * true_speed).share_inside(layered(), 1), 0.95);
}

TEST(TimeLeft, TestsFromAStoreSayNothingOfTheSpeed) {
  const Outlook outlook = calibrate::outlook_of(layered(), 1, {}, {});
  const auto left = [&](std::size_t n_new) {
    TimeLeft clock(true_speed);
    clock.outlook(outlook, 0.0);
    clock.begins(FindingKind::course_batch, 1.0);
    clock.tests({70, 70, n_new, 0.0});
    clock.begins(FindingKind::course_batch, 1.001);
    return clock.at(1.001)->high;
  };
  EXPECT_GT(left(0), 5.0 * left(70));
}

TEST(TimeLeft, StagesAndModelsAreCounted) {
  const Evidence evidence = layered();
  const Outlook outlook = calibrate::outlook_of(evidence, 1, {evidence, evidence}, {});
  TimeLeft clock(true_speed);
  clock.outlook(outlook, 0.0);
  clock.begins(FindingKind::course_moduli, 0.0);
  clock.begins(FindingKind::course_moduli_packings, 1.0);
  const TimeLeft::Place place = clock.place();
  EXPECT_EQ(place.model, 1);
  EXPECT_EQ(place.models, 3);
  EXPECT_EQ(place.stage, 2U);
  EXPECT_LT(place.least, place.most);
  clock.begins(FindingKind::course_batch, 2.0);
  EXPECT_FALSE(clock.begins(FindingKind::course_moduli_packings, 2.5)) << "fitted again, within the batch";
  EXPECT_EQ(clock.place().stage, 3U);
}

TEST(TimeLeft, OneStageIsNotCounted) {
  Outlook one;
  one.stages = {{FindingKind::course_moduli, true, 1e9}, {FindingKind::course_moduli_unseen, true, 1e9}};
  TimeLeft two(true_speed), single(true_speed);
  two.outlook(one, 0.0), two.begins(FindingKind::course_moduli, 0.0);
  one.stages.pop_back();
  single.outlook(one, 0.0), single.begins(FindingKind::course_moduli, 0.0);
  EXPECT_NE(two.text(0.0).find("stage 1 of 2"), std::string::npos) << two.text(0.0);
  EXPECT_EQ(single.place().most, 1U);
  EXPECT_EQ(single.text(0.0).find("stage"), std::string::npos) << single.text(0.0);
}

}  // namespace
}  // namespace phy::jobs
