// What a group is to its lanes: mates, moves, and states that have no direction.
#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "engine/small_groups.test.hpp"

namespace phy::engine {
namespace {

// Along a joint grains may slide until their centres meet: the branch vector then has no direction, and the
// joint goes on with its own.
TEST(Joint, GrainsPassThroughEachOther) {
  constexpr double R = 3e-4;
  Specimen s = assembly({{0.0, 0.0, R}, {2.0 * R, 0.0, R}}, soft_contact());
  BeddingRecipe set;
  set.theta = 0.0;  // the branch lies in the plane
  set.sigma_n = set.cohesion = 1e3;
  s.bedding = {set};
  s.plane_label = {1, 0};
  bond_touching(s);
  s.contacts[0].kind = ContactKind::joint, s.contacts[0].side = 1;
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    GroupOptions options;
    options.isa = native_isa();
    options.precision = precision;
    options.lanes = 4;
    auto group = make_group(s.packing, options);
    group->load(0, std::make_shared<const Specimen>(s), {});
    for (const double offset : {0.0, 1e-12, -1e-9}) {  // from the meeting of the centres
      group->set_motion(0, 0, {R, 0.0, 0.0}, {0.0, 0.0}, 0.0);
      group->set_motion(0, 1, {-R + offset, 0.0, 0.0}, {0.0, 0.0}, 0.0);
      for (int i = 0; i < 3; ++i) group->advance();
      EXPECT_TRUE(group->health(0).ok) << group->health(0).reason;
      for (const GrainState& g : group->grains(0)) EXPECT_TRUE(std::isfinite(g.ux + g.uy + g.rotation));
    }
  }
}

// Constants of a contact are the same in all lanes: a mate of the other convention would be computed wrongly.
TEST(Group, MatesShareTheStiffnessConvention) {
  MatrixRecipe m;
  const auto one = std::make_shared<const Specimen>(assembly({{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}}, m));
  m.stiffness_convention = StiffnessConvention::pfc5;
  const auto two = std::make_shared<const Specimen>(assembly({{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}}, m));
  GroupOptions options;
  options.lanes = 2;
  const auto group = make_group(one->packing, options), other = make_group(one->packing, options);
  group->load(0, one, {});
  EXPECT_THROW(group->load(1, two, {}), InternalError);
  other->load(0, two, {});
  EXPECT_THROW(other->move_lane(0, *group, 1), InternalError);
  other->load(0, one, {});
  other->move_lane(0, *group, 1);
}

}  // namespace
}  // namespace phy::engine
