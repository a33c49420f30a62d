// Does anything join the two bodies that load a specimen?
#pragma once
#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::lab {

/// Throws InputError, saying what to change, unless a chain of contacts leads from one loading body of the
/// recipe's test to the other: a specimen without one carries nothing, however long it is pressed. A body
/// reaches the grains that it grips, and those less than their radius away from it.
void check_load_path(const Specimen& specimen, const Recipe& recipe);

}  // namespace phy::lab
