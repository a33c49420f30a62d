#include "jobs/calibration_job.hpp"

#include <utility>

#include "calibrate/plan.hpp"

namespace phy::jobs {

CalibrationJob::CalibrationJob(const Rock& rock, CalibrationRequest request)
    : request_(std::move(request)),
      evidence_(with_matrix(rock, request_)),
      options_(options_of(request_)),
      specimens_(request_.out) {
  calibrate::check_budget(evidence_, options_);
  // Last, as it writes: what is refused above leaves no folder behind.
  if (!request_.out.empty()) begun_.emplace(begin_calibration(evidence_, request_));
}

Calibration CalibrationJob::run(const CalibrationHooks& hooks) {
  calibrate::SimulatorOptions machine;
  machine.threads = hooks.threads, machine.stop = hooks.stop, machine.on_work = hooks.work;
  machine.with_untrusted = request_.with_untrusted;
  if (begun_) {
    // Without a folder nobody can look, and there is nowhere to keep a picture.
    machine.store = begun_->store, machine.sink = &specimens_;
    watch_.emplace(request_.out);
    machine.on_reading = [&](const Recipe& r, double strain, double stress) {
      watch_->reading(r, strain, stress);
    };
    options_.listener.estimates = [&](const auto& known) { watch_->estimates(known); };
  }
  machine.on_progress = [&](const calibrate::TestProgress& p) {
    hooks.tests(p);
    if (watch_) watch_->tests(p);
  };
  options_.listener.say = [&](const std::string& text) {
    hooks.say(text);
    if (watch_) watch_->say(text);
  };
  Calibration result = calibrate::calibrate(evidence_, options_, *calibrate::make_simulator(machine));
  result.asked = asked(request_);
  if (!begun_) return result;
  // An interrupted one leaves its tests alone: files of half a result would be taken for a whole one.
  if (result.verdict.status == VerdictStatus::interrupted)
    watch_->end("stopped");
  else
    write_calibration(request_.out, result);
  return result;
}

void CalibrationJob::finish() {
  // Before a complaint about pictures: the calibration itself is whole.
  if (watch_) watch_->end("finished");
  specimens_.check();
}

}  // namespace phy::jobs
