// The laboratory's side as a user meets it: new, check, twin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
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
  ASSERT_EQ(run("rock check --all " + write("t.toml", "data = \"t.csv\"\n")), 0) << output;
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

TEST_F(RockCli, MeasuredRocksAreListedShownAndTaken) {
  ASSERT_EQ(run("rocks"), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("boryeong-shale"), HasSubstr("augen-gneiss")));
  ASSERT_EQ(run("rocks boryeong-shale"), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("Boryeong shale"), HasSubstr("Secondary"), HasSubstr("Source: ")));
  EXPECT_EQ(run("rocks boryeong-shal"), 2);
  EXPECT_THAT(output, HasSubstr("did you mean boryeong-shale?"));
  for (const char* rock :
       {"boryeong-shale", "th26-shale"}) {  // the table of the other one is beside its folder
    ASSERT_EQ(run(std::string("rocks ") + rock + " --out " + at(rock)), 0) << output;
    EXPECT_EQ(run("rock check " + at(rock) + "/rock.toml"), 0) << output;
  }
}

TEST_F(RockCli, ANewRockBeginsLikeAMeasuredOne) {
  const std::string table = write("mine.csv", "theta [deg],UCS [MPa]\n0,90\n45,60\n90,120\n");
  ASSERT_EQ(run("rock new " + at("mine") + " --data " + table + " --like augen-gneiss"), 0) << output;
  EXPECT_THAT(read(at("mine.toml")),
              AllOf(HasSubstr("\nspacing = \"10 mm\""), HasSubstr("\ngrain_size = \"2.231 mm\""),
                    HasSubstr("\nwidth = \"51 mm\"")));
  ASSERT_EQ(run("rock check " + at("mine.toml")), 0) << output;
  EXPECT_THAT(output, HasSubstr("Nearest in shape of the measured rocks: "));
  EXPECT_EQ(run("rock new " + at("other") + " --like no-rock"), 2);
  EXPECT_FALSE(fs::exists(at("other.toml")) || fs::exists(at("other.csv")));
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
  const std::string rock = write("t.toml", "data = \"t.csv\"\n");
  ASSERT_EQ(run("rock check " + rock), 0) << output;
  EXPECT_LE(std::ranges::count(output, '\n'), 13) << "a name, three notes, nine lines\n" << output;
  const auto follow_one_another = [&](const std::vector<const char*>& parts) {
    std::size_t at = 0;
    for (const char* part : parts) {
      const std::size_t found = output.find(part, at);
      ASSERT_NE(found, output.npos) << part << output;
      at = found;
    }
  };
  follow_one_another({"Read: ", "Moduli: E ", "Strengths: UCS ", "does not show the scatter of E and UCS",
                      "Not determined: ", "Forecast with ", "A calibration by one model takes ", "Model"});
  ASSERT_EQ(run("rock check --all " + rock), 0) << output;
  follow_one_another({"Read: ", "theta ", "- Eq. 1 through E: E = ", "- Jaeger's plane",
                      "- Largest value over least: ", "parameter "});
}

// UCS as an angle from the load has it, E and BTS from the horizontal; and a unit that is wrong.
TEST_F(RockCli, ACheckBeginsWithTheQuestionOfTheAnglesThenTheOtherDoubts) {
  write("t.csv",
        "theta [deg],E [GPa],UCS [MPa],BTS [MPa]\n0,20.1,88,8.1\n15,20.5,62,7.9\n30,21.4,41,7.5\n"
        "45,23,44,6.8\n60,26,58,5.5\n75,28.6,74,4.6\n90,300,82,4.1\n");
  const std::string rock = write("t.toml", "data = \"t.csv\"\n");
  ASSERT_EQ(run("rock check " + rock), 0) << output;
  // the angles, the unit of E, then the table
  const std::size_t angles = output.find("UCS counts from the load"), units = output.find("E is 300 GPa"),
                    table = output.find("Not determined");
  ASSERT_NE(units, output.npos) << output;
  EXPECT_LT(angles, units) << output;
  EXPECT_LT(units, table) << output;
  EXPECT_EQ(output.find("E is 300 GPa", units + 1), output.npos) << "said once";
}

TEST_F(RockCli, ATableOfBetaUnderThetaIsAskedInTheFirstLineOfCheckAndCalibration) {
  write("t.csv", "theta [deg],E [GPa],UCS [MPa]\n0,31,165\n30,27,98\n45,25,112\n60,23,128\n90,20,150\n");
  const std::string rock = write("t.toml", "data = \"t.csv\"\n");
  const auto question = HasSubstr("These angles look like beta. With theta = 90 - angle, planes miss ");
  ASSERT_EQ(run("rock check " + rock), 0) << output;
  EXPECT_THAT(output, question);
  small_recipe();
  const std::string small = write("s.toml", "data = \"t.csv\"\nrecipe = \"small.toml\"\n");
  ASSERT_THAT(run("calibrate " + small + " --elastic --threads 2 --out " + out()), testing::AnyOf(0, 1))
      << output;
  EXPECT_THAT(output, question);
  write("b.csv", "beta [deg],E [GPa],UCS [MPa]\n0,31,165\n30,27,98\n45,25,112\n60,23,128\n90,20,150\n");
  ASSERT_EQ(run("rock check " + write("b.toml", "data = \"b.csv\"\n")), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("(beta, counted from the load; below, theta = 90 - beta)"),
                            testing::Not(HasSubstr("look like beta"))));
}

TEST_F(RockCli, ACheckOfRockWithoutBeddingSaysNothingOfLayers) {
  write("t.csv", "E [GPa],UCS [MPa],BTS [MPa]\n20,100,14\n21,105,13\n19,98,15\n");
  ASSERT_EQ(run("rock check " + write("t.toml", "bedded = false\ndata = \"t.csv\"\n")), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("Forecast with "), testing::Not(HasSubstr("Eq. 1")),
                            testing::Not(HasSubstr("Jaeger")), testing::Not(HasSubstr("Largest value"))));
}

}  // namespace
