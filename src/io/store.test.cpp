#include "io/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "base/nan.hpp"
#include "io/load.hpp"
#include "io/toml_in.hpp"
#include "records/assembly.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;

class Store : public InFolder {
 protected:
  static TestResult small_result() {
    TestResult r;
    r.name = "theta = 30 deg";
    r.intact = false;
    r.theta = 30.0;
    r.outcome = {Status::peaked, "peak", ""};
    r.numbers = {{"ucs", 1.0 / 3.0, "Pa", "largest", ""}, {"nu", nan, "1", "ratio", "too few rows"}};
    r.history.rows.resize(3);
    r.history.rows[1].axial_stress = 0.1;
    r.cracks.resize(2);
    Snapshot shot;
    shot.grains.resize(2);
    shot.contacts.push_back({0, 1, ContactKind::joint, true, 5.0, -1.0, {1.0, 0.0}});
    r.snapshots = {shot};
    return r;
  }
  static Specimen pair() {
    Specimen s = assembly({{0.0, 0.0, 1.0}, {2.0, 0.0, 1.0}}, MatrixRecipe{});
    bond_touching(s);
    s.bedding.resize(1);
    s.bedding_report.resize(1);
    return s;
  }
};

TEST_F(Store, ResultFolderHoldsEverything) {
  const fs::path place = folder / "a" / "theta_30";
  write_result(place.string(), Recipe{}, "1.2.3", pair(), small_result());
  const auto j = nlohmann::json::parse(read(place / "result.json"));
  EXPECT_EQ(j["numbers"]["ucs"]["value"].get<double>(), 1.0 / 3.0);
  EXPECT_TRUE(j["numbers"]["nu"]["value"].is_null());
  EXPECT_EQ(j["numbers"]["nu"]["note"], "too few rows");
  EXPECT_EQ(j["outcome"]["status"], "peaked");
  EXPECT_EQ(write_recipe(parse_recipe(j["recipe"].get<std::string>(), "json")), write_recipe(Recipe{}));
  EXPECT_THAT(read(place / "history.csv"), testing::HasSubstr("axial_stress [Pa]"));
  for (const char* name :
       {"cracks.csv", "recipe.toml", "grains.pvd", "snapshots/grains_0.vtp", "snapshots/cracks.vtp"})
    EXPECT_TRUE(fs::exists(place / name)) << name;
}

TEST_F(Store, EventsAreThereWhereTheRecipeAsksForThem) {
  const fs::path place = folder / "heard";
  Recipe recipe;
  write_result(place.string(), recipe, "1", pair(), small_result());
  EXPECT_FALSE(fs::exists(place / "events.csv"));
  recipe.test.events = true;
  TestResult r = small_result();
  r.events.resize(2);
  write_result(place.string(), recipe, "1", pair(), r);
  EXPECT_TRUE(fs::exists(place / "snapshots" / "events.vtp"));
  EXPECT_EQ(read_result(place.string()).result.events.size(), 2U);
}

TEST_F(Store, ASecondResultReplacesTheFirstAndLeavesNoRest) {
  const fs::path place = folder / "x";
  TestResult r = small_result();
  write_result(place.string(), Recipe{}, "1", pair(), r);
  r.hash = "second";
  write_result(place.string(), Recipe{}, "1", pair(), r);
  EXPECT_THAT(read(place / "result.json"), testing::HasSubstr("second"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(Store, AFolderThatIsNoResultIsNeitherReplacedNorRemoved) {
  fs::create_directories(folder / "thesis");
  std::ofstream(folder / "thesis" / "chapter1.tex") << "years of work";
  try {
    write_result((folder / "thesis").string(), Recipe{}, "1", pair(), small_result());
    FAIL() << "no error";
  } catch (const IoError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("holds no result"));
  }
  EXPECT_EQ(read(folder / "thesis" / "chapter1.tex"), "years of work");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(Store, TheRecipeIsThereAsTextAndAsValuesWithUnits) {
  Recipe recipe;
  recipe.bedding.resize(1);
  recipe.test.angles = {0.0, 22.5};
  write_result((folder / "x").string(), recipe, "1", pair(), small_result());
  const auto j = nlohmann::json::parse(read(folder / "x" / "result.json"));
  EXPECT_EQ(j["format"], result_format);
  EXPECT_EQ(j["recipe"].get<std::string>(), write_recipe(recipe));
  EXPECT_EQ(read(folder / "x" / "recipe.toml"), write_recipe(recipe));
  const auto& values = j["recipe_values"];
  EXPECT_EQ(values["specimen"]["width [m]"].get<double>(), 0.038);
  EXPECT_EQ(values["bedding"][0]["k_n [Pa/m]"].get<double>(), 3360e9);
  EXPECT_EQ(values["bedding"][0]["rule"], "zone");
  EXPECT_EQ(values["test"]["angles [deg]"][1].get<double>(), 22.5);
  EXPECT_EQ(values["test"]["intact"], false);
  EXPECT_EQ(values["name"], "paper");
}

TEST_F(Store, NotANumberIsNullWithAReason) {
  TestResult r = small_result();
  r.numbers[1].note.clear();
  write_result((folder / "x").string(), Recipe{}, "1", pair(), r);
  const auto j = nlohmann::json::parse(read(folder / "x" / "result.json"));
  EXPECT_TRUE(j["numbers"]["nu"]["value"].is_null());
  EXPECT_EQ(j["numbers"]["nu"]["note"], "could not be determined");
}

TEST_F(Store, HistoryReadsBackToTheSameBits) {
  TestResult r = small_result();
  r.history.rows[2].axial_strain = 1.0 / 3.0;
  write_result((folder / "x").string(), Recipe{}, "1", pair(), r);
  std::istringstream lines(read(folder / "x" / "history.csv"));
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(lines, line);
  std::istringstream cells(line);
  std::vector<double> values;
  for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
  ASSERT_EQ(values.size(), TestKind()->columns.size());
  EXPECT_EQ(values[2], 1.0 / 3.0);
}

}  // namespace
}  // namespace phy::io
