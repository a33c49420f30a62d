#include "study/elastic_study.hpp"

#include <fmt/format.h>

#include <chrono>

#include "base/clock.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"

namespace phy::study {

ElasticStudy solve_recipe(const Recipe& recipe, statics::Platens platens, int threads,
                          const std::atomic<bool>* stop) {
  ElasticStudy study;
  study.recipe = recipe;
  Recipe with_intact = study.recipe;
  with_intact.test.intact = !recipe.matrix.directional();
  with_intact.test.kind = TestKind("uniaxial");  // the whole specimen, whatever test the recipe names
  study.specimens =
      genesis::make_specimens(genesis::packing_of(recipe, genesis::default_cache_folder(),
                                                  [stop] { return stop != nullptr && stop->load(); }),
                              with_intact);
  const auto start = std::chrono::steady_clock::now();
  statics::ElasticOptions options;
  options.platens = platens, options.stop = stop;
  study.one_sided = statics::solve_all(study.specimens, options, threads);
  options.bilateral = true;
  study.bilateral = statics::solve_all(study.specimens, options, threads);
  study.seconds = seconds_since(start);
  return study;
}

std::vector<NamedFit> fit_all(const ElasticStudy& study, theory::Eq1Loss loss) {
  std::vector<NamedFit> fits;
  for (const bool bilateral : {false, true}) {
    const std::vector<ElasticResult>& results = bilateral ? study.bilateral : study.one_sided;
    std::vector<theory::ModulusReading> readings;
    for (std::size_t i = 0; i < study.n_angles(); ++i)
      readings.push_back({study.theta(i), results[i].E_gauge});
    const auto fit = [&](const char* name, theory::Eq1Reference reference) {
      theory::Eq1Options options;
      options.loss = loss;
      options.reference = reference;
      options.E = results.back().E_gauge;
      fits.push_back({fmt::format("{}, {}", bilateral ? "pulling" : "pushing", name),
                      theory::fit_eq1(readings, options)});
    };
    fit("intact", theory::Eq1Reference::given);
    fit("90 deg", theory::Eq1Reference::measured_90);
    fit("free", theory::Eq1Reference::free);
  }
  return fits;
}

}  // namespace phy::study
