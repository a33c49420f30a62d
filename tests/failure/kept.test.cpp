// What is shown is what was computed: what was changed, cut short or damaged after it was stored is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../change_rows.hpp"
#include "../program.hpp"
#include "io/sqlite.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Kept : public ProgramTest {
 protected:
  /// Prefix that takes away what only root may do; empty when there is nothing to take away.
  static std::string as_nobody() {
    return ::geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  }
  std::string study() const {
    small_recipe("max_strain = 0.03\n");
    return write("study.toml", "recipe = \"small.toml\"\n");
  }
  void in_store(const std::string& sql) const { phy::io::Database(out() + "/study.sqlite").execute(sql); }
};

TEST_F(Kept, AChangedNumberOfAStudyIsTold) {
  ASSERT_EQ(run("study " + study() + " --out " + out()), 0) << output;
  in_store("UPDATE number SET value = 2 * value WHERE name = 'ucs'");
  for (const char* verb : {"status", "effects", "export", "resume"}) {
    EXPECT_EQ(run("study " + std::string(verb) + " " + out()), 3) << verb << output;
    EXPECT_THAT(output, AllOf(HasSubstr("3 record(s) are not as this program stored them"),
                              HasSubstr("(intact)"), HasSubstr("DELETE FROM specimen")));
  }
  in_store("DELETE FROM specimen");
  EXPECT_EQ(run("study resume " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("3 run in"));
}

TEST_F(Kept, AChangedFileOfAResultIsTold) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  for (const char* name : {"history.csv", "cracks.csv", "scene.bin", "result.json", "recipe.toml"}) {
    const std::string file = out() + "/intact/" + name, whole = read(file);
    std::string changed = whole;
    changed[whole.size() / 2] = static_cast<char>(changed[whole.size() / 2] ^ 1);
    for (const std::string& content :
         {changed, whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1), std::string()}) {
      std::ofstream(file, std::ios::binary) << content;
      EXPECT_EQ(run("show " + out()), 3) << name << output;
      EXPECT_THAT(output,
                  AllOf(HasSubstr(std::string(name) + ": is not as this program wrote it"), HasSubstr("45")));
    }
    std::ofstream(file, std::ios::binary) << whole;
  }
  EXPECT_EQ(run("show " + out()), 0) << output;
}

// Without its list a table is read as it is, but never one that is cut short.
TEST_F(Kept, ATableOfNoListIsReadToItsEnd) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  fs::remove(out() + "/intact/.written-by-phyllite");
  const std::string file = out() + "/intact/history.csv", whole = read(file);
  std::ofstream(file) << whole.substr(0, whole.size() - 3);
  EXPECT_EQ(run("report " + out()), 3) << output;
  EXPECT_THAT(output, HasSubstr("ends in the middle of a line"));
  std::ofstream(file) << "";
  EXPECT_EQ(run("show " + out()), 3) << output;
  EXPECT_THAT(output, HasSubstr("history.csv: is empty"));
}

TEST_F(Kept, RowsOfAnotherVersionAreTold) {
  ASSERT_EQ(run("study " + study() + " --out " + out()), 0) << output;
  EXPECT_THAT(output, Not(HasSubstr("made by")));
  phy::change_rows(out() + "/study.sqlite", "UPDATE specimen SET program = 'phyllite 0.0.9' WHERE intact",
                   [](phy::study::StoredResult& r) {
                     if (r.result.intact) r.program = "phyllite 0.0.9";
                   });
  for (const char* verb : {"status", "effects", "resume"}) {
    EXPECT_EQ(run("study " + std::string(verb) + " " + out()), 0) << output;
    EXPECT_THAT(output, HasSubstr("1 result(s) were made by phyllite 0.0.9, this is phyllite ")) << verb;
  }
}

TEST_F(Kept, AStudyThatCannotBeWrittenCanBeRead) {
  ASSERT_EQ(run("study " + study() + " --out " + out()), 0) << output;
  const std::string before = hash();
  fs::permissions(
      out(), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  ASSERT_EQ(run_line(as_nobody() + PHY_PROGRAM + " study status " + out()), 0) << output;
  EXPECT_EQ(hash(), before);
  EXPECT_EQ(run_line(as_nobody() + PHY_PROGRAM + " study export " + out() + " 2>/dev/null"), 0);
  EXPECT_EQ(output, read(out() + "/results.csv"));
  EXPECT_EQ(run_line(as_nobody() + PHY_PROGRAM + " study resume " + out()), 3);
  fs::permissions(out(), fs::perms::owner_all);
  EXPECT_EQ(run("study merge " + out() + " " + out() + "/study.sqlite"), 2) << "with itself";
  EXPECT_THAT(output, HasSubstr("expected another store"));
}

}  // namespace
