// Tests that blow up, and specimens that can carry nothing: told, stored like any other result, and the end
// of nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Unstable : public ProgramTest {
 protected:
  /// Rock of a thousandth of a bar under ten thousand times its modulus, in single precision, checked every
  /// 10,000 cycles: positions have long been no numbers when the watchdog looks.
  std::string blown_up() const {
    return write("blown.toml",
                 "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[matrix]\n"
                 "E_c = \"1 kPa\"\nE_b = \"1 kPa\"\n[[bedding]]\nspacing = \"2 mm\"\n[test]\n"
                 "kind = \"direct_shear\"\nnormal_stress = \"10 GPa\"\nplaten_speed = \"10 m/s\"\n"
                 "history_interval = 10000\nshear_gap = \"4 mm\"\nangles = [\"45 deg\"]\nintact = true\n"
                 "[engine]\nstep_safety = 1\ndamping = 0\nprecision = \"float\"\n");
  }
  /// True if all numbers of a table are numbers.
  bool is_finite_table(const fs::path& file) const {
    const std::string text = read(file.string());
    return text.find("nan") == text.npos && text.find("inf") == text.npos && !text.empty();
  }
};

TEST_F(Unstable, ATestThatBlowsUpRuinsNothing) {
  ASSERT_EQ(run("run " + blown_up() + " --out " + out()), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("no numbers any more"), HasSubstr("lower test.normal_stress"),
                            HasSubstr("raise engine.damping"), Not(HasSubstr("step_safety"))));
  EXPECT_THAT(output, AllOf(HasSubstr("theta = 45 deg: unstable"), HasSubstr("intact: unstable")));
  EXPECT_TRUE(fs::exists(out() + "/report.html"));
  bool lost = false;
  for (const char* name : {"theta_45_deg", "intact"}) {
    const fs::path place = fs::path(out()) / name;
    EXPECT_TRUE(is_finite_table(place / "history.csv")) << name;
    EXPECT_TRUE(is_finite_table(place / "cracks.csv")) << name;
    EXPECT_TRUE(is_finite_table(place / "grains.pvd")) << name;
    const std::string scene = read((place / "scene.bin").string());
    lost = lost || nlohmann::json::parse(scene.substr(0, scene.find('\n'))).value("lost", 0) > 0;
  }
  EXPECT_TRUE(lost) << "the scene says what it could not keep";
  EXPECT_EQ(run("show " + out()), 1);
  EXPECT_THAT(output, Not(HasSubstr("missing")));
  EXPECT_EQ(run("report " + out()), 0) << output;
  if (has("gnuplot")) {
    EXPECT_EQ(run("figure " + out() + " --kind cracks --out " + at("c.svg")), 0) << output;
  }
  EXPECT_EQ(run("film " + out() + " --out " + at("f.gif")), 2);
  EXPECT_THAT(output, HasSubstr("a test that was loaded"));
}

TEST_F(Unstable, AStudyKeepsItLikeAnyOtherResult) {
  blown_up();
  const std::string study = write("study.toml", "recipe = \"blown.toml\"\npackings = [1]\n");
  EXPECT_EQ(run("study " + study + " --out " + out()), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("no numbers any more"), HasSubstr("2 finished with hash")));
  EXPECT_EQ(run("study status " + out()), 1) << output;
  EXPECT_TRUE(is_finite_table(out() + "/results.csv"));
}

TEST_F(Unstable, OverlapsThatPushAreNamedAsTheCause) {
  const std::string file = small_recipe();
  std::string text = read(file);
  text.replace(text.find("[matrix]\n"), 9,
               "initial_stress = \"isotropic\"\nisotropic_stress = \"0.9 GPa\"\n[matrix]\nE_c = \"1 GPa\"\n");
  EXPECT_EQ(run("run " + write("squeezed.toml", text) + " --out " + out()), 1) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("overlap by 1.2 of the smaller radius"),
                            HasSubstr("lower packing.isotropic_stress"), Not(HasSubstr("step_safety"))));
}

TEST_F(Unstable, APackingThatJoinsNothingIsToldBeforeTheFirstStep) {
  const std::string loose = write("loose.toml",
                                  "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\n"
                                  "porosity = 0.39\n[test]\nplaten_speed = \"0.2 m/s\"\n");
  EXPECT_EQ(run("run " + loose + " --out " + out()), 2) << output;
  EXPECT_THAT(output,
              AllOf(HasSubstr("packing.porosity = 0.39"),
                    HasSubstr("chains from the bottom platen to the top platen"), HasSubstr("lower it")));
  EXPECT_FALSE(fs::exists(out() + "/intact"));
  EXPECT_EQ(run("envelope " + loose + " --out " + out()), 2) << output;
  EXPECT_EQ(run("specimen " + loose), 0) << "to look at, it will do";
  EXPECT_EQ(run("study " + write("study.toml", "recipe = \"loose.toml\"\n") + " --out " + at("study")), 1);
  EXPECT_THAT(output, AllOf(HasSubstr("specimen not made"), HasSubstr("chains from the bottom platen")));
}

// Two blocks of rock, each of a hundred discs that touch, a grain apart.
TEST_F(Unstable, HalvesThatDoNotMeetAreTold) {
  std::string discs = "x [m],y [m],r [m]\n";
  for (const double bottom : {0.0, 0.0111})
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i)
        discs += std::to_string(0.0005 + 0.001 * i) + "," + std::to_string(bottom + 0.0005 + 0.001 * j) +
                 ",0.0005\n";
  write("discs.csv", discs);
  const auto recipe = [&](const std::string& test) {
    return write("halves.toml",
                 "[specimen]\nwidth = \"10 mm\"\nheight = \"21.1 mm\"\n[packing]\nfile = \"discs.csv\"\n"
                 "[matrix]\nbond_gap = \"0.5 um\"\n[test]\n" +
                     test);
  };
  EXPECT_EQ(run("run " + recipe("") + " --out " + out()), 2) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("200 discs have 360 contact(s)"), HasSubstr("move them closer")));
  for (const char* test : {"kind = \"direct_tension\"\n", "kind = \"direct_shear\"\n",
                           "kind = \"biaxial\"\nconfining_stress = \"5 MPa\"\nconfinement = \"jacket\"\n"}) {
    EXPECT_EQ(run("run " + recipe(test) + " --out " + out()), 2) << output;
    EXPECT_THAT(output, HasSubstr("discs that touch, in chains from the")) << test;
  }
  EXPECT_EQ(
      run("run " + recipe("kind = \"direct_tension\"\ngrip_thickness = \"0.1 mm\"\n") + " --out " + out()),
      2);
  EXPECT_THAT(output, HasSubstr("the top grip reaches no disc"));
}

}  // namespace
