#include "io/file_kinds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/in_folder_fixture.hpp"
#include "io/regressions.hpp"
#include "io/toml_in.hpp"
#include "rock/file.hpp"
#include "rock/schema.hpp"

namespace phy::rock {
namespace {

using io::parse_recipe;
using io::parse_toml;
using io::read_user_file;
using io::refuse_other_kind;
using io::TomlValue;
using testing::HasSubstr;

const char* const rock = "name = \"slate\"\ndata = \"slate.csv\"\n[specimen]\nwidth = \"38 mm\"\n";
const char* const recipe =
    "name = \"first\"\n[specimen]\nwidth = \"8 mm\"\n[packing]\nn_grains = 330\n[[bedding]]\n";
const char* const study = "recipe = \"first.toml\"\n[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1]\n";
const char* const lines = "[[line]]\nsource = \"x\"\n";

std::string as(const std::string& wanted, const std::string& text) {
  std::vector<Problem> problems;
  try {
    refuse_other_kind(parse_toml(text, "my file.toml", problems), "my file.toml", wanted);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(FileKinds, EachIsToldFromTheOthers) {
  EXPECT_EQ(as("recipe", rock),
            "my file.toml is a rock file, not a recipe. To calibrate it: phyllite calibrate 'my file.toml'");
  EXPECT_EQ(as("rock", recipe),
            "my file.toml is a recipe, not a rock file. To test it: phyllite run 'my file.toml'");
  EXPECT_EQ(as("recipe", study),
            "my file.toml is a study, not a recipe. To run it: phyllite study 'my file.toml'");
  EXPECT_THAT(as("study", rock), HasSubstr("is a rock file, not a study"));
  EXPECT_THAT(as("study", recipe), HasSubstr("is a recipe, not a study"));
  EXPECT_THAT(as("rock", study), HasSubstr("is a study, not a rock file"));
  EXPECT_THAT(as("rock", lines), HasSubstr("is a list of published lines, not a rock file"));
}

TEST(FileKinds, OwnKeysCountFirst) {
  EXPECT_EQ(as("rock", rock), "");
  EXPECT_EQ(as("recipe", recipe), "");
  EXPECT_EQ(as("study", study), "");
  // What both have, and what none has, says nothing.
  EXPECT_EQ(as("recipe", "[specimen]\nwidth = \"38 mm\"\n"), "");
  EXPECT_EQ(as("rock", "nmae = \"x\"\n"), "");
  // A key in the wrong file is told as a key.
  EXPECT_EQ(as("recipe", std::string(recipe) + "[brazilian]\ndiameter = \"50 mm\"\n"), "");
  EXPECT_EQ(as("rock", std::string(rock) + "[matrix]\nmu = 1\n"), "");
}

// [bedding] and matrix = "..." are of a rock, [[bedding]] and [matrix] of a recipe.
TEST(FileKinds, WordsOfTwoKindsGoByTheirForm) {
  EXPECT_EQ(as("rock", "matrix = \"flat_joint\"\n[bedding]\nspacing = \"5 mm\"\n"), "");
  EXPECT_THAT(as("rock", "[[bedding]]\nspacing = \"5 mm\"\n"), HasSubstr("is a recipe"));
  EXPECT_THAT(as("rock", "[matrix]\nmu = 1\n"), HasSubstr("is a recipe"));
}

// Keys given to a function (line 0) are told one by one.
TEST(FileKinds, KeysOfNoFileAreNoFile) {
  std::vector<Problem> problems;
  TomlValue keys = parse_toml(rock, "", problems);
  for (TomlValue::Key& key : keys.keys) key.line = 0;
  EXPECT_NO_THROW(refuse_other_kind(keys, "Recipe", "recipe"));
}

// A word that is listed for a kind is a key or a table of its schema.
TEST(FileKinds, EveryKeyOfARockOnItsOwnIsOfARock) {
  for (const Field& f : rock_schema().fields) {
    const std::string word = f.table.empty() ? f.key : f.table;
    if (word == "name" || word == "recipe" || word == "specimen" || word == "bedding" || word == "matrix")
      continue;
    const std::string text = f.table.empty() ? word + " = 1\n" : "[" + word + "]\n";
    EXPECT_THAT(as("recipe", text), HasSubstr("is a rock file")) << word;
  }
}

TEST(FileKinds, TablesNeedARockFile) {
  for (const char* table : {"slate.csv", "slate.XLSX", "slate.ags"}) try {
      read_user_file(table, "recipe");
      FAIL() << table;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()), std::string(table) +
                                           " is a table, not a recipe. To make a rock file of it: "
                                           "phyllite rock new NAME --data " +
                                           table);
    }
}

// Editors of Windows name a recipe r.toml.txt.
class TextFiles : public InFolder {};
TEST_F(TextFiles, AreTablesWithoutKeys) {
  EXPECT_EQ(read_user_file(write("r.toml.txt", recipe), "recipe"), recipe);
  EXPECT_THROW(read_user_file(write("t.txt", "sigma1 sigma3\n100 10\n"), "recipe"), InputError);
}

TEST(FileKinds, ReadersRefuseTheOther) {
  try {
    parse_recipe(rock, "slate.toml");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().size(), 1u);
    EXPECT_THAT(e.what(), HasSubstr("slate.toml is a rock file"));
  }
  EXPECT_THROW(parse_rock(recipe, "first.toml", {}), InputError);
}

}  // namespace
}  // namespace phy::rock
