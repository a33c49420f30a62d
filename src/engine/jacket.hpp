// A flexible jacket: a pressure p along x on both sides of the specimen, on the grains that are its surface.
//
// The surface is what horizontal rays from outside meet first, where the grains are now; every ray stands for
// its piece of height h, so a grain carries p h per ray. A grain that is pushed in between others is shadowed
// by them and no longer pressed; the grains behind it that are now exposed are pressed instead. Rays that
// pass the specimen, where the platens have come in, press on nothing. Like a liquid behind thin rubber the
// jacket carries no load itself.
//
// It is looked for once per block of cycles; in between every grain keeps its force. So the work of a block
// is exactly p times the area that the jacket sweeps, sum_i h_i du_i, and the lateral strain is the sum of
// these areas over that of the specimen.
#pragma once
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace phy::engine {

/// Height [m] of each disc that the jacket presses on, on the left > 0 (it pushes along +x), on the right <
/// 0. Centres `x` and radii `r`; the jacket covers 0 ... `height` by rays `spacing` apart, or a little less.
std::vector<double> jacket_heights(std::span<const Vec2> x, std::span<const double> r, double height,
                                   double spacing);

}  // namespace phy::engine
