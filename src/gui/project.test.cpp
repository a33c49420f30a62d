#include "gui/project.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"

namespace phy::gui {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// The folder is the working directory while a test runs.
class ProjectTest : public InFolder {
 protected:
  const fs::path before = fs::current_path();
  void SetUp() override { fs::current_path(folder); }
  void TearDown() override { fs::current_path(before); }
};

const std::string table = "theta [deg],E [GPa]\n0,20\n45,15\n90,50\n";

TEST_F(ProjectTest, ANewRockIsATemplateUntilItIsSaved) {
  const RockFiles fresh = read_rock_files("shale");
  EXPECT_EQ(fresh.stamp, "");
  EXPECT_TRUE(rock_names().empty());
  const std::string stamp = save_rock("shale", fresh.toml, table, fresh.stamp);
  EXPECT_THAT(rock_names(), ElementsAre("shale"));
  EXPECT_EQ(read("shale.csv"), table);
  EXPECT_EQ(read_rock_files("shale").stamp, stamp);
  EXPECT_EQ(read_rock_files("shale").table, table);
}

TEST_F(ProjectTest, WhatSomebodyElseHasChangedIsNotWrittenOver) {
  const std::string toml = read_rock_files("shale").toml;
  const std::string stamp = save_rock("shale", toml, table, "");
  write("shale.csv", table + "60,17\n");
  EXPECT_THROW(save_rock("shale", toml, table, stamp), Changed);
  EXPECT_EQ(read("shale.csv"), table + "60,17\n");
  EXPECT_THROW(save_rock("shale", toml, table, ""), Changed);
  save_rock("shale", toml, table, read_rock_files("shale").stamp);
  EXPECT_EQ(read("shale.csv"), table);
}

TEST_F(ProjectTest, ATableThatIsThereIsTheRocks) {
  write("shale.csv", table);
  const RockFiles fresh = read_rock_files("shale");
  EXPECT_EQ(fresh.table, table);
  EXPECT_NE(fresh.stamp, "");
  save_rock("shale", fresh.toml, table + "60,17\n", fresh.stamp);
  EXPECT_EQ(read("shale.csv"), table + "60,17\n");
}

TEST_F(ProjectTest, OnlyTablesOfThisFolderAreWritten) {
  write("other.csv", "mine");
  write("model.toml", "[packing]\n");
  fs::create_directory("sub");
  for (const char* name :
       {"../x.csv", "/tmp/x.csv", "sub/x.csv", "model.toml", ".hidden.csv", "other.csv", "a\\nb.csv"})
    EXPECT_THROW(save_rock("shale", "data = \"" + std::string(name) + "\"\n", table, ""), InputError) << name;
  EXPECT_THROW(save_rock("shale", "E_is = \"average\"\n", table, ""), InputError);
  EXPECT_EQ(read("other.csv"), "mine");
  EXPECT_FALSE(fs::exists("shale.toml"));
}

TEST_F(ProjectTest, ATableThatIsNoTextStays) {
  write("shale.toml", "data = \"shale.xlsx\"\n");
  write("shale.xlsx", std::string("PK\x03\x04\0\xff", 6));
  write("old.toml", "data = \"old.csv\"\n");
  write("old.csv", "theta,E\n0,\xff\n");
  for (const char* name : {"shale", "old"}) {
    const RockFiles rock = read_rock_files(name);
    EXPECT_FALSE(rock.table) << name;
    save_rock(name, rock.toml + "# more\n", {}, rock.stamp);
  }
  EXPECT_EQ(read("old.csv"), "theta,E\n0,\xff\n");
  EXPECT_EQ(read("shale.toml"), "data = \"shale.xlsx\"\n# more\n");
}

// Its stamp would say nothing: what somebody else does to it meanwhile would be written over.
TEST_F(ProjectTest, WhatThePageCannotShowItDoesNotSaveEither) {
  const std::string large(5 << 20, '#');
  const std::string stamp = save_rock("shale", "data = \"shale.csv\"\n", table, "");
  EXPECT_THAT(message_of<InputError>([&] { save_rock("shale", "data = \"shale.csv\"\n", large, stamp); }),
              HasSubstr("shale.csv: expected a text of at most 4 MB"));
  EXPECT_THAT(
      message_of<InputError>([&] { save_rock("shale", "data = \"shale.csv\"\n" + large, {}, stamp); }),
      HasSubstr("shale.toml: expected a text of at most 4 MB"));
  EXPECT_EQ(read_rock_files("shale").stamp, stamp);
  write("shale.csv", large);  // from elsewhere
  const RockFiles shown = read_rock_files("shale");
  EXPECT_FALSE(shown.table);
  EXPECT_THROW(save_rock("shale", shown.toml, table, shown.stamp), InputError);
  EXPECT_EQ(fs::file_size("shale.csv"), large.size());
  ASSERT_EQ(::mkfifo("pipe.csv", 0600), 0);
  EXPECT_THROW(save_rock("other", "data = \"pipe.csv\"\n", table, ""), InputError);
}

TEST_F(ProjectTest, NamesBecomeFilesOfThisFolder) {
  for (const char* name : {"", ".", "..", "../a", "a/b", ".a", "-a", "a\"b", "a\nb", " a", "a\\b"})
    EXPECT_THROW(read_rock_files(name), InputError) << name;
  for (const char* name : {"a", "Grauwacke 2", "片岩", "a.b", "Öl-Schiefer"})
    EXPECT_NO_THROW(read_rock_files(name));
  EXPECT_THROW(check_name(std::string(81, 'a')), InputError);
}

TEST_F(ProjectTest, CalibrationsAreNumbered) {
  EXPECT_EQ(calibration_of("a"), "a-calibration");
  EXPECT_EQ(next_calibration_of("a"), "a-calibration");
  fs::create_directory("a-calibration");
  EXPECT_EQ(calibration_of("a"), "a-calibration");
  EXPECT_EQ(next_calibration_of("a"), "a-calibration-2");
  fs::create_directory("a-calibration-3");  // 2 was deleted
  fs::create_directory("a-calibration-x");
  fs::create_directory("a-calibration-04");
  EXPECT_EQ(calibration_of("a"), "a-calibration-3");
  EXPECT_EQ(next_calibration_of("a"), "a-calibration-4");
}

TEST_F(ProjectTest, ServesFilesOfTheFolderAlone) {
  fs::create_directory("results");
  write("results/report.html", "x");
  write(".hidden", "x");
  fs::create_symlink("/etc/passwd", "link.txt");
  fs::create_directory_symlink("/etc", "etc");
  fs::create_directory(".secret");
  write(".secret/x.txt", "x");
  fs::create_symlink(".secret/x.txt", "public.txt");
  EXPECT_THROW(check_inside("etc/x"), InputError);
  EXPECT_NO_THROW(check_inside("results/new/x"));
  EXPECT_NO_THROW(check_inside("not-there"));
  EXPECT_TRUE(served_file("results/report.html"));
  for (const char* path : {"../passwd", "results/../results/report.html", "/etc/passwd", "link.txt",
                           "public.txt", "etc/passwd", ".hidden", "results", "results/", "", "nothing.txt",
                           "results//report.html/", "..\\passwd", "./results/report.html"})
    EXPECT_FALSE(served_file(path)) << path;
  EXPECT_THAT(content_type("a/report.html"), HasSubstr("text/html"));
  EXPECT_EQ(content_type("picture.svg"), "application/octet-stream");  // may hold scripts
}

}  // namespace
}  // namespace phy::gui
