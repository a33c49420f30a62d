#include "io/load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "base/nan.hpp"
#include "base/rng.hpp"
#include "io/scene.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "records/assembly.hpp"
#include "records/file_key_fixture.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

Specimen lattice() {
  Specimen s = assembly(hexagonal(6, 8, 0.001), MatrixRecipe{});
  bond_touching(s);
  s.bedding.resize(1);
  s.bedding[0].theta = 30.0;
  s.bedding_report = {{1.25, 0.5, 1.0 / 3.0}};
  return s;
}

/// Every disc on a course of its own; forces of both signs.
TestResult moving(const Specimen& s) {
  TestResult r;
  r.name = "theta = 30 deg";
  r.intact = false, r.theta = 30.0;
  r.outcome = {Status::not_peaked, "no drop", "raise test.max_strain"};
  r.numbers = {{"ucs", 1.0 / 3.0, "Pa", "largest", ""}, {"nu", nan, "1", "ratio", "too few rows"}};
  r.history.rows.resize(4);
  r.history.rows[2].axial_stress = 0.1, r.history.rows[3].energy_error = -1e-300;
  r.cracks.resize(1);
  r.cracks[0] = {7,          0.5,         1.0 / 7.0, 3,  9, CrackMode::shear, CrackPlace::bedding,
                 {0.1, 0.2}, {0.6, -0.8}, 3e-4,      1.5};
  r.n_steps = 123456789012, r.n_contacts = 77, r.dt = 1e-8 / 3.0, r.seconds = 2.5, r.hash = "abc";
  for (int k = 0; k < 9; ++k) {
    Frame f{100.0 * k, 1e-4 * k, 1e6 * k, {}};
    for (std::size_t i = 0; i < s.packing->discs.size(); ++i)
      f.u.push_back({static_cast<float>(1e-5 * k * std::sin(0.7 * static_cast<double>(i) + k)),
                     static_cast<float>(-3e-5 * k)});
    r.frames.push_back(f);
  }
  Snapshot shot;
  shot.step = 400.0, shot.axial_strain = 4e-4;
  shot.grains.resize(s.packing->discs.size());
  for (const Contact& c : s.contacts)
    shot.contacts.push_back({c.a, c.b, c.kind, false, 1e5 * std::sin(c.a + 0.1 * c.b), 0.0, {}});
  r.snapshots = {shot};
  return r;
}

class Load : public InFolder {
 protected:
  Recipe recipe;
  void SetUp() override {
    recipe.bedding.resize(1);
    recipe.test.angles = {30.0, 60.0};
  }
  void write(const std::string& name) {
    const Specimen s = lattice();
    write_result((folder / name).string(), recipe, "9.9", s, moving(s));
  }
};

TEST_F(Load, DispersedJointsHaveOneNumber) {
  Specimen s = lattice();
  s.bedding_report[0] = {};
  s.bedding_report[0].dispersed = true, s.bedding_report[0].joint_fraction = 1.0 / 7.0;
  write_result((folder / "d").string(), recipe, "9.9", s, moving(s));
  EXPECT_THAT(read(folder / "d" / "result.json"), Not(HasSubstr("overlap_ratio")));
  const SpecimenRecord back = read_result((folder / "d").string());
  EXPECT_TRUE(back.bedding.at(0).report.dispersed);
  EXPECT_EQ(back.bedding.at(0).report.joint_fraction, 1.0 / 7.0);
}

TEST_F(Load, EveryNumberComesBackToTheSameBits) {
  write("a");
  const SpecimenRecord back = read_result((folder / "a").string());
  const Specimen s = lattice();
  const TestResult sent = moving(s);
  EXPECT_EQ(result_json(back), read(folder / "a" / "result.json"));
  EXPECT_EQ(back.result.n_steps, sent.n_steps);
  EXPECT_EQ(back.result.numbers[0].value, 1.0 / 3.0);
  EXPECT_TRUE(std::isnan(back.result.numbers[1].value));
  EXPECT_EQ(back.bedding.at(0).report.non_crossing_fraction, 1.0 / 3.0);
  ASSERT_EQ(back.result.history.rows.size(), 4U);
  for (const HistoryColumn& c : TestKind()->columns)
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(back.result.history.rows[i].*c.value, sent.history.rows[i].*c.value) << c.name;
  ASSERT_EQ(back.result.cracks.size(), 1U);
  const CrackEvent &c = back.result.cracks[0], &d = sent.cracks[0];
  EXPECT_EQ(c.strain, d.strain);
  EXPECT_EQ(c.b, d.b);
  EXPECT_EQ(c.mode, d.mode);
  EXPECT_EQ(c.place, d.place);
  EXPECT_EQ(c.normal.y, d.normal.y);
  EXPECT_EQ(c.energy, d.energy);
}

// Neither more nor fewer keys than docs/result-tables.md lists.
TEST_F(Load, EveryKeyOfAResultIsListed) {
  SpecimenRecord record = record_of(recipe, "9.9", lattice(), moving(lattice()));
  record.result.numbers = {
      {"kinetic_ratio", 0.5, "1", "d", ""}, {"ucs", 1.0, "Pa", "d", ""}, {"E", nan, "Pa", "d", ""}};
  record.result.numbers[1].upper_bound = true;
  BeddingRecord oriented;
  oriented.report.dispersed = true;
  record.bedding.push_back(oriented);
  std::set<std::string> met;
  EXPECT_THAT(unlisted_keys(result_json(record), result_keys(), met), testing::IsEmpty());
  EXPECT_THAT(met, testing::ContainerEq(listed_keys(result_keys())));
}

TEST_F(Load, TheSceneComesBackWithinItsRounding) {
  const Specimen s = lattice();
  const Scene sent = scene_of(*s.packing, moving(s));
  const Scene back = unpack_scene(pack_scene(sent, TestKind("uniaxial")), "here");
  ASSERT_EQ(back.discs.size(), sent.discs.size());
  for (std::size_t i = 0; i < sent.discs.size(); ++i) {
    EXPECT_NEAR(back.discs[i].x, sent.discs[i].x, sent.height / 65000 * 0.51);
    EXPECT_NEAR(back.discs[i].r, sent.discs[i].r, sent.height / 65000 * 0.51);
  }
  ASSERT_EQ(back.frames.size(), 9U);
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_EQ(back.frames[k].axial_strain, sent.frames[k].axial_strain);
    for (std::size_t i = 0; i < sent.discs.size(); ++i)
      for (const std::size_t j : {0U, 1U})
        EXPECT_NEAR(back.frames[k].u[i][j], sent.frames[k].u[i][j], 0.126e-6);
  }
  ASSERT_EQ(back.forces.size(), 1U);
  ASSERT_EQ(back.links.size(), s.contacts.size());
  for (std::size_t i = 0; i < back.links.size(); ++i) {
    EXPECT_EQ(back.links[i].a, s.contacts[i].a);
    EXPECT_EQ(back.links[i].b, s.contacts[i].b);
    EXPECT_NEAR(back.forces[0].F_n[i], sent.forces[0].F_n[i], 1e5 * 2.0 / 127);
  }
}

TEST_F(Load, ScenesOfDirectShearAreFiledUnderADisplacementAndOlderOnesUnderAStrain) {
  const Specimen s = lattice();
  const Scene sent = scene_of(*s.packing, moving(s));
  for (const TestKind kind : {TestKind("direct_shear"), TestKind("uniaxial")}) {
    const std::string bytes = pack_scene(sent, kind);
    const bool shear = kind == TestKind("direct_shear");
    EXPECT_EQ(bytes.find("\"axial_strain\"") == bytes.npos, shear);
    EXPECT_EQ(bytes.find("\"shear_displacement [m]\"") != bytes.npos, shear);
    const Scene back = unpack_scene(bytes, "here");
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_EQ(back.frames[k].axial_strain, sent.frames[k].axial_strain);
      EXPECT_EQ(back.frames[k].axial_stress, sent.frames[k].axial_stress);
    }
  }
}

TEST_F(Load, ADisplacementBeyondSixteenBitsKeepsItsRelativeRounding) {
  Scene scene;
  scene.width = scene.height = 1.0;
  scene.discs.resize(2);
  scene.frames = {{0, 0, 0, {{0.0F, 0.0F}, {-5.0F, 4.0F}}}, {1, 0, 0, {{1.0F, 0.5F}, {5.0F, -5.0F}}}};
  const Scene back = unpack_scene(pack_scene(scene, TestKind("uniaxial")), "here");
  EXPECT_NEAR(back.frames[1].u[1][0], 5.0, 1e-3);
  EXPECT_NEAR(back.frames[0].u[1][0], -5.0, 1e-3);
}

TEST_F(Load, DamagedScenesAreRefusedAndNeverCrash) {
  const Specimen s = lattice();
  const std::string good = pack_scene(scene_of(*s.packing, moving(s)), TestKind("uniaxial"));
  EXPECT_THROW(unpack_scene("", "x"), InputError);
  EXPECT_THROW(unpack_scene("{}\n", "x"), InputError);
  EXPECT_THROW(unpack_scene(good.substr(0, good.size() / 2), "x"), InputError);
  for (std::size_t i = 0; i < good.size(); i += 5) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x15);
    try {
      unpack_scene(bad, "x");
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("x"));
    }
  }
}

TEST_F(Load, ARunTellsWhatIsMissingAndWhatIsDamaged) {
  write("theta_30");
  RunRecord run = read_run(folder.string());
  ASSERT_EQ(run.tests.size(), 1U);
  ASSERT_EQ(run.missing.size(), 1U);
  EXPECT_EQ(run.missing[0].name, "theta = 60 deg");
  fs::create_directories(folder / "theta_60_deg");
  std::ofstream(folder / "theta_60_deg" / "result.json") << "{\"format\": 1}";
  run = read_run(folder.string());
  ASSERT_EQ(run.tests.size(), 1U);
  ASSERT_EQ(run.missing.size(), 1U) << "damaged is not missing too";
  EXPECT_THAT(run.missing[0].reason, HasSubstr("theta_60_deg"));
}

TEST_F(Load, BracketsInBracketsAndNumbersThatAreNoCountsAreRefused) {
  write("a");
  const std::string json = read(folder / "a" / "result.json");
  std::filesystem::remove(folder / "a" / ".written-by-phyllite");
  const auto refused = [&](const std::string& before, const std::string& now) {
    std::string bad = json;
    ASSERT_NE(bad.find(before), bad.npos);
    std::ofstream(folder / "a" / "result.json") << bad.replace(bad.find(before), before.size(), now);
    EXPECT_THROW(read_result((folder / "a").string()), InputError) << now.substr(0, 40);
  };
  refused("{", "{\"deep\":" + std::string(100000, '[') + std::string(100000, ']') + ",");
  refused("\"n_steps\": 123456789012", "\"n_steps\": 1e300");
  refused("\"n_contacts\": 77", "\"n_contacts\": 18446744073709551615");
}

TEST_F(Load, AnUnknownOutcomeIsNotTakenForAnother) {
  write("a");
  std::string json = read(folder / "a" / "result.json");
  const std::string known = "\"status\": \"not peaked\"";
  ASSERT_NE(json.find(known), json.npos);
  json.replace(json.find(known), known.size(), "\"status\": \"cracked\"");
  std::ofstream(folder / "a" / "result.json") << json;
  std::filesystem::remove(folder / "a" / ".written-by-phyllite");
  try {
    read_result((folder / "a").string());
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(),
                HasSubstr("result.json: outcome.status = cracked: expected one of peaked, not peaked"));
  }
}

TEST_F(Load, ATableWithABadCellNamesFileAndLine) {
  write("a");
  std::ofstream(folder / "a" / "cracks.csv", std::ios::app) << "1,x\n";
  std::filesystem::remove(folder / "a" / ".written-by-phyllite");
  try {
    read_result((folder / "a").string());
    FAIL() << "no error";
  } catch (const IoError& e) {
    EXPECT_THAT(e.what(), HasSubstr("cracks.csv:3"));
  }
}

TEST_F(Load, AFolderWithoutResultsIsRefused) {
  EXPECT_THROW(read_run(folder.string()), InputError);
  EXPECT_THROW(read_run((folder / "nothing").string()), IoError);
}

}  // namespace
}  // namespace phy::io
