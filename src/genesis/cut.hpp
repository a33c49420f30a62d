// Cutting: a disc, or half a disc with a notch, from the middle of a packing; a hole or a flaw in its middle.
#pragma once
#include <memory>
#include <string>

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

/// Without the discs whose centres lie less than diameter / 2 [m] from the middle of the box. Centres decide,
/// as of a disc: on average the rough wall lies at the diameter asked for.
Packing cut_hole(const Packing& packing, double diameter);

/// Without the discs of an open flaw through the middle of the box: those whose centres lie within half its
/// width of its axis, and that lie between its ends as a whole; on average the first grain left on the axis
/// has its centre at an end. Its width is that of the specimen, at least so large that no two grains touch or
/// are bonded across it, as of a notch.
Packing cut_flaw(const Packing& packing, const SpecimenSize& flaw, double bond_gap);

/// What the recipe takes out of the middle. Recipes with equal names and one packing have the same grains, if
/// their tests cut the same; empty: nothing.
std::string opening_name(const Recipe& recipe);

/// A specimen with a hole or flaw hangs together: all but a tenth of its grains, some of which never touched
/// any. Throws InputError.
void check_in_one_piece(const Specimen& specimen, const Recipe& recipe);

/// The packing in the shape that the recipe's test needs: as it is, or what is cut from it; without what the
/// recipe takes out of the middle.
std::shared_ptr<const Packing> shaped(std::shared_ptr<const Packing> packing, const Recipe& recipe);

}  // namespace phy::genesis
