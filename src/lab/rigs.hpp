// What the rigs of several tests are made of: walls and platens as lists of grains (engine/rig.hpp), and what
// a history and a text say of them.
#pragma once
#include <string>

#include "engine/rig.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy {

/// A rigid flat wall through `point` whose `normal` (unit) points into the specimen. All grains may touch it.
Tool flat_wall(const Packing& packing, std::string name, Vec2 point, Vec2 normal, bool rough);

/// Two flat platens at the bottom and the top of the box: the press. Tools 0 and 1.
Rig platens(const Packing& packing);
/// Axial stress of the press, from both platens and from each.
const HistoryColumns& platen_stress_columns();
/// "Two rigid platens (friction 0) closed at 0.05 m/s each".
std::string platens_text(const TestRecipe& test);

/// Modulus of contact and bond together [Pa]: rock is nearly as stiff.
double contact_modulus(const MatrixRecipe& matrix);

/// Change of the force on a face of rock of that area [m^2/m] per displacement within a block of `time` [s],
/// as an elastic wave [N/m per m].
double wave_stiffness(const MatrixRecipe& matrix, double area, double time);

}  // namespace phy
