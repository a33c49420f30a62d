#include "study/lane_batch.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

#include "lab/procedure_fixture.hpp"
#include "study/experiment.hpp"
#include "study/worker.hpp"

namespace phy::study {
namespace {

using std::chrono::milliseconds;

Recipe quick() {
  Recipe r = lab::small_rock(TestKind("uniaxial"));
  r.test.max_strain = 0.004;
  r.test.platen_speed = 0.1;
  r.engine.precision = Precision::single_precision;
  return r;
}

/// Four specimens, as many as there are lanes everywhere, whose tests end at different moments; a hash each.
class Bench {
 public:
  Bench() {
    packing_ = packing_of(quick());
    for (int i = 0; i < 4; ++i) {
      auto r = std::make_shared<Recipe>(quick());
      r->matrix.sigma_c = r->matrix.tau_c = 20e6 * (1 + i);
      recipes_.push_back(r);
    }
  }
  std::shared_ptr<const Packing> packing() const { return packing_; }
  std::map<std::size_t, std::string> found;

  LaneHooks hooks() {
    return {[this]() -> std::optional<Job> {
              if (next_ == recipes_.size()) return {};
              const auto& r = recipes_[next_];
              return Job{specimen_of(packing_, *r), r, next_++};
            },
            [this](std::size_t i, const TestResult& result) {
              const std::lock_guard lock(mutex_);
              found[i] = result.hash;
            },
            [](const LaneUse&, std::size_t) {}, [] { return false; }};
  }
  LaneHooks no_more() {
    LaneHooks h = hooks();
    h.next = [] { return std::optional<Job>(); };
    return h;
  }

 private:
  std::shared_ptr<const Packing> packing_;
  std::vector<std::shared_ptr<const Recipe>> recipes_;
  std::size_t next_ = 0;
  std::mutex mutex_;
};

/// As wide as the machine has it: sixteen with AVX-512, eight with AVX2, four with SSE2.
LaneBatchOptions full_register(bool fixed) {
  LaneBatchOptions o;
  o.group.isa = engine::native_isa();
  o.group.precision = Precision::single_precision;
  o.group.lanes = engine::native_lanes(o.group.precision, o.group.isa);
  o.group.interval = static_cast<int>(quick().test.history_interval);
  o.fixed = fixed;
  return o;
}

std::map<std::size_t, std::string> undisturbed() {
  Bench bench;
  auto lane_batch = std::make_unique<LaneBatch>(bench.packing(), full_register(true));
  lane_batch->fill(bench.hooks());
  LaneBatchExchange alone(1);
  run_lane_batch(std::move(lane_batch), bench.hooks(), alone);
  return bench.found;
}

engine::GroupOptions widest_group(Precision precision, engine::Isa isa) {
  engine::GroupOptions group;
  group.isa = isa, group.precision = precision;
  group.lanes = engine::native_lanes(precision, isa);
  return group;
}

// Lanes are the fewest that hold the tests, unless all would be done sooner one after the other.
TEST(LaneBatch, FittingLanesAreThoseThatAreDoneSooner) {
  for (const engine::Isa isa : {engine::Isa::sse2, engine::Isa::avx2, engine::Isa::avx512})
    for (const Precision precision : {Precision::double_precision, Precision::single_precision})
      for (const bool alike : {false, true}) {
        const engine::GroupOptions group = widest_group(precision, isa);
        EXPECT_EQ(fitting_lanes(1, alike, group), 1);
        EXPECT_EQ(fitting_lanes(50, alike, group), group.lanes);
        bool in_lanes = false;
        for (std::size_t n = 1; n <= static_cast<std::size_t>(group.lanes); ++n) {
          const int lanes = fitting_lanes(n, alike, group);
          EXPECT_FALSE(in_lanes && lanes == 1) << n << " of " << group.lanes;  // fewer were put into lanes
          in_lanes = lanes > 1;
          if (!in_lanes) continue;
          EXPECT_GE(static_cast<std::size_t>(lanes), n);
          EXPECT_LT(slowness(lanes, alike, precision, isa), static_cast<double>(n));
        }
      }
  const engine::GroupOptions floats = widest_group(Precision::single_precision, engine::Isa::avx512);
  EXPECT_EQ(fitting_lanes(6, false, floats), 1);
  EXPECT_EQ(fitting_lanes(7, false, floats), 8);
  EXPECT_EQ(fitting_lanes(9, false, floats), 16);
  EXPECT_EQ(fitting_lanes(6, true, floats), 8);
}

TEST(LaneBatch, AnEmptyOneDoesNothing) {
  Bench bench;
  LaneHooks hooks = bench.no_more();
  hooks.block = [](const LaneUse&, std::size_t) { ADD_FAILURE() << "a block without a test"; };
  LaneBatchExchange alone(1);
  run_lane_batch(std::make_unique<LaneBatch>(bench.packing(), full_register(false)), hooks, alone);
}

TEST(LaneBatch, WhatIsSoonerDoneOneAfterTheOtherIsTakenApart) {
  Bench bench;
  LaneBatch lane_batch(bench.packing(), full_register(false));
  lane_batch.fill(bench.hooks());
  for (int i = 0; i < 10; ++i) lane_batch.work(bench.no_more());
  const std::size_t before = lane_batch.n_tests();
  auto others = lane_batch.narrowed();
  EXPECT_EQ(lane_batch.n_tests(), 0U);
  std::size_t n = 0;
  for (const auto& other : others) {
    n += other->n_tests();
    EXPECT_FALSE(other->too_wide());
    while (other->n_tests() > 0) other->work(bench.no_more());
  }
  EXPECT_EQ(n, before);
  EXPECT_EQ(bench.found, undisturbed());
}

TEST(LaneBatch, PartsGoTheirOwnWayAndEndAsIfTogether) {
  Bench bench;
  LaneBatch lane_batch(bench.packing(), full_register(false));
  lane_batch.fill(bench.hooks());
  for (int i = 0; i < 10; ++i) lane_batch.work(bench.no_more());
  const std::size_t before = lane_batch.n_tests();
  ASSERT_GE(before, 3U);
  auto other = lane_batch.part(2);
  EXPECT_EQ(other->n_tests(), 2U);
  EXPECT_EQ(lane_batch.n_tests(), before - 2);
  EXPECT_TRUE(lane_batch.too_wide());
  while (lane_batch.n_tests() > 0) lane_batch.work(bench.no_more());
  while (other->n_tests() > 0) other->work(bench.no_more());
  EXPECT_EQ(bench.found.size(), 4U);
  EXPECT_EQ(bench.found, undisturbed());
}

TEST(LaneBatch, AWorkerWhoHasRunDryIsGivenTests) {
  Bench bench;
  LaneBatchExchange exchange(2);
  std::atomic<int> taken{0};
  std::jthread helper([&] {
    while (auto lane_batch = exchange.wait()) {
      ++taken;
      run_lane_batch(std::move(lane_batch), bench.no_more(), exchange);
    }
    exchange.leave();
  });
  auto lane_batch = std::make_unique<LaneBatch>(bench.packing(), full_register(false));
  lane_batch->fill(bench.hooks());
  LaneHooks hooks = bench.no_more();
  hooks.block = [&](const LaneUse&, std::size_t) {  // it waits before the tests are over
    if (taken == 0) std::this_thread::sleep_for(milliseconds(1));
  };
  run_lane_batch(std::move(lane_batch), hooks, exchange);
  exchange.leave();
  helper.join();
  EXPECT_GE(taken.load(), 1);
  EXPECT_EQ(bench.found, undisturbed());
}

TEST(LaneBatchExchange, EndsWhenNobodyHasWork) {
  LaneBatchExchange exchange(3);
  const auto idle = [&] {
    EXPECT_EQ(exchange.wait(), nullptr);
    exchange.leave();
  };
  std::jthread one(idle), two(idle);
  EXPECT_EQ(exchange.wait_for(milliseconds(20)), nullptr);
  EXPECT_FALSE(exchange.waited() < 0.02);
  exchange.leave();
}

TEST(LaneBatchExchange, MakesNoLaneBatchThatNobodyWaitsFor) {
  LaneBatchExchange exchange(1);
  EXPECT_FALSE(exchange.share([]() -> std::unique_ptr<LaneBatch> {
    ADD_FAILURE() << "nobody is there to take it";
    return nullptr;
  }));
}

// The time to wait ends while the lane batch is made; it is taken nevertheless, or its tests would be lost.
TEST(LaneBatchExchange, ALaneBatchThatIsBeingMadeIsWaitedFor) {
  LaneBatchExchange exchange(2);
  std::atomic<bool> begun{false};
  std::unique_ptr<LaneBatch> taken;
  std::jthread idle([&] {
    while (!begun) taken = exchange.wait_for(milliseconds(10));
  });
  const auto slowly = [&] {
    begun = true;
    std::this_thread::sleep_for(milliseconds(50));
    return std::make_unique<LaneBatch>(Bench().packing(), full_register(false));
  };
  while (!exchange.share(slowly)) std::this_thread::yield();
  idle.join();
  EXPECT_NE(taken, nullptr);
}

// Two workers with a test each; the first reading of one is the end of both.
TEST(RunTests, AfterAnExceptionTheOthersStopSoon) {
  const Recipe r = quick();
  const auto specimen = specimen_of(packing_of(r), r);
  std::size_t n_later = 0;
  bool thrown = false;
  Hooks hooks;
  hooks.on_reading = [&](std::size_t index, const RunningTest&) {
    if (thrown) ++n_later, std::this_thread::sleep_for(milliseconds(1));
    if (index == 1) thrown = true, throw std::runtime_error("no room for a reading");
  };
  EXPECT_THROW(run_tests({specimen, specimen}, r, {2, 1, 4, engine::native_isa()}, hooks),
               std::runtime_error);
  EXPECT_LT(n_later, 100U) << "a whole test has many more";
}

TEST(RunTests, ARunningTestIsSeenAsItIsAndChangesNothing) {
  const Recipe r = quick();
  const std::vector<std::shared_ptr<const Specimen>> specimens = {specimen_of(packing_of(r), r)};
  const study::MachineOptions machine{1, 0, 4, engine::native_isa()};
  std::vector<SpecimenNow> seen;
  double strain = 0.0;
  int n_ends = 0;
  Hooks hooks;
  hooks.on_reading = [&](std::size_t, const RunningTest& now) {
    EXPECT_EQ(&now.specimen, specimens.front().get());
    EXPECT_GE(now.strain, strain);
    strain = now.strain, n_ends += now.over ? 1 : 0;
    seen.push_back(now.look());
  };
  const TestResult watched = run_tests(specimens, r, machine, hooks).front();
  EXPECT_EQ(n_ends, 1);
  EXPECT_EQ(seen.back().moved.u.size(), specimens.front()->packing->discs.size());
  EXPECT_EQ(seen.back().moved.u, watched.frames.back().u);
  EXPECT_EQ(seen.back().cracks.size(), watched.cracks.size());
  EXPECT_GT(seen.back().cracks.size(), seen.front().cracks.size());
  EXPECT_EQ(watched.hash, run_tests(specimens, r, machine).front().hash);
}

// Specimens of one packing whose holes differ have other grains: they share no group, and each has the result
// that it has alone.
TEST(RunTests, OpeningsOfOnePackingDoNotMeet) {
  std::vector<Recipe> recipes(4, quick());
  recipes[1].specimen.hole_diameter = 0.002;
  recipes[2].specimen.hole_diameter = 0.003;
  recipes[3].specimen.flaw_length = 0.003, recipes[3].specimen.flaw_angle = 45.0;
  const Plan plan = plan_of(recipes);
  EXPECT_EQ(plan.batches.size(), 4U);
  std::map<std::size_t, std::string> together;
  Hooks hooks;
  hooks.on_result = [&](std::size_t test, TestResult& r) { together[test] = r.hash; };
  run_plan(plan, {1, 0, 4, engine::native_isa()}, hooks);
  std::set<std::string> hashes;
  const auto packing = packing_of(quick());
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    const auto one = specimen_of(packing, recipes[i]);
    EXPECT_EQ(together[i], run_tests({one}, recipes[i], {1, 0, 1, engine::native_isa()}).front().hash) << i;
    hashes.insert(together[i]);
  }
  EXPECT_EQ(hashes.size(), 4U);
}

TEST(RunTests, ATestThatHasNotBegunKnowsWhoseItIs) {
  Recipe r = lab::small_rock(TestKind("biaxial"));
  r.bedding.resize(1);
  r.test.angles = {30.0};
  r.test.intact = true;
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (const Recipe& single : single_recipes(r)) specimens.push_back(specimen_of(packing_of(r), single));
  const std::atomic<bool> stop{true};
  Hooks hooks;
  hooks.stop = &stop;
  const auto results = run_tests(specimens, r, {1, 0, 4, engine::native_isa()}, hooks);
  for (const TestResult& result : results) {
    EXPECT_EQ(result.outcome.reason, "not started");
    EXPECT_EQ(result.kind, TestKind("biaxial"));
  }
  EXPECT_EQ(results[0].theta, 30.0);
  EXPECT_FALSE(results[0].intact);
  EXPECT_TRUE(results[1].intact);
}

}  // namespace
}  // namespace phy::study
