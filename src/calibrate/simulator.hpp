// What a calibration knows of the model: a recipe goes in, an answer comes out. Another simulator can take
// the place of this program's own by answering the same two questions.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/elastic.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "study/mpi.hpp"
#include "study/work.hpp"

namespace phy::calibrate {

/// The user has asked to stop: what a simulator throws in place of an answer, and the one way in which a
/// calibration ends early.
struct Stopped {};

/// What a direct solution is asked for.
enum class Statics {
  one_sided,   ///< contacts that open carry nothing
  two_sided,   ///< contacts also pull: one linear system, five times faster
  with_rates,  ///< two-sided, with derivatives by the stiffness parameters
};

/// On which grains a test is done.
enum class Grains { own, coarse };

/// All recipes here stand for one specimen: no test.angles, the bedding at its final angle (or none).
class Simulator {
 public:
  virtual ~Simulator() = default;
  /// Small-strain E and nu.
  std::vector<ElasticResult> elastic(const std::vector<Recipe>& recipes, Statics what);
  /// Laboratory tests. Results in the order of the recipes; equal recipes are one test.
  std::vector<TestResult> test(const std::vector<Recipe>& recipes, Grains grains = Grains::own);
  /// What was asked for and answered so far.
  const SimulatorCount& count() const { return count_; }
  /// As many as the user gives the calibration, also for what it computes itself.
  virtual int threads() const { return 1; }

 private:
  SimulatorCount count_;

  /// The two questions. May throw Stopped; where stopped() is true afterwards the answer is dropped.
  virtual std::vector<ElasticResult> solve(const std::vector<Recipe>& recipes, Statics what) = 0;
  virtual std::vector<TestResult> run(const std::vector<Recipe>& recipes) = 0;
  /// True once the user has asked to stop.
  virtual bool stopped() const = 0;
};

/// How far the tests of the present batch are.
struct TestProgress {
  std::size_t n_done = 0, n_total = 0;
  std::size_t n_new = 0;      ///< of those done: not known from a store
  double seconds_left = 0.0;  ///< of this batch; 0: not known yet
};

/// Where specimens go whose tests keep pictures (keeps_pictures()): a store holds numbers, curves and cracks
/// alone.
class SpecimenSink {
 public:
  virtual ~SpecimenSink() = default;
  /// False: the test is done again, though the store may have its numbers.
  virtual bool holds(const Recipe& recipe) = 0;
  virtual void add(const Specimen& specimen, const Recipe& recipe, const TestResult& result) = 0;
};
/// States or displacement fields through the test.
bool keeps_pictures(const Recipe& recipe);

struct SimulatorOptions {
  int threads = 1;
  std::string store;  ///< SQLite file of finished tests (study/store.hpp); empty: kept until the end only
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const TestProgress&)> on_progress;             ///< from a worker, one at a time
  std::function<void(const study::WorkReport&)> on_work = nullptr;  ///< after every batch of tests
  /// A running test after each block; from a worker, one at a time.
  std::function<void(const RunningTest&)> on_reading = nullptr;
  bool with_untrusted = false;          ///< tests that are not to be trusted count like the others
  SpecimenSink* sink = nullptr;         ///< called from a worker, one at a time; null: pictures are lost
  const study::Ranks* ranks = nullptr;  ///< that run tests, too; null: none
};

/// This program: packings from the cache, statics, press. Tests that the store holds are not run again.
std::unique_ptr<Simulator> make_simulator(SimulatorOptions options);

}  // namespace phy::calibrate
