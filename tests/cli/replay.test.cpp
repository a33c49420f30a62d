// `phyllite replay`: what is stored comes out again, and what does not is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <regex>
#include <thread>

#include "../change_rows.hpp"
#include "../program.hpp"
#include "io/sqlite.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Replay : public ProgramTest {
 protected:
  std::string study(const std::string& more = "") const {
    small_recipe("max_strain = 0.03\n");
    return write("study.toml", "recipe = \"small.toml\"\n" + more);
  }
  void in_store(const std::string& sql) const { phy::io::Database(out() + "/study.sqlite").execute(sql); }
  /// Changes a file of a result as somebody would who knows of the list beside it.
  void change(const std::string& file, const std::regex& from, const std::string& to) const {
    const std::string text = read(file);
    std::ofstream(file) << std::regex_replace(text, from, to);
    fs::remove(fs::path(file).parent_path() / ".written-by-phyllite");
  }
};

TEST_F(Replay, ARunIsEqual) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  EXPECT_EQ(run("replay " + out()), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("3 of 3 tests run again"), HasSubstr("is equal to what is stored")));
  EXPECT_EQ(run("replay " + out() + "/intact --out " + at("again")), 0) << output;
  EXPECT_THAT(output, HasSubstr("1 of 1 tests run again"));
  EXPECT_EQ(read(at("again/intact/history.csv")), read(out() + "/intact/history.csv"));
  EXPECT_EQ(run("replay " + out() + " --out " + at("again")), 2) << "it holds results";
  EXPECT_EQ(run("replay " + out() + " --tests 2"), 0) << output;
  EXPECT_THAT(output, HasSubstr("2 of 2 tests run again"));
}

TEST_F(Replay, AChangedResultIsTold) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  change(out() + "/intact/result.json", std::regex("(\"ucs\": \\{\\s*\"value\": )[0-9.e+]+"), "$012");
  change(out() + "/theta_45_deg/result.json", std::regex("\"program\": \"phyllite [0-9.]+"),
         "\"program\": \"phyllite 0.0.9");
  EXPECT_EQ(run("replay " + out()), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("intact: DIFFERS"), HasSubstr("ucs [Pa]: stored"),
                            HasSubstr("1 result(s) were made by phyllite 0.0.9"), HasSubstr("1 differs")));
  change(out() + "/theta_60_deg/history.csv", std::regex("\n5\\d\\d,([^\n]*)"), "\n599,$1");
  EXPECT_EQ(run("replay " + out()), 1) << output;
  EXPECT_THAT(output, HasSubstr("step [1]: stored 599"));
}

TEST_F(Replay, ADamagedFolderIsTold) {
  EXPECT_EQ(run("replay " + at("absent")), 3) << output;
  fs::create_directories(out());
  EXPECT_EQ(run("replay " + out()), 2) << output;
  EXPECT_THAT(output, HasSubstr("a folder with results that can be run again"));
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  std::ofstream(out() + "/intact/recipe.toml", std::ios::app) << "# changed\n";
  EXPECT_EQ(run("replay " + out()), 3) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("recipe.toml: is not as this program wrote it"),
                            HasSubstr("2 of 2 tests run again")));
}

TEST_F(Replay, SomeTestsOfAStore) {
  ASSERT_EQ(run("study " + study() + " --out " + out()), 0) << output;
  EXPECT_EQ(run("replay " + out()), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("3 of its 3 tests"), HasSubstr("3 of 3 tests run again")));
  EXPECT_EQ(run("replay " + out() + " --tests 1 --out " + at("again")), 0) << output;
  EXPECT_THAT(output, HasSubstr("1 of its 3 tests"));
  EXPECT_EQ(run("show " + at("again")), 0) << "as results of a run: " << output;
  const std::string twice = "UPDATE number SET value = 2 * value WHERE name = 'ucs'";
  phy::change_rows(out() + "/study.sqlite", twice, [](phy::study::StoredResult& r) {
    for (phy::Number& n : r.result.numbers)
      if (n.name == "ucs") n.value *= 2.0;
  });
  EXPECT_EQ(run("replay " + out()), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("(-50 %)"), HasSubstr("3 differ")));
  in_store(twice);  // without the checksum
  EXPECT_EQ(run("replay " + out()), 3) << output;
}

TEST_F(Replay, RowsOfOtherPhysicsAreTold) {
  ASSERT_EQ(run("study " + study() + " --out " + out()), 0) << output;
  phy::change_rows(
      out() + "/study.sqlite",
      "UPDATE number SET key = 'x' || substr(key, 2); UPDATE specimen SET key = 'x' || substr(key, 2)",
      [](phy::study::StoredResult& r) { r.key[0] = 'x'; });
  EXPECT_EQ(run("replay " + out()), 1) << output;
  EXPECT_THAT(output, HasSubstr("stored by a version of other physics"));
}

TEST_F(Replay, DirectSolutions) {
  ASSERT_EQ(run("study " + study("solver = \"direct\"\n") + " --out " + out()), 0) << output;
  EXPECT_EQ(run("replay " + out()), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("direct solution"), HasSubstr("equal"), Not(HasSubstr("DIFFERS"))));
}

TEST_F(Replay, ASignalEndsIt) {
  small_recipe();
  const std::string recipe =
      write("slow.toml", std::regex_replace(read(at("small.toml")), std::regex("0.2 m/s"), "0.05 m/s"));
  ASSERT_EQ(run("run " + recipe + " --out " + out()), 0) << output;
  const pid_t child = start({"replay", out()}, at("log"));
  for (int i = 0; i < 3000 && read(at("log")).find("replay ") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << read(at("log"));
  EXPECT_THAT(read(at("log")), AllOf(HasSubstr("intact: not run"), HasSubstr("stopped before the others")));
}

}  // namespace
