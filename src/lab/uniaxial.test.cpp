// The press room: the jump start and its rule.
#include "lab/uniaxial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"

namespace phy {
namespace {

Recipe small_recipe() {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.bedding = {BeddingRecipe{}};
  r.bedding[0].theta = 60.0;
  r.bedding[0].spacing = 0.002;
  r.test.platen_speed = 0.1;
  r.test.history_interval = 20;
  return r;
}

const std::shared_ptr<const Specimen>& specimen() {
  static const std::shared_ptr<const Specimen> one = [] {
    const Recipe r = small_recipe();
    const auto packing = std::make_shared<const Packing>(make_packing(r.specimen, r.packing, r.matrix));
    return std::make_shared<const Specimen>(make_specimens(packing, r).front());
  }();
  return one;
}

TestResult press(double jump_strain) {
  Recipe r = small_recipe();
  r.test.jump_strain = jump_strain;
  GroupOptions options;
  options.isa = native_isa();
  options.interval = static_cast<int>(r.test.history_interval);
  const auto group = make_group(specimen()->packing, options);
  UniaxialTest test(specimen(), r, *group, 0);
  do group->advance();
  while (!test.after_block());
  return test.take_result();
}

double number(const TestResult& r, const std::string& name) {
  for (const Number& n : r.numbers)
    if (n.name == name) return n.value;
  return std::nan("");
}
std::string note(const TestResult& r, const std::string& name) {
  for (const Number& n : r.numbers)
    if (n.name == name) return n.note;
  return "absent";
}

TEST(JumpStart, StartsLoadedAndKeepsTheBooks) {
  const double strain = 5e-4;
  const TestResult plain = press(0.0), jumped = press(strain);
  ASSERT_EQ(jumped.outcome.status, Status::peaked);
  const HistoryRow& first = jumped.history.rows.front();
  EXPECT_GT(first.axial_strain, strain);
  EXPECT_LT(first.axial_strain, strain + 1e-5) << "one row later";
  EXPECT_EQ(first.n_cracks, 0.0);
  EXPECT_NEAR(first.axial_stress / first.axial_strain_gauge / number(plain, "E_small"), 1.0, 0.1);
  // What the damped cycles have left of the jump's work is what the springs hold: half of stress times
  // strain.
  const double held = first.boundary_work - first.damping - first.slip;
  EXPECT_NEAR(held / (0.5 * first.axial_stress * first.axial_strain * 0.008 * 0.016), 1.0, 0.1);
  EXPECT_LT(number(jumped, "energy_error"), 5e-3);
  EXPECT_LT(jumped.history.rows.size(), plain.history.rows.size());
  EXPECT_NEAR(number(jumped, "ucs") / number(plain, "ucs"), 1.0, 0.1);  // chance, on 330 grains
}

// A jump so far that a bond or joint would break the moment strengths return is taken back: the test is then
// the plain one, to the last bit.
TEST(JumpStart, SpecimenAtItsStrengthIsRunWithoutIt) {
  const TestResult plain = press(0.0), too_far = press(2e-3);
  ASSERT_LT(plain.cracks.front().strain, 2e-3) << "the jump is to go beyond first breakage";
  EXPECT_EQ(too_far.hash, plain.hash);
  EXPECT_EQ(too_far.history.rows.front().step, plain.history.rows.front().step);
  EXPECT_EQ(number(too_far, "sigma_first_crack"), number(plain, "sigma_first_crack"));
  EXPECT_FALSE(note(too_far, "sigma_ci").starts_with("below")) << "nothing was jumped over";
}

}  // namespace
}  // namespace phy
