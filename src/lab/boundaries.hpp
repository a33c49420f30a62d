// What the boundaries of several tests are made of: walls and platens as lists of grains
// (engine/boundary.hpp), and what a history and a text say of them.
#pragma once
#include <cstdint>
#include <string>

#include "engine/boundary.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::lab {

/// What the travel and force of two opposite bodies are over.
struct LoadScale {
  double length = 1.0;  ///< strain = travel / length [m]; 1: a displacement stands in the place of the strain
  double area = 1.0;    ///< stress = force / area [m per m thickness]
};

/// The boundary of a test: bodies, and what their travel and force are as strain and stress.
struct TestBoundary {
  engine::Boundary boundary;
  LoadScale axial, lateral;
  double first_wave = 0.0;  ///< strain below which the first wave still runs through: the stop rule sleeps
};

/// Bodies `lo` and `hi`, of which `direction` points from the first to the second, become the axial axis.
void set_axial(TestBoundary& boundary, int lo, int hi, Vec2 direction, LoadScale scale);

/// A rigid flat wall through `point` whose `normal` (unit) points into the specimen. All grains may touch it.
engine::BoundaryBody flat_wall(const Packing& packing, std::string name, Vec2 point, Vec2 normal, bool rough);

/// The grain that a ray from `from` along the unit vector `direction` meets first; -1: none.
std::int64_t first_grain(const Packing& packing, Vec2 from, Vec2 direction);
/// Distance of rays that miss no grain of a surface: a quarter of the smallest radius [m].
double ray_spacing(const Packing& packing);

/// Two flat platens at the bottom and the top of the box: the press. Bodies 0 and 1.
TestBoundary platens(const Packing& packing);
/// Axial stress of the press, from both platens and from each.
const HistoryColumns& platen_stress_columns();
/// "0.05 m/s each", or with the approach before it.
std::string speed_text(const TestRecipe& test);
/// "Two rigid platens (friction 0) closed at 0.05 m/s each".
std::string platens_text(const TestRecipe& test);

/// Change of the force on a face of rock of that area [m^2/m] per displacement within a block of `time` [s],
/// as an elastic wave [N/m per m].
double wave_stiffness(const MatrixRecipe& matrix, double area, double time);

}  // namespace phy::lab
