// From a study to its work: every point on every packing and bond seed is split into specimens; specimens
// that occur twice (the base of one_at_a_time, the intact rock) are run once.
//
// Tests of one packing, boundary, contact model, stiffness convention and block length can share a group of
// lanes: a batch. Within a batch the longest come first, so that lanes and cores run out of work together.
// The length of a test is not known before its peak; a guess is enough for the order and, scaled by what
// finished tests took, for the remaining time.
//
// Tests whose bedding lies at the same angles are of one kind. A contact that is a smooth joint in some lanes
// only is computed by both laws, so a group of one kind runs up to twice as fast as one of seven angles: a
// worker that needs a test is given one of the kind that its lanes hold, if there is one (study/runner.hpp).
#pragma once
#include <string>
#include <vector>

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
  std::string key;    ///< specimen_key
  Recipe recipe;      ///< of this one specimen
  double cost = 0.0;  ///< expected [cycles times grains], a guess
  std::size_t batch = 0;
  std::size_t kind = 0;  ///< equal for equal angles of the bedding
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
Plan plan_of(const std::vector<Recipe>& singles);

}  // namespace phy::study
