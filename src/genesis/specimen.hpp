// From a packing and a recipe to the specimens of a test: bonded (bond.hpp), then bedded (bedding.hpp).
//
// All specimens of a recipe share one packing and one set of bond strengths: what differs between them is the
// bedding alone. Turning the bedding, never the packing, keeps the scatter of packings out of a comparison of
// angles.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "records/specimen.hpp"

namespace phy::genesis {

/// One specimen with the given sets of bedding; without any it is intact.
Specimen make_specimen(std::shared_ptr<const Packing> packing, const MatrixRecipe& matrix,
                       std::vector<BeddingRecipe> bedding, std::string name);

/// The recipe's bedding with the first set at `theta` [deg] and all other sets turned by the same angle,
/// about the specimen's centre. Angles are brought back to [0, 180); half a turn reverses the normal and with
/// it the offset.
std::vector<BeddingRecipe> turned(std::vector<BeddingRecipe> bedding, double theta);

/// The specimens of a recipe: one per test.angles ("theta = 30 deg"), or one with the bedding as it stands
/// where no angles are given; then "intact" if test.intact is set or there is no bedding. Throws InputError
/// for angles without bedding. Some tests cut them from the packing (cut.hpp).
std::vector<Specimen> make_specimens(std::shared_ptr<const Packing> packing, const Recipe& recipe);

}  // namespace phy::genesis
