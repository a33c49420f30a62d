// What can be seen of a calibration while it runs: a file in its folder, rewritten once a second, for pages
// and scripts that follow it (docs/formats.md, "Calibration"). It says how far the tests have come and what
// is known of the parameters after every batch. Beside it lies the specimen in the press (press_watch.hpp).
#pragma once
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.hpp"
#include "jobs/press_watch.hpp"
#include "jobs/time_left.hpp"

namespace phy::jobs {

/// Its name. Like the list of written files it belongs to the program, and to no result.
constexpr const char* watch_file = ".progress.json";

/// All may be called from any thread. A file that cannot be written is no failure: nobody will see it.
class CalibrationWatch {
 public:
  /// `folder` is there. Writes at once.
  explicit CalibrationWatch(const std::string& folder);
  /// Without an end the calibration has "failed".
  ~CalibrationWatch();
  CalibrationWatch(const CalibrationWatch&) = delete;
  CalibrationWatch& operator=(const CalibrationWatch&) = delete;
  /// A stage: its words, where it is among the others, how long the calibration goes on.
  void begins(const std::string& stage, const TimeLeft::Place& place,
              const std::optional<SecondsRange>& left);
  void tests(const calibrate::TestProgress& progress, const TimeLeft::Place& place,
             const std::optional<SecondsRange>& left);
  /// None: those of before are another model's.
  void estimates(const std::vector<ParameterEstimate>& parameters);
  void reading(const RunningTest& now) { press_.reading(now); }
  /// The last that is written: "finished", or "stopped" by the user.
  void end(const std::string& state);

 private:
  using Clock = std::chrono::steady_clock;
  struct Step {
    double value, low, high;
  };
  struct Known {
    std::string key, symbol, unit;
    double box_low, box_high;
    std::vector<Step> steps;
  };
  std::string file_;
  std::mutex mutex_;
  std::string state_ = "running";
  std::vector<std::string> said_;
  std::vector<Known> known_;  // in the order of their first estimate
  calibrate::TestProgress tests_;
  TimeLeft::Place place_;
  std::optional<SecondsRange> left_;
  PressWatch press_;
  Clock::time_point start_, written_;

  std::string text() const;
  void write_now();
  void write_soon();
  void end_stage();
};

}  // namespace phy::jobs
