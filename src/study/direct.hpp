// A specimen of a study by the direct elastic solution (statics/uniaxial.hpp) instead of a test in time: E
// and nu at small strain, with linear contacts that only push and, an idealisation, with contacts that also
// pull.
#pragma once
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "statics/uniaxial.hpp"

namespace phy::study {

/// The seed of the bonds moves moduli: it says where joints are, or contacts without a bond.
bool moduli_are_drawn(const Recipe& recipe);

/// What the solution depends on: the specimen, whatever test is done and with what engine; no strength is
/// drawn. The rest stands at its default.
Recipe elastic_recipe(Recipe single);

/// `solved`, or `unsolved` with the reason. No history; the hash is that of the numbers.
TestResult solve_directly(const Specimen& specimen, statics::UniaxialStatics& statics);

}  // namespace phy::study
