// A packing: the discs of a specimen, in equilibrium in their box, before anything is bonded.
//
//   1. radii      drawn from [radius_min, radius_max], uniform by number or by area (number density ~ 1/r^2)
//   2. placement  at random in the box, overlapping as it comes; above 200,000 discs in rows (placement.hpp)
//   3. settling   frictionless, to balanced forces (settle.hpp): mean unbalanced force 1e-6 of the mean
//                 contact force, above 200,000 discs 1e-4
//   4. stress     only `isotropic`: radii times 1 + alpha, settled again, until the mean stress is right
//   5. rattlers   discs with fewer than three contacts grow into their cages (rattlers.hpp); then 3, 4 again
//
// Source of the procedure: Potyondy & Cundall 2004, specimen genesis. Differences, and why: discs start at
// full size (the energy minimisation copes with any overlap); the stress is reached by radii alone, walls
// never move, so that the specimen has exactly the size of the recipe. Radii drawn lie in the stated range;
// steps 4 and 5 change them after that (step 4 by some 0.3 %, step 5 a few discs by up to 30 %).
//
// Two ways to say how much rock there is: `n_grains`, or `porosity`. With n_grains = 0 discs are drawn until
// the porosity before step 3 is nearest to the stated one. The paper's 7481 discs of 0.25-0.415 mm in 38 x 76
// mm have a porosity of 0.08 if uniform by number, which is over-compressed (mean overlap 3 % of the
// diameter); it is used `stress_free`: the overlaps are declared to be the undeformed state. Uniform by area
// they have 0.156, a packing that just holds, which can carry a small isotropic stress.
#pragma once
#include <functional>

#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::genesis {

/// Changes whenever the same recipe would give other discs; part of the key of the cache.
constexpr int packing_generation = 1;

/// Makes the packing of a recipe. A pure function: the same bits on every machine. Throws InputError if fewer
/// than two discs or discs larger than the box are asked for. A stress that cannot be reached is reported,
/// not thrown: report.stress_left says what there is; one below what coordinates resolve is an InputError.
/// packing.file is not read here. `stop` is asked now and then; where it says true, Interrupted is thrown.
Packing make_packing(const SpecimenSize& size, const PackingRecipe& recipe, const MatrixRecipe& matrix,
                     const std::function<bool()>& stop = {});

/// A packing of given discs (imported), taken as they are: checks that they lie in the box, measures,
/// fingerprints.
Packing adopt_packing(const SpecimenSize& size, const PackingRecipe& recipe, const MatrixRecipe& matrix,
                      std::vector<Disc> discs);

/// Fingerprint of the discs' bits.
std::string packing_hash(const std::vector<Disc>& discs);

}  // namespace phy::genesis
