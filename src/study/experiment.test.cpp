// What is one specimen, and when are two the same?
#include "study/experiment.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "base/hash.hpp"
#include "base/in_folder_fixture.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "io/file.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"

namespace phy::study {
namespace {

Recipe seven_angles() {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.bedding.resize(2);
  r.bedding[1].theta = 170;
  r.bedding[1].offset = 0.001;
  r.test.angles = {0, 15, 30, 45, 60, 75, 90};
  r.test.intact = true;
  return r;
}

TEST(SingleRecipes, MakeTheSpecimensOfTheWholeRecipe) {
  const Recipe r = seven_angles();
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  const std::vector<Specimen> all = genesis::make_specimens(packing, r);
  const std::vector<Recipe> singles = single_recipes(r);
  ASSERT_EQ(singles.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto one = specimen_of(packing, singles[i]);
    EXPECT_EQ(one->name, all[i].name);
    ASSERT_EQ(one->bedding.size(), all[i].bedding.size());
    for (std::size_t k = 0; k < one->bedding.size(); ++k) {
      EXPECT_EQ(one->bedding[k].theta, all[i].bedding[k].theta);
      EXPECT_EQ(one->bedding[k].offset, all[i].bedding[k].offset);
    }
    EXPECT_EQ(single_recipes(singles[i]).size(), 1u);
    EXPECT_EQ(specimen_key(single_recipes(singles[i]).front()), specimen_key(singles[i]));
    EXPECT_EQ(specimen_key(io::parse_recipe(io::write_recipe(singles[i]), "single")),
              specimen_key(singles[i]));
  }
}

TEST(SpecimenKey, ChangesWithEverythingThatChangesTheResult) {
  std::set<std::string> keys;
  const Recipe base = single_recipes(seven_angles()).front();
  const auto add = [&](auto change) {
    Recipe r = base;
    change(r);
    EXPECT_TRUE(keys.insert(specimen_key(r)).second);
  };
  add([](Recipe&) {});
  add([](Recipe& r) { r.bedding[1].k_s *= 1.0 + 1e-15; });
  add([](Recipe& r) { r.bedding[0].theta = 15; });
  add([](Recipe& r) { r.bedding[0].zone_thickness *= 2; });
  add([](Recipe& r) { r.bedding.clear(); });
  add([](Recipe& r) { r.packing.seed = 2; });
  add([](Recipe& r) { r.matrix.bond_seed = 2; });
  add([](Recipe& r) { r.engine.precision = Precision::single_precision; });
  add([](Recipe& r) { r.test.pre_strain = 1e-4; });
  add([](Recipe& r) { r.specimen.hole_diameter = 0.003; });
  add([](Recipe& r) { r.specimen.flaw_length = 0.003; });
  add([](Recipe& r) { r.specimen.flaw_length = 0.003, r.specimen.flaw_angle = 30.0; });
}

TEST(SpecimenKey, IgnoresWhatChangesNothing) {
  Recipe a = single_recipes(seven_angles()).front(), b = a;
  b.name = "another name";
  b.test.n_snapshots = 9;
  EXPECT_EQ(specimen_key(a), specimen_key(b));
  for (BeddingRecipe& set : a.bedding) set.rule = BeddingRule::crossing;
  b = a;
  b.bedding[0].zone_thickness *= 2;
  EXPECT_EQ(specimen_key(a), specimen_key(b));
}

TEST(SpecimenKey, IgnoresWhatTheRuleDoesNotRead) {
  const auto change = [](Recipe& r) {
    r.bedding[0].orientation_range = 40.0, r.bedding[0].patch_length = 0.002;
  };
  Recipe a = single_recipes(seven_angles()).front(), b = a;
  change(b);
  EXPECT_EQ(specimen_key(a), specimen_key(b));
  a.bedding[0].persistence = b.bedding[0].persistence = 0.5;
  EXPECT_NE(specimen_key(a), specimen_key(b)) << "patches";
  a.bedding[0] = b.bedding[0] = {};
  b.bedding[0].bridges = false;
  EXPECT_NE(specimen_key(a), specimen_key(b));
  a.bedding[0].rule = b.bedding[0].rule = BeddingRule::crossing;
  EXPECT_EQ(specimen_key(a), specimen_key(b));
  a.bedding[0].rule = b.bedding[0].rule = BeddingRule::oriented;
  b.bedding[0].zone_thickness *= 2.0;
  EXPECT_EQ(specimen_key(a), specimen_key(b));
  b.bedding[0].orientation_range = 20.0;
  EXPECT_NE(specimen_key(a), specimen_key(b));
}

// A key that comes to the recipe later, and is left alone, has its default: the same fingerprint.
TEST(SpecimenKey, IsTakenOfWhatIsNotByDefault) {
  Recipe r;
  EXPECT_EQ(keys_not_by_default(r), "0 sets of bedding\n");
  r.bedding.resize(2);
  r.bedding[1].k_n = 1e12, r.matrix.mu = 0.25;
  EXPECT_EQ(keys_not_by_default(r), "2 sets of bedding\nmatrix.mu = 0.25\nbedding[1].k_n = \"1000 GPa/m\"\n");
}

TEST(RecipeDifferences, AreAllKeysButTheAngles) {
  const Recipe a = seven_angles();
  Recipe b = a;
  b.test.angles = {5, 10};
  b.test.intact = false;
  genesis::turn_layers(b.matrix, b.bedding, 30.0);
  EXPECT_THAT(differences(a, b), testing::IsEmpty());
  b.matrix.mu = 0.25;
  b.bedding[1].k_s *= 2.0;
  const std::vector<RecipeDifference> d = differences(a, b);
  ASSERT_EQ(d.size(), 2u);
  EXPECT_EQ(d[0].key + " " + d[0].one + " " + d[0].other, "matrix.mu 0.8 0.25");
  EXPECT_EQ(d[1].key, "bedding[1].k_s");
  b.bedding.pop_back();
  ASSERT_EQ(differences(a, b).size(), 1u);
  EXPECT_EQ(differences(a, b)[0].other, "1");
}

class SpecimenKeyOfFiles : public InFolder {};

TEST_F(SpecimenKeyOfFiles, TakesAnImportedPackingByContent) {
  Recipe r = single_recipes(seven_angles()).front();
  const auto key_of = [&](const std::string& name, const char* content) {
    io::write_file(name, content);
    r.packing.file = name;
    return specimen_key(r);
  };
  const std::string one = key_of(at("phy-a"), "discs");
  EXPECT_EQ(key_of(at("phy-b"), "discs"), one);
  EXPECT_NE(key_of(at("phy-a"), "discs moved"), one);
}

// Rows of other physics must not be found under the keys of today. Quantiles are none of a row.
TEST(SpecimenKey, TheVersionOfResultsIsRaisedWithTheRecordedNumbers) {
  std::ifstream file(PHY_SOURCE_DIR "/tests/recorded.txt");
  std::string physics;
  for (std::string name, value; file >> name >> value;)
    if (!name.starts_with("columns/") && name != "golden/quantiles") physics += name + " " + value + "\n";
  EXPECT_EQ(std::to_string(results_version) + ": " + fingerprint_of(physics),
            "2: c3d35a42662641d2b645b4ac0f035a22")
      << "raise results_version (study/experiment.hpp), unless lines were only added to tests/recorded.txt, "
         "then write its new fingerprint here";
}

}  // namespace
}  // namespace phy::study
