// What can be seen of a calibration while it runs: a file in its folder, rewritten once a second, for pages
// and scripts that follow it (docs/formats.md, "Calibration"). It says how far the tests have come, what is
// known of the parameters after every batch, and how the specimen does that is in the press.
#pragma once
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.hpp"
#include "jobs/time_left.hpp"

namespace phy::jobs {

/// Its name. Like the list of written files it belongs to the program, and to no result.
constexpr const char* watch_file = ".progress.json";

/// All may be called from any thread. A file that cannot be written is no failure: nobody will see it.
class CalibrationWatch {
 public:
  /// `folder` is there. Writes at once. A test that has not been heard of for `patience` is over.
  explicit CalibrationWatch(const std::string& folder,
                            std::chrono::seconds patience = std::chrono::seconds(3));
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
  /// Of all tests that run one is shown, until it ends or falls silent, then the one that is heard next: the
  /// curves of all are kept, so that each is shown from its beginning.
  void reading(const Recipe& test, double strain, double stress);
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
  struct Pressed {
    std::string name, kind;
    std::vector<double> strain, stress;
    Clock::time_point heard;
  };
  std::string file_;
  std::mutex mutex_;
  std::string state_ = "running";
  std::vector<std::string> said_;
  std::vector<Known> known_;  // in the order of their first estimate
  calibrate::TestProgress tests_;
  TimeLeft::Place place_;
  std::optional<SecondsRange> left_;
  std::map<const Recipe*, Pressed> pressed_;  // the addresses are names: never followed
  const Recipe* shown_ = nullptr;             // of these
  std::chrono::seconds patience_;
  Clock::time_point start_, written_;

  std::string text() const;
  void write_now();
  void write_soon();
  void end_stage();
};

}  // namespace phy::jobs
