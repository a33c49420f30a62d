#include "study/crew.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "lab/tests.hpp"

namespace phy::study {

int fitting_lanes(std::size_t n, Precision precision, int widest) {
  int lanes = precision == Precision::single_precision ? 4 : 1;
  while (static_cast<std::size_t>(lanes) < n && lanes < widest) lanes *= 2;
  return lanes;
}

Crew::Crew(std::shared_ptr<const Packing> packing, const CrewOptions& options)
    : packing_(std::move(packing)),
      options_(options),
      group_(engine::make_group(packing_, options.group)),
      seats_(static_cast<std::size_t>(options.group.lanes)) {}

void Crew::fill(const LaneHooks& hooks) {
  for (std::size_t lane = 0; lane < seats_.size(); ++lane) {
    Seat& seat = seats_[lane];
    if (seat.test) continue;
    std::optional<Job> job = hooks.next();
    if (!job) return;
    seat.job = std::move(*job);
    seat.seconds = 0.0;
    seat.test = lab::make_test(seat.job.specimen, *seat.job.recipe, *group_, static_cast<int>(lane));
  }
}

void Crew::hand_over(const LaneHooks& hooks, Seat& seat) {
  TestResult result = seat.test->take_result();
  result.seconds = seat.seconds;
  hooks.done(seat.job.index, std::move(result));
  seat.test.reset();
}

void Crew::work(const LaneHooks& hooks) {
  const auto n = static_cast<double>(n_tests());
  const double before = thread_seconds();
  group_->advance();
  const double seconds = thread_seconds() - before;
  hooks.block(n * options_.group.interval, packing_->discs.size());
  for (std::size_t lane = 0; lane < seats_.size(); ++lane) {
    Seat& seat = seats_[lane];
    if (!seat.test) continue;
    seat.seconds += seconds / n;
    bool over = seat.test->after_block();
    if (const lab::LabTest::Reading r = seat.test->latest(); hooks.reading)
      hooks.reading(seat.job.index, r.strain, r.stress);
    if (!over && hooks.stopped()) seat.test->interrupt(), over = true;
    if (!over) continue;
    hand_over(hooks, seat);
    group_->clear(static_cast<int>(lane));
  }
  fill(hooks);
}

std::size_t Crew::n_tests() const {
  return static_cast<std::size_t>(
      std::count_if(seats_.begin(), seats_.end(), [](const Seat& s) { return s.test != nullptr; }));
}

bool Crew::too_wide() const {
  return fitting_lanes(n_tests(), options_.group.precision, options_.group.lanes) < options_.group.lanes;
}

std::unique_ptr<Crew> Crew::part(std::size_t n) {
  std::vector<std::size_t> busy;
  for (std::size_t lane = 0; lane < seats_.size(); ++lane)
    if (seats_[lane].test) busy.push_back(lane);
  PHY_CHECK(n <= busy.size(), "a crew gives tests that it has");
  const auto theta = [this](std::size_t lane) {
    const Specimen& s = *seats_[lane].job.specimen;
    return s.bedding.empty() ? -1.0 : s.bedding.front().theta;
  };
  std::stable_sort(busy.begin(), busy.end(),
                   [&](std::size_t a, std::size_t b) { return theta(a) < theta(b); });
  CrewOptions options = options_;
  options.group.lanes = fitting_lanes(n, options.group.precision, options.group.lanes);
  auto other = std::make_unique<Crew>(packing_, options);
  for (std::size_t lane = 0; lane < n; ++lane) {
    Seat& seat = seats_[busy[lane]];
    seat.test->move_to(*other->group_, static_cast<int>(lane));
    other->seats_[lane] = std::exchange(seat, Seat{});
  }
  return other;
}

std::unique_ptr<Crew> CrewExchange::take_offered() {
  if (offered_.empty()) return nullptr;
  std::unique_ptr<Crew> crew = std::move(offered_.back());
  offered_.pop_back();
  return crew;
}

std::unique_ptr<Crew> CrewExchange::wait() {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  ++n_waiting_;
  if (--n_working_ == 0) change_.notify_all();
  change_.wait(lock, [this] { return !offered_.empty() || n_working_ == 0; });
  --n_waiting_, ++n_working_;
  waited_ += seconds_since(start);
  return take_offered();
}

std::unique_ptr<Crew> CrewExchange::wait_for(std::chrono::milliseconds patience) {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  ++n_waiting_;
  change_.wait_for(lock, patience, [this] { return !offered_.empty(); });
  --n_waiting_;
  waited_ += seconds_since(start);
  return take_offered();
}

// Made under the lock, or he who waits might have gone meanwhile. That takes less than a block of cycles,
// and the others look in once per block.
bool CrewExchange::share(const std::function<std::unique_ptr<Crew>()>& make) {
  const std::lock_guard lock(mutex_);
  if (n_waiting_ == offered_.size()) return false;
  offered_.push_back(make());
  change_.notify_one();
  return true;
}

void CrewExchange::leave() {
  const std::lock_guard lock(mutex_);
  if (--n_working_ == 0) change_.notify_all();
}

double CrewExchange::waited() {
  const std::lock_guard lock(mutex_);
  return waited_;
}

void run_crew(std::unique_ptr<Crew> crew, const LaneHooks& hooks, CrewExchange& exchange) {
  while (crew->n_tests() > 0) {
    crew->work(hooks);
    if (crew->fixed()) continue;
    if (crew->n_tests() > 1) exchange.share([&] { return crew->part(crew->n_tests() / 2); });
    if (crew->n_tests() > 0 && crew->too_wide()) crew = crew->part(crew->n_tests());
  }
}

}  // namespace phy::study
