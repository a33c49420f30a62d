#include "io/load_variation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"
#include "io/regressions.hpp"
#include "io/toml_in.hpp"

namespace phy::io {
namespace {

class LoadVariation : public InFolder {};

TEST_F(LoadVariation, OneAtATimeAroundTheFirstPointOfAStudy) {
  Recipe recipe;
  recipe.bedding.resize(1);
  recipe.bedding[0].spacing = 0.004;
  write("recipe.toml", write_recipe(recipe));
  write("results.csv",
        "point,packing,bond_seed,theta [deg],intact,bedding.k_n [Pa/m],bedding.mu,ucs [Pa],E_tangent "
        "[Pa],status,reason\n"
        "0,1,1,0,0,3e+12,0.4,1e+08,2e+10,peaked,\"peak, stopped\"\n"
        "0,2,1,0,0,3e+12,0.4,1.2e+08,2.2e+10,peaked,x\n"
        "0,1,1,90,0,3e+12,0.4,,5e+10,peaked,x\n"
        "0,2,1,90,0,3e+12,0.4,3e+08,9e+10,not peaked,what it carried most is no strength\n"
        "0,1,1,,1,3e+12,0.4,2e+08,6e+10,peaked,x\n"
        "0,2,1,,1,3e+12,0.4,2e+08,1e+10,unstable,x\n"
        "1,1,1,0,0,1.5e+12,0.4,9e+07,1e+10,peaked,x\n"
        "2,1,1,0,0,3e+12,0.6000000000000001,1.1e+08,2e+10,peaked,x\n"
        "3,1,1,0,0,1.5e+12,0.8,1e+06,1e+09,peaked,both differ from the base\n");
  const Variation v = read_variation(folder.string());
  EXPECT_EQ(v.spacing, 0.004);
  EXPECT_EQ(v.name, read_recipe((folder / "recipe.toml").string()).name);
  recipe.bedding[0].rule = BeddingRule::oriented;
  write("recipe.toml", write_recipe(recipe));
  EXPECT_EQ(read_variation(folder.string()).spacing, 0.0);
  write("study.toml", "name = \"soft joints\"\n");
  EXPECT_EQ(read_variation(folder.string()).name, "soft joints");
  EXPECT_EQ(v.E_intact, 6e10);
  ASSERT_EQ(v.parameters.size(), 2U);
  const VariedParameter& k_n = v.parameters[0];
  EXPECT_EQ(k_n.key, "bedding.k_n");
  ASSERT_EQ(k_n.settings.size(), 2U);
  EXPECT_EQ(k_n.settings[0].text, "1500 GPa/m");
  EXPECT_EQ(k_n.settings[0].factor, 0.5);
  EXPECT_TRUE(k_n.settings[1].base);
  EXPECT_DOUBLE_EQ(k_n.settings[1].ucs[0].value.mean, 1.1e8);  // two packings
  EXPECT_EQ(k_n.settings[1].ucs.size(), 1U);                   // no strength at 90
  EXPECT_EQ(k_n.settings[1].E.size(), 2U);
  ASSERT_EQ(k_n.settings[1].E_each.size(), 2U);  // the second packing was not run at 90
  EXPECT_EQ(k_n.settings[1].E_each[0].size(), 2U);
  EXPECT_EQ(k_n.settings[1].E_each[1].at(0).value.mean, 2.2e10);
  EXPECT_EQ(v.parameters[1].settings[1].text, "0.6");
}

TEST_F(LoadVariation, OfTheDirectSolutionWithLinesOfOthers) {
  Recipe recipe;
  recipe.bedding.resize(1);
  write("recipe.toml", write_recipe(recipe));
  write("results.csv",
        "point,packing,bond_seed,theta [deg],intact,bedding.k_n [Pa/m],E_gauge [Pa],status\n"
        "0,1,1,0,0,3.36e12,2e10,solved\n0,1,1,,1,3.36e12,6e10,solved\n1,1,1,0,0,6.72e12,3e10,solved\n"
        "1,2,1,0,0,6.72e12,4e10,unsolved\n");
  write(regressions_file,
        "[[line]]\nsource = \"they\"\nnumber = \"K_n\"\nkey = \"bedding.k_n\"\nslope = 1.5\nintercept = "
        "\"312.4 GPa/m\"\n");
  const Variation v = read_variation(folder.string());
  EXPECT_EQ(v.E_intact, 6e10);
  const VariedSetting& twice = v.parameters.at(0).settings.at(1);
  EXPECT_EQ(twice.factor, 2.0);
  EXPECT_EQ(twice.value, 6.72e12);
  EXPECT_EQ(twice.E.at(0).value.mean, 3e10) << "what is not solved is no answer";
  ASSERT_EQ(v.regressions.size(), 1U);
  EXPECT_EQ(v.regressions[0].intercept, 312.4e9);
  EXPECT_EQ(v.regressions[0].unit, "Pa/m");
  EXPECT_EQ(write_regressions(read_regressions(at(regressions_file))), write_regressions(v.regressions));
}

TEST_F(LoadVariation, EveryProblemOfRegressionsIsTold) {
  write(regressions_file,
        "[[line]]\nsource = 3\nnumber = \"K_n\"\nkey = \"bedding.kn\"\nslop = 1.5\nintercept = \"3 "
        "apples\"\nR2 = "
        "2\n");
  const std::string told = message_of<InputError>([&] { read_regressions(at(regressions_file)); });
  for (const char* part :
       {"toml:2: line[0].source = 3: expected text", "toml:4: line[0].key", "did you mean \"bedding.k_n\"?",
        "toml:5: line[0].slop: unknown key; did you mean \"slope\"?", "toml:6: line[0].intercept",
        "toml:7: line[0].R2 = 2: expected 0 <= value <= 1"})
    EXPECT_THAT(told, testing::HasSubstr(part));
}

TEST_F(LoadVariation, WhatIsNoneIsTold) {
  write("results.csv", "point,theta [deg]\n0,0\n");
  write("recipe.toml", write_recipe(Recipe{}));
  EXPECT_THROW(read_variation(folder.string()), InputError);
  EXPECT_FALSE(holds_variation((folder / "nowhere").string()));
}

}  // namespace
}  // namespace phy::io
