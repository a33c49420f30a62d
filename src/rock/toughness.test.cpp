// K_Ic in a table, and the size of the model's grains that goes with it.
#include "rock/file_fixture.hpp"

namespace phy::rock {
namespace {

const std::string table =
    "theta [deg],UCS [MPa],K_Ic [MPa m^0.5],K_Ic_sd [MPa m^0.5],diameter [mm]\n"
    "0,100,1.2,0.1,30\n45,60,,,\n90,120,0.8,,\n";

TEST_F(RockFile, ToughnessIsReadInItsUnitWithItsHalfDisc) {
  const Rock r = rock(table);
  const std::vector<Target> t = of_property(targets_of(r), Property::fracture_toughness);
  ASSERT_THAT(t, SizeIs(2));
  EXPECT_DOUBLE_EQ(t[0].mean, 1.2e6);
  EXPECT_DOUBLE_EQ(t[0].diameter, 0.03);
  EXPECT_DOUBLE_EQ(t[1].mean, 0.8e6);
  EXPECT_EQ(t[1].diameter, 0.0);
  EXPECT_EQ(of_property(targets_of(r), Property::ucs)[0].diameter, 0.0);
  // one specimen, the prior of 15 % alone
  const Rock one = rock("theta [deg],K_Ic [MPa m^0.5]\n0,1\n45,1\n90,1\n");
  EXPECT_NEAR(targets_of(one)[0].sd, 0.15e6, 1.0);
}

TEST_F(RockFile, ToughnessInAnotherUnitIsRefused) {
  EXPECT_THAT(problems("theta [deg],K_Ic [MPa]\n0,1\n45,1\n90,1\n"),
              Contains(AllOf(HasSubstr("K_Ic [MPa] = MPa"), HasSubstr("K_Ic [MPa sqrt(m)]"))));
  EXPECT_THAT(problems("theta [deg],K_Ic [Pa m^0.5]\n0,1\n45,1\n90,1\n"),
              Contains(AllOf(HasSubstr("r.csv:2: K_Ic = 1 Pa sqrt(m)"), HasSubstr("1 kPa sqrt(m) <= K_Ic"))));
}

// Half a disc is as high as its radius: twice the height of the specimen bounds it, and its width.
TEST_F(RockFile, AHalfDiscLargerThanTheSpecimenIsRefused) {
  EXPECT_THAT(problems("theta [deg],K_Ic [MPa m^0.5],diameter [mm]\n0,1,39\n45,1,\n90,1,\n"),
              Contains(AllOf(HasSubstr("r.csv:2: diameter"), HasSubstr("at most the width and twice"))));
}

TEST_F(RockFile, WithoutAGrainSizeToughnessIsCompared) {
  const Rock r = rock(table);
  EXPECT_FALSE(r.grains_stated);
  EXPECT_THAT(r.notes, Contains(HasSubstr("K_Ic is not fitted")));
  const Rock stated = rock(table, "grain_size = \"1 mm\"\n");
  EXPECT_TRUE(stated.grains_stated);
  EXPECT_THAT(stated.notes, Not(Contains(HasSubstr("not fitted"))));
}

// The paper's 7,481 grains of 0.25 to 0.415 mm radius, 0.665 mm in the mean: twice as large they are a
// quarter as many.
TEST_F(RockFile, StatedGrainsFillTheSameSpecimen) {
  const PackingRecipe p = rock(table, "grain_size = \"1.33 mm\"\n").model.packing;
  EXPECT_NEAR(p.radius_min, 0.0005, 1e-12);
  EXPECT_NEAR(p.radius_max, 0.00083, 1e-12);
  EXPECT_EQ(p.n_grains, 1870);
  const Rock large =
      rock(table, "grain_size = \"1.33 mm\"\n[specimen]\nwidth = \"76 mm\"\nheight = \"152 mm\"\n");
  EXPECT_NEAR(large.model.packing.radius_max, 0.00083, 1e-12);
  EXPECT_EQ(large.model.packing.n_grains, 7481);
  EXPECT_DOUBLE_EQ(large.model.bedding[0].spacing, 0.01) << "what is no grain is magnified as before";
  EXPECT_THAT(
      large.notes,
      Contains(HasSubstr("grain_size = 1.33 mm: 7481 grains in the specimen; a test costs about 1 times")));
}

TEST_F(RockFile, GrainsThatTheSpecimenDoesNotTakeAreRefused) {
  EXPECT_THAT(problems(table, "grain_size = \"5 mm\"\n"),
              ElementsAre(AllOf(HasSubstr("r.toml:2: grain_size = 5 mm"),
                                HasSubstr("at least ten mean grain diameters, 50 mm"),
                                HasSubstr("state smaller grains"))));
  EXPECT_THAT(
      problems(table, "grain_size = \"20 mm\"\n"),
      ElementsAre(AllOf(HasSubstr("r.toml:2: grain_size = 20 mm"), HasSubstr("state smaller grains"))));
  EXPECT_THAT(problems(table, "grain_size = \"0.01 mm\"\n"),
              ElementsAre(AllOf(HasSubstr("r.toml:2: grain_size = 10 um"), HasSubstr("1000000"),
                                HasSubstr("state larger grains"))));
  const std::string size = "[specimen]\nwidth = \"38 mm\"\nheight = \"76 mm\"\n";
  EXPECT_THAT(problems(table, "grain_size = \"5 mm\"\n" + size),
              ElementsAre(HasSubstr("state smaller grains")));
  EXPECT_THAT(problems(table, "grain_size = \"0.6 mm\"\n[bedding]\nspacing = \"0.5 mm\"\n"),
              ElementsAre(HasSubstr("state smaller grains")));
  EXPECT_THAT(problems(table, "grain_size = \"1.2 mm\"\n[brazilian]\ndiameter = \"900 mm\"\n"),
              ElementsAre(AllOf(HasSubstr("brazilian.diameter"), HasSubstr("at most the smaller side"))))
      << "which no grains mend";
  EXPECT_THAT(problems(table, "grain_size = 1.2\n"), Contains(HasSubstr("has no unit")));
  EXPECT_THAT(problems(table, "grain_size = \"1.2 mm\"\n"), IsEmpty());
}

TEST_F(RockFile, ARecipeStatesItsGrainsItself) {
  write("m.toml", "[specimen]\nwidth = \"38 mm\"\n[[bedding]]\n");
  EXPECT_TRUE(rock(table, "recipe = \"m.toml\"\n").grains_stated);
  EXPECT_THAT(problems(table, "recipe = \"m.toml\"\ngrain_size = \"1 mm\"\n"),
              Contains(AllOf(HasSubstr("r.toml:3: grain_size"), HasSubstr("the recipe says it"))));
}

}  // namespace
}  // namespace phy::rock
