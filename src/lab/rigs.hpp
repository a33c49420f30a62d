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

/// The grain that a ray from `from` along the unit vector `direction` meets first; -1: none.
std::int64_t first_grain(const Packing& packing, Vec2 from, Vec2 direction);

/// Bottom and top of a Brazilian test on a disc in the middle of the box: flat platens against the outermost
/// grains, or jaws that hold an arc of `angle` [deg] of the rim. Tools 0 and 1. Axial stress: tension at the
/// centre (analysis/brazilian.hpp); axial strain: approach over `diameter` [m].
Rig jaws(const Packing& packing, double diameter, double angle);

/// The press with sides: walls (tools 2 left, 3 right) or a jacket; none without confining stress.
Rig confined_platens(const Packing& packing, const TestRecipe& test);

/// Two boxes (tools 0 lower, 1 upper) that hold all grains farther than gap / 2 [m] from half the height.
/// Axial: sliding along x, lateral: closing along y, both as displacements [m]; stresses over the width.
Rig shear_boxes(const Packing& packing, double gap);

/// The rig of the recipe's test.
Rig rig_of(const Packing& packing, const Recipe& recipe);

/// Change of the force on a face of rock of that area [m^2/m] per displacement within a block of `time` [s],
/// as an elastic wave [N/m per m].
double wave_stiffness(const MatrixRecipe& matrix, double area, double time);

/// For the servo of a pair of platens of that area, `length` apart [m]: change of force per displacement of
/// each within a block of `time`, of rock as stiff as its contacts, at rest and as a wave [N/m per m].
double block_stiffness(const Specimen& specimen, double area, double length, double time);

/// For the servo of a shear box: normal stiffness at rest of what lies between the boxes, the contacts across
/// half the height in series with layers of sound rock that fill the gap [N/m per m].
double plane_stiffness(const Specimen& specimen, double gap);

}  // namespace phy
