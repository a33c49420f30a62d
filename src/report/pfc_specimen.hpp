// One specimen, disc by disc and bond by bond, and its uniaxial test as command files of PFC2D: what another
// program needs to repeat a test on the same packing. report/pfc_commands.hpp has the parameters alone.
//
// Every command is marked by where it was looked up (the head of the files says how). Nobody has run the
// files in PFC2D yet.
#pragma once
#include <string>

#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::report {

/// Bodies that PFC2D takes without a licence. A user of PFC2D 7.0 gives this number
/// (github.com/yusong652/pfc-mcp, header/pfc/README.md); no page of the vendor's with it was found.
constexpr std::size_t pfc_free_bodies = 1000;

struct PfcFiles {
  std::string specimen;  ///< discs, platens, bonds with their strengths, joints with dips and sides
  std::string test;      ///< calls the file above, presses, writes strain [1], stress [Pa], cracks as CSV
};

/// Throws InputError with everything in the recipe that has no place in the files: tests other than uniaxial
/// compression, flat joints, stiffnesses that differ from contact to contact, a locked-in stress, an affine
/// pre-strain, a fast approach, bonds that never break. `where` names the recipe.
void check_pfc_export(const Recipe& recipe, const std::string& where);

/// The files of one specimen of a recipe that was checked. The test calls the specimen "STEM-specimen.p2dat"
/// and writes "STEM-pfc.csv". Coordinates are those of the packing, to the last bit, and so are strengths;
/// disc k has the number k + 1.
PfcFiles pfc_specimen(const Recipe& recipe, const Specimen& specimen, const std::string& stem);

}  // namespace phy::report
