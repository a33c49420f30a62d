// Will what a test leaves for pictures be small enough to be read again?
#pragma once
#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::lab {

/// Throws InputError where the frames and snapshots that the recipe asks for make a scene.bin of more than
/// base/largest_file.hpp: an upper estimate, with half as many contacts again as at the start.
void check_scene_room(const Specimen& specimen, const Recipe& recipe);

}  // namespace phy::lab
