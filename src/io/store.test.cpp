// Files: whole or not at all, and back to the same bits.
#include "io/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "io/toml_in.hpp"
#include "records/assembly.hpp"

namespace phy {
namespace {

namespace fs = std::filesystem;

class Store : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("phyllite-store-" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  static TestResult small_result() {
    TestResult r;
    r.name = "theta = 30 deg";
    r.intact = false;
    r.theta = 30.0;
    r.outcome = {Status::peaked, "peak", ""};
    r.numbers = {{"ucs", 1.0 / 3.0, "Pa", "largest", ""},
                 {"nu", std::numeric_limits<double>::quiet_NaN(), "1", "ratio", "too few rows"}};
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
  std::string read(const fs::path& p) const {
    std::ifstream in(p);
    return {std::istreambuf_iterator<char>(in), {}};
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

TEST_F(Store, ASecondResultReplacesTheFirstAndLeavesNoRest) {
  const fs::path place = folder / "x";
  TestResult r = small_result();
  write_result(place.string(), Recipe{}, "1", pair(), r);
  r.hash = "second";
  write_result(place.string(), Recipe{}, "1", pair(), r);
  EXPECT_THAT(read(place / "result.json"), testing::HasSubstr("second"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(Store, AFileInTheWayIsToldWithARemedy) {
  std::ofstream(folder / "file") << "x";
  try {
    check_writable((folder / "file" / "out").string());
    FAIL() << "no error";
  } catch (const IoError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("a file of that name is in the way"));
  }
}

TEST_F(Store, AFullDiskLeavesNothingBehind) {
  fs::create_symlink("/dev/full", folder / (std::string("full.csv.part-") + std::to_string(::getpid())));
  try {
    write_file((folder / "full.csv").string(), "some text");
    FAIL() << "no error";
  } catch (const IoError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("free some space"));
  }
  EXPECT_FALSE(fs::exists(folder / "full.csv"));
}

TEST_F(Store, DiscsReadBackToTheSameBits) {
  Packing p;
  p.width = 1.0 / 3.0;
  p.discs = {{0.1, 0.2, 1.0 / 7.0}, {1e-17, 3.0, 0.3}};
  write_file((folder / "d.csv").string(), discs_csv(p));
  const auto back = read_discs((folder / "d.csv").string());
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].r, p.discs[0].r);
  EXPECT_EQ(back[1].x, p.discs[1].x);
}

TEST_F(Store, BadDiscsAreToldAllAtOnce) {
  write_file((folder / "d.csv").string(), "x [m],y [m],r [m]\n1,2,3\n1,2\n1,2,-3\n1,two,3\n");
  try {
    read_discs((folder / "d.csv").string());
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().size(), 3U);
    EXPECT_THAT(e.what(), testing::HasSubstr("d.csv:3"));
  }
  write_file((folder / "e.csv").string(), "x,y,r\n1,2,3\n");
  EXPECT_THROW(read_discs((folder / "e.csv").string()), InputError);
}

TEST_F(Store, ContactsNameTheirKind) {
  EXPECT_THAT(contacts_csv(pair()), testing::HasSubstr("0,1,bonded,0,1,0,"));
}

}  // namespace
}  // namespace phy
