#include "jobs/calibration_job.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "calibrate/plan.hpp"
#include "report/words.hpp"

namespace phy::jobs {
namespace {

/// [s]
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

CalibrationJob::CalibrationJob(const Rock& rock, CalibrationRequest request)
    : request_(std::move(request)),
      evidence_(with_matrix(rock, request_)),
      options_(options_of(request_)),
      specimens_(request_.out) {
  calibrate::check_budget(evidence_, options_);
  // Last, as it writes: what is refused above leaves no folder behind.
  if (!request_.out.empty()) begun_.emplace(begin_calibration(evidence_, request_));
}

calibrate::Listener CalibrationJob::listener(const CalibrationHooks& hooks) {
  calibrate::Listener l;
  l.outlook = [&](const calibrate::Outlook& ahead) { clock_->outlook(ahead, now()); };
  l.begins = [&](const Finding& stage) {
    const std::string text = report::sentence(stage);
    // between models there is no stage yet, and a stage within another says nothing new
    if (!clock_->begins(stage.kind, now()))
      return stage.kind == FindingKind::course_model ? hooks.say(text) : void();
    hooks.say(fmt::format("{} ({})", text, clock_->text(now())));
    if (watch_) watch_->begins(text, clock_->place(), clock_->at(now()));
  };
  l.estimates = [&](const auto& known) {
    if (watch_) watch_->estimates(known);
  };
  return l;
}

Calibration CalibrationJob::run(const CalibrationHooks& hooks) {
  calibrate::SimulatorOptions machine;
  machine.threads = hooks.threads, machine.ranks = hooks.ranks, machine.stop = hooks.stop;
  machine.on_work = hooks.work;
  machine.with_untrusted = request_.with_untrusted;
  if (begun_) {
    // Without a folder nobody can look, and there is nowhere to keep a picture.
    machine.store = begun_->store, machine.sink = &specimens_;
    watch_.emplace(request_.out);
    machine.on_reading = [&](const RunningTest& now) { watch_->reading(now); };
  }
  machine.on_progress = [&](const calibrate::TestProgress& p) {
    clock_->tests(p);
    hooks.tests(p, progress_text(p, *clock_, now()));
    if (watch_) watch_->tests(p, clock_->place(), clock_->at(now()));
  };
  // Direct solutions stay on this process; tests take most of the time.
  const int n_workers = study::n_workers(hooks.ranks, hooks.threads);
  clock_.emplace(seconds_per_cost(n_workers));
  options_.listener = listener(hooks);
  hooks.say(report::sentence(expected_course(calibrate::outlook_of(evidence_, options_), n_workers)));
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
