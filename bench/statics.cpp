// Seconds per direct elastic solution of the paper's specimen, assembly and symbolic analysis included.
#include <benchmark/benchmark.h>

#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "statics/uniaxial.hpp"

namespace {

using namespace phy;

/// Seven angles times nine pairs of joint stiffnesses (k_n and k_s times 1/4, 1/2, 1, 2, 4, one at a time).
const std::vector<Specimen>& paper_specimens() {
  static const std::vector<Specimen> all = [] {
    Recipe r;
    r.bedding = {BeddingRecipe{}};
    r.test.angles = {0, 15, 30, 45, 60, 75, 90};
    const std::vector<Specimen> angles =
        genesis::make_specimens(genesis::packing_of(r, genesis::default_cache_folder()), r);
    std::vector<Specimen> list;
    for (const auto& [n, s] : {std::pair{1.0, 1.0},
                               {0.25, 1.0},
                               {0.5, 1.0},
                               {2.0, 1.0},
                               {4.0, 1.0},
                               {1.0, 0.25},
                               {1.0, 0.5},
                               {1.0, 2.0},
                               {1.0, 4.0}})
      for (Specimen copy : angles) {
        copy.bedding[0].k_n *= n, copy.bedding[0].k_s *= s;
        list.push_back(std::move(copy));
      }
    return list;
  }();
  return all;
}

statics::ElasticOptions options(bool bilateral, bool sensitivities) {
  statics::ElasticOptions o;
  o.bilateral = bilateral, o.sensitivities = sensitivities;
  return o;
}

/// Everything anew: network, order of elimination, factors, sensitivities.
void one_angle(benchmark::State& state, bool bilateral) {
  const Specimen& specimen = paper_specimens()[static_cast<std::size_t>(state.range(0)) / 15];
  for (auto _ : state) benchmark::DoNotOptimize(statics::solve_uniaxial(specimen, options(bilateral, true)));
}

/// The same with the symbolic part kept: what each further angle or parameter set costs.
void next_angle(benchmark::State& state, bool bilateral) {
  const Specimen& specimen = paper_specimens()[static_cast<std::size_t>(state.range(0)) / 15];
  statics::UniaxialStatics statics;
  statics.solve(specimen, options(bilateral, true));
  for (auto _ : state) benchmark::DoNotOptimize(statics.solve(specimen, options(bilateral, true)));
}

void all_sets(benchmark::State& state, bool bilateral) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        statics::solve_all(paper_specimens(), options(bilateral, false), static_cast<int>(state.range(0))));
}

#define EACH(function, name, bilateral)        \
  BENCHMARK_CAPTURE(function, name, bilateral) \
      ->Unit(benchmark::kMillisecond)          \
      ->MeasureProcessCPUTime()                \
      ->UseRealTime()

EACH(one_angle, bilateral, true)->Arg(0)->Arg(45);
EACH(one_angle, unilateral, false)->Arg(0)->Arg(45);
EACH(next_angle, bilateral, true)->Arg(45);
EACH(next_angle, unilateral, false)->Arg(45);
EACH(all_sets, seven_angles_nine_sets_bilateral, true)->Arg(1)->Arg(4)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
