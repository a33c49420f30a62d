// A recipe in the commands of PFC2D: contact models and properties of a packing that is already there.
#pragma once
#include <string>

#include "records/recipe.hpp"

namespace phy::report {

/// Commands for PFC2D 6 and later: the matrix (linear contacts with parallel bonds, or flat joints) with its
/// drawn strengths and directions, smooth joints by the recipe's rule. What has no command here is named at
/// the head of the text. Written from PFC's manual and not run there.
std::string pfc_commands(const Recipe& recipe);

}  // namespace phy::report
