// Does a study give the same store whatever the threads, the company in the lanes, and the processes at it?
#include "study/task_queue.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"
#include "records/test_description.hpp"
#include "study/experiment.hpp"
#include "study/store_queue.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"
#include "study/worker.hpp"

namespace phy::study {
namespace {

class Queues : public InFolder {
 protected:
  void SetUp() override {
    ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    io::write_file(at("base.toml"),
                   "[specimen]\nwidth = \"7 mm\"\nheight = \"8 mm\"\n[packing]\nn_grains = 143\n[matrix]\n"
                   "sigma_c = \"40 MPa\"\ntau_c = \"40 MPa\"\n[[bedding]]\nspacing = \"2 mm\"\n[test]\n"
                   "angles = [\"45 deg\", \"60 deg\"]\nintact = true\nplaten_speed = \"0.5 m/s\"\n");
  }
  Plan plan(const std::string& text, Shard shard = {}) const {
    io::write_file(at("study.toml"), "recipe = \"base.toml\"\n" + text);
    return make_plan(read_study(at("study.toml")), shard);
  }
  /// Progress at the end of a study by one worker.
  static Progress progress_after(const Plan& plan, Store& store) {
    const Hooks none;
    StoreQueue queue(plan, store, none, 1);
    MachineOptions machine;
    machine.isa = engine::native_isa();
    work_at(queue, plan, machine);
    return queue.progress();
  }
  static WorkReport work(const Plan& plan, Store& store, int threads, const Hooks& hooks = {}) {
    MachineOptions machine;
    machine.isa = engine::native_isa();
    machine.threads = threads;
    StoreQueue queue(plan, store, hooks, threads);
    return work_at(queue, plan, machine);
  }
};

const char* two_packings =
    "packings = [1, 2]\n[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n"
    "[[vary]]\nkey = \"engine.precision\"\nvalues = [\"double\", \"float\"]\n";

TEST_F(Queues, ThreadsAndLanesChangeNothing) {
  const Plan p = plan(two_packings);
  Store one(at("1.sqlite")), four(at("4.sqlite"));
  work(p, one, 1);
  work(p, four, 4);
  EXPECT_EQ(one.size(), p.tests.size());
  EXPECT_EQ(hash_of(rows_of(p, one)), hash_of(rows_of(p, four)));
}

TEST_F(Queues, AWorkerIsGivenTheAngleThatItsLanesHold) {
  const Plan p = plan("[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n");  // 45, 60 deg, intact
  PlanQueue queue(p, {}, 2);
  const Assignment first = queue.enter();
  EXPECT_EQ(first.n_tests, 4U) << "half of seven";
  const std::size_t batch = first.batch;
  std::optional<std::size_t> one, two;
  std::vector<std::size_t> kinds_one, kinds_two;
  for (int i = 0; i < 3; ++i) {  // two workers in turn
    one = queue.take(batch, one), two = queue.take(batch, two);
    kinds_one.push_back(p.tests[*one].group), kinds_two.push_back(p.tests[*two].group);
  }
  EXPECT_EQ(std::set<std::size_t>(kinds_one.begin(), kinds_one.end()).size(), 1u);
  EXPECT_EQ(std::set<std::size_t>(kinds_two.begin(), kinds_two.end()).size(), 1u);
  EXPECT_NE(kinds_one[0], kinds_two[0]) << "the second worker begins another angle";
  const auto last = queue.take(batch, one);
  ASSERT_TRUE(last);
  EXPECT_TRUE(p.tests[*last].recipe.bedding.empty()) << "what is left";
  EXPECT_FALSE(queue.take(batch, last));
}

// Or the others would keep away from a group that nobody is at any more.
TEST_F(Queues, AWorkerThatLeavesIsAtNoGroup) {
  const Plan p = plan("[[vary]]\nkey = \"bedding.mu\"\nvalues = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7]\n");
  PlanQueue queue(p, {}, 2);
  const std::size_t batch = queue.enter().batch;
  const auto one = queue.take(batch, {});
  queue.leave(batch, one);
  const std::size_t again = queue.enter().batch;
  const auto two = queue.take(again, {});
  EXPECT_EQ(p.tests[*two].group, p.tests[*one].group) << "still the group with most work";
}

TEST_F(Queues, ARowIsTheTestOfItsRecipeRunAlone) {
  const Plan p = plan(two_packings);
  Store store(at("s.sqlite"));
  work(p, store, 2);
  for (const std::size_t t : {std::size_t{0}, p.tests.size() - 1}) {
    const Recipe& r = p.tests[t].recipe;
    const auto results = run_tests({specimen_of(packing_of(r), r)}, r, {1, 0, 4, engine::native_isa()});
    const auto row = store.find(p.tests[t].key);
    ASSERT_TRUE(row);
    EXPECT_EQ(row->result.hash, results[0].hash);
    EXPECT_EQ(phy::hash_of(row->result).size(), results[0].hash.size());
    EXPECT_EQ(row->result.history.rows.size(), results[0].history.rows.size());
  }
}

/// Every row of a plan is the test of its recipe run alone.
void expect_rows_as_alone(const Plan& p, Store& store) {
  for (const PlannedTest& t : p.tests) {
    const auto alone =
        run_tests({specimen_of(packing_of(t.recipe), t.recipe)}, t.recipe, {1, 0, 4, engine::native_isa()});
    const auto row = store.find(t.key);
    ASSERT_TRUE(row);
    EXPECT_EQ(row->result.hash, alone[0].hash) << alone[0].name;
  }
}

// All lanes of a group have one stiffness convention, masses of one kind, flat joints of one number of
// elements (one and the same number shares its lanes): tests that differ in these may not share a batch.
TEST_F(Queues, WhatAllLanesShareDoesNotMix) {
  for (const char* study :
       {"[[vary]]\nkey = \"matrix.stiffness_convention\"\nvalues = [\"pfc31\", \"pfc5\"]\n",
        "[[vary]]\nkey = \"engine.grain_inertia\"\nvalues = [\"disc\", \"equal\"]\n",
        "[set]\n\"matrix.model\" = \"flat_joint\"\n[[vary]]\nkey = \"matrix.elements\"\nvalues = [2, 3]\n"
        "[[vary]]\nkey = \"matrix.mu\"\nvalues = [0.3, 0.6]\n"}) {
    SCOPED_TRACE(study);
    const Plan p = plan(study);
    EXPECT_EQ(p.batches.size(), 2u);
    Store store(at("s.sqlite"));
    work(p, store, 1);
    expect_rows_as_alone(p, store);
  }
}

// The file alone does not make the packing: its size and whether its overlaps carry stress are the recipe's.
TEST_F(Queues, AnImportedPackingIsMadeForEverySize) {
  io::write_file(at("discs.txt"),
                 "x [m],y [m],r [m]\n0.002,0.002,0.001\n0.004,0.002,0.001\n0.003,0.0037,0.001\n");
  io::write_file(at("base.toml"),
                 "[specimen]\nwidth = \"7 mm\"\nheight = \"8 mm\"\n[packing]\nfile = \"discs.txt\"\n");
  const Plan p = plan("[[vary]]\nkey = \"specimen.height\"\nvalues = [\"8 mm\", \"9 mm\"]\n");
  EXPECT_EQ(p.batches.size(), 2u);
}

TEST_F(Queues, ShardsMergeToTheWhole) {
  Store whole(at("whole.sqlite")), joined(at("joined.sqlite"));
  const Plan p = plan(two_packings);
  work(p, whole, 2);
  for (int i = 1; i <= 3; ++i) {
    const std::string file = at(("part" + std::to_string(i)).c_str());
    {
      Store part(file, Sharing::alone);
      work(plan(two_packings, {i, 3}), part, 1);
    }
    EXPECT_TRUE(joined.merge(file).different.empty());
  }
  EXPECT_EQ(hash_of(rows_of(p, joined)), hash_of(rows_of(p, whole)));
}

TEST_F(Queues, TwoStudiesShareWhatIsTheSame) {
  Store store(at("s.sqlite"));
  work(plan("[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1]\n"), store, 1);
  std::size_t n = 0;
  Hooks hooks;
  hooks.on_result = [&](std::size_t, const TestResult&) { ++n; };
  work(plan("[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n"), store, 1, hooks);
  EXPECT_EQ(n, 2u) << "the new level at two angles; the intact rock is known";
}

TEST_F(Queues, StopKeepsWhatIsFinishedAndGivesTheRestBack) {
  const Plan p = plan(two_packings);
  Store store(at("s.sqlite")), whole(at("whole.sqlite"));
  std::atomic<bool> stop{false};
  Hooks hooks;
  hooks.stop = &stop;
  hooks.on_result = [&](std::size_t, const TestResult&) { stop = true; };
  work(p, store, 1, hooks);
  EXPECT_GE(store.size(), 1u);
  EXPECT_LT(store.size(), p.tests.size());
  EXPECT_EQ(store.n_claimed(), 0u);
  work(p, store, 2);
  work(p, whole, 2);
  EXPECT_EQ(hash_of(rows_of(p, store)), hash_of(rows_of(p, whole)));
}

TEST_F(Queues, FailuresAreStoredWithAdviceAndTheStudyGoesOn) {
  const Plan p =
      plan("design = \"full_factorial\"\n[[vary]]\nkey = \"test.max_strain\"\nvalues = [0.0005, 0.05]\n");
  Store store(at("s.sqlite"));
  const Progress now = progress_after(p, store);
  EXPECT_EQ(now.n_done, 6u);
  std::size_t n_short = 0, n_failed = 0;
  for (const StoredResult& row : store.rows()) {
    n_short += row.result.outcome.status == Status::not_peaked ? 1 : 0;
    if (row.result.outcome.status == Status::peaked) continue;
    ++n_failed;
    EXPECT_FALSE(row.result.outcome.advice.empty()) << row.result.name;
  }
  EXPECT_EQ(n_short, 3u);
  EXPECT_EQ(now.n_failed, n_failed);  // untrusted ones are among them: the platens are fast here
}

// As of a rank that was stopped alone (study/mpi.hpp): a calibration would take a hole for an answer.
TEST_F(Queues, AnInterruptedTestGoesToTheNextWorkerUnlessAllAreStopped) {
  const Plan p = plan("[set]\n\"packing.seed\" = 3\n");
  Store store(at("s.sqlite"));
  std::atomic<bool> stop{false};
  Hooks hooks;
  hooks.stop = &stop;
  StoreQueue queue(p, store, hooks, 1);
  const Assignment a = queue.enter();
  const auto give_out = [&] { return queue.take(a.batch, {}); };
  std::vector<std::size_t> first, second;
  while (const auto test = give_out()) first.push_back(*test);
  ASSERT_EQ(first.size(), p.tests.size());
  for (const std::size_t test : first) queue.deliver_from("elsewhere", test, TestResult());
  while (const auto test = give_out()) second.push_back(*test);
  EXPECT_EQ(second, first);
  stop = true;
  for (const std::size_t test : second) queue.deliver_from("elsewhere", test, TestResult());
  stop = false;
  EXPECT_FALSE(give_out()) << "left for the next run";
}

// Of discs cut from a packing that is given by its porosity.
TEST_F(Queues, WorkIsCountedInTheGrainsThatRan) {
  io::write_file(at("base.toml"),
                 "[specimen]\nwidth = \"7 mm\"\nheight = \"8 mm\"\n[packing]\nporosity = 0.16\nn_grains = 0\n"
                 "[test]\nkind = \"brazilian\"\nplaten_speed = \"0.2 m/s\"\n");
  const Plan p = plan("packings = [1, 2]\n");
  Store store(at("s.sqlite"));
  const Progress now = progress_after(p, store);
  EXPECT_GT(now.work, 0.0);
  EXPECT_EQ(now.work_new, now.work) << "all tests are finished";
}

// Discs beside the box cannot be adopted: that is an outcome of this point, not the end of the study.
TEST_F(Queues, APackingThatCannotBeMadeIsAnOutcome) {
  io::write_file(at("discs.csv"), "x [m],y [m],r [m]\n1,1,0.001\n");
  const Plan p = plan("[set]\n\"packing.seed\" = 3\n");
  Plan broken = p;
  for (PlannedTest& t : broken.tests) t.recipe.packing.file = at("discs.csv");
  Store store(at("s.sqlite"));
  work(broken, store, 2);
  ASSERT_EQ(store.size(), 3u);
  for (const StoredResult& row : store.rows()) {
    EXPECT_EQ(row.result.outcome.status, Status::not_settled);
    EXPECT_FALSE(row.result.outcome.advice.empty());
  }
}

TEST_F(Queues, TheTableHasARowPerSpecimenOfTheDesign) {
  const Plan p =
      plan("packings = [1, 2]\n[[vary]]\nkey = \"bedding.rule\"\nvalues = [\"zone\", \"crossing\"]\n");
  Store store(at("s.sqlite"));
  const std::string empty = study_csv(p, rows_of(p, store));
  EXPECT_EQ(std::count(empty.begin(), empty.end(), '\n'), 1 + 12);
  work(p, store, 2);
  const std::string text = study_csv(p, rows_of(p, store));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 12);
  EXPECT_EQ(text.find("not run"), text.npos);
  for (const char* part : {"bedding.rule,", ",ucs [Pa],", ",crossing,", ",peaked,"})
    EXPECT_NE(text.find(part), text.npos) << part;
}

TEST_F(Queues, TheTableHasWhatEachAngleWasLoadedWith) {
  const Plan p = plan(
      "[[vary]]\nkey = \"bedding.rule\"\nvalues = [\"zone\"]\n"
      "[by_angle]\n\"test.stop_at\" = [0.5, 0.6, 0.7]\n");
  const std::string text = study_csv(p, std::vector<std::optional<StoredResult>>(p.tests.size()));
  for (const char* part : {"theta [deg],test.stop_at,intact,bedding.rule,n_cracks", ",0.5,0,zone,",
                           ",0.6,0,zone,", ",,0.7,1,zone,"})
    EXPECT_NE(text.find(part), text.npos) << part << "\n" << text;
}

}  // namespace
}  // namespace phy::study
