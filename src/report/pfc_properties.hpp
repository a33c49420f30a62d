// Parameters of a recipe as properties of PFC's contact models: one table for all command files.
#pragma once
#include <string>

#include "records/recipe.hpp"

namespace phy::report {

/// Commands that give all ball-ball contacts of the model linearpbond their stiffness and friction, and the
/// stiffness of their bonds. Strengths are drawn per bond, and none of them.
std::string pfc_matrix_properties(const MatrixRecipe& matrix);

/// Lines of a FISH function that give the smooth joint `c` its properties; not its dip.
std::string pfc_joint_properties(const BeddingRecipe& set);

}  // namespace phy::report
