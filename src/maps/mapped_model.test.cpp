// Maps of models: that each varies all that a calibration seeks.
#include "maps/mapped_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace phy::maps {
namespace {

/// Bonds with directions, of stiffness too or of strength alone.
Recipe foliated(bool stiffness) {
  Recipe r;
  r.matrix.stiffness_ratio = stiffness ? 1.5 : 1.0;
  r.matrix.tension_ratio = 1.2, r.matrix.cohesion_ratio = 0.8, r.matrix.cohesion_oblique = 1.3;
  r.matrix.shear_strength = ShearStrength::cohesion_friction, r.matrix.phi = 10.0;
  return r;
}

// A parameter that no map varies would begin its search without any expectation.
TEST(MappedModels, AllRatiosAreVariablesOfTheirMap) {
  Recipe crossing, intact;
  crossing.bedding.resize(1), crossing.bedding[0].rule = BeddingRule::crossing;
  Recipe both = crossing, with_bridges = crossing;
  with_bridges.bedding[0].persistence = 0.5;
  both.matrix = foliated(false).matrix;
  for (const Recipe& model : {crossing, with_bridges, foliated(true), both, intact}) {
    const MappedModel* mapped = mapped_model_of(model);
    ASSERT_NE(mapped, nullptr);
    for (const Parameter* p : strength_parameters(model))
      // joints of the maps stick without friction, and only tables of direct shear ask for it
      EXPECT_TRUE(p == &matrix_sigma_c || p == &joint_phi ||
                  std::any_of(mapped->variables.begin(), mapped->variables.end(),
                              [&](const MapVariable& l) { return l.parameter == p; }))
          << mapped->name << ' ' << p->key;
  }
}

}  // namespace
}  // namespace phy::maps
