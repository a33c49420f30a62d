// Eq. 2 of the paper by the direct solution: on the dense packing with the crossing rule each macro joint
// stiffness is a straight line of its own micro stiffness.
#include <gtest/gtest.h>

#include "io/toml_in.hpp"
#include "study/stiffness_sweep.hpp"

namespace phy {
namespace {

TEST(PaperEq2, DensePackingCrossingRuleGivesLines) {
  Recipe recipe = io::read_recipe(PHY_SOURCE_DIR "/examples/paper/press-crossing.toml");
  recipe.sweep.factors = {0.25, 0.5, 1.0, 1.5};
  recipe.sweep.n_packings = 1;
  const auto packings = study::sweep_packings(recipe, 2);
  const study::SweptPacking swept = study::sweep_stiffness(packings[0], 1, recipe, BeddingRule::crossing, 2);
  const study::MacroReading reading{study::Contacts::pushing, study::StrainReading::gauge,
                                    theory::Eq1Loss::compliance, theory::Eq1Reference::given};
  EXPECT_GE(study::fit_macro_line(std::span(&swept, 1), study::SweptStiffness::normal, reading).R2.mean,
            0.999);
  EXPECT_GE(study::fit_macro_line(std::span(&swept, 1), study::SweptStiffness::shear, reading).R2.mean,
            0.995);
}

}  // namespace
}  // namespace phy
