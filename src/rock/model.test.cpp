// The model of a rock file: what its recipe may hold, what the file says of layers, matrix and size.
#include "rock/file_fixture.hpp"

namespace phy::rock {
namespace {

TEST_F(RockFile, ARecipeWithAPackingFromAFileIsRefused) {
  write("discs.csv", "x [m],y [m],r [m]\n0.002,0.002,0.002\n0.006,0.002,0.002\n");
  write("m.toml", "[packing]\nfile = \"discs.csv\"\n[[bedding]]\nspacing = \"5 mm\"\n");
  EXPECT_THAT(problems(good, "recipe = \"m.toml\"\n"),
              Contains(AllOf(HasSubstr("r.toml:2: recipe"), HasSubstr("no packing.file"))));
}

TEST_F(RockFile, OnlyParallelEquallySpacedPlanesAreCalibrated) {
  for (const char* key : {"rule = \"oriented\"", "persistence = 0.5", "spacing_sd = 0.1",
                          "theta_sd = \"2 deg\"", "sigma_n_sd = \"1 MPa\"", "bridges = false"}) {
    write("m.toml", std::string("[[bedding]]\n") + key + "\n");
    EXPECT_THAT(
        problems(good, "recipe = \"m.toml\"\n"),
        Contains(AllOf(HasSubstr("r.toml:2: recipe"), HasSubstr("a calibration knows no other bedding"))))
        << key;
  }
  write("m.toml", "[[bedding]]\nrule = \"crossing\"\nbridges = false\n");  // read by the zone rule only
  EXPECT_THAT(problems(good, "recipe = \"m.toml\"\n"), IsEmpty());
}

TEST_F(RockFile, TheMatrixIsThatOfTheRecipeUnlessTheFileAsksForAnother) {
  EXPECT_EQ(rock(good, "").matrix, std::nullopt);  // without a recipe: what predicts best
  write("m.toml", "[matrix]\nmodel = \"flat_joint\"\n[[bedding]]\nspacing = \"5 mm\"\n");
  EXPECT_EQ(rock(good, "recipe = \"m.toml\"\n").matrix, MatrixModel::flat_joint);
  EXPECT_EQ(rock(good, "recipe = \"m.toml\"\nmatrix = \"choose\"\n").matrix, std::nullopt);
  EXPECT_EQ(rock(good, "matrix = \"flat_joint\"\n").matrix, MatrixModel::flat_joint);
  EXPECT_EQ(rock(good, "matrix = \"parallel_bond\"\n").matrix, MatrixModel::parallel_bond);
  EXPECT_THAT(
      problems(good, "matrix = \"flat_joint\"\nlayers = \"directions\"\n"),
      testing::ElementsAre(AllOf(HasSubstr("r.toml:2: matrix"), HasSubstr("flat joints have: planes"))));
  EXPECT_THAT(problems(good, "matrix = \"glue\"\n"), Contains(HasSubstr("flat_joint")));
  write("m.toml", "[matrix]\nmodel = \"flat_joint\"\ntension_ratio = 2\n");
  EXPECT_THAT(
      problems(good, "recipe = \"m.toml\"\n"),
      testing::ElementsAre(AllOf(HasSubstr("r.toml:2: recipe"), HasSubstr("flat joints have: planes"))));
}

TEST_F(RockFile, TheFirstPackingIsAskedForWithOrWithoutARecipe) {
  EXPECT_EQ(rock(good, "").model.packing.seed, 1);
  EXPECT_EQ(rock(good, "first_packing = 501\n").model.packing.seed, 501);
  write("m.toml", "[packing]\nseed = 7\n");
  EXPECT_EQ(rock(good, "recipe = \"m.toml\"\n").model.packing.seed, 7);
  EXPECT_EQ(rock(good, "recipe = \"m.toml\"\nfirst_packing = 501\n").model.packing.seed, 501);
  EXPECT_THAT(problems(good, "first_packing = -1\n"), testing::ElementsAre(HasSubstr("first_packing")));
}

TEST_F(RockFile, AnotherSizeMagnifiesTheModel) {
  const Rock r = rock(good, "[specimen]\nwidth = \"50 mm\"\nheight = \"100 mm\"\n");
  const Recipe paper;
  EXPECT_DOUBLE_EQ(r.model.packing.radius_min, paper.packing.radius_min * 50.0 / 38.0);
  EXPECT_EQ(r.model.packing.n_grains, paper.packing.n_grains);
}

TEST_F(RockFile, TwoSizesAreToldWithBothLines) {
  write("m.toml",
        "name = \"m\"\n[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n");
  const std::string here = "recipe = \"m.toml\"\n[specimen]\nwidth = \"38 mm\"\nheight = \"76 mm\"\n";
  EXPECT_THAT(
      problems(good, here),
      testing::ElementsAre(
          AllOf(HasSubstr("r.toml:4: specimen: the size is 38 x 76 mm here, and 8 x 16 mm in "),
                HasSubstr("m.toml:2. Delete one."), HasSubstr("write grain_size = \"3 mm\" and no recipe"))));
  write("m.toml", "[packing]\nseed = 2\n");  // the reference specimen, unsaid
  EXPECT_THAT(problems(good, "recipe = \"m.toml\"\n[specimen]\nheight = \"60 mm\"\n"),
              testing::ElementsAre(
                  AllOf(HasSubstr("r.toml:4: specimen: the size is 38 x 60 mm here, and 38 x 76 mm in "),
                        HasSubstr("m.toml. Delete one."))));
  // What is advised is taken.
  EXPECT_THAT(problems(good, "grain_size = \"3 mm\"\n[specimen]\nwidth = \"38 mm\"\nheight = \"76 mm\"\n"),
              IsEmpty());
}

TEST_F(RockFile, WhatARunWouldRefuseIsRefusedHere) {
  EXPECT_THAT(problems(good, "[brazilian]\nloading_angle = \"45 deg\"\n"),
              testing::ElementsAre(
                  AllOf(HasSubstr("r.toml:3: brazilian.loading_angle = \"45 deg\""), HasSubstr("30 deg"))));
  EXPECT_THAT(problems(good, "[specimen]\nwidth = \"30 mm\"\nheight = \"10 m\"\n"),
              testing::ElementsAre(AllOf(HasSubstr("r.toml:4: packing.n_grains = 1246833"),
                                         HasSubstr("1000000"), HasSubstr("magnifies the paper's specimen"))));
  EXPECT_THAT(
      problems("theta [deg],UCS [MPa],BTS [MPa],diameter [mm]\n0,100,9,2\n45,60,,\n90,120,,\n"),
      testing::ElementsAre(AllOf(HasSubstr("r.csv:2: diameter = 2 mm"), HasSubstr("ten mean grain"))));
  write("m.toml",
        "[specimen]\nwidth = \"80 mm\"\nheight = \"160 mm\"\n[packing]\nradius_min = \"2.6 mm\"\n"
        "radius_max = \"3 mm\"\nn_grains = 468\n");  // wider than the paper's planes are apart
  EXPECT_THAT(
      problems(good, "recipe = \"m.toml\"\n"),
      testing::ElementsAre(AllOf(HasSubstr("r.toml:2: bedding[0].spacing"), HasSubstr("largest grain"))));
  EXPECT_THAT(problems("UCS [MPa]\n100\n", "recipe = \"m.toml\"\nbedded = false\n"), IsEmpty());
}

TEST_F(RockFile, PlanesAreByCrossingUnlessTheRecipeSaysOtherwise) {
  const std::string size = "[specimen]\nwidth = \"38 mm\"\nheight = \"76 mm\"\n";
  write("m.toml", size);
  for (const std::string& keys : {std::string(), std::string("recipe = \"m.toml\"\n")}) {
    const Rock assumed = rock(good, keys);
    EXPECT_EQ(assumed.model.bedding.at(0).rule, BeddingRule::crossing);
    EXPECT_EQ(assumed.layers, LayerModel::choose);
    EXPECT_THAT(assumed.notes, Contains(HasSubstr("the distance of the layers is not given: 5 mm is taken")));
    const Rock given = rock(good, keys + "layers = \"planes\"\n[bedding]\nspacing = \"8 mm\"\n");
    EXPECT_DOUBLE_EQ(given.model.bedding.at(0).spacing, 8e-3);
    EXPECT_EQ(given.layers, LayerModel::planes);
    EXPECT_THAT(given.notes, Each(testing::Not(HasSubstr("distance of the layers"))));
  }
  EXPECT_THAT(rock(good, "layers = \"directions\"\n").notes,
              Each(testing::Not(HasSubstr("distance of the layers"))));
  EXPECT_THAT(
      problems(good, "layers = \"directions\"\n[bedding]\nspacing = \"8 mm\"\n"),
      testing::ElementsAre(AllOf(HasSubstr("r.toml:4: bedding.spacing"), HasSubstr("have no spacing"))));
  EXPECT_THAT(problems(good, "[bedding]\nspacing = \"80 mm\"\n"),
              testing::ElementsAre(AllOf(HasSubstr("r.toml:3: bedding.spacing"), HasSubstr("38 mm"))));
  EXPECT_THAT(
      problems(good, "[bedding]\nspacing = \"0.1 mm\"\n"),
      testing::ElementsAre(AllOf(HasSubstr("r.toml:3: bedding.spacing"), HasSubstr("largest grain"))));
  EXPECT_THAT(problems(good, "bedded = false\nlayers = \"planes\"\n"),
              testing::ElementsAre(AllOf(HasSubstr("r.toml:3: layers"), HasSubstr("a rock with bedding"))));
  write("m.toml", size + "[[bedding]]\n");
  const Rock zone = rock(good, "recipe = \"m.toml\"\n");
  EXPECT_EQ(zone.model.bedding.at(0).rule, BeddingRule::zone);
  EXPECT_EQ(zone.layers, LayerModel::planes);
  EXPECT_THAT(zone.notes, Each(testing::Not(HasSubstr("distance of the layers"))));
  EXPECT_THAT(problems(good, "recipe = \"m.toml\"\nlayers = \"planes\"\n[bedding]\nspacing = \"8 mm\"\n"),
              testing::ElementsAre(AllOf(HasSubstr("r.toml:3: layers"), HasSubstr("the recipe says it")),
                                   HasSubstr("r.toml:5: bedding.spacing")));
}

TEST_F(RockFile, PlanesMayLieBetweenBondsWithDirections) {
  const Rock named = rock(good, "layers = \"planes and directions\"\n[bedding]\nspacing = \"8 mm\"\n");
  EXPECT_EQ(named.layers, LayerModel::planes_and_directions);
  EXPECT_DOUBLE_EQ(named.model.bedding.at(0).spacing, 8e-3);
  write("m.toml", "[matrix]\ncohesion_ratio = 1.5\n[[bedding]]\n");
  const Rock r = rock(good, "recipe = \"m.toml\"\n");
  EXPECT_EQ(r.layers, LayerModel::planes_and_directions);
  EXPECT_EQ(r.model.bedding.size(), 1U);
}

TEST_F(RockFile, PlanesMayHaveBridges) {
  const Rock named = rock(good, "layers = \"planes with bridges\"\n");
  EXPECT_EQ(named.layers, LayerModel::planes_with_bridges);
  write("m.toml", "[[bedding]]\nrule = \"crossing\"\npersistence = 0.7\npatch_length = \"6 mm\"\n");
  const Rock r = rock(good, "recipe = \"m.toml\"\n");
  EXPECT_EQ(r.layers, LayerModel::planes_with_bridges);
  EXPECT_DOUBLE_EQ(r.model.bedding.at(0).patch_length, 6e-3);
  EXPECT_EQ(rock(good, "recipe = \"m.toml\"\nbedded = false\n").layers, LayerModel::planes) << "of none";
  for (const char* other :
       {"[[bedding]]\npersistence = 0.7\n",  // zone
        "[matrix]\ncohesion_ratio = 1.5\n[[bedding]]\nrule = \"crossing\"\npersistence = 0.7\n"}) {
    write("m.toml", other);
    EXPECT_THAT(problems(good, "recipe = \"m.toml\"\n"),
                testing::ElementsAre(AllOf(HasSubstr("crossing"), HasSubstr("bonds without directions"))))
        << other;
  }
}

TEST_F(RockFile, ARecipeWithDirectionsAloneGetsNoPlanes) {
  write("m.toml", "[matrix]\nstiffness_ratio = 1.5\nmoment_contribution = 0.1\n");
  const Rock r = rock(good, "recipe = \"m.toml\"\n");
  EXPECT_TRUE(r.model.bedding.empty());
  EXPECT_EQ(r.layers, LayerModel::directions);
}

}  // namespace
}  // namespace phy::rock
