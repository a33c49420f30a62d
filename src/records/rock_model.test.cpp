// The list of models of rock: what a recipe has says which it is, and what a rock file asks for finds it.
#include "records/rock_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace phy {
namespace {

/// A recipe that has what the model says.
Recipe recipe_of(const RockModel& m) {
  Recipe r;
  r.matrix.model = m.matrix;
  if (m.joints) r.bedding.resize(1);
  if (m.bridges) r.bedding[0].persistence = 0.5;
  if (m.directions) r.matrix.tension_ratio = 1.5;
  return r;
}

TEST(RockModels, AreToldApartByTheirRecipes) {
  for (const RockModel& m : rock_models()) {
    EXPECT_EQ(model_of(recipe_of(m)), &m) << m.words;
    EXPECT_EQ(find_model(m.layered, m.layers, m.matrix), &m) << m.words;
    if (m.layered) {
      EXPECT_EQ(layers_of(recipe_of(m)), m.layers) << m.words;
    }
    if (m.contains != nullptr) {
      EXPECT_TRUE(m.contains->matrix == m.matrix && m.contains->layered == m.layered) << m.words;
    }
  }
}

TEST(RockModels, OfFlatJointsHavePlanesWithAndWithoutBridges) {
  for (const LayerModel m : {LayerModel::planes, LayerModel::planes_with_bridges, LayerModel::choose})
    EXPECT_FALSE(of_parallel_bonds(m)) << to_string(m);
  for (const LayerModel m : {LayerModel::directions, LayerModel::planes_and_directions})
    EXPECT_TRUE(of_parallel_bonds(m)) << to_string(m);
  EXPECT_THAT(layers_of_matrix(MatrixModel::flat_joint),
              testing::ElementsAre(testing::StrEq("planes"), testing::StrEq("planes with bridges")));
  const RockModel* bridged = find_model(true, LayerModel::planes_with_bridges, MatrixModel::flat_joint);
  ASSERT_NE(bridged, nullptr);
  EXPECT_EQ(text_of(*bridged, 0.65), "joints on 0.65 of the planes, between flat joints");
}

TEST(RockModels, ARecipeThatNoneIsHasNoModel) {
  Recipe r;
  r.matrix.model = MatrixModel::flat_joint, r.matrix.tension_ratio = 1.5;
  EXPECT_EQ(model_of(r), nullptr);
  EXPECT_EQ(layers_of(r), LayerModel::directions);
}

}  // namespace
}  // namespace phy
