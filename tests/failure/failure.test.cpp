// Everything that a user can get wrong, as the program meets it: one clear message with all problems, exit
// code 2 (input) or 3 (files), and nothing half-written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Failure : public ProgramTest {
 protected:
  /// Prefix that takes away what only root may do; empty when there is nothing to take away.
  static std::string as_nobody() {
    return ::geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  }
};

struct Wrong {
  const char* name;
  const char* recipe;
  const char* where;  ///< file:line: key = value
  const char* says;   ///< expected, remedy
};
void PrintTo(const Wrong& w, std::ostream* out) { *out << w.name; }

class WrongRecipe : public Failure, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongRecipe, IsToldAndNothingIsWritten) {
  const std::string file = write("wrong.toml", GetParam().recipe);
  EXPECT_EQ(run("run " + file + " --out " + out()), 2) << output;
  EXPECT_THAT(output,
              AllOf(HasSubstr(std::string("wrong.toml:") + GetParam().where), HasSubstr(GetParam().says)));
  EXPECT_FALSE(fs::exists(out()));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongRecipe,
    testing::Values(
        Wrong{"misspelt", "[specimen]\nwidht = \"38 mm\"\n", "2: specimen.widht", "did you mean \"width\"?"},
        Wrong{"out_of_range", "[matrix]\nmu = -0.1\n", "2: matrix.mu = -0.1", "expected 0 <="},
        Wrong{"wrong_unit", "[matrix]\nE_c = \"38 mm\"\n", "2: matrix.E_c", "GPa"},
        Wrong{"no_unit", "[matrix]\nE_c = 38\n", "2: matrix.E_c = 38", "has no unit"},
        Wrong{"negative_thickness", "[[bedding]]\nzone_thickness = \"-1 mm\"\n",
              "2: bedding[0].zone_thickness", "expected"},
        Wrong{"thickness_not_below_spacing", "[[bedding]]\nspacing = \"2 mm\"\nzone_thickness = \"2 mm\"\n",
              "3: bedding[0].zone_thickness = 2 mm", "below the spacing of 2 mm"},
        Wrong{"spacing_below_the_largest_disc", "[[bedding]]\nspacing = \"0.8 mm\"\n",
              "2: bedding[0].spacing = 0.8 mm", "at least the largest grain diameter, 0.83 mm"},
        Wrong{"angle_200", "[[bedding]]\ntheta = \"200 deg\"\n", "2: bedding[0].theta",
              "0 deg <= value < 180 deg"},
        Wrong{"angle_200_in_the_list", "[[bedding]]\n[test]\nangles = [\"0 deg\", \"200 deg\"]\n",
              "3: test.angles", "0 deg <= value < 180 deg"},
        Wrong{"angles_without_bedding", "[test]\nangles = [\"30 deg\"]\n", "2: test.angles",
              "add [[bedding]]"},
        Wrong{"angle_twice", "[[bedding]]\n[test]\nangles = [\"30 deg\", \"30 deg\"]\n", "3: test.angles",
              "every angle once"},
        Wrong{"dilation_above_friction", "[[bedding]]\nmu = 0.1\npsi = \"20 deg\"\n", "3: bedding[0].psi",
              "create energy"},
        Wrong{"radii_exchanged", "[packing]\nradius_min = \"0.5 mm\"\nradius_max = \"0.3 mm\"\n",
              "2: packing.radius_min", "exchange the two"},
        Wrong{"too_few_grains_across", "[specimen]\nwidth = \"5 mm\"\n", "2: specimen.width",
              "ten mean grain diameters"},
        Wrong{"grains_that_do_not_fill", "[packing]\nn_grains = 900\n", "2: packing.n_grains = 900",
              "900 discs of 0.665 mm fill 11 % of 38 mm x 76 mm. About 7500 fill it; or make them larger"},
        Wrong{"unknown_test", "[test]\nkind = \"uniaxal\"\n", "2: test.kind", "did you mean \"uniaxial\"?"},
        Wrong{"no_toml", "[specimen]\nwidth = 38 mm\n", "2:", "put a quantity in quotes"},
        Wrong{"pre_strain_beyond_the_end", "[test]\npre_strain = 0.02\n", "2: test.pre_strain",
              "below max_strain"}),
    [](const auto& one) { return std::string(one.param.name); });

// Whatever verb is given a file of another kind names the kind and the verb for it, and nothing else.
TEST_F(Failure, AnotherKindOfFileIsToldWithItsVerb) {
  const std::string rock = write("slate.toml", "name = \"slate\"\ndata = \"slate.csv\"\n"),
                    table = write("slate.csv", "theta [deg],UCS [MPa]\n0,100\n"), recipe = small_recipe(),
                    study = write("study.toml", "recipe = \"x.toml\"\n[[vary]]\nkey = \"bedding.k_n\"\n");
  for (const char* verb :
       {"run ", "specimen ", "recipe ", "elastic ", "envelope --confining '0 MPa,5 MPa,10 MPa' "}) {
    EXPECT_EQ(run(verb + rock), 2) << output;
    EXPECT_EQ(output,
              rock + " is a rock file, not a recipe. To calibrate it: phyllite calibrate " + rock + "\n");
    EXPECT_EQ(run(verb + table), 2) << output;
    EXPECT_THAT(
        output,
        HasSubstr(table + " is a table, not a recipe. To make a rock file of it: phyllite rock new "));
  }
  for (const char* verb : {"calibrate ", "rock check "}) {
    EXPECT_EQ(run(verb + recipe), 2) << output;
    EXPECT_EQ(output, recipe + " is a recipe, not a rock file. To test it: phyllite run " + recipe + "\n");
    EXPECT_EQ(run(verb + study), 2) << output;
    EXPECT_EQ(output, study + " is a study, not a rock file. To run it: phyllite study " + study + "\n");
  }
  EXPECT_EQ(run("study " + rock), 2) << output;
  EXPECT_THAT(output, HasSubstr("is a rock file, not a study. To calibrate it: phyllite calibrate "));
}

TEST_F(Failure, EmptyNamesOfFilesAndFolders) {
  const std::string recipe = small_recipe();
  for (const std::string& words : {"run " + recipe, "specimen " + recipe, "calibrate " + recipe,
                                   "study " + recipe, "study effects " + out(), "envelope " + recipe,
                                   "export pfc2d " + recipe, "replay " + out(), std::string("man")}) {
    EXPECT_EQ(run(words + " --out ''"), 2) << words;
    EXPECT_THAT(output, HasSubstr("--out: the name of a folder is empty; see `phyllite")) << words;
  }
  EXPECT_EQ(run("figure " + out() + " --kind stress_strain --out ''"), 2);
  EXPECT_THAT(output, HasSubstr("--out: the name of a file is empty"));
  EXPECT_EQ(run("rock new x --data ''"), 2);
  EXPECT_THAT(output, HasSubstr("--data: the name of a file is empty"));
}

TEST_F(Failure, AllProblemsAtOnce) {
  const std::string file = write("many.toml",
                                 "[specimen]\nwidht = \"38 mm\"\n[matrix]\nE_c = 38\nmu = -1\n[[bedding]]\n"
                                 "theta = \"200 deg\"\nspacing = \"-5 mm\"\n");
  EXPECT_EQ(run("run " + file + " --out " + out()), 2);
  for (const char* line : {"many.toml:2", "many.toml:4", "many.toml:5", "many.toml:7", "many.toml:8"})
    EXPECT_THAT(output, HasSubstr(line));
}

TEST_F(Failure, CommandLine) {
  EXPECT_EQ(run("run"), 2);
  EXPECT_THAT(output, HasSubstr("recipe is required"));
  EXPECT_EQ(run("run " + small_recipe() + " --lanes 3"), 2);
  EXPECT_THAT(output, HasSubstr("--lanes"));
  EXPECT_EQ(run("run " + small_recipe() + " --lnaes 4 --theads 2"), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("option = --lnaes"), HasSubstr("did you mean --lanes?"),
                            HasSubstr("did you mean --threads?")));
  EXPECT_EQ(run(""), 2);
  EXPECT_THAT(output, HasSubstr("verb: expected one of run, specimen"));
  EXPECT_EQ(run("study statsu folder"), 2);
  EXPECT_THAT(output, HasSubstr("one of status, resume"));
  EXPECT_EQ(run("show one two"), 2);
  EXPECT_THAT(output, HasSubstr("two: expected nothing more after phyllite show"));
  EXPECT_EQ(run("calibrat rock.toml"), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("verb = calibrat"), HasSubstr("did you mean calibrate?")));
  EXPECT_EQ(run("rock nwe"), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("one of new, check, twin"), HasSubstr("did you mean new?")));
  EXPECT_EQ(run("recipe --explain zone"), 2);
  EXPECT_THAT(output, HasSubstr("did you mean \"zone_thickness\"?"));
  EXPECT_EQ(run("study merge " + (folder / "absent").string()), 3);
  EXPECT_THAT(output, HasSubstr("absent: is no folder; name the --out"));
  EXPECT_EQ(run("verify V99"), 2);
  EXPECT_THAT(output, HasSubstr("case = V99: expected one of V0, V1, V2,"));
  EXPECT_EQ(run("recipe"), 2);
  EXPECT_THAT(output, HasSubstr("--explain"));
}

TEST_F(Failure, MissingAndUnreadableRecipe) {
  EXPECT_EQ(run("run " + (folder / "absent.toml").string() + " --out " + out()), 3);
  EXPECT_THAT(output, AllOf(HasSubstr("absent.toml"), HasSubstr("check the name")));
  EXPECT_EQ(run("run " + folder.string() + " --out " + out()), 3);
  EXPECT_THAT(output, HasSubstr("not a folder"));
  const std::string file = small_recipe();
  fs::permissions(file, fs::perms::none);
  EXPECT_EQ(run_line(as_nobody() + PHY_PROGRAM + " run " + file + " --out " + out()), 3) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("cannot be read"), HasSubstr("check the permissions"),
                            Not(HasSubstr("--out"))));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Failure, ReadOnlyAndBlockedOutputFolder) {
  const std::string file = small_recipe();
  fs::create_directories(folder / "theirs");
  fs::permissions(folder / "theirs", fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                         fs::perms::others_exec);
  EXPECT_EQ(
      run_line(as_nobody() + PHY_PROGRAM + " run " + file + " --out " + (folder / "theirs/new").string()), 3);
  EXPECT_THAT(output, AllOf(HasSubstr("theirs/new"), HasSubstr("choose a folder of your own")));
  EXPECT_EQ(run_line(as_nobody() + PHY_PROGRAM + " run " + file + " --out " + (folder / "theirs").string()),
            3);
  EXPECT_THAT(output, AllOf(HasSubstr("cannot be written"), HasSubstr("check the permissions")));
  EXPECT_TRUE(fs::is_empty(folder / "theirs"));
  write("blocked", "a file");
  EXPECT_EQ(run("run " + file + " --out " + (folder / "blocked").string()), 3);
  EXPECT_THAT(output, HasSubstr("in the way"));
}

// Somebody else's folder in the place of a result is not replaced.
TEST_F(Failure, ForeignFolderIsKept) {
  fs::create_directories(folder / "out/intact");
  std::ofstream(folder / "out/intact/thesis.txt") << "ten years";
  EXPECT_EQ(run("run " + small_recipe() + " --out " + out()), 3) << output;
  EXPECT_THAT(output, HasSubstr("cannot be replaced"));
  EXPECT_TRUE(fs::exists(folder / "out/intact/thesis.txt"));
}

// A file system of 64 kB, mounted in a name space of its own: the probe fits, a result does not.
TEST_F(Failure, FullDisk) {
  fs::create_directories(folder / "small");
  const std::string mount = "mount -t tmpfs -o size=64k none " + (folder / "small").string();
  if (run_line("unshare -rm sh -c '" + mount + "'") != 0) GTEST_SKIP() << "no name spaces here: " << output;
  const std::string file = small_recipe();
  const std::string command = mount + " && { " + PHY_PROGRAM + " run " + file + " --out " +
                              (folder / "small").string() + "; echo code $?; find " +
                              (folder / "small").string() + " -type f; }";
  run_line("unshare -rm sh -c '" + command + "'");
  EXPECT_THAT(output, AllOf(HasSubstr("No space left"), HasSubstr("free some space"), HasSubstr("code 3")));
  EXPECT_THAT(output, AllOf(Not(HasSubstr("history.csv")), Not(HasSubstr(".part"))));
}

// The two files of `rock new` want free names: half of them would block the next try.
TEST_F(Failure, FullDiskLeavesNoHalfRock) {
  const std::string small = at("small"), mount = "mount -t tmpfs -o size=4k none " + small;
  fs::create_directories(small);
  if (run_line("unshare -rm sh -c '" + mount + "'") != 0) GTEST_SKIP() << "no name spaces here: " << output;
  run_line("unshare -rm sh -c '" + mount + " && { " + PHY_PROGRAM + " rock new " + small +
           "/rock; echo code $?; find " + small + " -type f; }'");
  EXPECT_THAT(output, AllOf(HasSubstr("No space left"), HasSubstr("code 3"), Not(HasSubstr("rock.csv\n"))));
}

// Files come before tables: a full output takes no result away.
TEST_F(Failure, FullStandardOutputTakesNoFileAway) {
  const std::string body =
      "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[[bedding]]\nspacing = "
      "\"2 "
      "mm\"\n[test]\nangles = [\"0 deg\", \"45 deg\", \"90 deg\"]\n";
  write("base.toml", body);
  const std::string study = write("study.toml", std::string("recipe = \"base.toml\"\nsolver = \"direct\"\n") +
                                                    "[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n"
                                                    "[[vary]]\nkey = \"bedding.k_s\"\ntimes = [0.5, 1, 2]\n");
  ASSERT_EQ(run("study " + study + " --out " + out()), 0) << output;
  EXPECT_EQ(run("study " + study + " --out " + at("full") + " >/dev/full"), 3);
  EXPECT_TRUE(fs::exists(at("full") + "/effects.csv"));
}

TEST_F(Failure, FullStandardOutput) {
  for (const char* verb : {"--help", "recipe --template", "contact linear", "verify V9"}) {
    EXPECT_EQ(run_line(std::string(PHY_PROGRAM) + " " + verb + " >/dev/full"), 3) << verb;
    EXPECT_THAT(output, HasSubstr("standard output"));
  }
}

// One thread beside the first, where three specimens ask for three. The search for leaks wants one of its own
// (build/asan), so it is left out.
TEST_F(Failure, NoMoreThreads) {
  const std::string limited = as_nobody() + "env ASAN_OPTIONS=detect_leaks=0 prlimit --nproc=2 ";
  if (run_line(limited + "sh -c 'true & true & true & true & true & wait'") == 0)
    GTEST_SKIP() << "no limit of threads here";
  EXPECT_EQ(run_line(limited + PHY_PROGRAM + " elastic " + small_recipe() + " --threads 8"), 3) << output;
  EXPECT_THAT(output, HasSubstr("of 3 cannot be started; use fewer (--threads)"));
}

TEST_F(Failure, AnUnreadableResultIsToldOnceAndPicturesNeedAFolder) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  fs::permissions(out() + "/intact/result.json", fs::perms::none);
  const std::string nobody = as_nobody() + PHY_PROGRAM;
  EXPECT_EQ(run_line(nobody + " show " + out()), 3);
  const std::size_t first = output.find("missing:");
  EXPECT_NE(first, output.npos);
  EXPECT_EQ(output.find("missing:", first + 1), output.npos) << output;
  fs::permissions(folder, fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  EXPECT_EQ(run_line(nobody + " figure " + out() + " --kind cracks --out " + at("x.svg")), 3);
  EXPECT_THAT(output, AllOf(HasSubstr("cannot be written"), HasSubstr("check the permissions")));
}

class Imported : public Failure {
 protected:
  std::string recipe(const std::string& size, const std::string& more = "") const {
    return write("sub/imported.toml", "[specimen]\n" + size + "[packing]\nfile = \"discs.csv\"\n" + more);
  }
  void SetUp() override {
    ProgramTest::SetUp();
    fs::create_directories(folder / "sub");
    ASSERT_EQ(run("specimen " + small_recipe() + " --out " + (folder / "sub").string()), 0) << output;
  }
  const std::string box = "width = \"8 mm\"\nheight = \"16 mm\"\n";
};

TEST_F(Imported, FileIsFoundFromTheRecipesFolder) {
  EXPECT_EQ(run("specimen " + recipe(box)), 0) << output;
  EXPECT_THAT(output, HasSubstr("330 discs"));
}
TEST_F(Imported, BoxOfTheFileIsHeldAgainstTheRecipe) {
  EXPECT_EQ(run("specimen " + recipe("width = \"9 mm\"\nheight = \"16 mm\"\n")), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("specimen.width = 9 mm"), HasSubstr("write width = \"8 mm\"")));
  EXPECT_THAT(output, Not(HasSubstr("height")));
}
TEST_F(Imported, SpacingIsHeldAgainstTheGrainsOfTheFile) {
  EXPECT_EQ(run("specimen " + recipe(box, "[[bedding]]\nspacing = \"0.8 mm\"\n")), 2);
  EXPECT_THAT(output, HasSubstr("at least the largest grain diameter, 0.8"));
}
TEST_F(Imported, BadLinesAreToldWithTheirNumbers) {
  write("sub/discs.csv", "x [m],y [m],r [m]\n0.1,0.1,1e-3\n0.1,oops,1e-3\n0.1,0.1,-1\n");
  EXPECT_EQ(run("specimen " + recipe(box)), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("discs.csv:3"), HasSubstr("discs.csv:4")));
}
TEST_F(Imported, DiscsInOnePlaceAreTold) {
  const std::string discs = read(at("sub/discs.csv"));
  const std::string last = discs.substr(discs.rfind('\n', discs.size() - 2) + 1);
  write("sub/discs.csv", discs + last);
  EXPECT_EQ(run("specimen " + recipe(box)), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("discs.csv:333: disc"), HasSubstr("the disc of line 332")));
}
TEST_F(Imported, DiscsOfAnotherScaleAreTold) {
  write("sub/discs.csv", "x [m],y [m],r [m]\n4e-3,4e-3,1e-12\n5e-3,4e-3,1e-12\n");
  EXPECT_EQ(run("specimen " + recipe(box)), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("sub/discs.csv:2: disc"), HasSubstr("discs.csv:3: disc"),
                            HasSubstr("a radius from 1/10000"), HasSubstr("check the units")));
}
TEST_F(Imported, MissingFile) {
  fs::remove(folder / "sub/discs.csv");
  EXPECT_EQ(run("specimen " + recipe(box)), 3);
  EXPECT_THAT(output, HasSubstr("sub/discs.csv"));
}

}  // namespace
