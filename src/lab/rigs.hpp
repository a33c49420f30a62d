// Rigs from a packing: the tools of the laboratory as lists of grains (engine/rig.hpp).
#pragma once
#include <string>

#include "engine/rig.hpp"
#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy {

/// Tests with equal names on one packing have the same rig and may share a group.
std::string rig_name(const Recipe& recipe);

/// A rigid flat wall through `point` whose `normal` (unit) points into the specimen. All grains may touch it.
Tool flat_wall(const Packing& packing, std::string name, Vec2 point, Vec2 normal, bool rough);

/// Two flat platens at the bottom and the top of the box: the press. Tools 0 and 1.
Rig platens(const Packing& packing);

/// Thickness of a grip [m]: the recipe's, or four times the largest radius where that is 0.
double grip_thickness(const Recipe& recipe, const Packing& packing);

/// Two grips that hold the grains within `thickness` of the bottom and the top, along y only. Tools 0 and 1.
Rig grips(const Packing& packing, double thickness);

}  // namespace phy
