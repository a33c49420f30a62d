#include "study/lane_batch.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "lab/tests.hpp"
#include "system/process.hpp"

namespace phy::study {

namespace {

/// Lanes of the narrowest group that holds `n` tests.
int holding_lanes(std::size_t n, Precision precision, int widest) {
  // Float has no kernel of two lanes (engine/isa.hpp); counts are powers of two.
  int lanes = n > 1 && precision == Precision::single_precision ? 4 : 1;
  while (static_cast<std::size_t>(lanes) < n && lanes < widest) lanes *= 2;
  return lanes;
}

}  // namespace

double slowness(int lanes, bool alike, Precision precision, engine::Isa isa) {
  struct Times {
    double two, four, eight, sixteen;  // lanes; 0: no such group (engine::lanes_of)
  };
  // Measured with bench_engine (docs/decisions/0013): by `alike`, then by instruction set from SSE2 to
  // AVX-512.
  constexpr Times singles[2][3] = {{{0.0, 3.0, 0.0, 0.0}, {0.0, 4.2, 4.7, 0.0}, {0.0, 4.6, 6.1, 7.6}},
                                   {{0.0, 2.0, 0.0, 0.0}, {0.0, 2.8, 2.7, 0.0}, {0.0, 3.3, 3.6, 4.7}}};
  constexpr Times doubles[2][3] = {{{1.5, 0.0, 0.0, 0.0}, {2.4, 2.8, 0.0, 0.0}, {2.9, 3.9, 5.7, 0.0}},
                                   {{1.2, 0.0, 0.0, 0.0}, {1.8, 1.9, 0.0, 0.0}, {2.4, 2.6, 3.3, 0.0}}};
  const auto& of_precision = precision == Precision::single_precision ? singles : doubles;
  const Times& t = of_precision[alike ? 1 : 0][static_cast<int>(isa)];
  return lanes == 1 ? 1.0 : lanes == 2 ? t.two : lanes == 4 ? t.four : lanes == 8 ? t.eight : t.sixteen;
}

int fitting_lanes(std::size_t n, bool alike, const engine::GroupOptions& widest) {
  constexpr double as_good_as = 1.05;  // one after the other takes less memory and is shared out more evenly
  const int lanes = holding_lanes(n, widest.precision, widest.lanes);
  const double side_by_side = slowness(lanes, alike, widest.precision, widest.isa);
  return static_cast<double>(n) <= as_good_as * side_by_side ? 1 : lanes;
}

double layers_of(const Specimen& specimen) { return layered(specimen) ? inclination(specimen) : -1.0; }

LaneBatch::LaneBatch(std::shared_ptr<const Packing> packing, const LaneBatchOptions& options)
    : packing_(std::move(packing)),
      options_(options),
      group_(engine::make_group(packing_, options.group)),
      slots_(static_cast<std::size_t>(options.group.lanes)) {}

void LaneBatch::fill(const LaneHooks& hooks) {
  for (std::size_t lane = 0; lane < slots_.size(); ++lane) {
    LaneSlot& slot = slots_[lane];
    if (slot.test) continue;
    std::optional<Job> job = hooks.next();
    if (!job) return;
    slot.job = std::move(*job);
    slot.seconds = 0.0;
    slot.test = lab::make_test(slot.job.specimen, *slot.job.recipe, *group_, static_cast<int>(lane));
  }
}

void LaneBatch::hand_over(const LaneHooks& hooks, LaneSlot& slot) {
  TestResult result = slot.test->take_result();
  result.seconds = slot.seconds;
  hooks.done(slot.job.index, std::move(result));
  slot.test.reset();
}

void LaneBatch::work(const LaneHooks& hooks) {
  const auto n = static_cast<double>(n_tests());
  const double cycles = options_.group.interval;
  LaneUse use;
  use.test_steps = n * cycles, use.lane_steps = static_cast<double>(slots_.size()) * cycles;
  use.alone_steps = slots_.size() == 1 ? use.test_steps : 0.0;
  for (std::size_t lane = 0; lane < slots_.size(); ++lane)
    if (slots_[lane].test)
      use.contact_steps += cycles * static_cast<double>(group_->n_contacts(static_cast<int>(lane)));
  // Time on the processor, not on the clock: other workers and programs do not count.
  const double before = system::thread_seconds();
  group_->advance();
  use.seconds = system::thread_seconds() - before;
  hooks.block(use, packing_->discs.size());
  for (std::size_t lane = 0; lane < slots_.size(); ++lane) {
    LaneSlot& slot = slots_[lane];
    if (!slot.test) continue;
    // A block advances all lanes at once; its time is shared equally among the tests in them.
    slot.seconds += use.seconds / n;
    bool over = slot.test->after_block();
    if (const lab::Procedure::Reading r = slot.test->latest(); hooks.reading)
      hooks.reading(slot.job.index, {*slot.job.specimen, *slot.job.recipe, r.strain, r.stress, over,
                                     [&slot] { return slot.test->now(); }});
    // A test that has just ended keeps its result, even when the run is being stopped.
    if (!over && hooks.stopped()) slot.test->interrupt(), over = true;
    if (!over) continue;
    // The result is taken before its lane is emptied: it reads the group's memory.
    hand_over(hooks, slot);
    group_->clear(static_cast<int>(lane));
  }
  fill(hooks);
}

std::size_t LaneBatch::n_tests() const {
  return static_cast<std::size_t>(
      std::count_if(slots_.begin(), slots_.end(), [](const LaneSlot& s) { return s.test != nullptr; }));
}

std::vector<std::size_t> LaneBatch::busy_lanes() const {
  std::vector<std::size_t> busy;
  for (std::size_t lane = 0; lane < slots_.size(); ++lane)
    if (slots_[lane].test) busy.push_back(lane);
  return busy;
}

bool LaneBatch::alike() const {
  const std::vector<std::size_t> busy = busy_lanes();
  const auto layers = [this](std::size_t lane) { return layers_of(*slots_[lane].job.specimen); };
  return std::all_of(busy.begin(), busy.end(),
                     [&](std::size_t lane) { return layers(lane) == layers(busy.front()); });
}

bool LaneBatch::too_wide() const {
  return fitting_lanes(n_tests(), alike(), options_.group) < options_.group.lanes;
}

std::unique_ptr<LaneBatch> LaneBatch::part(std::size_t n) {
  std::vector<std::size_t> busy = busy_lanes();
  PHY_CHECK(n <= busy.size(), "a lane batch gives tests that it has");
  // Neighbours in angle stay together: where all lanes have the same interfaces only one law is evaluated per
  // contact (study/plan.hpp). Intact rock is sorted in front of all angles.
  const auto layers = [this](std::size_t lane) { return layers_of(*slots_[lane].job.specimen); };
  std::stable_sort(busy.begin(), busy.end(),
                   [&](std::size_t a, std::size_t b) { return layers(a) < layers(b); });
  LaneBatchOptions options = options_;
  options.group.lanes = holding_lanes(n, options.group.precision, options.group.lanes);
  auto other = std::make_unique<LaneBatch>(packing_, options);
  for (std::size_t lane = 0; lane < n; ++lane) {
    LaneSlot& slot = slots_[busy[lane]];
    // The procedure moves with its lane; both groups are between blocks.
    slot.test->move_to(*other->group_, static_cast<int>(lane));
    other->slots_[lane] = std::exchange(slot, LaneSlot{});
  }
  return other;
}

std::vector<std::unique_ptr<LaneBatch>> LaneBatch::narrowed() {
  const std::size_t each = fitting_lanes(n_tests(), alike(), options_.group) == 1 ? 1 : n_tests();
  std::vector<std::unique_ptr<LaneBatch>> all;
  while (n_tests() > 0) all.push_back(part(each));
  return all;
}

std::unique_ptr<LaneBatch> LaneBatchExchange::take_offered() {
  if (offered_.empty()) return nullptr;
  std::unique_ptr<LaneBatch> lane_batch = std::move(offered_.back());
  offered_.pop_back();
  return lane_batch;
}

std::unique_ptr<LaneBatch> LaneBatchExchange::wait() {
  const auto start = std::chrono::steady_clock::now();
  // Waiting means having no work: the last one to wait wakes all others, which then end.
  std::unique_lock lock(mutex_);
  ++n_waiting_;
  if (--n_working_ == 0) change_.notify_all();
  change_.wait(lock, [this] { return !offered_.empty() || n_working_ == 0; });
  // Working again, also when nothing came: leave() takes the worker off the count.
  --n_waiting_, ++n_working_;
  waited_ += seconds_since(start);
  return take_offered();
}

std::unique_ptr<LaneBatch> LaneBatchExchange::wait_for(std::chrono::milliseconds patience) {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  // Still counted as working: this worker may yet find tests of another packing or process.
  ++n_waiting_;
  change_.wait_for(lock, patience, [this] { return !offered_.empty(); });
  --n_waiting_;
  waited_ += seconds_since(start);
  return take_offered();
}

// Made under the lock, or the worker that waits might have gone meanwhile. That takes less than a block of
// cycles, and the others look in once per block.
bool LaneBatchExchange::share(const std::function<std::unique_ptr<LaneBatch>()>& make) {
  const std::lock_guard lock(mutex_);
  // Every batch on offer has a worker waiting for it; one more would be run by none.
  if (n_waiting_ == offered_.size()) return false;
  offered_.push_back(make());
  change_.notify_one();
  return true;
}

void LaneBatchExchange::leave() {
  const std::lock_guard lock(mutex_);
  if (--n_working_ == 0) change_.notify_all();
}

double LaneBatchExchange::waited() {
  const std::lock_guard lock(mutex_);
  return waited_;
}

void run_lane_batch(std::unique_ptr<LaneBatch> lane_batch, const LaneHooks& hooks,
                    LaneBatchExchange& exchange) {
  std::vector<std::unique_ptr<LaneBatch>> mine;  // the last one runs, the others wait for it
  mine.push_back(std::move(lane_batch));
  const auto half = [&] { return mine.back()->part(mine.back()->n_tests() / 2); };
  const auto first = [&] {
    std::unique_ptr<LaneBatch> given = std::move(mine.front());
    mine.erase(mine.begin());
    return given;
  };
  while (!mine.empty()) {
    if (mine.back()->n_tests() == 0) {
      mine.pop_back();
      continue;
    }
    mine.back()->work(hooks);
    // The number of lanes was fixed by the user (MachineOptions::lanes): nothing is narrowed or shared.
    if (mine.back()->fixed() || mine.back()->n_tests() == 0) continue;
    if (mine.back()->too_wide()) {
      // Moving into a narrower group costs far less than cycles with empty lanes.
      const std::unique_ptr<LaneBatch> wide = std::move(mine.back());
      mine.pop_back();
      for (std::unique_ptr<LaneBatch>& narrow : wide->narrowed()) mine.push_back(std::move(narrow));
    }
    if (mine.size() > 1)
      exchange.share(first);
    else if (mine.back()->n_tests() > 1)
      // Half of the tests: this worker and the one that waits then take about as long.
      exchange.share(half);
  }
}

}  // namespace phy::study
