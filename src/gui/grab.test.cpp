#include "gui/grab.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"

namespace phy::gui {
namespace {

class Grab : public InFolder {
 protected:
  const std::string recipe = write("calibrated.toml",
                                   "name = \"mine\"\n[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n"
                                   "[packing]\nn_grains = 330\n[[bedding]]\nspacing = \"2 mm\"\n");
};

TEST_F(Grab, LayeredRockIsStifferAlongItsLayers) {
  const Json across = moduli_answer(recipe, 0.0), along = moduli_answer(recipe, 90.0);
  EXPECT_LT(across["E"].get<double>(), along["E"].get<double>());
  EXPECT_GT(along["nu"].get<double>(), 0.0);
  EXPECT_EQ(along["theta"], 90.0);
  EXPECT_THROW(moduli_answer(recipe, -1.0), InputError);
}

TEST_F(Grab, TheSpecimenIsThatOfTheRockFile) {
  const std::string table = "theta [deg],UCS [MPa]\n0,60\n45,40\n90,80\n";
  const Json d =
      discs_answer("r", "data = \"r.csv\"\ngrain_size = \"3 mm\"\n[bedding]\nspacing = \"8 mm\"\n", table);
  EXPECT_NEAR(d["bedding"]["spacing"].get<double>(), 8e-3, 1e-12);
  EXPECT_NEAR(d["width"].get<double>(), 38e-3, 1e-3);
  EXPECT_FALSE(d["discs"].get<std::string>().empty());
  EXPECT_THROW(discs_answer("r", "data = 1\n", table), InputError);
}

}  // namespace
}  // namespace phy::gui
