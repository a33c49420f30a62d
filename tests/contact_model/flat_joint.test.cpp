// Flat joints in whole tests: a small uniaxial test with every element count.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/analyse.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "study/worker.hpp"

namespace phy {
namespace {

Recipe small_recipe() {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  MatrixRecipe& m = r.matrix;
  m.model = MatrixModel::flat_joint;
  m.E_c = 76e9, m.mu = 0.5;
  m.sigma_c = 20e6, m.sigma_c_sd = 2e6, m.tau_c = 40e6, m.tau_c_sd = 4e6;
  r.test.platen_speed = 0.1;
  r.test.n_snapshots = 0;
  return r;
}

TestResult run(const Recipe& r) {
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  const auto specimen = std::make_shared<const Specimen>(genesis::make_specimens(packing, r).front());
  return study::run_tests({specimen}, r, study::MachineOptions{}).front();
}

double number(const TestResult& r, const char* name) { return analysis::find(r.numbers, name)->value; }

// Work of the platens = kinetic + held + slip + damping + released, over the whole test and at the usual
// step.
TEST(FlatJointInThePress, EnergyIsAllAccountedFor) {
  for (const int n : {1, 2, 3, 4}) {
    Recipe r = small_recipe();
    r.matrix.elements = n, r.matrix.unbonded_fraction = 0.05;
    const TestResult result = run(r);
    ASSERT_TRUE(has_answer(result.outcome.status)) << result.outcome.reason;
    const HistoryRow& end = result.history.rows.back();
    double released = 0.0;
    for (const CrackEvent& c : result.cracks) released += c.energy;
    EXPECT_NEAR(end.released, released, 1e-9 * released);
    EXPECT_GT(end.slip, 0.0);
    double worst = 0.0;
    for (const HistoryRow& row : result.history.rows)
      if (row.boundary_work > 0.01 * end.boundary_work) worst = std::max(worst, std::fabs(row.energy_error));
    EXPECT_LT(worst, 1.3e-3) << n << " elements";
  }
}

// A failure in tension: elements of an interface break one after the other within a few steps. What is left
// is half of the damping of the step behind the last row, which its kinetic energy has lost already.
TEST(FlatJointInThePress, EnergyOfAFailureInTension) {
  Recipe r = small_recipe();
  r.test.kind = TestKind("direct_tension");
  r.test.platen_speed = 0.015;
  EXPECT_LT(number(run(r), "energy_error"), 2.5e-3);
}

// The two precisions part with the first cracks; until then they are as near as single precision is.
TEST(FlatJointInThePress, FloatIsNearDouble) {
  Recipe r = small_recipe();
  const TestResult one = run(r);
  r.engine.precision = Precision::single_precision;
  const TestResult other = run(r);
  EXPECT_NEAR(number(other, "E_tangent") / number(one, "E_tangent"), 1.0, 5e-3);
  EXPECT_NEAR(number(other, "ucs") / number(one, "ucs"), 1.0, 0.1);
}

// An element breaks on its own: more cracks than contacts have broken, none longer than an element.
TEST(FlatJointInThePress, CracksAreElements) {
  Recipe r = small_recipe();
  r.test.n_snapshots = 1;
  const TestResult result = run(r);
  ASSERT_FALSE(result.cracks.empty());
  std::size_t broken = 0;
  for (const ContactState& c : result.snapshots.back().contacts) broken += c.broken ? 1 : 0;
  EXPECT_GT(result.cracks.size(), 3 * broken);
  for (const CrackEvent& c : result.cracks) EXPECT_LE(c.size, 2.0 / 3.0 * r.packing.radius_max);
}

}  // namespace
}  // namespace phy
