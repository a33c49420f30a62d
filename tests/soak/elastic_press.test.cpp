// The paper's specimen at seven angles: direct solution against the press, for both rules, on the packing
// whose overlaps are its stress-free state. (The packing by area starts under a stress of its own: its
// contacts pull until that is used up, a state that the direct solution does not have; there E differs by up
// to 2.9 %.)
#include <gtest/gtest.h>

#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/toml_in.hpp"
#include "statics/uniaxial.hpp"
#include "study/press_check.hpp"

namespace phy {
namespace {

class PaperSpecimen : public testing::TestWithParam<const char*> {};

TEST_P(PaperSpecimen, DirectSolutionIsTheSlopeOfThePress) {
  const Recipe recipe =
      io::read_recipe(std::string(PHY_SOURCE_DIR "/examples/paper/") + GetParam() + ".toml");
  const auto specimens =
      genesis::make_specimens(genesis::packing_of(recipe, genesis::default_cache_folder()), recipe);
  ASSERT_EQ(specimens.size(), 8U);  // seven angles and the intact rock
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  machine.threads = 2;
  const auto direct = statics::solve_all(specimens, {}, 2);
  const auto press = study::press_moduli(specimens, recipe, machine, true);
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    ASSERT_TRUE(direct[i].outcome.ok()) << direct[i].outcome.reason;
    ASSERT_TRUE(press[i].outcome.empty()) << press[i].outcome;
    EXPECT_NEAR(press[i].E / direct[i].E_gauge, 1.0, 0.01) << press[i].name;
    EXPECT_NEAR(press[i].nu, direct[i].nu_gauge, 0.01) << press[i].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Recipes, PaperSpecimen, testing::Values("press", "press-crossing"));

}  // namespace
}  // namespace phy
