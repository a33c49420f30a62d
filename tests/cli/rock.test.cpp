// The laboratory's side as a user meets it: new, check, twin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using RockCli = ProgramTest;

TEST_F(RockCli, DiscsOfTwoDiametersAreBothShown) {
  write("t.csv",
        "theta [deg],UCS [MPa],BTS [MPa],diameter [mm]\n0,100,14,20\n0,,11,30\n45,60,8,20\n90,120,,\n");
  ASSERT_EQ(run("rock check " + write("t.toml", "data = \"t.csv\"\n")), 0) << output;
  for (const char* row : {" 14 [^\n]* 20\n", " 11 [^\n]* 30\n", " 8 [^\n]* 20\n"})
    EXPECT_THAT(output, testing::ContainsRegex(row));
}

TEST_F(RockCli, NamesThatNoRockFileCanHaveAreRefused) {
  const std::string here = "cd " + folder.string() + " && " + PHY_PROGRAM + " rock ";
  for (const char* name : {"''", "'a\"b'", "'a\\b'", "sub/"}) {
    run_line("(" + here + "new " + name + "; echo code $?)");
    EXPECT_THAT(output, AllOf(HasSubstr("without quotes and backslashes"), HasSubstr("code 2"))) << name;
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(RockCli, TheNameOfTheFileIsTakenForThatOfTheRock) {
  ASSERT_EQ(run("rock new " + at("schist.toml")), 0) << output;
  EXPECT_TRUE(fs::exists(at("schist.toml")) && fs::exists(at("schist.csv"))) << output;
  EXPECT_EQ(run("rock new " + at(".toml")), 2) << output;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << output;
}

TEST_F(RockCli, TheNameOfATableIsTakenForThatOfTheRock) {
  ASSERT_EQ(run("rock new " + at("gneiss.csv")), 0) << output;
  EXPECT_TRUE(fs::exists(at("gneiss.toml")) && fs::exists(at("gneiss.csv"))) << output;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << "no gneiss.csv.toml";
  const std::string table = write("mine.csv", "theta [deg],UCS [MPa]\n0,100\n");
  for (const std::string& name : {at("mine"), table}) {
    EXPECT_EQ(run("rock new " + name), 2);
    EXPECT_THAT(output,
                HasSubstr("mine.csv: the file is there already. If it is your table: phyllite rock new " +
                          at("mine") + " --data " + table));
  }
  EXPECT_EQ(run("rock new " + at("mine") + " --data " + table), 0) << "what is advised is taken: " << output;
}

TEST_F(RockCli, ATwinWritesOverNothing) {
  write("mine.csv", "precious\n");
  ASSERT_EQ(run("rock twin " + write("m.toml", "") + " " + at("mine")), 2) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("mine.csv"), HasSubstr("a name that is free")));
  EXPECT_EQ(read(at("mine.csv")), "precious\n");
}

TEST_F(RockCli, ATwinStopsWhenAskedAndWritesNothing) {
  ASSERT_EQ(run_to_event(3, SIGINT, "rock twin " + small_recipe() + " " + at("twin") + " --threads 2"), 1)
      << output;
  EXPECT_THAT(output, HasSubstr("stopped, nothing was written"));
  EXPECT_FALSE(fs::exists(at("twin.csv")));
}

TEST_F(RockCli, ACheckEndsWithTheVerdictThatIsForetold) {
  write("t.csv",
        "theta [deg],E [GPa],UCS "
        "[MPa]\n0,20,110\n15,20.5,98\n30,22,75\n45,25,58\n60,30,56\n75,36,75\n90,40,115\n");
  ASSERT_EQ(run("rock check " + write("t.toml", "data = \"t.csv\"\n")), 0) << output;
  std::size_t at = 0;
  for (const char* part : {"theta ", "- Eq. 1 through E: E = ", "- Jaeger's plane", "- largest over least: ",
                           "parameter ", "- in the maps", "foretold: a calibration will probably end "}) {
    const std::size_t found = output.find(part, at);
    ASSERT_NE(found, output.npos) << part << output;
    at = found;
  }
  EXPECT_EQ(output.find('\n', at), output.size() - 1);
}

TEST_F(RockCli, ACheckOfRockWithoutBeddingSaysNothingOfLayers) {
  write("t.csv", "E [GPa],UCS [MPa],BTS [MPa]\n20,100,14\n21,105,13\n19,98,15\n");
  ASSERT_EQ(run("rock check " + write("t.toml", "bedded = false\ndata = \"t.csv\"\n")), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("foretold: "), testing::Not(HasSubstr("Eq. 1")),
                            testing::Not(HasSubstr("Jaeger")), testing::Not(HasSubstr("largest over"))));
}

}  // namespace
