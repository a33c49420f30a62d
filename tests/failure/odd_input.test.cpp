// Input that is odd rather than wrong: numbers without a value, words in the wrong place, files of other
// systems.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class OddInput : public ProgramTest {};

TEST_F(OddInput, LanesOfAnotherPrecision) {
  const std::string file = small_recipe();
  const std::string with_sse2 = "PHYLLITE_ISA=sse2 " PHY_PROGRAM " run ";
  EXPECT_EQ(run_line(with_sse2 + file + " --lanes 16 --out " + out()), 2);
  EXPECT_THAT(output, HasSubstr("--lanes = 16: expected 1, 2: what sse2 registers hold in double precision"));
  write("float.toml", read(file) + "[engine]\nprecision = \"float\"\n");
  EXPECT_EQ(run_line(with_sse2 + at("float.toml") + " --lanes 2 --out " + out()), 2);
  EXPECT_THAT(output, HasSubstr("--lanes = 2: expected 1, 4: what sse2 registers hold in single precision"));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(OddInput, AMistypedInstructionSet) {
  EXPECT_EQ(run_line("PHYLLITE_ISA=avx3 " + std::string(PHY_PROGRAM) + " run " + small_recipe() + " --out " +
                     out()),
            2);
  EXPECT_THAT(output, HasSubstr("PHYLLITE_ISA = avx3: expected sse2, avx2 or avx512"));
}

TEST_F(OddInput, OptionsThatAreNoNumber) {
  for (const char* option : {"--seconds nan", "--magnify nan", "--seconds inf", "--seconds -nan"}) {
    EXPECT_EQ(run("film " + out() + " " + option), 2) << option;
    EXPECT_THAT(output, HasSubstr("is not a number from 0"));
  }
}

TEST_F(OddInput, IndicesOfNoSet) {
  small_recipe();
  for (const char* index : {"-1", "", "x", "1x", "99999999999999999999"}) {
    const std::string file = write("study.toml", "recipe = \"small.toml\"\n[[vary]]\nkey = \"bedding[" +
                                                     std::string(index) + "].k_n\"\ntimes = [1, 2]\n");
    EXPECT_EQ(run("study " + file + " --dry-run"), 2) << index << output;
    EXPECT_THAT(output, HasSubstr("study.toml:3: vary[0].key")) << index;
  }
}

TEST_F(OddInput, AnEmptyRecipeIsSaidToBeOne) {
  EXPECT_EQ(run("study " + write("study.toml", "recipe = \"" + write("empty.toml", "# later\n") + "\"\n") +
                " --dry-run"),
            0);
  EXPECT_THAT(output, HasSubstr("nothing is stated: this is the paper's intact specimen, of 7481 discs"));
}

// ulimit -f: the signal of the system would end the program in the middle of a file.
TEST_F(OddInput, ALimitOfTheSizeOfFilesIsTold) {
  const std::string command = std::string(PHY_PROGRAM) + " run " + small_recipe() + " --out " + out();
  EXPECT_EQ(run_line("(ulimit -f 20; " + command + ")"), 3) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("cannot be written"), HasSubstr("ulimit -f")));
  EXPECT_FALSE(fs::exists(out())) << "nothing is left";
}

// A denormal goes through every table and its report.
TEST_F(OddInput, TheSmallestNumbersAreNumbers) {
  small_recipe("max_strain = 0.03\n");
  const std::string file =
      write("study.toml", "recipe = \"small.toml\"\n[[vary]]\nkey = \"matrix.mu\"\nvalues = [1e-320, 0.5]\n");
  EXPECT_EQ(run("study " + file + " --out " + out()), 0) << output;
  EXPECT_EQ(run("report " + out()), 0) << output;
}

TEST_F(OddInput, AnAngleHasOneName) {
  const std::string plain = small_recipe(), text = read(plain);
  write("minus.toml", "name = \"small\"\n[test]\nangles = [\"-0 deg\", \"0 deg\"]\n[[bedding]]\n");
  EXPECT_EQ(run("recipe " + at("minus.toml")), 2);
  EXPECT_THAT(output, HasSubstr("every angle once"));
  write("one.toml", "[test]\nangles = [\"-0 deg\"]\n[[bedding]]\n");
  EXPECT_EQ(run("recipe " + at("one.toml")), 0);
  EXPECT_THAT(output, HasSubstr("angles = [\"0 deg\"]"));
}

TEST_F(OddInput, AStressThatRoundingHides) {
  const std::string file = small_recipe();
  std::string text = read(file);
  text.insert(text.find("n_grains"), "initial_stress = \"isotropic\"\nisotropic_stress = \"25 Pa\"\n");
  EXPECT_EQ(run("run " + write("soft.toml", text) + " --out " + out()), 2);
  EXPECT_THAT(output,
              AllOf(HasSubstr("packing.isotropic_stress = 25 Pa: expected at least"), HasSubstr("rounding")));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(OddInput, DiscsOfOtherProgramsAreToldWithAllTheirLines) {
  const std::string recipe = small_recipe("max_strain = 0.0001\n"), text = read(recipe);
  ASSERT_EQ(run("specimen " + recipe + " --out " + at("discs")), 0) << output;
  const std::string discs = read(at("discs") + "/discs.csv");
  const auto import = [&](const std::string& content, const std::string& more = "") {
    write("their.csv", content);
    std::string with = text;
    with.replace(with.find("n_grains = 330"), 14, "file = \"their.csv\"\n" + more);
    return run("run " + write("import.toml", with) + " --out " + out());
  };
  EXPECT_EQ(import(discs + "0.1,0.001,0.0001\n0.001,0.001,0.00000001\n"), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("their.csv:333: disc = (100 mm, 1 mm): expected a centre inside"),
                            HasSubstr("their.csv:334: disc = 0.00001 mm: expected a radius")));
  EXPECT_EQ(import(discs, "n_grains = 300\n"), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("packing.n_grains = 300"), HasSubstr("the file has 330 discs")));
  EXPECT_FALSE(fs::exists(out()));
  std::string macs = discs;
  std::replace(macs.begin(), macs.end(), '\n', '\r');
  for (const std::string& same : {"\xEF\xBB\xBF" + discs, macs}) EXPECT_LT(import(same), 2) << output;
  fs::remove_all(out());
  EXPECT_LT(import(discs, "n_grains = 330\n"), 2) << output;
}

TEST_F(OddInput, LinesThatEndAsOnOldMacs) {
  EXPECT_EQ(run("recipe " + write("mac.toml", "[specimen]\rwidth = \"38 mm\"\r")), 2);
  EXPECT_THAT(output, HasSubstr("mac.toml:1: expected line ends of Unix or Windows"));
  write("mac.csv", "theta [deg],UCS [MPa]\r0,100\r30,60\r90,90\r");
  EXPECT_EQ(run("rock check " + write("rock.toml", "data = \"mac.csv\"\n")), 0) << output;
  EXPECT_THAT(output, HasSubstr("the file has line ends of old Macs"));
}

TEST_F(OddInput, FiftyProblemsOfAKindAreEnough) {
  std::string table = "theta [deg],UCS [MPa]\n";
  for (int i = 0; i < 30000; ++i) table += "95,x\n";
  write("bad.csv", table);
  EXPECT_EQ(run("rock check " + write("rock.toml", "data = \"bad.csv\"\n")), 2);
  EXPECT_LT(std::count(output.begin(), output.end(), '\n'), 110);
  EXPECT_THAT(output, AllOf(HasSubstr("bad.csv:51: UCS = x"), HasSubstr("29950 more of this kind")));
}

}  // namespace
