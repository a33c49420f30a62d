// Nanoseconds per contact, step and specimen of the press with everything of a normal run switched on: energy
// balance, cracks, watchdog, list updates, history. A contact counts if it is bonded, a joint or touching at
// the start. Thread CPU time. Lines whose instruction set this processor lacks are marked as not measured.
// UCS_per_minute, where PHY_BENCH_TESTS is set: whole tests per minute and core at that speed, with the
// recipe's time step, platen speed and stop rule; how many cycles such a test takes is counted by running the
// seven angles to their end in single precision, which takes a minute or two. kind/...: the other tests of
// the laboratory on the same packing, 16 lanes of float. size/...: specimens of 10^3 to 10^6 discs, 16 side
// by side or one alone; those above 10^5 where PHY_BENCH_SIZES is set (their packings take minutes).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "study/worker.hpp"

namespace {

using namespace phy;

const std::vector<std::shared_ptr<const Specimen>>& paper_specimens() {
  static const std::vector<std::shared_ptr<const Specimen>> all = [] {
    Recipe r;
    r.bedding = {BeddingRecipe{}};
    r.test.angles = {0, 15, 30, 45, 60, 75, 90};
    const auto packing = genesis::packing_of(r, genesis::default_cache_folder());
    std::vector<std::shared_ptr<const Specimen>> list;
    for (Specimen& s : genesis::make_specimens(packing, r))
      list.push_back(std::make_shared<const Specimen>(std::move(s)));
    return list;
  }();
  return all;
}

/// Mean cycles of a whole test: of 45 degrees alone, or of the seven angles.
double cycles_per_test(std::size_t angles) {
  static const std::vector<TestResult> results = [] {
    Recipe recipe;
    recipe.engine.precision = Precision::single_precision;
    study::MachineOptions machine;
    machine.isa = engine::native_isa();
    machine.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    return study::run_tests(paper_specimens(), recipe, machine);
  }();
  double sum = 0.0;
  for (const TestResult& r : results) sum += static_cast<double>(r.n_steps);
  return angles == 1 ? static_cast<double>(results[3].n_steps) : sum / static_cast<double>(results.size());
}

/// Tests side by side, one per lane.
class Running {
 public:
  Running(const Recipe& recipe, engine::Isa isa, const std::vector<std::shared_ptr<const Specimen>>& lanes)
      : recipe_(recipe), lanes_(lanes.size()) {
    engine::GroupOptions options;
    options.isa = isa;
    options.precision = recipe.engine.precision;
    options.lanes = static_cast<int>(lanes_);
    interval_ = options.interval;
    group_ = engine::make_group(lanes.front()->packing, options);
    for (int l = 0; l < options.lanes; ++l)
      tests_.push_back(lab::make_test(lanes[static_cast<std::size_t>(l)], recipe_, *group_, l));
  }
  void block() {
    group_->advance();
    for (const auto& t : tests_) t->after_block();
  }
  /// After `before` blocks; tells the time per contact, step and specimen. Returns steps of specimens.
  double measure(benchmark::State& state, int before) {
    for (int i = 0; i < before; ++i) block();
    for (auto _ : state) block();
    const double steps = static_cast<double>(state.iterations()) * interval_ * static_cast<double>(lanes_);
    state.counters["per_contact_step"] =
        benchmark::Counter(steps * static_cast<double>(group_->n_contacts(0)),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    return steps;
  }

 private:
  Recipe recipe_;
  std::size_t lanes_;
  int interval_;
  std::unique_ptr<engine::LaneGroup> group_;
  std::vector<std::unique_ptr<lab::Procedure>> tests_;
};

constexpr int into_the_elastic_range = 60;  // blocks

/// True, and the line marked, where this processor lacks the instruction set.
bool skipped(benchmark::State& state, engine::Isa isa) {
  if (isa <= engine::native_isa()) return false;
  state.SkipWithError("not measured: instruction set absent");
  return true;
}

/// One group: `angles` = 1: all lanes at 45 degrees; 7: the lanes take the seven angles in turn.
void press(benchmark::State& state, engine::Isa isa, Precision precision, int lanes, std::size_t angles) {
  if (skipped(state, isa)) return;
  Recipe recipe;
  recipe.engine.precision = precision;
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (std::size_t l = 0; l < static_cast<std::size_t>(lanes); ++l)
    specimens.push_back(paper_specimens()[angles == 1 ? 3 : l % 7]);
  const double steps = Running(recipe, isa, specimens).measure(state, into_the_elastic_range);
  if (std::getenv("PHY_BENCH_TESTS") == nullptr) return;
  state.counters["UCS_per_minute"] =
      benchmark::Counter(60.0 * steps / cycles_per_test(angles), benchmark::Counter::kIsRate);
}

/// Any kind of test on the paper's packing at 45 degrees, 10 MPa where there is a confining or normal stress,
/// all lanes alike: the loop of the press with another boundary.
void kind(benchmark::State& state, const char* which, Confinement sides) {
  if (skipped(state, engine::Isa::avx512)) return;
  Recipe recipe;
  recipe.bedding = {BeddingRecipe{}};
  recipe.test.angles = {45};
  recipe.test.kind = TestKind(which);
  recipe.test.confinement = sides;
  recipe.test.confining_stress = recipe.test.normal_stress = 10e6;
  recipe.engine.precision = Precision::single_precision;
  const auto& packing = paper_specimens().front()->packing;
  const auto specimen = std::make_shared<const Specimen>(genesis::make_specimens(packing, recipe).front());
  Running(recipe, engine::Isa::avx512, {16, specimen}).measure(state, into_the_elastic_range);
}

/// Intact rock of so many discs, all lanes alike.
void size(benchmark::State& state, std::size_t lanes) {
  if (skipped(state, engine::Isa::avx512)) return;
  if (state.range(0) > 100000 && std::getenv("PHY_BENCH_SIZES") == nullptr)
    return state.SkipWithError("not measured: PHY_BENCH_SIZES is not set");
  Recipe recipe;
  const double side = std::sqrt(static_cast<double>(state.range(0)) / 7481.0);
  recipe.specimen.width *= side, recipe.specimen.height *= side;
  recipe.packing.n_grains = state.range(0);
  recipe.engine.precision = Precision::single_precision;
  const auto packing = genesis::packing_of(recipe, genesis::default_cache_folder());
  const auto specimen = std::make_shared<const Specimen>(genesis::make_specimens(packing, recipe).front());
  Running(recipe, engine::Isa::avx512, {lanes, specimen}).measure(state, 3);
}

#define KIND(name, which, sides)                            \
  BENCHMARK_CAPTURE(kind, name, #which, Confinement::sides) \
      ->Unit(benchmark::kMillisecond)                       \
      ->MeasureProcessCPUTime()

KIND(press, uniaxial, walls);
KIND(direct_tension, direct_tension, walls);
KIND(brazilian, brazilian, walls);
KIND(biaxial_walls, biaxial, walls);
KIND(biaxial_jacket, biaxial, jacket);
KIND(direct_shear, direct_shear, walls);

#define SIZE(name, lanes)              \
  BENCHMARK_CAPTURE(size, name, lanes) \
      ->RangeMultiplier(10)            \
      ->Range(1000, 1000000)           \
      ->Unit(benchmark::kMillisecond)  \
      ->MeasureProcessCPUTime()

SIZE(sixteen_float, 16);
SIZE(alone_float, 1);

#define PRESS(name, isa, precision, lanes, angles)                                                  \
  BENCHMARK_CAPTURE(press, name, engine::Isa::isa, Precision::precision##_precision, lanes, angles) \
      ->Unit(benchmark::kMillisecond)                                                               \
      ->MeasureProcessCPUTime()

PRESS(one_angle_float16_avx512, avx512, single, 16, 1);
PRESS(seven_angles_float16_avx512, avx512, single, 16, 7);
PRESS(one_angle_double8_avx512, avx512, double, 8, 1);
PRESS(seven_angles_double8_avx512, avx512, double, 8, 7);
PRESS(one_angle_float8_avx2, avx2, single, 8, 1);
PRESS(seven_angles_float8_avx2, avx2, single, 8, 7);
PRESS(one_angle_double4_avx2, avx2, double, 4, 1);
PRESS(one_angle_float4_sse2, sse2, single, 4, 1);
PRESS(one_angle_double1_scalar, sse2, double, 1, 1);

// One specimen alone, a register full of its contacts.
PRESS(alone_float1_avx512, avx512, single, 1, 1);
PRESS(alone_float1_avx2, avx2, single, 1, 1);
PRESS(alone_float1_sse2, sse2, single, 1, 1);
PRESS(alone_double1_avx512, avx512, double, 1, 1);
PRESS(alone_double1_avx2, avx2, double, 1, 1);

// What a group of fewer lanes takes, which decides how tests are dealt (slowness() in study/lane_batch.cpp).
PRESS(seven_angles_float8_avx512, avx512, single, 8, 7);
PRESS(seven_angles_float4_avx512, avx512, single, 4, 7);
PRESS(seven_angles_double4_avx512, avx512, double, 4, 7);
PRESS(seven_angles_double2_avx512, avx512, double, 2, 7);
PRESS(seven_angles_float4_avx2, avx2, single, 4, 7);
PRESS(seven_angles_double4_avx2, avx2, double, 4, 7);
PRESS(seven_angles_double2_avx2, avx2, double, 2, 7);
PRESS(seven_angles_float4_sse2, sse2, single, 4, 7);
PRESS(one_angle_float8_avx512, avx512, single, 8, 1);
PRESS(one_angle_float4_avx512, avx512, single, 4, 1);
PRESS(one_angle_float4_avx2, avx2, single, 4, 1);
PRESS(one_angle_double4_avx512, avx512, double, 4, 1);
PRESS(one_angle_double2_avx512, avx512, double, 2, 1);
PRESS(one_angle_double2_avx2, avx2, double, 2, 1);
PRESS(one_angle_double2_sse2, sse2, double, 2, 1);
PRESS(seven_angles_double2_sse2, sse2, double, 2, 7);

}  // namespace

BENCHMARK_MAIN();
