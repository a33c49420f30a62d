// What a calibration knows of the model: a recipe goes in, an answer comes out. Another simulator can take
// the place of this program's own by answering the same two questions.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "records/elastic.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"

namespace phy {

/// All recipes here stand for one specimen: no test.angles, the bedding at its final angle (or none).
class Simulator {
 public:
  virtual ~Simulator() = default;
  /// Small-strain E and nu with derivatives. `bilateral`: contacts also pull, five times faster.
  virtual std::vector<ElasticResult> elastic(const std::vector<Recipe>& recipes, bool bilateral) = 0;
  /// Laboratory tests. Results in the order of the recipes; Status::interrupted where the user stopped.
  virtual std::vector<TestResult> test(const std::vector<Recipe>& recipes) = 0;
  /// True once the user has asked to stop.
  virtual bool stopped() const = 0;
};

struct SimulatorOptions {
  int threads = 1;
  std::string store;  ///< SQLite file of finished tests (study/store.hpp); empty: none is kept
  const std::atomic<bool>* stop = nullptr;
  /// Finished and all tests of the present batch; from a worker, one at a time.
  std::function<void(std::size_t done, std::size_t of)> on_progress;
};

/// This program: packings from the cache, statics, press. Tests that the store holds are not run again.
std::unique_ptr<Simulator> make_simulator(SimulatorOptions options);

}  // namespace phy
