// A calibration as every front end asks for it: checked, begun in its folder, run, and all that is left
// there.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "jobs/calibration_folder.hpp"
#include "jobs/calibration_watch.hpp"
#include "jobs/time_left.hpp"

namespace phy::jobs {

/// Where it runs, and who follows it. Functions are called from workers, one at a time.
struct CalibrationHooks {
  int threads = 1;                      ///< of this process
  const study::Ranks* ranks = nullptr;  ///< that run tests, too; null: none
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string&)> say;  ///< what begins, one line
  /// Of this batch; and where the calibration is, and how long it goes on.
  std::function<void(const calibrate::TestProgress&, const std::string&)> tests;
  std::function<void(const study::WorkReport&)> work = nullptr;  ///< after every batch of tests
};

class CalibrationJob {
 public:
  /// Nothing is written before all checks have passed. Throws InputError, IoError.
  CalibrationJob(const Rock& rock, CalibrationRequest request);
  const Evidence& evidence() const { return evidence_; }
  /// What the folder held of the same calibration, whose tests are taken up; else it begins afresh.
  bool resumes() const { return begun_ && begun_->had_tests; }
  /// Once. Leaves its files in the folder, but the page; none where it is interrupted.
  Calibration run(const CalibrationHooks& hooks);
  /// When the page is there, too. Throws what kept a specimen from being written.
  void finish();

 private:
  CalibrationRequest request_;
  Evidence evidence_;
  calibrate::CalibrationOptions options_;
  std::optional<BegunCalibration> begun_;  // none: nothing is kept
  SpecimenFolder specimens_;
  std::optional<CalibrationWatch> watch_;
  std::optional<TimeLeft> clock_;

  calibrate::Listener listener(const CalibrationHooks& hooks);
};

}  // namespace phy::jobs
