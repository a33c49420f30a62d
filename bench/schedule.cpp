// How a study or a calibration would scale over threads and ranks that this machine does not have:
//   bench_schedule study STUDY.toml STORE
//   bench_schedule calibrate ROCK.toml EFFORT STORE
// STORE holds the finished tests. The queue gives them out by its own rules to workers of which each has its
// own clock; a block of cycles takes what tests side by side take (study::slowness), and all tests together
// what they took when they were recorded. A calibration is done again with the answers of the store: what it
// computes between tests is measured, as CPU time. Of that the first thread's stays serial; what for_all
// gives to others is a piece per strength of the table, shared out over the threads of rank 0 like direct
// solutions. Not in it: memory that cores share, messages between ranks.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <map>

#include "calibrate/calibration.hpp"
#include "calibrate/simulator.hpp"
#include "engine/kernels.hpp"
#include "jobs/calibration_folder.hpp"
#include "rock/file.hpp"
#include "study/effects.hpp"
#include "study/lane_batch.hpp"
#include "study/study_in.hpp"
#include "study/task_queue.hpp"
#include "system/process.hpp"

namespace {

using namespace phy;
using study::Plan;

struct Machine {
  int ranks = 1, threads = 1;  // threads of each rank
  int workers() const { return ranks * threads; }
};

struct Times {
  double wall = 0.0, busy = 0.0;
};

/// A lane batch in the middle of its course.
struct Lanes {
  engine::GroupOptions group;
  std::size_t batch = 0;
  bool takes = false;  // new tests: it is with the worker that asked the queue for it
  std::vector<std::pair<std::size_t, double>> tests = {};  // with the cycles that each has left
};

struct Clock {
  double time = 0.0, busy = 0.0;
  int rank = 0;
  bool waits = false;
  std::vector<Lanes> mine = {};  // the last one runs
  std::optional<study::Assignment> at = {};
  std::optional<std::size_t> last = {};
};

/// Runs a plan on paper. Tests that have no cycles are finished already.
class Paper {
 public:
  Paper(const Plan& plan, const std::vector<TestResult>& results, const Machine& machine)
      : plan_(plan), results_(results), queue_(plan, {}, machine.workers()) {
    for (int k = 0; k < machine.workers(); ++k) clocks_.push_back({0.0, 0.0, k / machine.threads});
  }

  Times run() {
    for (Clock& c : clocks_) begin(c);
    for (Clock* c = first(); c != nullptr; c = first()) {
      end_block(*c);
      begin(*c);
    }
    Times all;
    for (const Clock& c : clocks_) all.wall = std::max(all.wall, c.time), all.busy += c.busy;
    return all;
  }

 private:
  const Plan& plan_;
  const std::vector<TestResult>& results_;
  study::PlanQueue queue_;
  std::vector<Clock> clocks_;

  Clock* first() {
    Clock* next = nullptr;
    for (Clock& c : clocks_)
      if (!c.waits && (next == nullptr || c.time < next->time)) next = &c;
    return next;
  }

  bool alike(const std::vector<std::pair<std::size_t, double>>& tests) const {
    return std::all_of(tests.begin(), tests.end(), [&](const auto& t) {
      return plan_.tests[t.first].group == plan_.tests[tests.front().first].group;
    });
  }

  void fill(Clock& c, Lanes& lanes, std::size_t most) {
    const auto n = std::min(most, static_cast<std::size_t>(lanes.group.lanes));
    while (lanes.takes && lanes.tests.size() < n) {
      const auto test = queue_.take(lanes.batch, c.last);
      if (!test) return;
      c.last = test;
      lanes.tests.emplace_back(*test, static_cast<double>(results_[*test].n_steps));
    }
  }

  Lanes entered(const study::Assignment& a) const {
    const Recipe& any = plan_.tests[plan_.batches[a.batch].tests.front()].recipe;
    std::vector<std::pair<std::size_t, double>> all;
    for (const std::size_t t : plan_.batches[a.batch].tests) all.emplace_back(t, 0.0);
    Lanes lanes{{}, a.batch, true};
    lanes.group.isa = engine::native_isa(), lanes.group.precision = any.engine.precision;
    lanes.group.interval = static_cast<int>(any.test.history_interval);
    lanes.group.lanes = engine::native_lanes(any.engine.precision, lanes.group.isa);
    lanes.group.lanes = study::fitting_lanes(a.n_tests, alike(all), lanes.group);
    return lanes;
  }

  /// The next block, or none.
  void begin(Clock& c) {
    while (!c.mine.empty() && c.mine.back().tests.empty()) c.mine.pop_back();
    while (c.mine.empty()) {
      if (c.at) queue_.leave(c.at->batch, c.last);
      c.at = queue_.enter(), c.last.reset();
      c.waits = c.at->kind != study::Assignment::Kind::work;
      if (c.waits) return c.at.reset();
      Lanes lanes = entered(*c.at);
      fill(c, lanes, c.at->n_tests);  // as Worker::run_batch
      if (!lanes.tests.empty()) c.mine.push_back(std::move(lanes));
    }
    const Lanes& lanes = c.mine.back();
    const double seconds =
        lanes.group.interval * static_cast<double>(results_[lanes.tests.front().first].n_contacts) *
        study::slowness(lanes.group.lanes, alike(lanes.tests), lanes.group.precision, lanes.group.isa);
    c.time += seconds, c.busy += seconds;
  }

  void end_block(Clock& c) {
    Lanes& lanes = c.mine.back();
    for (auto& [test, left] : lanes.tests) {
      left -= lanes.group.interval;
      if (left <= 0.0) queue_.deliver(test, results_[test]);
    }
    std::erase_if(lanes.tests, [](const auto& t) { return t.second <= 0.0; });
    fill(c, lanes, plan_.tests.size());
    if (lanes.tests.empty()) return;
    if (study::fitting_lanes(lanes.tests.size(), alike(lanes.tests), lanes.group) < lanes.group.lanes) {
      const Lanes wide = std::move(c.mine.back());
      c.mine.pop_back();
      narrow(c, wide);
    }
    share(c);
  }

  /// As LaneBatch::narrowed: one after the other, or fewer lanes.
  void narrow(Clock& c, Lanes wide) const {
    if (study::fitting_lanes(wide.tests.size(), alike(wide.tests), wide.group) > 1)
      return c.mine.push_back(part(wide, wide.tests.size()));
    while (!wide.tests.empty()) c.mine.push_back(part(wide, 1));
  }

  Lanes part(Lanes& whole, std::size_t n) const {
    std::stable_sort(whole.tests.begin(), whole.tests.end(), [&](const auto& a, const auto& b) {
      return plan_.tests[a.first].group < plan_.tests[b.first].group;
    });
    const auto end = whole.tests.begin() + static_cast<std::ptrdiff_t>(n);
    Lanes given{whole.group, whole.batch, whole.takes, {whole.tests.begin(), end}};
    whole.tests.erase(whole.tests.begin(), end);
    given.group.lanes = n > 1 && whole.group.precision == Precision::single_precision ? 4 : 1;
    while (static_cast<std::size_t>(given.group.lanes) < n) given.group.lanes *= 2;
    return given;
  }

  /// With the first of this rank that waits, as run_lane_batch does.
  void share(Clock& giver) {
    auto& mine = giver.mine;
    const auto taker = std::find_if(clocks_.begin(), clocks_.end(),
                                    [&](const Clock& c) { return c.waits && c.rank == giver.rank; });
    if (taker == clocks_.end() || (mine.size() == 1 && mine.back().tests.size() < 2)) return;
    if (mine.size() > 1) {
      taker->mine.push_back(std::move(mine.front()));
      mine.erase(mine.begin());
    } else {
      taker->mine.push_back(part(mine.back(), mine.back().tests.size() / 2));
    }
    taker->mine.back().takes = false;
    taker->waits = false, taker->time = giver.time;
    begin(*taker);
  }
};

/// CPU [s] of the first thread, and of all others.
struct Cpu {
  double serial = 0.0, shared = 0.0;
};

/// Time of `n` equal pieces that take `seconds` together on so many threads.
double shared_out(double seconds, std::size_t n, int threads) {
  const auto rounds =
      static_cast<double>((n + static_cast<std::size_t>(threads) - 1) / static_cast<std::size_t>(threads));
  return n == 0 ? 0.0 : seconds * rounds / static_cast<double>(n);
}

/// What was done between two questions, and what was asked.
struct Phase {
  Cpu before = {}, solving = {};
  std::size_t n_pieces = 0, n_solutions = 0;
  Plan plan = {};
  std::vector<TestResult> results = {};  // of its tests, in their order
};

/// Answers from a store, and keeps what was asked when.
class Recorder : public calibrate::Simulator {
 public:
  Recorder(const std::string& store, std::size_t n_pieces)
      : own_(calibrate::make_simulator({1, store, nullptr, nullptr})), n_pieces_(n_pieces) {}
  std::vector<Phase> phases;
  /// What was done behind the last question.
  void end() { phases.push_back({lap(), {}, n_pieces_}); }

 private:
  std::unique_ptr<calibrate::Simulator> own_;
  std::size_t n_pieces_;
  Cpu since_ = now();

  static Cpu now() {
    const double first = system::thread_seconds();
    return {first, static_cast<double>(std::clock()) / CLOCKS_PER_SEC - first};
  }
  Cpu lap() {
    const Cpu before = std::exchange(since_, now());
    return {since_.serial - before.serial, since_.shared - before.shared};
  }
  std::vector<ElasticResult> solve(const std::vector<Recipe>& recipes, calibrate::Statics what) override {
    Phase phase{lap(), {}, n_pieces_};
    std::vector<ElasticResult> results = own_->elastic(recipes, what);
    phase.solving = lap(), phase.n_solutions = recipes.size();
    phases.push_back(std::move(phase));
    return results;
  }
  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    Phase phase{lap(), {}, n_pieces_};
    std::vector<TestResult> results = own_->test(recipes);
    phase.plan = study::plan_of(recipes);
    phase.results.resize(phase.plan.tests.size());
    for (const study::Run& r : phase.plan.runs) phase.results[r.test] = results[r.place];
    phase.before.serial += lap().serial;
    phases.push_back(std::move(phase));
    return results;
  }
  bool stopped() const override { return false; }
};

void print(const std::vector<Phase>& phases) {
  double recorded = 0.0, units = 0.0;
  for (const Phase& p : phases) {
    for (const TestResult& r : p.results) recorded += r.seconds;
    units += Paper(p.plan, p.results, {}).run().busy;
  }
  const auto row = [&](const Machine& machine) {
    double serial = 0.0, shared = 0.0, testing = 0.0, busy = 0.0;
    for (const Phase& p : phases) {
      serial += p.before.serial + p.solving.serial;
      shared += shared_out(p.before.shared, p.n_pieces, machine.threads) +
                shared_out(p.solving.shared, p.n_solutions, machine.threads);
      const Times t = Paper(p.plan, p.results, machine).run();
      testing += t.wall * recorded / units, busy += t.busy * recorded / units;
    }
    const double wall = serial + shared + testing;
    fmt::print("{:5} {:7} {:8.1f} {:8.1f} {:9.1f} {:8.1f} {:10.1f} {:7.2f}\n", machine.ranks, machine.threads,
               wall, serial, shared, testing, busy, busy / testing / machine.workers());
    return wall;
  };
  fmt::print("ranks threads  seconds   serial    shared    tests  tests' CPU    busy\n");
  std::map<int, double> wall;
  for (const int threads : {1, 2, 4, 8, 16}) wall[threads] = row({1, threads});
  for (const int ranks : {2, 4}) row({ranks, 16 / ranks});
  row({4, 16});
  fmt::print("from 2 to 16 threads {:.2f}\n", wall[2] / wall[16] / 8.0);
}

std::vector<Phase> study_phases(const std::string& file, const std::string& store) {
  Phase phase;
  phase.plan = study::make_plan(study::read_study(file));
  std::vector<std::string> keys;
  for (const study::PlannedTest& t : phase.plan.tests) keys.push_back(t.key);
  for (const auto& row : study::Store(store, study::Sharing::reading).rows(keys))
    phase.results.push_back(row.value().result);
  std::vector<Phase> phases;
  phases.push_back(std::move(phase));
  return phases;
}

std::vector<Phase> calibration_phases(const std::string& file, const std::string& effort,
                                      const std::string& store) {
  jobs::CalibrationRequest request;
  request.rock = file, request.effort = effort;
  const Evidence evidence(jobs::with_matrix(rock::read_rock(file), request));
  Recorder recorder(store, evidence.strengths.size());
  calibrate::calibrate(evidence, jobs::options_of(request), recorder);
  recorder.end();
  return std::move(recorder.phases);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 3 && words[0] == "study")
      print(study_phases(words[1], words[2]));
    else if (words.size() == 4 && words[0] == "calibrate")
      print(calibration_phases(words[1], words[2], words[3]));
    else
      return fmt::print("bench_schedule study STUDY STORE | calibrate ROCK EFFORT STORE\n"), 2;
  } catch (const std::exception& e) {
    return fmt::print("{}\n", e.what()), 1;
  }
}
