#include "engine/stable_step.hpp"

#include <gtest/gtest.h>

#include "base/rng.hpp"
#include "engine/small_groups.test.hpp"

namespace phy::engine {
namespace {

// The bound is compared with the frequency that the engine itself shows at the edge of stability: a step a
// little below 2/omega_max keeps the energy bounded, which a bound on the unsafe side would not.
TEST(FrequencyBound, FullStepIsStable) {
  Specimen s = assembly(hexagonal(12, 12, 3e-4), soft_contact());
  bond_touching(s);
  GroupOptions options;
  options.isa = native_isa();
  auto group = make_group(s.packing, options);
  LaneSetup setup;
  setup.damping = 0.0;
  setup.step_safety = 1.0;
  const auto shared = std::make_shared<const Specimen>(s);
  group->load(0, shared, setup);
  for (std::uint32_t i = 0; i < s.packing->discs.size(); ++i)
    group->set_motion(0, i, {}, {1e-6 * normal(1, Stream::test, i, 0), 1e-6 * normal(1, Stream::test, i, 1)},
                      1e-3 * normal(1, Stream::test, i, 2));
  group->advance();
  const double start = group->row(0).kinetic + group->row(0).strain_bond;
  for (int i = 0; i < 100; ++i) group->advance();
  EXPECT_LT(group->row(0).kinetic + group->row(0).strain_bond, 3.0 * start);
}

TEST(FrequencyBound, NewContactsOnlyRaiseIt) {
  Specimen s = assembly(hexagonal(6, 6, 3e-4), soft_contact());
  bond_touching(s);
  FrequencyBound bound(s, initial_stiffnesses(contact::standard_models(), s));
  const double before = bound.omega();
  s.matrix = MatrixRecipe{};
  bound.add(stiffness_of(contact::standard_models(), s, {3, 4, ContactKind::touching}, {1.0, 0.0}));
  EXPECT_GT(bound.omega(), before);
  EXPECT_TRUE(bound.loose());
}

}  // namespace
}  // namespace phy::engine
