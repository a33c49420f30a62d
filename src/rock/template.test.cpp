// A new rock that begins like another one is read back as that.
#include "rock/template.hpp"

#include <gtest/gtest.h>

#include "rock/file.hpp"

namespace phy::rock {
namespace {

Rock read_back(const Start& start) {
  const std::string table = start.bedded ? "theta [deg],UCS [MPa]\n0,90\n45,60\n90,120\n" : "UCS [MPa]\n90\n";
  return parse_rock(rock_template("mine", "mine.csv", start), "mine.toml", {table, {}});
}

TEST(RockTemplate, BeginsWithGrainsSpacingSizeAndModel) {
  Start start;
  start.layers = "planes with bridges", start.matrix = "parallel_bond";
  start.grain_size = 2.231e-3, start.spacing = 0.01, start.size = {0.051, 0.102};
  const Rock rock = read_back(start);
  EXPECT_EQ(rock.layers, LayerModel::planes_with_bridges);
  EXPECT_EQ(rock.matrix, MatrixModel::parallel_bond);
  EXPECT_NEAR(grain_size(rock.model), 2.231e-3, 1e-12);
  EXPECT_DOUBLE_EQ(rock.model.bedding.at(0).spacing, 0.01);
  EXPECT_DOUBLE_EQ(rock.model.specimen.width, 0.051);
  EXPECT_DOUBLE_EQ(rock.model.specimen.height, 0.102);
}

TEST(RockTemplate, ReadsEAsTheRockItIsLike) {
  Start start;
  start.E_is = to_string(ModulusReading::secant_at_peak);
  const std::string table = "theta [deg],E [GPa],UCS [MPa]\n0,30,90\n45,20,60\n90,40,120\n";
  EXPECT_EQ(parse_rock(rock_template("mine", "mine.csv", start), "mine.toml", {table, {}}).E_is,
            ModulusReading::secant_at_peak);
}

// A key that was set still shows every other value, "choose" among them.
TEST(RockTemplate, ASetModelLeavesTheChoices) {
  Start start;
  start.layers = "planes", start.matrix = "flat_joint";
  const std::string text = rock_template("mine", "mine.csv", start);
  for (const char* line : {"\nlayers = \"planes\"", "\nmatrix = \"flat_joint\""}) {
    const std::size_t begin = text.find(line);
    ASSERT_NE(begin, text.npos) << line;
    EXPECT_NE(text.substr(begin, text.find('\n', begin + 1) - begin).find("\"choose\""), text.npos) << line;
  }
}

TEST(RockTemplate, DirectionsHaveNoSpacing) {
  Start start;
  start.layers = "directions", start.spacing = 0.01;
  EXPECT_EQ(read_back(start).layers, LayerModel::directions);
}

TEST(RockTemplate, WithoutABeginningItIsThePapersSpecimen) {
  const Rock rock = read_back({});
  EXPECT_EQ(rock.layers, LayerModel::choose);
  EXPECT_FALSE(rock.grains_stated);
  EXPECT_EQ(rock.model.packing.n_grains, PackingRecipe().n_grains);
}

TEST(RockTemplate, ARockWithoutBeddingHasNone) {
  Start start;
  start.bedded = false;
  EXPECT_FALSE(read_back(start).bedded);
}

}  // namespace
}  // namespace phy::rock
