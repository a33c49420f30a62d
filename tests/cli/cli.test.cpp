// The program as a user meets it: exit codes, messages, files.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Cli : public ProgramTest {
 protected:
  std::string many_angles() const {
    std::string angles = "angles = [\"0 deg\"";
    for (int i = 1; i < 30; ++i) angles += ", \"" + std::to_string(6 * i) + " deg\"";
    return write("many.toml",
                 "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[[bedding]]\n"
                 "spacing = \"2 mm\"\n[test]\n" +
                     angles + "]\nplaten_speed = \"0.2 m/s\"\n");
  }
  static int n_results(const std::string& in) {
    int n = 0;
    if (fs::exists(in))
      for (const auto& entry : fs::directory_iterator(in))
        if (fs::exists(entry.path() / "result.json")) ++n;
    return n;
  }
  /// Sends Ctrl-C to the program, with one thread, as soon as something is `finished`. The exit code, or -1
  /// if it ended by the signal.
  int interrupted(std::vector<std::string> arguments, const std::function<bool()>& finished) {
    arguments.insert(arguments.begin(), {"--threads", "1"});
    const std::string log = at("log");
    const pid_t child = start(arguments, log);
    int status = 0;
    while (!finished() && ::waitpid(child, &status, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ::kill(child, SIGINT);
    ::waitpid(child, &status, 0);
    output = read(log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Results in a folder; whatever else is a folder there is half a result.
  static int n_whole_results(const std::string& in) {
    int n = 0;
    for (const auto& entry : fs::directory_iterator(in)) {
      if (!entry.is_directory()) continue;
      std::ifstream file(entry.path() / "result.json");
      EXPECT_NE(nlohmann::json::parse(file)["outcome"]["status"], "interrupted") << entry.path();
      EXPECT_TRUE(fs::exists(entry.path() / "history.csv"));
      ++n;
    }
    return n;
  }
  /// The longest line of the output, without the ends of lines of a terminal.
  std::size_t widest() const {
    std::size_t width = 0;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
      while (line.ends_with('\r')) line.pop_back();
      width = std::max(width, line.size());
    }
    return width;
  }
};

TEST_F(Cli, VersionAndHelp) {
  EXPECT_EQ(run("--version"), 0);
  EXPECT_THAT(output, HasSubstr("phyllite "));
  EXPECT_EQ(run("--help"), 0);
  EXPECT_THAT(output, HasSubstr("verify"));
  EXPECT_EQ(run("crush"), 2);
}

TEST_F(Cli, RunLeavesCompleteResults) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("UCS"));
  for (const char* name : {"theta_45_deg", "theta_60_deg", "intact"}) {
    const fs::path file = fs::path(out()) / name / "result.json";
    ASSERT_TRUE(fs::exists(file)) << file;
    std::ifstream in(file);
    const auto j = nlohmann::json::parse(in);
    EXPECT_EQ(j["outcome"]["status"], "peaked");
    EXPECT_GT(j["numbers"]["ucs"]["value"].get<double>(), 20e6);           // the first stress wave is 2 MPa
    EXPECT_LT(j["numbers"]["energy_error"]["value"].get<double>(), 5e-3);  // driven four times too fast
  }
}

TEST_F(Cli, ShowPrintsWhatRunPrinted) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  EXPECT_TRUE(fs::exists(fs::path(out()) / "report.html"));
  const std::string table =
      output.substr(output.find(" theta"), output.rfind("intact") - output.find(" theta"));
  EXPECT_EQ(run("show " + out()), 0);
  EXPECT_THAT(output, HasSubstr(table));
  fs::remove_all(fs::path(out()) / "intact");
  EXPECT_EQ(run("show " + out()), 1);
  EXPECT_THAT(output, HasSubstr("intact: missing"));
  EXPECT_EQ(run("report " + out() + " --out " + (folder / "page.html").string()), 0);
  EXPECT_THAT(output, HasSubstr("intact: missing"));
  EXPECT_GT(fs::file_size(folder / "page.html"), 100000U);
  EXPECT_EQ(run("show " + out() + "/theta_45_deg"), 0);
  EXPECT_EQ(run("show " + folder.string()), 2);
  for (const auto& [file, verb] : {std::pair{"study.toml", "phyllite study status"},
                                   {"calibration.json", "tables.txt"},
                                   {"envelope.csv", "sigma_3_"}}) {
    fs::create_directories(folder / "other");
    std::ofstream(folder / "other" / file) << "\n";
    EXPECT_EQ(run("show " + at("other")), 2);
    EXPECT_THAT(output, HasSubstr(verb)) << file;
    fs::remove_all(folder / "other");
  }
  EXPECT_EQ(run("show /nonexistent"), 3);
}

TEST_F(Cli, FiguresAreWrittenWholeOrNotAtAll) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  const fs::path file = folder / "a picture.svg";
  const std::string figure = "figure " + out() + " --out '" + file.string() + "' --kind ";
  EXPECT_EQ(run(figure + "fig5"), 2);
  EXPECT_THAT(output, testing::AllOf(HasSubstr("--kind = fig5"), HasSubstr("study")));
  EXPECT_EQ(run(figure + "rose --format png"), 2);
  EXPECT_THAT(output, HasSubstr("--format = png: expected svg, as --out"));
  for (const char* size : {"1e-3", "-90", "1e9", "nan", "0", "90x", "90x5", "wide"}) {
    EXPECT_EQ(run(figure + "rose --size " + size), 2);
    EXPECT_THAT(output, HasSubstr("expected 30 to 1000 mm"));
  }
  EXPECT_EQ(run_line("PATH=/nonexistent " PHY_PROGRAM " " + figure + "cracks"), 3);
  EXPECT_THAT(output, HasSubstr("apt install gnuplot-nox"));
  EXPECT_FALSE(fs::exists(file));
  if (!has("gnuplot")) GTEST_SKIP() << "no gnuplot here";
  for (const char* kind : {"stress_strain", "anisotropy", "rose", "cracks", "fig2", "fig3"}) {
    ASSERT_EQ(run(figure + kind), 0) << output;
    std::ifstream in(file);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    EXPECT_THAT(text, HasSubstr("</svg>")) << kind;
    EXPECT_GT(text.size(), 10000U) << kind;
  }
  const std::string rose = "figure " + out() + " --kind rose --out ";
  EXPECT_EQ(run(rose + at("rose.png")), 0) << output;
  EXPECT_THAT(read(at("rose.png")), testing::StartsWith("\x89PNG")) << "the ending says the format";
  EXPECT_EQ(run(rose + at("smallest.svg") + " --size 30"), 0) << output;
  EXPECT_EQ(
      run("figure " + out() + " --out " + at("curves.svg") + " --size 90x70 --data " + at("curves.csv")), 0)
      << output;
  EXPECT_THAT(read(at("curves.svg")), HasSubstr("width=\"340\" height=\"265\""));
  EXPECT_THAT(read(at("curves.csv")), testing::StartsWith("panel,series,x_axis,y_axis,x,y,low,high,text\n"));
  const fs::path locked = folder / "locked";
  EXPECT_EQ(
      run("figure " + out() + " --kind rose --format pdf --out " + (locked / "deeper" / "x.pdf").string()),
      0);
  EXPECT_TRUE(fs::exists(locked / "deeper" / "x.pdf"));
}

// `script` (of every Debian) gives the program a terminal.
TEST_F(Cli, CurvesAreDrawnOnlyWhereATerminalCanShowThem) {
  const std::string recipe = small_recipe("platen_friction = 0.1\n");
  const auto on_terminal = [&](const std::string& size, const std::string& environment) {
    return run_line("env -u LC_ALL -u LC_CTYPE -u NO_COLOR TERM=xterm " + environment +
                    " script -qec \"stty " + size + "; " PHY_PROGRAM " run " + recipe + " --out " + out() +
                    "\" /dev/null");
  };
  const auto has_dots = [&] {
    return output.find("\xE2\xA1") != output.npos || output.find("\xE2\xA0") != output.npos;
  };
  ASSERT_EQ(on_terminal("cols 100 rows 40", "LANG=C.UTF-8"), 0) << output;
  EXPECT_TRUE(has_dots()) << output;
  EXPECT_THAT(output, HasSubstr("\033[38;2;"));
  EXPECT_THAT(output, AllOf(HasSubstr("axial stress [MPa]"), HasSubstr("│")));
  ASSERT_EQ(on_terminal("cols 100 rows 40", "LANG=C.UTF-8 NO_COLOR=1"), 0);
  EXPECT_TRUE(has_dots());
  EXPECT_EQ(output.find("\033[38"), output.npos);
  for (const auto& [size, environment] : {std::pair{"cols 60 rows 40", "LANG=C.UTF-8"},
                                          {"cols 100 rows 20", "LANG=C.UTF-8"},
                                          {"cols 100 rows 40", "LANG=C"},
                                          {"cols 100 rows 40", "LANG=C.UTF-8 TERM=dumb"}}) {
    ASSERT_EQ(on_terminal(size, environment), 0) << output;
    EXPECT_FALSE(has_dots()) << size << " " << environment;
  }
  ASSERT_EQ(run("run " + recipe + " --out " + out()), 0);
  EXPECT_FALSE(has_dots());
}

TEST_F(Cli, TablesFitTheTerminalAndAreWholeInAFile) {
  const std::string recipe = small_recipe();
  for (const std::string& verb : std::vector<std::string>{
           "run " + recipe + " --out " + out(), "show " + out(), "elastic --press " + recipe, "verify V9",
           "envelope --confining '0 MPa,2 MPa,4 MPa' " + recipe + " --out " + at("envelope")}) {
    const std::string line = PHY_PROGRAM " " + verb + " 2>/dev/null";
    for (const std::size_t columns : {60U, 80U}) {
      run_line("script -qec \"stty cols " + std::to_string(columns) + "; " + line + "\" /dev/null");
      EXPECT_LE(widest(), columns) << output;
      EXPECT_GT(widest(), columns / 2) << output;
    }
    run_line(line);
    EXPECT_GT(widest(), 80U) << output;
  }
}

TEST_F(Cli, FilmsAreEncoded) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  EXPECT_EQ(run("film " + out() + " --out " + (folder / "film.avi").string()), 2);
  EXPECT_THAT(output, HasSubstr(".webm"));
  if (!has("ffmpeg")) GTEST_SKIP() << "no ffmpeg here";
  const std::pair<const char*, const char*> films[] = {
      {"film.gif", "GIF89a"}, {"film.mp4", "ftyp"}, {"film.webm", "\x1A\x45\xDF\xA3"}};
  for (const auto& [name, magic] : films) {
    ASSERT_EQ(run("film " + out() + " --seconds 0.5 --width 320 --out " + (folder / name).string()), 0)
        << output;
    EXPECT_THAT(output, HasSubstr("10 frames"));
    std::ifstream in(folder / name, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    EXPECT_THAT(bytes.substr(0, 12), HasSubstr(magic));
    EXPECT_GT(bytes.size(), 5000U);
  }
}

TEST_F(Cli, AnInterruptedFilmLeavesNothing) {
  if (!has("ffmpeg")) GTEST_SKIP() << "no ffmpeg here";
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  const fs::path films = folder / "films";
  const pid_t child =
      start({"film", out(), "--seconds", "120", "--out", (films / "film.webm").string()}, at("log"));
  int status = 0;
  while ((!fs::exists(films) || fs::is_empty(films)) && ::waitpid(child, &status, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(child, SIGINT);
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << "the signal must not kill it";
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(read(at("log")), HasSubstr("interrupted, nothing was written"));
  EXPECT_TRUE(fs::is_empty(films));
}

TEST_F(Cli, BadRecipeIsRefusedWithAllProblemsAndNothingIsWritten) {
  const std::string bad = write("bad.toml", "[specimen]\nwidht = \"8 mm\"\nheight = 16\n");
  EXPECT_EQ(run("run " + bad + " --out " + out()), 2);
  EXPECT_THAT(output, HasSubstr("bad.toml:2"));
  EXPECT_THAT(output, HasSubstr("bad.toml:3"));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Cli, RecipesOfOneFileNameAreNotRunTogether) {
  fs::create_directories(folder / "d1");
  fs::create_directories(folder / "d2");
  for (const char* place : {"d1", "d2"}) fs::copy(small_recipe(), folder / place / "press.toml");
  EXPECT_EQ(run("run " + at("d1/press.toml") + " " + at("d2/press.toml") + " --out " + out()), 2);
  EXPECT_THAT(output, testing::AllOf(HasSubstr("d2/press.toml: expected another file name than"),
                                     HasSubstr("d1/press.toml"), HasSubstr("--out each")));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Cli, AFolderHoldsResultsOfOneRecipe) {
  const auto recipe = [&](const std::string& k_n, const std::string& angles) {
    return write("press.toml",
                 "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n"
                 "[[bedding]]\nspacing = \"2 mm\"\nk_n = \"" +
                     k_n +
                     "\"\n[test]\n"
                     "platen_speed = \"0.2 m/s\"\nangles = [" +
                     angles + "]\n");
  };
  const std::string line = " --out " + out();
  ASSERT_EQ(run("run " + recipe("3000 GPa/m", "\"45 deg\"") + line), 0) << output;
  ASSERT_EQ(run("run " + recipe("3000 GPa/m", "\"60 deg\"") + line), 0) << output;
  EXPECT_EQ(n_results(out()), 2) << "other angles are added";
  EXPECT_THAT(read(out() + "/report.html"),
              testing::AllOf(HasSubstr("theta = 45 deg"), HasSubstr("theta = 60 deg")));
  fs::create_directories(fs::path(out()) / "mine");
  EXPECT_EQ(run("run " + recipe("1000 GPa/m", "\"45 deg\"") + line), 2);
  EXPECT_THAT(output, testing::AllOf(HasSubstr("out (2 results): bedding[0].k_n = \"3000 GPa/m\""),
                                     HasSubstr("expected \"1000 GPa/m\", as in"), HasSubstr("--replace")));
  EXPECT_EQ(n_results(out()), 2);
  ASSERT_EQ(run("run --replace " + recipe("1000 GPa/m", "\"45 deg\"") + line), 0) << output;
  EXPECT_EQ(n_results(out()), 1);
  EXPECT_TRUE(fs::exists(fs::path(out()) / "mine")) << "what is no result stays";
  EXPECT_EQ(run("show " + out()), 0);
  EXPECT_THAT(output, testing::Not(HasSubstr(" 60")));
}

TEST_F(Cli, StressesWithoutUnitAreShownInMPa) {
  EXPECT_EQ(run("envelope --confining '0 MPa,5,10 MPa' " + small_recipe() + " --out " + out()), 2);
  EXPECT_THAT(output, HasSubstr("\"5 MPa\""));
}

TEST_F(Cli, MissingRecipeAndBlockedFolderExitWith3) {
  EXPECT_EQ(run("run /nonexistent.toml"), 3);
  write("blocked", "a file");
  EXPECT_EQ(run("run " + small_recipe() + " --out " + (folder / "blocked").string()), 3);
  EXPECT_THAT(output, HasSubstr("in the way"));
}

TEST_F(Cli, ATestThatNeverPeaksIsStoredAndExitsWith1) {
  EXPECT_EQ(run("run " + small_recipe("max_strain = 5e-4\n") + " --out " + out()), 1);
  EXPECT_THAT(output, HasSubstr("raise test.max_strain"));
  EXPECT_TRUE(fs::exists(fs::path(out()) / "intact" / "result.json"));
}

// Thirty tests one after the other; Ctrl-C as soon as the first result is there.
TEST_F(Cli, InterruptKeepsWhatIsFinishedAndSaysTheRest) {
  const auto finished = [&] { return n_results(out()) > 0; };
  EXPECT_EQ(interrupted({"run", many_angles(), "--lanes", "1", "--out", out()}, finished), 1) << output;
  EXPECT_THAT(output, HasSubstr("interrupted: not started; run the same recipe again"));
  EXPECT_GE(n_whole_results(out()), 1);
  EXPECT_LT(n_whole_results(out()), 30);
}

TEST_F(Cli, InterruptOfAnEnvelopeKeepsWhatIsFinishedToo) {
  const auto total = [&](const auto& count) {
    int n = 0;  // the stresses are tested side by side
    if (fs::exists(out()))
      for (const auto& e : fs::directory_iterator(out()))
        if (e.is_directory()) n += static_cast<int>(count(e.path().string()));
    return n;
  };
  const auto finished = [&] { return total([](const std::string& f) { return n_results(f); }) > 0; };
  EXPECT_EQ(interrupted({"envelope", many_angles(), "--out", out()}, finished), 1) << output;
  EXPECT_THAT(output, HasSubstr("theta = 0 deg at 20 MPa"));
  EXPECT_THAT(output, HasSubstr("interrupted: not started; run the same recipe again"));
  const int n_finished = total([](const std::string& f) { return n_whole_results(f); });
  EXPECT_GE(n_finished, 1);
  const std::string tests = read(out() + "/envelope.csv");
  EXPECT_EQ(std::count(tests.begin(), tests.end(), '\n'), 1 + 4 * 30);
  int n_interrupted = 0;  // the others are reported with what they have: a peak, a knee, none
  for (std::size_t at = 0; (at = tests.find(",interrupted,", at)) != tests.npos; ++at) ++n_interrupted;
  EXPECT_EQ(4 * 30 - n_interrupted, n_finished);
  EXPECT_GE(n_interrupted, 1);
  EXPECT_TRUE(fs::exists(out() + "/fits.csv"));
}

TEST_F(Cli, AnEnvelopeOfAnotherRecipeIsNotMixedIn) {
  const auto recipe = [&](int n) {
    return write("r.toml",
                 fmt::format("[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = {}\n"
                             "[test]\nintact = true\nplaten_speed = \"0.2 m/s\"\n",
                             n));
  };
  const std::string rest = " --confining \"0 MPa,5 MPa,10 MPa\" --out " + out();
  ASSERT_EQ(run("envelope " + recipe(330) + rest), 0) << output;
  EXPECT_EQ(run("envelope " + recipe(331) + rest), 2);
  EXPECT_THAT(output, HasSubstr("packing.n_grains = 330: expected 331"));
  EXPECT_EQ(run("envelope " + recipe(330) + rest), 0) << output;
}

TEST_F(Cli, APackingWithoutContactsIsTold) {
  const auto specimen = [&](const char* porosity) {
    return run("specimen " + write("r.toml", std::string("[specimen]\nwidth = \"10 mm\"\nheight = \"20 mm\"\n"
                                                         "[packing]\nradius_min = \"0.3 mm\"\nradius_max = "
                                                         "\"0.5 mm\"\nporosity = ") +
                                                 porosity + "\n"));
  };
  ASSERT_EQ(specimen("0.2"), 0) << output;
  EXPECT_THAT(output, HasSubstr("LOOSE: the discs do not press on each other at this porosity"));
  ASSERT_EQ(specimen("0.16"), 0) << output;
  EXPECT_THAT(output, testing::Not(HasSubstr("LOOSE")));
}

TEST_F(Cli, RecipeExplainsKeysAndFindsNearOnes) {
  EXPECT_EQ(run("recipe --explain poro"), 0);
  EXPECT_THAT(output, HasSubstr("packing.porosity"));
  EXPECT_EQ(run("recipe --explain rgap"), 2);
  EXPECT_THAT(output, HasSubstr("it has no key"));
  EXPECT_EQ(run("recipe --explain zone_thickness"), 0);
  EXPECT_THAT(output, HasSubstr("0.6 mm"));
  EXPECT_EQ(run("recipe --explain zone_thicknes"), 2);
  EXPECT_THAT(output, HasSubstr("did you mean"));
  EXPECT_EQ(run("recipe --template > " + (folder / "t.toml").string()), 0);
  EXPECT_EQ(run("recipe " + (folder / "t.toml").string()), 0);
}

TEST_F(Cli, ContactShowsALawBesideItsClosedForm) {
  ASSERT_EQ(run("contact"), 0);
  EXPECT_THAT(output, HasSubstr("sj_da"));
  const std::string path = write("path.csv", "closure [m],slide [m],rotation [rad]\n1e-6,0,0\n1e-6,8e-6,0\n");
  ASSERT_EQ(
      run("contact linear --set mu=0.5 --set \"k_n=40e9 N/m\" --steps 4 --path " + path + " --out " + out()),
      0)
      << output;
  std::ifstream in(out());
  std::string line, last;
  while (std::getline(in, line)) last = line;
  EXPECT_THAT(last, HasSubstr(",40000,-20000,0,40000,-20000,0,"));  // mu k_n closure, stepped and exact
  EXPECT_EQ(run("contact rubber"), 2);
  EXPECT_THAT(output, HasSubstr("smooth_joint"));
  EXPECT_EQ(run("contact linear --set k_n=5 --to \"1, 2 um\""), 2);
  EXPECT_THAT(output, HasSubstr("--set k_n = 5: expected 1000 to 1e+15 N/m"));
  EXPECT_THAT(output, HasSubstr("1 has no unit"));
  EXPECT_EQ(run("contact flat_joint --set elements=2.5"), 2);
  EXPECT_THAT(output, HasSubstr("--set elements = 2.5: expected a whole number, 1 to 4"));
  EXPECT_EQ(run("contact dashpot --set mode=0.5"), 2);
  EXPECT_EQ(run("contact flat_joint --set elements=2 --out " + out()), 0) << output;
  write("bad.csv", "closure [m],slide [m],rotation [rad]\n1e-6;0;0\n");
  EXPECT_EQ(run("contact linear --path " + (folder / "bad.csv").string()), 2);
  EXPECT_THAT(output, HasSubstr("bad.csv:2"));
}

TEST_F(Cli, ExamplesAreValid) {
  const std::string paper = std::string(PHY_SOURCE_DIR) + "/examples/paper/";
  for (const char* name : {"press", "press-crossing", "press-area"})
    EXPECT_EQ(run("recipe " + paper + name + ".toml"), 0) << output;
  for (const char* name : {"elastic", "elastic-crossing", "elastic-area", "elastic-area-crossing", "study"})
    EXPECT_EQ(run("study " + paper + name + ".toml --dry-run --out " + out()), 0) << output;
  EXPECT_EQ(run("elastic " + paper + "elastic.toml"), 2);
  EXPECT_THAT(output, HasSubstr("elastic.toml is a study, not a recipe. To run it: phyllite study "));
}

TEST_F(Cli, ElasticPrintsModuliFitsAndSensitivities) {
  ASSERT_EQ(run("elastic " + small_recipe()), 0) << output;
  for (const char* part : {"theta = 45 deg", "intact", "sum(A)/L", "bridges", "bedding[0].k_n", "K_s"})
    EXPECT_THAT(output, HasSubstr(part));
  EXPECT_THAT(output, HasSubstr("no fit: 2 distinct angle(s)"));
  EXPECT_EQ(output.find(" nan"), output.npos);
}

TEST_F(Cli, ElasticComparesWithThePress) {
  ASSERT_EQ(run("elastic --press " + small_recipe()), 0) << output;
  EXPECT_THAT(output, HasSubstr("held: nothing breaks and nothing slips"));
}

TEST_F(Cli, SpecimenExportsAndImportsTheSamePacking) {
  ASSERT_EQ(run("specimen " + small_recipe() + " --out " + out()), 0) << output;
  ASSERT_TRUE(fs::exists(fs::path(out()) / "discs.csv"));
  const std::string imported =
      write("imported.toml", "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nfile = \"" +
                                 out() + "/discs.csv\"\n");
  EXPECT_EQ(run("specimen " + imported), 0) << output;
  EXPECT_THAT(output, HasSubstr("330 discs"));
}

TEST_F(Cli, DiscsOfASpecimenAreThoseThatItsContactsNumber) {
  ASSERT_EQ(run("specimen " + small_recipe("kind = \"brazilian\"\n") + " --out " + out()), 0) << output;
  const std::string discs = read(out() + "/discs.csv");
  std::istringstream contacts(read(out() + "/contacts_intact.csv"));
  std::size_t most = 0;
  std::string line;
  std::getline(contacts, line);
  while (std::getline(contacts, line))
    most = std::max<std::size_t>(most, std::stoul(line.substr(line.find(',') + 1)));
  EXPECT_EQ(most + 3, static_cast<std::size_t>(std::count(discs.begin(), discs.end(), '\n')))
      << "two lines of heads";
}

}  // namespace
