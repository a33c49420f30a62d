// Cutting: a disc, or half a disc with a notch, from the middle of a packing.
#pragma once
#include <memory>

#include "records/recipe.hpp"
#include "records/specimen.hpp"
#include "records/test_description.hpp"

namespace phy::genesis {

/// The discs whose centres lie within diameter / 2 [m] of the box's centre, in their order, in a square box
/// that holds them all, centre on centre. Centres decide, not outlines: on average the rough rim then lies at
/// the diameter asked for. The report stays that of the packing it was cut from. 0 < diameter <= the smaller
/// side.
Packing cut_disc(const Packing& packing, double diameter);

/// The upper half of such a disc, flat face down, in a box that holds it: the middle of the flat face is at
/// (width / 2, largest radius). A notch is sawn: the grains whose centres lie within half its width of the
/// axis, and that lie below its end as a whole, are taken out; on average the first grain left on the axis
/// then has its centre at the end. It is wider than a largest grain by `bond_gap` [m], so that no two grains
/// touch or are bonded across it; a cut of the bonds alone would leave flanks that press and rub on each
/// other. 0 < diameter <= width and twice the height; `bond_gap` is the matrix's.
Packing cut_half_disc(const Packing& packing, const SpecimenCut& cut, double bond_gap);

Packing cut_hole(const Packing& packing, double diameter);

/// The packing in the shape that the recipe's test needs: as it is, or what is cut from it.
std::shared_ptr<const Packing> shaped(std::shared_ptr<const Packing> packing, const Recipe& recipe);

}  // namespace phy::genesis
