#include "jobs/calibration_watch.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/clock.hpp"
#include "io/file.hpp"

namespace phy::jobs {
namespace {

using Json = nlohmann::ordered_json;
// The page looks every other second or so; thousands of quick tests would else write thousands of files.
constexpr std::chrono::seconds period{1};

}  // namespace

CalibrationWatch::CalibrationWatch(const std::string& folder)
    : file_((std::filesystem::path(folder) / watch_file).string()), press_(folder), start_(Clock::now()) {
  write_now();
}

CalibrationWatch::~CalibrationWatch() {
  // Also when an exception ends the calibration: the page would show it as running for ever.
  if (state_ == "running") end("failed");
}

void CalibrationWatch::begins(const std::string& stage, const TimeLeft::Place& place,
                              const std::optional<SecondsRange>& left) {
  const std::lock_guard lock(mutex_);
  said_.push_back(stage), place_ = place, left_ = left;
  end_stage();
  write_now();
}

void CalibrationWatch::tests(const calibrate::TestProgress& progress, const TimeLeft::Place& place,
                             const std::optional<SecondsRange>& left) {
  const std::lock_guard lock(mutex_);
  tests_ = progress, place_ = place, left_ = left;
  write_soon();
}

void CalibrationWatch::estimates(const std::vector<ParameterEstimate>& parameters) {
  const std::lock_guard lock(mutex_);
  // A new model begins, with other parameters; steps of the one before would be drawn on.
  if (parameters.empty()) known_.clear();
  for (const ParameterEstimate& p : parameters) {
    auto known = std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.key == p.key; });
    if (known == known_.end())
      known = known_.insert(known_.end(), {p.key, p.symbol, p.unit, p.box_low, p.box_high, {}});
    // All estimates are kept: the page draws how the intervals shrink.
    known->steps.push_back({p.value, p.low, p.high});
  }
  write_now();
}

void CalibrationWatch::end_stage() {
  tests_ = {};
  // Between stages nothing is pressed, and the last specimen would stand there as if it were.
  press_.clear();
}

void CalibrationWatch::end(const std::string& state) {
  const std::lock_guard lock(mutex_);
  state_ = state, end_stage();
  write_now();
}

std::string CalibrationWatch::text() const {
  Json j = {{"state", state_},
            {"stage", said_.empty() ? "" : said_.back()},
            {"seconds", seconds_since(start_)},
            {"model", {place_.model, place_.models}},
            {"stages", {place_.stage, place_.least, place_.most}},
            {"n_done", tests_.n_done},
            {"n_total", tests_.n_total},
            {"seconds_left", left_ ? Json{left_->low, left_->high} : Json(nullptr)},
            {"said", said_},
            {"parameters", Json::array()}};
  for (const Known& k : known_) {
    Json steps = Json::array();
    for (const Step& s : k.steps) steps.push_back({{"value", s.value}, {"low", s.low}, {"high", s.high}});
    j["parameters"].push_back({{"key", k.key},
                               {"symbol", k.symbol},
                               {"unit", k.unit},
                               {"box", {k.box_low, k.box_high}},
                               {"steps", std::move(steps)}});
  }
  // Names from the user's files need not be UTF-8, and a progress report must not end a calibration.
  return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void CalibrationWatch::write_now() {
  written_ = Clock::now();
  // Not synced to the disk, as results are: the workers wait meanwhile. What matters reports a full disk.
  io::write_passing(file_, text());
}

void CalibrationWatch::write_soon() {
  if (Clock::now() - written_ >= period) write_now();
}

}  // namespace phy::jobs
