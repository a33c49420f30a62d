// Guesses of the length of a test beside the test.
#include "study/expected.hpp"

#include <gtest/gtest.h>

#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "study/work.hpp"

namespace phy::study {
namespace {

Recipe rock(TestKind kind) {
  Recipe r;
  r.specimen = {0.014, 0.016};
  r.packing.n_grains = 0, r.packing.porosity = 0.16;
  r.test.kind = kind, r.test.platen_speed = 0.1;
  return r;
}

std::shared_ptr<const Specimen> specimen(const Recipe& r) {
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  return std::make_shared<const Specimen>(genesis::make_specimens(packing, r).front());
}

// Some hundred radii are drawn, with a coefficient of variation of r^2 of 0.3; a rim of a disc cuts grains.
TEST(Expected, GrainsOfTheSpecimenThatRuns) {
  for (const TestKind kind : {TestKind("uniaxial"), TestKind("brazilian")})
    for (const auto distribution : {RadiusDistribution::by_number, RadiusDistribution::by_area}) {
      Recipe r = rock(kind);
      r.packing.distribution = distribution;
      EXPECT_NEAR(expected_grains(r) / static_cast<double>(specimen(r)->packing->discs.size()), 1.0, 0.04);
    }
}

// Largest resident set of whole runs less that of the program: the paper's specimen at seven angles 238 MB;
// 49,760 discs that end in their first rows, which hold no frames and one snapshot yet, 182 MB.
TEST(Expected, MemoryAsMeasuredOrMore) {
  Recipe paper, large;
  large.specimen = {0.098, 0.196}, large.packing.n_grains = 49760;
  EXPECT_GT(expected_memory(paper, 7), 238e6);
  EXPECT_LT(expected_memory(paper, 7), 1.3 * 238e6);
  EXPECT_GT(expected_memory(large, 1), 182e6);
  EXPECT_LT(expected_memory(large, 1), 2.0 * 182e6);
}

TEST(Expected, CostWithinAFactorOfTwo) {
  for (const TestKind kind : {TestKind("uniaxial"), TestKind("brazilian"), TestKind("direct_shear")}) {
    Recipe r = rock(kind);
    r.test.normal_stress = 5e6;
    r.test.max_strain = kind == TestKind("direct_shear") ? 0.004 : 0.01;
    const TestResult result = lab::run_alone(specimen(r), r);
    ASSERT_NE(result.outcome.status, Status::not_settled) << result.outcome.reason;
    const double ratio = static_cast<double>(result.n_steps * result.n_grains) / expected_cost(r);
    EXPECT_GT(ratio, 0.5) << kind->name;
    EXPECT_LT(ratio, 2.0) << kind->name;
  }
}

// One finished test tells how far expected costs are off; before it, nothing does.
TEST(ProgressOfTests, HasNoTimeLeftBeforeOneHasFinished) {
  Progress p;
  p.work = 10.0, p.cost_left = 500.0;
  EXPECT_EQ(p.seconds_left(2.0), 0.0);
  // It was expected to cost 100 and took 50; 400 more are expected, of which 30 are done.
  p.work = 80.0, p.work_new = 50.0, p.cost_new = 100.0, p.cost_left = 400.0;
  EXPECT_DOUBLE_EQ(p.seconds_left(16.0), 16.0 * (250.0 - 80.0) / 80.0);
}

}  // namespace
}  // namespace phy::study
