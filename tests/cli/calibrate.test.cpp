// A calibration as a user meets it: table in, files out; stopped, killed and taken up again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "../program.hpp"
#include "jobs/calibration_options.hpp"
#include "records/file_key_fixture.hpp"
#include "report/calibration_files.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class CalibrateCli : public ProgramTest {
 protected:
  /// A table of the small specimen at four angles, made by the program from other strengths.
  std::string rock() const {
    write("start.toml",
          "[specimen]\nwidth = \"7 mm\"\nheight = \"14 mm\"\n[packing]\nn_grains = 253\n[[bedding]]\nspacing "
          "= \"2 "
          "mm\"\n");
    write("table.csv",
          "theta [deg],E [GPa],nu,UCS "
          "[MPa],n\n0,17.5,0.10,105,3\n30,15.6,0.36,60,3\n60,21.0,0.5,45,3\n90,48,0.25,"
          "128,3\n");
    return write("rock.toml", "data = \"table.csv\"\nrecipe = \"start.toml\"\n");
  }
  std::string calibrate(const std::string& more) const {
    return "calibrate " + rock() + " --threads 2 --max-tests 72 --out " + more;  // the least
  }
};

TEST_F(CalibrateCli, EndsWithTablesVerdictRecipeAndFilesForOtherPrograms) {
  ASSERT_THAT(run(calibrate(out())), testing::AnyOf(0, 1)) << output;  // 1: verdict "out of reach"
  for (const char* text :
       {"Table 1. Intact rock", "Cohesion C_sj [MPa]", "95 % interval",
        "Laboratory and model, on unseen packings", "root mean square error", "72 tests in compression"})
    EXPECT_THAT(output, HasSubstr(text));
  const std::string all = output, first = all.substr(all.find("Next: "), 30);  // of the sentence of verdict
  EXPECT_GT(all.rfind(first), all.find("tests in compression")) << "and where the output ends";
  EXPECT_THAT(read(out() + "/tables.txt"), testing::AllOf(HasSubstr("Details\n"), HasSubstr("verdict: ")));
  const std::string found = read(out() + "/calibration.json");
  EXPECT_THAT(found, HasSubstr("\"verification\""));
  std::set<std::string> met;
  EXPECT_THAT(phy::unlisted_keys(found, phy::report::calibration_keys(), met), testing::IsEmpty());
  EXPECT_THAT(read(out() + "/calibrated.p2dat"), HasSubstr("'smoothjoint'"));
  EXPECT_THAT(read(out() + "/calibrated-yade.py"), HasSubstr("JCFpmMat"));
  EXPECT_THAT(read(out() + "/calibrated.toml"), HasSubstr("# The data do not constrain"));
  for (const char* recipe : {"/calibrated.toml", "/ensemble/01.toml", "/ensemble/20.toml"})
    ASSERT_EQ(run("recipe " + out() + recipe), 0) << output;  // a recipe that the program reads
  EXPECT_THAT(read(out() + "/ensemble/20.toml"),
              testing::AllOf(HasSubstr("# rock: draw 20 of 20"), HasSubstr("seed = 55\n")));
  EXPECT_FALSE(fs::exists(out() + "/ensemble/21.toml"));
  // as it broke, on the first packing of the verification: seeds 1 to 5 are those of the fit
  EXPECT_THAT(read(out() + "/specimens/theta_60_deg/recipe.toml"), HasSubstr("\nseed = 6\n"));
  ASSERT_THAT(run("show " + out() + "/specimens"), testing::AnyOf(0, 1)) << output;
  for (const char* angle : {"0", "30", "60", "90"}) EXPECT_THAT(output, HasSubstr(angle));
  const auto n_drawn = [&] {
    const std::string page = read(out() + "/report.html");
    int n = 0;
    for (int k = 0; k < 9; ++k) n += page.find("id=\"scene-" + std::to_string(k) + "\"") != page.npos;
    return n;
  };
  EXPECT_EQ(n_drawn(), 4);
  fs::remove_all(out() + "/specimens/theta_60_deg");  // as if it had been killed before it was written
  ASSERT_EQ(run("report " + out()), 0) << output;
  EXPECT_EQ(n_drawn(), 3);
  ASSERT_THAT(run(calibrate(out() + " --resume")), testing::AnyOf(0, 1)) << output;
  EXPECT_EQ(n_drawn(), 4);
  // damaged: left alone and told, behind everything else
  std::ofstream(out() + "/specimens/theta_60_deg/result.json") << "half";
  fs::remove(out() + "/calibration.json");
  ASSERT_EQ(run(calibrate(out() + " --resume")), 3);
  EXPECT_THAT(output, testing::AllOf(HasSubstr("theta_60_deg"), HasSubstr("root mean square error")));
  EXPECT_TRUE(fs::exists(out() + "/calibration.json"));
  EXPECT_EQ(read(out() + "/specimens/theta_60_deg/result.json"), "half");
  ASSERT_EQ(run(calibrate(out())), 2);
  EXPECT_THAT(output, HasSubstr("--resume goes on with it"));
  for (int i = 0; i < 2; ++i) {  // what was refused does not bar the folder
    ASSERT_EQ(run("calibrate " + rock() + " --max-tests 71 --out " + at("more")), 2);
    EXPECT_THAT(output, HasSubstr("at least 72"));
  }
}

TEST_F(CalibrateCli, KilledOrStoppedAndResumedItEndsWithTheIdenticalResult) {
  ASSERT_THAT(run(calibrate(at("whole"))), testing::AnyOf(0, 1)) << output;
  const std::string expected = read(at("whole") + "/calibration.json");
  EXPECT_EQ(run_to_event(500, SIGKILL, calibrate(at("parts"))), 128 + SIGKILL) << output;
  EXPECT_FALSE(fs::exists(at("parts") + "/calibration.json"));
  // as of a process killed while it wrote the draws; there is no such thread
  fs::create_directories(at("parts/ensemble"));
  const std::string rest = write("parts/ensemble/01.toml.phyllite-part-1999999999", "half");
  EXPECT_EQ(run_to_event(300, SIGINT, calibrate(at("parts") + " --resume")), 1) << output;
  ASSERT_THAT(run(calibrate(at("parts") + " --resume")), testing::AnyOf(0, 1)) << output;
  EXPECT_EQ(read(at("parts") + "/calibration.json"), expected);
  EXPECT_FALSE(fs::exists(rest));
  EXPECT_EQ(read(at("parts") + "/calibrated.toml"), read(at("whole") + "/calibrated.toml"));
  EXPECT_EQ(read(at("parts") + "/ensemble/07.toml"), read(at("whole") + "/ensemble/07.toml"));
}

TEST_F(CalibrateCli, ResultsOfAnotherRunAreNotTakenForTheSpecimens) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out() + "/specimens"), 0) << output;
  ASSERT_EQ(run(calibrate(out())), 2);
  EXPECT_THAT(output, HasSubstr("results of before lie there"));
  EXPECT_FALSE(fs::exists(out() + "/runs.sqlite"));
}

TEST_F(CalibrateCli, EnsembleRunsTheTestOfTheRecipeOnEveryDrawAndTellsTheBand) {
  ASSERT_THAT(run(calibrate(at("rock")) + " --elastic"), testing::AnyOf(0, 1)) << output;
  for (int k = 7; k <= 20; ++k)  // six draws are enough to try it
    fs::remove(at("rock") + "/ensemble/" + (k < 10 ? "0" : "") + std::to_string(k) + ".toml");
  std::string text = read(at("rock") + "/calibrated.toml");
  const std::size_t begin = text.find("\n[test]") + 1, end = text.find("\n[", begin);
  text.replace(begin, end - begin,
               "[test]\nkind = \"direct_tension\"\nangles = [\"45 deg\"]\nplaten_speed = \"0.05 m/s\"\n");
  const std::string recipe = write("rock/calibrated.toml", text);

  const std::string tested = "run " + recipe + " --ensemble --threads 1 --out ";
  const long n = n_events(tested + out());
  ASSERT_EQ(run(tested + out()), 0) << output;
  EXPECT_THAT(output,
              testing::AllOf(HasSubstr("6 draws"), HasSubstr("sigma_t"), HasSubstr("71.4 %")));  // 5/7
  const std::string tests = read(out() + "/ensemble.csv"), band = read(out() + "/band.csv");
  EXPECT_THAT(tests, testing::AllOf(HasSubstr("\n1,36,"), HasSubstr("\n6,41,"), Not(HasSubstr("\n7,"))));
  EXPECT_THAT(band, HasSubstr("\ntheta = 45 deg,45,,sigma_t,Pa,6,0,"));
  // killed in the middle, and once more: finished tests are kept, and nothing of the result changes
  EXPECT_EQ(run_to_event(n / 2, SIGKILL, tested + at("parts")), 128 + SIGKILL) << output;
  EXPECT_FALSE(fs::exists(at("parts") + "/band.csv"));
  ASSERT_EQ(run(tested + at("parts")), 0) << output;
  EXPECT_EQ(read(at("parts") + "/ensemble.csv"), tests);
  EXPECT_EQ(read(at("parts") + "/band.csv"), band);

  // what the calibration misses of this test's strength: 0.1 in every draw
  std::string draws = "0.1";
  for (int k = 1; k < 20; ++k) draws += ", 0.1";
  std::string found = read(at("rock") + "/calibration.json");
  found.replace(
      found.find("\"errors\":"), 0,
      R"("residuals": [{"property": "DTS", "theta [deg]": 45.0, "confining [Pa]": 0.0, "laboratory": 5e6,
                "value": 0.1, "noise": 1e-6, "unknown": 0.0, "draws": [)" +
          draws + "]}], ");
  write("rock/calibration.json", found);
  ASSERT_EQ(run(tested + out()), 0) << output;
  EXPECT_THAT(band, testing::ContainsRegex("sigma_t,Pa,6,0,[^\n]*,,,,,\n"));
  EXPECT_THAT(read(out() + "/band.csv"),
              testing::ContainsRegex("sigma_t,Pa,6,0,[^\n]*,1\\.10[45][0-9]*,0\\.00"));

  const std::string confined = "envelope " + recipe + " --ensemble --threads 2 --with-untrusted --out ";
  fs::remove(at("rock") + "/ensemble/03.toml");
  EXPECT_EQ(run(confined + at("envelope")), 2);
  EXPECT_THAT(output, testing::AllOf(HasSubstr("without a gap"), HasSubstr("ensemble/03.toml")));
  for (int k = 4; k <= 6; ++k) fs::remove(at("rock") + "/ensemble/0" + std::to_string(k) + ".toml");
  EXPECT_EQ(run("run " + recipe + " --ensemble --out " + at("rock")), 2);
  EXPECT_THAT(output, HasSubstr("it holds a calibration"));
  ASSERT_EQ(run(confined + at("envelope") + " --confining \"0 MPa,5 MPa,10 MPa\""), 0) << output;
  EXPECT_THAT(output, testing::AllOf(HasSubstr("sigma_1"), HasSubstr("phi"), HasSubstr("m_i")));
  EXPECT_THAT(read(at("envelope") + "/band.csv"),
              testing::AllOf(HasSubstr("45,5e+06,sigma_1,Pa,2,0,"), HasSubstr("45,,cohesion,Pa,")));

  fs::remove(at("rock") + "/.written-by-phyllite");  // calibration.json was changed above
  const std::string design = "design " + at("rock") + " --threads 2 --with-untrusted --out " + at("design");
  EXPECT_THAT(run(design), testing::AnyOf(0, 1)) << output;  // 1: of so few discs a part may be missing
  EXPECT_THAT(read(at("design") + "/design.csv"), HasSubstr("elasticity,E_n,"));
  EXPECT_THAT(read(at("design") + "/ogs-elastic.xml"), HasSubstr("youngs_modulus_a"));
  EXPECT_THAT(read(at("design") + "/tests.csv"), HasSubstr(",simulated,corrected,unit\n"));
  EXPECT_EQ(run(design + " --nu 1"), 1);
  EXPECT_FALSE(fs::exists(at("design") + "/ogs-elastic.xml"));  // of the design before: no body has such a nu
  EXPECT_EQ(run(design + " --stresses \"0 MPa,5 MPa\""), 2);
  EXPECT_THAT(output, HasSubstr("at least three stresses"));
  EXPECT_EQ(run(design + " --draws 9"), 2);
  EXPECT_THAT(output, HasSubstr("2 to 2 draws"));
}

TEST_F(CalibrateCli, EnsembleWithoutDrawsBesideTheRecipeSaysWhereTheyWouldBe) {
  const std::string recipe = small_recipe();
  for (const std::string verb : {"run ", "envelope "}) {
    ASSERT_EQ(run(verb + recipe + " --ensemble --out " + out()), 2);
    EXPECT_THAT(output, testing::AllOf(HasSubstr("small.toml"), HasSubstr("ensemble/01.toml"),
                                       HasSubstr("phyllite calibrate")));
  }
  ASSERT_EQ(run("run " + recipe + " " + recipe + " --ensemble --out " + out()), 2);
  EXPECT_THAT(output, HasSubstr("one calibrated.toml"));
  EXPECT_NE(run("run " + recipe + " --ensemble --replace --out " + out()), 0);
  EXPECT_NE(run("run " + recipe + " --with-untrusted --out " + out()), 0);
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(CalibrateCli, AnotherRockOrOtherOptionsDoNotGoOnInTheFolder) {
  const std::string own = "calibrate " + rock() + " --threads 2 --elastic --resume --out " + out();
  ASSERT_THAT(run(own), testing::AnyOf(0, 1)) << output;  // --resume of nothing begins
  const std::string expected = read(out() + "/calibration.json");
  write("other.csv", "theta [deg],E [GPa]\n0,17.5\n30,15.6\n60,21.0\n90,47\n");
  const std::string other = write("other.toml", "data = \"other.csv\"\nrecipe = \"start.toml\"\n");
  const std::string more = " --threads 2 --resume --out " + out();
  const auto refused = [&](const std::string& command, const std::vector<std::string>& texts) {
    ASSERT_EQ(run(command), 2) << output;
    for (const std::string& text : texts) EXPECT_THAT(output, HasSubstr(text)) << command;
    EXPECT_THAT(output, HasSubstr("another --out"));
  };
  refused("calibrate " + other + " --elastic" + more, {"with this table", "\"rock\"", "rock.toml"});
  refused("calibrate " + at("rock.toml") + more, {"--elastic = off: expected on"});
  refused(own + " --max-tests 999 --matrix flat_joint",
          {"--max-tests = 999: expected 2000", "--matrix = flat_joint: expected not given"});
  write("start.toml", read(at("start.toml")) + "[matrix]\nmu = 0.3\n");
  refused(own, {"with this recipe and rock file"});
  fs::remove(at("rock.toml")), rock();
  EXPECT_EQ(read(out() + "/calibration.json"), expected);
  ASSERT_THAT(run(own), testing::AnyOf(0, 1)) << output;
  EXPECT_EQ(read(out() + "/calibration.json"), expected);
}

TEST_F(CalibrateCli, ACalibrationIsDrawnWithoutAskingForAKind) {
  ASSERT_THAT(run("calibrate " + rock() + " --threads 2 --elastic --out " + out()), testing::AnyOf(0, 1))
      << output;
  const std::string figure = "figure " + out() + " --out " + at("a.svg");
  ASSERT_EQ(run(figure + " --kind cracks"), 2);
  EXPECT_THAT(output, testing::AllOf(HasSubstr("has tested none"), HasSubstr("--kind anisotropy")));
  ASSERT_EQ(run(figure + " --kind fig5"), 2);
  EXPECT_THAT(output,
              testing::AllOf(HasSubstr("expected one of stress_strain"), HasSubstr("holds no study")));
  ASSERT_EQ(run(figure + " --rock " + at("rock.toml")), 2);
  EXPECT_THAT(output, HasSubstr("has its laboratory values already"));
  fs::create_directories(folder / "stopped");
  write("stopped/request.toml", "calibration of \"rock\"\n");
  ASSERT_EQ(run("figure " + at("stopped")), 2);
  EXPECT_THAT(output, HasSubstr("--resume"));
  EXPECT_FALSE(fs::exists(at("a.svg")));
  if (!has("gnuplot")) GTEST_SKIP() << "no gnuplot here";
  ASSERT_EQ(run(figure), 0) << output;
  EXPECT_THAT(read(at("a.svg")), testing::AllOf(HasSubstr("model, unseen packings"), HasSubstr("</svg>")));
}

TEST_F(CalibrateCli, ThePapersSequenceEndsWithTheSameFilesAndNoIntervals) {
  rock();
  const std::string small_strain = write(  // no moduli once more after every strength
      "sequence.toml", "data = \"table.csv\"\nrecipe = \"start.toml\"\nE_is = \"small strain\"\n");
  const auto calibrate = [&](const std::string& more) {
    return "calibrate " + small_strain + " --threads 2 --max-tests 72 --out " + more;
  };
  ASSERT_THAT(run(calibrate(out() + " --method sequence")), testing::AnyOf(0, 1)) << output;
  EXPECT_THAT(output, testing::AllOf(HasSubstr("Laboratory and model, on unseen packings"),
                                     HasSubstr("Cohesion C_sj [MPa]"), Not(HasSubstr("95 % interval"))));
  EXPECT_THAT(read(out() + "/tables.txt"), testing::AllOf(HasSubstr("Eq. 2 on these packings: K_n = "),
                                                          HasSubstr("one after the other by bisection")));
  EXPECT_THAT(read(out() + "/calibration.json"), HasSubstr("\"method\": \"sequence\""));
  EXPECT_TRUE(fs::exists(out() + "/report.html"));
  ASSERT_EQ(run("recipe " + out() + "/calibrated.toml"), 0) << output;
  ASSERT_EQ(run(calibrate(out() + " --resume")), 2);  // by the other method
  EXPECT_THAT(output, testing::AllOf(HasSubstr("--method"), HasSubstr("sequence")));
  EXPECT_EQ(run(calibrate(at("other") + " --method newton")), 2);
  EXPECT_EQ(run_to_event(300, SIGINT, calibrate(at("parts") + " --method sequence")), 1) << output;
  EXPECT_THAT(output, HasSubstr("--method sequence --resume"));
  ASSERT_EQ(run(calibrate(at("none") + " --method sequence --effort quick")), 2);
  EXPECT_THAT(output, HasSubstr("none beside --method sequence"));
  ASSERT_EQ(run("calibrate " + rock() + " --elastic --effort thorough --out " + at("none")), 2);
  EXPECT_THAT(output, HasSubstr("none beside --elastic"));
  EXPECT_FALSE(fs::exists(at("none")));
}

TEST_F(CalibrateCli, EveryOptionOfTheListIsInHelpManualAndCompletion) {
  ASSERT_EQ(run("calibrate --help"), 0);
  const std::string help = output;
  ASSERT_EQ(run("man calibrate"), 0);
  std::string manual = output;
  manual.erase(std::remove(manual.begin(), manual.end(), '\\'), manual.end());  // "\-" is a hyphen
  for (const phy::jobs::CalibrationOption& option : phy::jobs::calibration_options()) {
    const std::string name = "--" + option.word();
    EXPECT_THAT(help, HasSubstr(name));
    EXPECT_THAT(manual, HasSubstr(name));
    EXPECT_THAT(manual, HasSubstr(option.meaning));
    for (const std::string& word : option.words) EXPECT_THAT(help, HasSubstr(word)) << name;
  }
}

TEST_F(CalibrateCli, EffortIsRememberedAndNamesTheNextOne) {
  const std::string quick = "calibrate " + rock() + " --threads 2 --effort quick --out " + out();
  ASSERT_EQ(run("calibrate " + rock() + " --effort hasty --out " + out()), 2);
  EXPECT_THAT(output, HasSubstr("quick"));
  EXPECT_EQ(run_to_event(300, SIGINT, quick), 1) << output;
  EXPECT_THAT(output, HasSubstr("--effort quick --resume"));
  ASSERT_THAT(run(quick + " --resume"), testing::AnyOf(0, 1)) << output;
  EXPECT_THAT(output, HasSubstr("Fitting the moduli (stage 1 of")) << "the first stage, reported at once";
  EXPECT_THAT(read(out() + "/tables.txt"), HasSubstr("--effort normal"));
  EXPECT_THAT(read(out() + "/calibration.json"),
              testing::AllOf(HasSubstr("\"effort\": \"quick\""), HasSubstr("\"search_short\"")));
  ASSERT_EQ(run("calibrate " + rock() + " --threads 2 --resume --out " + out()), 2) << "of another effort";
}

TEST_F(CalibrateCli, BadTablesAreRefusedAtOnceWithTheirLines) {
  write("table.csv", "theta [deg],E [GPa],UCS [MPa]\n0,20,-5\n120,25,90\n45,abc,60\n");
  ASSERT_EQ(run("calibrate " + write("bad.toml", "data = \"table.csv\"\n") + " --out " + out()), 2);
  for (const char* text : {"table.csv:2", "table.csv:3", "table.csv:4"}) EXPECT_THAT(output, HasSubstr(text));
  EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
