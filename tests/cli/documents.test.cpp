// Every command that the documents show is run, on a specimen of a few hundred discs: a word in capitals or
// an example of full size stands for something small. A command that this test cannot place fails it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;

/// `phyllite ...` in the text of README, CONTRIBUTING and docs, without the program's name.
std::set<std::string> shown_commands() {
  std::vector<fs::path> files = {"README.md", "CONTRIBUTING.md"};
  const fs::path root = PHY_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::set<std::string> commands;
  for (const fs::path& file : files) {
    std::ifstream in(root / file);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const std::regex shown("`phyllite\\s+([^`]+)`");
    for (std::sregex_iterator it(text.begin(), text.end(), shown), end; it != end; ++it)
      commands.insert(std::regex_replace((*it)[1].str(), std::regex("\\s+"), " "));
  }
  return commands;
}

class Documents : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    small_recipe();
    fs::create_symlink(fs::path(PHY_SOURCE_DIR) / "examples", at("examples"));
    write(
        "base.toml",
        "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[[bedding]]\nspacing = "
        "\"2 mm\"\n[test]\nangles = [\"0 deg\", \"15 deg\", \"30 deg\", \"45 deg\", \"60 deg\", \"75 deg\", "
        "\"90 deg\"]\nintact = true\nplaten_speed = \"0.4 "
        "m/s\"\n");
    const std::string varied =
        "recipe = \"base.toml\"\n[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n";
    write("study.toml", varied);
    write("direct.toml", "solver = \"direct\"\n" + varied);
    write("table.csv",
          "theta [deg],E [GPa],nu,UCS [MPa],n\n0,17.5,0.10,105,3\n30,15.6,0.36,60,3\n60,21.0,0.5,45,3\n"
          "90,48,0.25,128,3\n");
    write("rock.toml", "data = \"table.csv\"\nrecipe = \"base.toml\"\n");
    write("events.toml", read(at("small.toml")) + "events = true\n");
    for (const char* line : {"run small.toml --out result", "run events.toml --out results/events",
                             "run small.toml --out results/paper", "study study.toml --out results/study",
                             "study direct.toml --out results/direct"})
      ASSERT_LE(in_folder(line), 1) << line << "\n" << output;
  }
  int in_folder(const std::string& arguments) {
    return run_line("cd " + folder.string() + " && " + PHY_PROGRAM + " " + arguments);
  }
};

/// The same command on something small.
std::string small(const std::string& shown) {
  static const std::map<std::string, std::string> whole = {
      // the page runs until it is stopped: tests/cli/gui.test.cpp
      {"gui rocks", "gui --help"},
      {"gui rocks --port 8642", "gui --help"},
      // of a calibration with draws: tests/cli/calibrate.test.cpp
      {"design CALIBRATION", "design --help"},
      {"rock check shale.toml", "rock check rock.toml"},
      {"calibrate shale.toml --out shale-calibration", "calibrate rock.toml --elastic --out again/gui"},
      {"report shale-calibration", "report again/gui"},
      {"run shale-tests/pull.toml --out shale-tests/pull", "run small.toml --out again/pull"},
      {"calibrate ROCK", "calibrate rock.toml --elastic --out again/one"},
      {"calibrate ROCK --out FOLDER", "calibrate rock.toml --elastic --out again/two"},
      {"compare THEIRS.csv RESULT", "compare result/intact/history.csv result/intact"},
      {"compare THEIRS.csv RESULT --figure FILE",
       "compare result/intact/history.csv result/intact --figure again/compared.svg"},
      {"export pfc2d FOLDER --out FILES", "export pfc2d result --out again/pfc2d"},
      {"export pfc2d", "export pfc2d base.toml --out again/pfc2d-verb"},
      {"export pfc2d RECIPE", "export pfc2d base.toml --out again/pfc2d-recipe"},
      {"calibrate rock.toml", "calibrate rock.toml --elastic --out again/three"},
      {"elastic examples/paper/press.toml", "elastic base.toml"},
      {"figure RESULT --kind events", "figure results/events --kind events --out again/events.svg"},
      {"figure --kind stiffness", "figure results/study --kind stiffness --out again/stiffness.svg"},
      {"figure results/bend --kind cracks", "figure result --kind cracks --out again/bend.svg"},
      {"figure results/brazilian --kind cracks", "figure result --kind cracks --out again/disc.svg"},
      {"figure results/shear --kind cracks", "figure result --kind cracks --out again/shear.svg"},
      {"run examples/lab/brazilian.toml --out results/brazilian", "run small.toml --out again/disc"},
      {"run examples/lab/direct-shear.toml --out results/shear", "run small.toml --out again/shear"},
      {"run examples/lab/semi-circular-bend.toml --out results/bend", "run small.toml --out again/bend"},
      {"film RESULT", "film result --seconds 0.5 --width 320"},
      {"film RESULT --out film.webm", "film result --seconds 0.5 --width 320 --out again/film.webm"},
      {"replay FOLDER", "replay result"},
      {"recipe --explain", "recipe --explain spacing"},
      {"recipe first.toml", "recipe base.toml"},
      {"rock new slate --data slate.csv", "rock new slates --data table.csv"},
      {"study joints.toml --slurm 8", "study study.toml --slurm 8"},
      {"rock check", "rock check rock.toml"},
      {"rock new", "rock new fresh"},
      {"rock new NAME", "rock new another"},
      {"run examples/paper/press.toml", "run small.toml --out again/press"},
      {"specimen --out", "specimen small.toml --out again/specimen"},
      {"study --explain", "study --explain packings"},
      {"study examples/evidence/NAME.toml --out results/evidence/NAME",
       "study study.toml --out again/evidence"},
      {"study examples/paper/study.toml --dry-run",
       "study examples/paper/study.toml --dry-run --out again/dry"},
      {"study effects", "study effects results/study"},
      {"verify --markdown", "verify V1 --markdown"},
      {"calibrate rock.toml --method sequence",
       "calibrate rock.toml --method sequence --elastic --out again/sequence"},
      {"study examples/paper/elastic-crossing.toml --out results/direct",
       "study direct.toml --out again/direct"},
      {"study examples/paper/study-small.toml --out results/study", "study study.toml --out again/study"}};
  if (const auto known = whole.find(shown); known != whole.end()) return known->second;
  std::string command = shown;
  const std::vector<std::pair<std::string, std::string>> words = {{"svg|pdf|png", "svg"},
                                                                  {"--size WIDTH", "--size 90"},
                                                                  {"--out FILE", "--out again/figure.svg"},
                                                                  {"KIND", "cracks"},
                                                                  {"RESULT", "result"},
                                                                  {"ROCK", "rock.toml"},
                                                                  {"RECIPE", "base.toml"},
                                                                  {"LAW", "linear"},
                                                                  {"NAME", "linear"}};
  for (const auto& [word, instead] : words)
    if (const std::size_t at = command.find(word); at != command.npos)
      command.replace(at, word.size(), instead);
  return command;
}

TEST_F(Documents, EveryCommandThatTheyShowIsRun) {
  const bool figures = has("gnuplot"), films = has("ffmpeg");
  const std::set<std::string> commands = shown_commands();
  ASSERT_GT(commands.size(), 30U);
  for (const std::string& shown : commands) {
    if (shown.find(' ') == shown.npos) {  // a verb, not a command
      EXPECT_EQ(run(shown + " --help"), 0) << shown << "\n" << output;
      continue;
    }
    if (((shown.starts_with("figure") || shown.find("--figure") != shown.npos) && !figures) ||
        (shown.starts_with("film") && !films))
      continue;
    const int code = in_folder(small(shown));
    // 1: a verdict, or a test without a peak
    EXPECT_THAT(code, testing::AnyOf(0, 1)) << "phyllite " << shown << "\nrun as: " << small(shown) << "\n"
                                            << output;
  }
}

TEST_F(Documents, TheReferenceIsThatOfTheProgram) {
  std::string all;
  for (const char* file : {"recipe", "study", "rock"}) {
    ASSERT_EQ(run(std::string(file) + " --reference"), 0) << output;
    all += output;
  }
  EXPECT_EQ(read(std::string(PHY_SOURCE_DIR) + "/docs/reference.md"), all) << "make docs writes it";
  const std::map<std::string, std::string> pages = {{"rock --tables", "tables"},
                                                    {"calibrate --reference", "calibration-tables"},
                                                    {"run --reference", "result-tables"}};
  for (const auto& [command, page] : pages) {
    ASSERT_EQ(run(command), 0) << output;
    EXPECT_EQ(read(std::string(PHY_SOURCE_DIR) + "/docs/" + page + ".md"), output) << "make docs writes it";
  }
}

/// `make docs`: no broken link between pages, a search, and nothing fetched from a network.
TEST_F(Documents, AreASite) {
  if (!has("sphinx-build")) GTEST_SKIP() << "sphinx-build is missing";
  const std::string root = PHY_SOURCE_DIR;
  ASSERT_EQ(run_line("sphinx-build -q -W --keep-going -b html -c " + root + "/docs/site -d " + at("trees") +
                     " " + root + "/docs " + at("site")),
            0)
      << output;
  EXPECT_TRUE(fs::exists(at("site/search.html")));
  EXPECT_NE(read(at("site/searchindex.js")).find("smooth"), std::string::npos);
  const std::regex fetched("(src|rel=\"stylesheet\"[^>]* href)=\"https?:");
  for (const auto& entry : fs::recursive_directory_iterator(at("site")))
    if (entry.path().extension() == ".html") {
      EXPECT_FALSE(std::regex_search(read(entry.path().string()), fetched)) << entry.path();
    }
}

}  // namespace
