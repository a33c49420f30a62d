// From a packing and a recipe to the specimens of a test: bonded (bond.hpp), then bedded (bedding.hpp).
//
// All specimens of a recipe share one packing and one set of draws for the bonds: what differs between them
// is how the layers lie. Turning the layers, never the packing, keeps the scatter of packings out of a
// comparison of angles.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "records/specimen.hpp"

namespace phy::genesis {

/// One specimen with the given sets of bedding; without any it is intact.
Specimen make_specimen(std::shared_ptr<const Packing> packing, const MatrixRecipe& matrix,
                       std::vector<BeddingRecipe> bedding, std::string name);

/// Turns the layers so that the first set of bedding (without bedding: the foliation of the matrix) lies at
/// `theta` [deg], and all others by the same angle, about the specimen's centre. Angles are brought back to
/// [0, 180); half a turn reverses the normal and with it the offset.
void turn_layers(MatrixRecipe& matrix, std::vector<BeddingRecipe>& bedding, double theta);

/// The specimens of a recipe: one per test.angles ("theta = 30 deg"), or one with the layers as they stand
/// where no angles are given; then "intact", without bedding, if test.intact is set or there are no layers.
/// Throws InputError for angles without layers. Some tests cut them from the packing (cut.hpp).
std::vector<Specimen> make_specimens(std::shared_ptr<const Packing> packing, const Recipe& recipe);

}  // namespace phy::genesis
