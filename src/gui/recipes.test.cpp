#include "gui/recipes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "io/toml_in.hpp"
#include "records/test_description.hpp"

namespace phy::gui {
namespace {

using testing::HasSubstr;

class RecipesTest : public InFolder {
 protected:
  const std::string base = write("base.toml",
                                 "name = \"mine\"\n[specimen]\nwidth = \"9 mm\"\nheight = \"18 "
                                 "mm\"\n[packing]\nn_grains = 418\n[[bedding]]\nspacing = \"2 mm\"\n");
};

TEST_F(RecipesTest, ChoicesBecomeAFinishedRecipe) {
  const Json answer = recipe_answer(base, {{"test.kind", "biaxial"},
                                           {"test.angles", "[\"0 deg\", \"45 deg\"]"},
                                           {"test.confining_stress", "10 MPa"},
                                           {"test.intact", "true"}});
  ASSERT_TRUE(answer["problems"].empty()) << answer;
  const Recipe recipe = io::parse_recipe(answer["toml"].get<std::string>(), "answer");
  EXPECT_STREQ(recipe.test.kind->name, "biaxial");
  EXPECT_EQ(recipe.test.angles, (std::vector<double>{0.0, 45.0}));
  EXPECT_DOUBLE_EQ(recipe.test.confining_stress, 10e6);
  EXPECT_TRUE(recipe.test.intact);
  EXPECT_EQ(recipe.name, "mine");
  EXPECT_EQ(recipe.packing.n_grains, 418);
}

TEST_F(RecipesTest, AKeyWithADimensionHasTheUnitOfItsValues) {
  const auto unit_of = [](const std::string& path) {
    for (const Json& key : keys_json())
      if (key["path"] == path) return key.value("unit", "none");
    return std::string("no key");
  };
  EXPECT_EQ(unit_of("test.angles"), "deg");
  EXPECT_EQ(unit_of("test.confining_stress"), "Pa");
  EXPECT_EQ(unit_of("test.intact"), "none");
}

// A page offers keys by the test: every word "biaxial: " in a meaning stands in the list, too.
TEST_F(RecipesTest, AKeyOfOneTestNamesIt) {
  for (const Json& key : keys_json()) {
    std::vector<std::string> said;
    const std::string meaning = "; " + key["meaning"].get<std::string>();
    for (const TestDescription* test : laboratory_tests())
      if (meaning.find(std::string("; ") + test->name + ": ") != meaning.npos) said.emplace_back(test->name);
    EXPECT_THAT(key.value("tests", std::vector<std::string>()), testing::UnorderedElementsAreArray(said))
        << key["path"];
  }
}

TEST_F(RecipesTest, EveryTestCanBeChosen) {
  for (const TestDescription* test : laboratory_tests()) {
    std::map<std::string, std::string> chosen = {{"test.kind", test->name}, {"test.angles", "[\"30 deg\"]"}};
    if (test->kept_stress.value != nullptr) chosen[std::string("test.") + test->kept_stress.key] = "5 MPa";
    const Json answer = recipe_answer(base, chosen);
    EXPECT_TRUE(answer["problems"].empty()) << test->name << answer["problems"];
  }
}

TEST_F(RecipesTest, ATestUnderAStressAsksForIt) {
  for (const auto& [kind, key] :
       {std::pair("biaxial", "test.confining_stress"), std::pair("direct_shear", "test.normal_stress")})
    for (const char* given : {"", "0 MPa"}) {
      std::map<std::string, std::string> chosen = {{"test.kind", kind}};
      if (*given != '\0') chosen[key] = given;
      const Json answer = recipe_answer(base, chosen);
      ASSERT_EQ(answer["problems"].size(), 1U) << answer;
      EXPECT_EQ(answer["problems"][0]["key"], key);
      EXPECT_THAT(answer["problems"][0]["text"].get<std::string>(), HasSubstr("a stress above 0"));
    }
  EXPECT_EQ(
      recipe_answer(base, {{"test.kind", "biaxial"}, {"test.confining_stress", "much"}})["problems"].size(),
      1U);
  EXPECT_TRUE(recipe_answer(base, {{"test.kind", "uniaxial"}})["problems"].empty());
}

TEST_F(RecipesTest, WhatIsWrongIsSaidOfItsKey) {
  const std::map<std::string, std::string> wrong = {
      {"test.kind", "triaxal"},        {"test.angles", "0, 45"},         {"test.confining_stress", "10"},
      {"test.platen_speed", "-1 m/s"}, {"test.n_frames", "2.5"},         {"matrix.E_c", "\"1 GPa\""},
      {"test.no_such", "1"},           {"test.stop_at", "1]\n[matrix]"}, {"test.intact", "perhaps"}};
  for (const auto& [key, value] : wrong) {
    const Json answer = recipe_answer(base, {{key, value}});
    ASSERT_EQ(answer["problems"].size(), 1U) << key << answer;
    EXPECT_EQ(answer["problems"][0]["key"], key);
    EXPECT_TRUE(answer["toml"].is_null());
  }
  EXPECT_THAT(
      recipe_answer(base, {{"test.confining_stress", "10"}})["problems"][0]["text"].get<std::string>(),
      HasSubstr("unit"));
}

TEST_F(RecipesTest, KeysAreThoseOfTheOneList) {
  const Json keys = keys_json();
  EXPECT_TRUE(
      std::any_of(keys.begin(), keys.end(), [](const Json& k) { return k["path"] == "test.platen_speed"; }));
  EXPECT_EQ(kinds_json().size(), laboratory_tests().size());
  EXPECT_THROW(recipe_answer(at("absent.toml"), {}), IoError);
}

}  // namespace
}  // namespace phy::gui
