// From a study to its work: every point on every packing and bond seed is split into specimens; specimens
// that occur twice (the base of one_at_a_time, the intact rock) are run once.
//
// Tests of one packing, boundary, contact model, stiffness convention and block length can share a group of
// lanes: a batch. Within a batch the longest come first, so that lanes and cores run out of work together.
// The length of a test is not known before its peak; a guess is enough for the order and, scaled by what
// finished tests took, for the remaining time.
//
// Tests whose bedding lies at the same angles are of one group. A contact that is a smooth joint in some
// lanes only is computed by both laws, so lanes of one group run up to twice as fast as those of seven
// angles: a worker that needs a test is given one of the group that its lanes hold, if there is one
// (task_queue.hpp).
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "records/specimen.hpp"
#include "study/design.hpp"

namespace phy::study {

/// A specimen's place in the design.
struct Run {
  std::size_t point = 0;
  std::int64_t packing = 0, bond_seed = 0;
  std::size_t place = 0;  ///< among the specimens of the point: the angles, then the intact rock
  std::size_t test = 0;   ///< in Plan::tests
};

/// One test to be run.
struct PlannedTest {
  std::string key;    ///< specimen_key; empty where the specimen is made already
  Recipe recipe;      ///< of this one specimen; of one that is made already that of the run
  double cost = 0.0;  ///< expected [cycles times grains], a guess
  std::size_t batch = 0;
  std::size_t group = 0;                               ///< equal for equal angles of the bedding
  std::shared_ptr<const Specimen> specimen = nullptr;  ///< made already; none: made when a worker takes it
};

/// Tests that can share a group, longest first.
struct Batch {
  std::vector<std::size_t> tests;
};

struct Plan {
  Study study;
  std::vector<Point> points;
  std::vector<Run> runs;  ///< by point, packing, bond seed, place
  std::vector<PlannedTest> tests;
  std::vector<Batch> batches;
};

/// Part i of n of the tests, i = 1 ... n. Every part has its share of long and short tests.
struct Shard {
  int i = 1, n = 1;
};

Plan make_plan(const Study& study, const Shard& shard = {});

/// A plan of given specimens without a study around them: run i is specimen i; equal ones are one test.
Plan plan_of(const std::vector<Recipe>& singles, Solver solver = Solver::dynamic);

/// A plan of specimens that are made already, all of one packing: test i is specimen i by recipe i; equal
/// ones stay two tests.
Plan plan_of(const std::vector<std::shared_ptr<const Specimen>>& specimens,
             const std::vector<Recipe>& recipes);

}  // namespace phy::study
