#include "io/load_variation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "base/in_folder.test.hpp"
#include "io/file.hpp"
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
  const std::vector<Variation> variations = read_variations(folder.string());
  ASSERT_EQ(variations.size(), 1U);
  const Variation& v = variations[0];
  EXPECT_EQ(v.spacing, 0.004);
  EXPECT_EQ(v.name, read_recipe((folder / "recipe.toml").string()).name);
  write("study.toml", "name = \"soft joints\"\n");
  EXPECT_EQ(read_variations(folder.string())[0].name, "soft joints");
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

TEST_F(LoadVariation, SweepsPerRecipeAndRule) {
  const std::string reading = ",pushing,gauge,compliance,intact,";
  write(
      "fig4.csv",
      "recipe,rule,contacts,strain,loss,reference E,varied,factor,k [GPa/m],packings,K_n [GPa/m],K_n +-,K_s "
      "[GPa/m],K_s +-,R2 of Eq. 1,Eq. 2 of the paper [GPa/m]\n"
      "\"a, dense\",zone" +
          reading +
          "k_n,1,3360,5,7000,70,1400,30,0.99,6405\n"
          "\"a, dense\",zone" +
          reading +
          "k_n,2,6720,5,14000,70,1400,30,0.99,12499\n"
          "\"a, dense\",zone,pulling,gauge,compliance,intact,k_n,1,3360,5,1,1,1,1,0.99,6405\n"
          "\"a, dense\",zone" +
          reading +
          "k_s,1,960,5,7000,70,1400,30,0.99,1666\n"
          "\"a, dense\",crossing" +
          reading +
          "k_n,1,3360,1,6000,nan,1300,nan,0.99,6405\n"
          "\"a, dense\",crossing" +
          reading + "k_s,1,960,1,6000,nan,1300,nan,0.99,1666\n");
  write("moduli.csv",
        "recipe,rule,seed,k_n [GPa/m],k_s [GPa/m],contacts,theta [deg],E gauge [GPa]\n"
        "\"a, dense\",zone,1,3360,960,pushing,0,20\n\"a, dense\",zone,2,3360,960,pushing,0,22\n"
        "\"a, dense\",zone,1,6720,960,pushing,0,30\n\"a, dense\",zone,1,3360,960,pulling,0,99\n"
        "\"a, dense\",zone,1,,,pushing,intact,60\n");
  const std::vector<Variation> variations = read_variations(folder.string());
  ASSERT_EQ(variations.size(), 2U);
  EXPECT_EQ(variations[0].name, "a, dense, zone rule");
  const VariedParameter& k_n = variations[0].parameters.at(0);
  ASSERT_EQ(k_n.macro.size(), 2U);
  EXPECT_DOUBLE_EQ(k_n.macro[1].K_n.mean, 14e12);
  EXPECT_DOUBLE_EQ(k_n.macro[1].paper, 12499e9);
  EXPECT_DOUBLE_EQ(k_n.settings[0].E.at(0).value.mean, 21e9);
  EXPECT_DOUBLE_EQ(k_n.settings[1].E.at(0).value.mean, 30e9);
  EXPECT_EQ(k_n.settings[1].text, "6720 GPa/m");
  EXPECT_DOUBLE_EQ(variations[0].E_intact, 60e9);
  EXPECT_FALSE(std::isfinite(variations[1].parameters[0].macro[0].K_n.half_width));
}

TEST_F(LoadVariation, WhatIsNoneIsTold) {
  write("results.csv", "point,theta [deg]\n0,0\n");
  write("recipe.toml", write_recipe(Recipe{}));
  EXPECT_THROW(read_variations(folder.string()), InputError);
  EXPECT_FALSE(holds_variations((folder / "nowhere").string()));
}

}  // namespace
}  // namespace phy::io
