// Whether a specimen is one: what its packing and bedding must have before any test of it means something.
#pragma once
#include <vector>

#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::analysis {

/// Measures, all [1]:
///   grains_across       smaller side of the specimen (diameter of a disc) over the mean grain diameter
///   porosity            1 - area of all discs / area of the box, before a disc is cut from it;
///                       below zero discs lie on top of each other
///   overlap             largest overlap of two grains in contact at the start / radius of the smaller one
///   rattlers            share of grains that no contact can load (docs/reliability.md)
///   grains_per_spacing  spacing of the bedding over the mean grain diameter; of several sets the smallest
///   joints              number of smooth joints of a bedding set; of several sets the smallest number
///
/// The last two only with bedding. Rattlers are what is left over when grains with fewer than two contacts
/// are taken away one after the other, and all that is cut off from the largest part.
std::vector<Number> specimen_checks(const Specimen& specimen);

/// Mean over the grains [m].
double grain_diameter(const Specimen& specimen);

/// broken_at_start: share of the bonds of the matrix that have broken up to a cycle, that at which loading
/// began; joints may have hardly a strength on purpose. NaN where the matrix has no bonds.
Number broken_at_start(const Specimen& specimen, const std::vector<CrackEvent>& cracks, std::int64_t step);

}  // namespace phy::analysis
