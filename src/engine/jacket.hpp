// A flexible jacket: a stress on the grains that are a surface of the specimen, its sides or the wall of a
// hole. Compression positive, with two components, along x and along y. On the sides only that along x acts,
// as the pressure of a cell. On the wall of a hole both are equal for a pressure; unequal ones are the
// traction that rock in the place of the hole would exert (excavation by relaxation, lab/opening).
//
// The surface is what rays meet first, where the grains are now: horizontal rays from outside, or rays from
// the middle of the hole. Every ray stands for its piece of the surface, an area vector that points into the
// rock, and a grain carries stress times area. A grain that is pushed in between others is shadowed by them
// and no longer pressed; the grains behind it that are now exposed are pressed instead. Rays that pass the
// specimen, where the platens have come in, press on nothing. Like a liquid behind thin rubber the jacket
// carries no load itself. Around a hole the pieces close, so that a stress leaves no force on the whole.
//
// It is looked for once per block of cycles; in between every grain keeps its force. So the work of a block
// is exactly stress times the area that the jacket sweeps, sum_i a_i . du_i, and on the sides the lateral
// strain is the sum of these areas over that of the specimen.
#pragma once
#include <span>
#include <vector>

#include "base/vec.hpp"
#include "engine/boundary.hpp"

namespace phy::engine {

/// Area [m^2 per m] of each disc that a jacket presses on from the sides: (+height, 0) on the left, (-height,
/// 0) on the right. Centres `x` and radii `r`; the jacket covers 0 ... `height` by rays `spacing` apart, or a
/// little less.
std::vector<Vec2> side_areas(std::span<const Vec2> x, std::span<const double> r, double height,
                             double spacing);

/// The same of the wall of a hole, `spacing` apart where it was cut. What lies nearer to its centre than half
/// its radius has fallen in, and is not seen.
std::vector<Vec2> hole_areas(std::span<const Vec2> x, std::span<const double> r, const Hole& hole,
                             double spacing);

}  // namespace phy::engine
