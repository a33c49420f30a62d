// A bad run never looks like a good one: runs made bad on purpose, as the program tells of them in its table,
// its exit code, its files and its studies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../program.hpp"

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Quality : public ProgramTest {
 protected:
  /// The paper's rock with 254 discs, every length of its microstructure 5.4 times larger. `change` replaces
  /// a line that begins like it.
  std::string rock(const std::vector<std::string>& changes = {}) const {
    std::vector<std::string> lines = {"[specimen]",
                                      "width = \"38 mm\"",
                                      "height = \"76 mm\"",
                                      "[packing]",
                                      "radius_min = \"1.357 mm\"",
                                      "radius_max = \"2.252 mm\"",
                                      "n_grains = 254",
                                      "seed = 1",
                                      "[matrix]",
                                      "E_c = \"38 GPa\"",
                                      "[[bedding]]",
                                      "spacing = \"27 mm\"",
                                      "zone_thickness = \"3.2 mm\"",
                                      "k_n = \"620 GPa/m\"",
                                      "k_s = \"177 GPa/m\"",
                                      "offset = \"0 mm\"",
                                      "[test]",
                                      "kind = \"uniaxial\"",
                                      "angles = [\"60 deg\"]",
                                      "platen_speed = \"0.02 m/s\"",
                                      "approach_strain = 0",
                                      "approach_speed = \"0 m/s\"",
                                      "history_interval = 100",
                                      "stop_at = 0.6",
                                      "post_peak = 1",
                                      "n_snapshots = 1",
                                      "n_frames = 2",
                                      "[engine]",
                                      "damping = 0.7"};
    for (const std::string& change : changes) {
      const std::string key = change.substr(0, change.find('='));
      bool found = false;
      for (std::string& line : lines)
        if (line.starts_with(key)) line = change, found = true;
      EXPECT_TRUE(found) << change;
    }
    std::string text = "name = \"254 discs\"\n";
    for (const std::string& line : lines) text += line + "\n";
    return write("rock.toml", text);
  }
  nlohmann::json result(const std::string& specimen = "theta_60_deg") const {
    std::ifstream in(out() + "/" + specimen + "/result.json");
    return nlohmann::json::parse(in);
  }
};

// At 60 degrees cracks open where nu is read, in grains as coarse as these.
const std::string uncracked = "angles = [\"30 deg\"]";

TEST_F(Quality, ASlowTestOfARealSpecimenIsGood) {
  EXPECT_EQ(run("run " + rock({uncracked}) + " --out " + out()), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("good"), Not(HasSubstr("warning")), Not(HasSubstr("untrusted"))));
  EXPECT_EQ(result("theta_30_deg")["quality"]["grade"], "good");
  EXPECT_TRUE(result("theta_30_deg")["quality"]["marks"].empty());
}

// The strength stands and is counted; nu is withheld, in the table and in the file.
TEST_F(Quality, NuOfARockThatGrowsInAreaIsNotGiven) {
  EXPECT_EQ(run("run " + rock() + " --out " + out()), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("nu, nu_platen not given: area_change below 0"), HasSubstr("peaked")));
  const nlohmann::json j = result();
  EXPECT_EQ(j["outcome"]["status"], "peaked");
  EXPECT_EQ(j["quality"]["grade"], "warning");
  EXPECT_EQ(j["quality"]["marks"][0]["grade"], "untrusted");
  EXPECT_EQ(j["quality"]["marks"][0]["of"][0], "nu");
  EXPECT_TRUE(j["numbers"]["nu"]["value"].is_null());
  EXPECT_TRUE(j["numbers"]["ucs"]["value"].is_number());
}

struct Bad {
  const char* name;
  std::vector<std::string> changes;
  const char* measure;
  const char* advice;
};
void PrintTo(const Bad& b, std::ostream* out) { *out << b.name; }

class Untrusted : public Quality, public testing::WithParamInterface<Bad> {};

TEST_P(Untrusted, IsNoResultAndSaysWhy) {
  EXPECT_EQ(run("run " + rock(GetParam().changes) + " --out " + out()), 1) << output;
  EXPECT_THAT(output,
              AllOf(HasSubstr("untrusted"), HasSubstr(GetParam().measure), HasSubstr(GetParam().advice)));
  const nlohmann::json j = result();
  EXPECT_EQ(j["outcome"]["status"], "untrusted");
  EXPECT_EQ(j["quality"]["grade"], "untrusted");
  EXPECT_EQ(j["quality"]["marks"][0]["grade"], "untrusted");
  EXPECT_EQ(run("show " + out()), 1);
  EXPECT_THAT(output, HasSubstr("untrusted"));
}

INSTANTIATE_TEST_SUITE_P(
    Each, Untrusted,
    testing::Values(
        Bad{"platens_at_2_m_per_s", {"platen_speed = \"2 m/s\""}, "wave_transits", "lower test.platen_speed"},
        Bad{"platens_at_10_m_per_s", {"platen_speed = \"10 m/s\""}, "rows_to_peak", "lower test."},
        Bad{"grips_that_differ",
            {"kind = \"direct_tension\"", "platen_speed = \"1 m/s\"", "history_interval = 10"},
            "wave_transits",
            "lower test.platen_speed"},
        Bad{"four_hundred_discs_in_the_space_of_254", {"n_grains = 400"}, "porosity", "put fewer discs"},
        Bad{"planes_that_miss", {"spacing = \"200 mm\"", "offset = \"100 mm\""}, "joints", "bedding.offset"},
        Bad{"grains_without_load", {"n_grains = 212", "seed = 2"}, "rattlers", "put more discs"},
        Bad{"ended_at_the_first_dip", {"stop_at = 0.99"}, "peak_confirmed", "lower test.stop_at"},
        Bad{"ended_right_behind_the_peak",
            {"stop_at = 0", "post_peak = 0.02"},
            "peak_confirmed",
            "raise test.post_peak"},
        Bad{"three_rows",
            {"history_interval = 5000"},
            "rows_to_peak",
            "slow already, test.history_interval"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST_F(Quality, WithoutDampingTheNumberStandsWithAWarning) {
  EXPECT_EQ(run("run " + rock({"damping = 0"}) + " --out " + out()), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("warning"), HasSubstr("raise engine.damping")));
  EXPECT_EQ(result()["outcome"]["status"], "peaked");
  EXPECT_EQ(result()["quality"]["grade"], "warning");
}

// 0.02 m/s is what the recipe asks for, but the peak comes at the speed of the approach.
TEST_F(Quality, APeakWithinTheApproachHasAWarningThatNamesIt) {
  const std::string fast = "approach_speed = \"0.03 m/s\"";
  EXPECT_EQ(run("run " + rock({"approach_strain = 0.009", fast}) + " --out " + out()), 0) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("slow_share below 0.2"), HasSubstr("lower test.approach_strain"),
                            HasSubstr("behind 0.030 m/s up to a strain of 0.009")));
  EXPECT_EQ(result()["quality"]["grade"], "warning");
  EXPECT_EQ(run("run " + rock({"approach_strain = 2e-4", fast, uncracked}) + " --out " + at("early")), 0)
      << output;
  EXPECT_THAT(output, AllOf(HasSubstr("good"), Not(HasSubstr("slow_share"))));
}

// In a study an untrusted test is left out of means and effects, unless asked for.
TEST_F(Quality, AStudyLeavesUntrustedTestsOut) {
  rock({uncracked});
  const std::string study = write(
      "study.toml", "name = \"speeds\"\nrecipe = \"rock.toml\"\ndesign = \"list\"\nfile = \"points.csv\"\n");
  write("points.csv", "test.platen_speed [m/s]\n0.05\n0.02\n2\n");
  EXPECT_EQ(run("study " + study + " --out " + out()), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("not to be trusted"), HasSubstr("left out: 1 of 3 specimens")));
  std::ifstream in(out() + "/results.csv");
  const std::string csv(std::istreambuf_iterator<char>(in), {});
  EXPECT_THAT(csv,
              AllOf(HasSubstr("status,reason,quality,marks"), HasSubstr(",untrusted,"), HasSubstr(",good,")));
  EXPECT_EQ(run("study effects " + out() + " --with-untrusted"), 0) << output;
  EXPECT_THAT(output, AllOf(Not(HasSubstr("left out")), HasSubstr("1 of 3 tests carry a warning")));
}

TEST_F(Quality, AnEnvelopeLeavesUntrustedTestsOut) {
  const std::string file = rock({"platen_speed = \"2 m/s\""});
  EXPECT_EQ(run("envelope " + file + " --confining '0 MPa,5 MPa,10 MPa' --out " + out()), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("untrusted"), HasSubstr("no Mohr-Coulomb envelope")));
  EXPECT_EQ(
      run("envelope " + file + " --confining '0 MPa,5 MPa,10 MPa' --with-untrusted --out " + at("asked")), 1);
  EXPECT_THAT(output, Not(HasSubstr("no Mohr-Coulomb envelope"))) << output;
}

}  // namespace
