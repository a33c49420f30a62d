// A text of the user stays a text in every language that the program writes: Python, PFC, gnuplot, sh, HTML,
// CSV, TOML, and on the terminal. The languages themselves are asked, with texts that want to be more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <fstream>

#include "../program.hpp"
#include "base/quote.hpp"
#include "report/calibration_files.hpp"
#include "report/pfc_commands.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// In one language or another each part makes a file of the name `marker`.
const std::string attack =
    "ü'; system('touch marker') #\"; system(\"touch marker\") # `touch marker` $(touch marker) ''' \"\"\" "
    "@marker {/:Bold b}_^~& \\101 \\ </script><img src=x><!-- <b> ;|touch marker";

class Attack : public ProgramTest {
 protected:
  void TearDown() override {
    EXPECT_FALSE(fs::exists(folder / "marker")) << "a text was run";
    ProgramTest::TearDown();
  }
  /// In the folder where the marker would appear.
  int here(const std::string& line) { return run_line("cd " + folder.string() + " && " + line); }
  int phyllite(const std::string& line) { return here(PHY_PROGRAM " " + line); }
  std::string named_recipe(const std::string& more = "") const {
    return write("named.toml",
                 "name = " + phy::toml_string(attack) + "\n" + more +
                     "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = "
                     "330\n[[bedding]]\nspacing = \"2 mm\"\n[test]\nplaten_speed = \"0.2 m/s\"\n"
                     "angles = [\"0 deg\", \"45 deg\", \"90 deg\"]\nmax_strain = 0.03\n");
  }
  /// Every text that a picture shows.
  std::string texts_of(const std::string& svg) {
    const std::string script = write("svg.py",
                                     "import sys, xml.etree.ElementTree as t\n"
                                     "for e in t.parse(sys.argv[1]).iter():\n"
                                     "    if e.tag.endswith('}text'): print(''.join(e.itertext()))\n");
    EXPECT_EQ(here("python3 " + script + " " + svg), 0) << output;
    return output;
  }
};

struct Odd {
  const char* name;
  const char* file;  ///< its ending says what reads it
  std::string text;
  const char* says;
};
void PrintTo(const Odd& o, std::ostream* out) { *out << o.name; }

class OddText : public Attack, public testing::WithParamInterface<Odd> {};

TEST_P(OddText, IsRefusedWithFileLineAndKey) {
  write("table.csv", "theta [deg],E [GPa]\n0,20\n45,22\n90,30\n");
  small_recipe();
  const Odd& odd = GetParam();
  write(odd.file, odd.text);
  const std::string verb = std::string(odd.file).starts_with("study") ? "study --dry-run study.toml"
                           : std::string(odd.file) == "recipe.toml"   ? "recipe recipe.toml"
                                                                      : "rock check rock.toml";
  if (odd.file == std::string("odd.csv")) write("rock.toml", "data = \"odd.csv\"\n");
  ASSERT_EQ(phyllite(verb), 2) << output;
  EXPECT_THAT(output, HasSubstr(odd.says));
  EXPECT_THAT(output, AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\nimport"))));
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << "one problem: " << output;
}

INSTANTIATE_TEST_SUITE_P(
    Each, OddText,
    testing::Values(
        Odd{"recipe", "recipe.toml", "name = \"a\\nimport os\"\n",
            "recipe.toml:1: name = \"a\\u000aimport os\""},
        Odd{"lines", "recipe.toml", "\nname = \"\"\"a\nimport os\"\"\"\n", "recipe.toml:2: name"},
        Odd{"packing_file", "recipe.toml", "[packing]\nfile = \"a\\u001b[2J\"\n",
            "recipe.toml:2: packing.file"},
        Odd{"rock", "rock.toml", "data = \"table.csv\"\nname = \"a\\nimport os\"\n", "rock.toml:2: name"},
        Odd{"eighth_bit", "rock.toml", "data = \"table.csv\"\nname = \"a\\u009b2J\"\n", "rock.toml:2: name"},
        Odd{"study", "study.toml",
            "recipe = \"small.toml\"\nname = \"a\\tb\"\n[[vary]]\nkey = \"matrix.mu\"\ntimes "
            "= [1, 2]\n",
            "study.toml:2: name"},
        Odd{"latin_1", "recipe.toml", "# M\xFCller\nname = \"a\"\n", "recipe.toml:1: expected text in UTF-8"},
        Odd{"header", "odd.csv", "theta [deg],E [GPa],\x1b]0;x\a\n0,20,\n45,22,\n90,30,\n",
            "odd.csv:1: expected text in UTF-8 without control characters"},
        Odd{"cell", "odd.csv", "theta [deg],E [GPa],who\n0,20,M\xFCller\n45,22,\n90,30,\n",
            "odd.csv:2: byte 0xFC, \"ü\" in Latin-1: expected text in UTF-8"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST_F(Attack, NamesOfFilesThatAreNoNamesAreNotTaken) {
  write("table.csv", "theta [deg],E [GPa]\n0,20\n45,22\n90,30\n");
  write("a\nimport os.toml", "data = \"table.csv\"\n");
  ASSERT_EQ(phyllite("rock check 'a\nimport os.toml'"), 2);
  EXPECT_THAT(output, HasSubstr("expected a name in UTF-8 without control characters"));
}

TEST_F(Attack, NamesInEveryAlphabetStay) {
  write("r.toml", "name = \"Schiefer Müller, θ = 30°, 片岩\"\n");
  ASSERT_EQ(phyllite("recipe r.toml"), 0) << output;
  EXPECT_THAT(output, HasSubstr("name = \"Schiefer Müller, θ = 30°, 片岩\"\n"));
}

// What Python takes an encoding from, utf-7 and unicode_escape, would make line breaks of harmless letters.
TEST_F(Attack, PythonAndPfcSeeAComment) {
  if (!has("python3")) GTEST_SKIP() << "no python3 here";
  fs::create_directories(folder / "yade");
  write("yade/__init__.py", "utils = None\n");
  write("run.py",
        "import builtins, sys\n"
        "class O: materials = []\n"
        "builtins.O, builtins.JCFpmMat, builtins.Vector3 = O, lambda **k: k, lambda *a: a\n"
        "exec(compile(open(sys.argv[1], 'rb').read(), 'script', 'exec'), {})\n"
        "assert len(O.materials) == 1\n");
  const std::string run = "import os; os.system('touch marker')";
  for (const std::string& name :
       {attack, "a\n" + run + "\n#", "a\r" + run + "\r#", "coding: utf-7 +AAo-" + run + "+AAo-#",
        "coding: unicode_escape \\x0a" + run + "\\x0a#", std::string("coding: latin-1 \xFC")}) {
    phy::Recipe recipe;
    recipe.name = name;
    recipe.bedding.resize(1);
    write("script.py", phy::report::yade_script(recipe));
    EXPECT_EQ(here("python3 run.py script.py"), 0) << output;
    EXPECT_THAT(read(at("script.py")), HasSubstr("\n# " + phy::comment_text(name) + " - written by"));
    const std::string pfc = phy::report::pfc_commands(recipe);
    EXPECT_TRUE(pfc.starts_with("; " + phy::comment_text(name) + " - written by")) << pfc.substr(0, 200);
  }
}

TEST_F(Attack, ACalibrationOfAnyNameIsOneOfThatName) {
  named_recipe();
  write("table.csv", "theta [deg],E [GPa]\n0,17.5\n45,18\n90,48\n");
  write("rock.toml",
        "name = " + phy::toml_string(attack) + "\ndata = \"table.csv\"\nrecipe = \"named.toml\"\n");
  ASSERT_THAT(phyllite("calibrate rock.toml --elastic --threads 2 --out out"), testing::AnyOf(0, 1))
      << output;
  EXPECT_THAT(output, HasSubstr(attack));
  ASSERT_EQ(phyllite("recipe out/calibrated.toml"), 0) << output;
  EXPECT_THAT(output, HasSubstr(phy::toml_string(
                          attack + ", moduli calibrated, strengths given (not decided by the table)")));
  if (!has("python3")) GTEST_SKIP() << "no python3 here";
  EXPECT_EQ(here("python3 -m py_compile out/calibrated-yade.py"), 0) << output;
}

TEST_F(Attack, GnuplotShowsHeadersAndCellsOfATable) {
  if (!has("gnuplot") || !has("python3")) GTEST_SKIP() << "no gnuplot or python3 here";
  fs::create_directories(folder / "foreign");
  named_recipe();
  fs::copy(at("named.toml"), folder / "foreign/recipe.toml");
  const std::string key = "a.b'`touch${IFS}marker`\"@x{_^";
  std::string table = "point,packing,bond_seed,theta [deg],intact," + phy::csv_cell(key + " [Pa]") +
                      ",E_tangent [Pa],ucs [Pa],status\n";
  const std::string quotes = "''';system('touch marker');#''";
  for (const std::string& cell : {std::string("1"), attack, quotes})
    for (const int theta : {0, 45, 90})
      table += "0,1,1," + std::to_string(theta) + ",0," + phy::csv_cell(cell) + ",2e10,1e8,peaked\n";
  write("foreign/results.csv", table);
  for (const char* kind : {"modulus", "strength"}) {
    ASSERT_EQ(phyllite(std::string("figure foreign --kind ") + kind + " --out a.svg"), 0) << output;
    EXPECT_THAT(texts_of("a.svg"), AllOf(HasSubstr(key), HasSubstr(attack), HasSubstr(quotes))) << kind;
  }
}

TEST_F(Attack, RegressionsOfAnySourceAreDrawnAndRead) {
  if (!has("gnuplot") || !has("python3")) GTEST_SKIP() << "no gnuplot or python3 here";
  named_recipe();
  write("lines.toml", "[[line]]\nsource = " + phy::toml_string(attack) +
                          "\nnumber = \"K_n\"\nkey = \"bedding.k_n\"\nslope = 2\nintercept = \"1 GPa/m\"\n");
  write("study.toml",
        "recipe = \"named.toml\"\nsolver = \"direct\"\nregressions = \"lines.toml\"\n[[vary]]\nkey = "
        "\"bedding.k_n\"\ntimes = [0.5, 1, 2]\n");
  ASSERT_EQ(phyllite("study study.toml --out out"), 0) << output;
  ASSERT_EQ(phyllite("figure out --kind stiffness --out a.svg"), 0) << output;
  EXPECT_THAT(texts_of("a.svg"), HasSubstr(attack));
  const std::string script =
      write("read.py",
            "import csv\n"
            "rows = list(csv.reader(open('out/effects.csv', newline='')))\n"
            "assert all(len(r) == len(rows[0]) for r in rows)\n"
            "assert 'slope over that of ' + open('attack').read() in {r[3] for r in rows}\n");
  write("attack", attack);
  EXPECT_EQ(here("python3 " + script), 0) << output;
}

TEST_F(Attack, APlaceForAPictureIsAPlace) {
  named_recipe("");
  ASSERT_EQ(phyllite("run named.toml --out out"), 0) << output;
  if (has("gnuplot")) {
    ASSERT_EQ(phyllite("figure out --kind rose --out '|touch marker; echo it'\\''s `touch marker`/a.svg'"), 0)
        << output;
    EXPECT_TRUE(fs::exists(folder / "|touch marker; echo it's `touch marker`/a.svg"));
    EXPECT_EQ(phyllite("figure out --kind rose --out 'a\nb.svg'"), 2) << output;
  }
  if (has("ffmpeg")) {
    ASSERT_EQ(phyllite("film out --seconds 0.5 --width 320 --out concat:a/film.gif"), 0) << output;
    EXPECT_TRUE(fs::exists(folder / "concat:a/film.gif"));
  }
}

TEST_F(Attack, AReportIsOneScriptOfData) {
  if (!has("python3")) GTEST_SKIP() << "no python3 here";
  named_recipe("");
  ASSERT_EQ(phyllite("run named.toml --out out"), 0) << output;
  write("attack", attack);
  write("page.py",
        "import html.parser, json\n"
        "class Page(html.parser.HTMLParser):\n"
        "    data, tags, inside = '', [], False\n"
        "    def handle_starttag(self, tag, attributes):\n"
        "        self.tags.append(tag)\n"
        "        self.inside = ('id', 'report-data') in attributes\n"
        "    def handle_endtag(self, tag): self.inside = False\n"
        "    def handle_data(self, text):\n"
        "        if self.inside: self.data += text\n"
        "page = Page()\n"
        "page.feed(open('out/report.html', encoding='utf-8').read())\n"
        "assert 'img' not in page.tags\n"
        "assert json.loads(page.data)['name'] == open('attack', encoding='utf-8').read()\n");
  EXPECT_EQ(here("python3 page.py"), 0) << output;
}

TEST_F(Attack, TheJobScriptRunsTheStudyOfThatName) {
  if (!has("bash")) GTEST_SKIP() << "no bash here";
  small_recipe();
  const std::string name = "s $(touch marker) `touch marker`\"; touch marker; it's --wrap=touch.toml";
  write(name, "recipe = \"small.toml\"\n[[vary]]\nkey = \"matrix.mu\"\ntimes = [1, 2]\n");
  ASSERT_EQ(phyllite("study " + phy::sh_word(name) + " --slurm 2 --out " + phy::sh_word("o $(touch marker)")),
            0)
      << output;
  write("job.sh", output);
  EXPECT_THAT(output, testing::ContainsRegex("#SBATCH --job-name=[A-Za-z0-9_.-]+\n"));
  fs::create_directories(folder / "bin");
  write("bin/phyllite", "#!/bin/sh\nfor word in \"$@\"; do printf '%s\\n' \"$word\"; done\n");
  fs::permissions(folder / "bin/phyllite", fs::perms::owner_all);
  EXPECT_EQ(here("bash -n job.sh"), 0) << output;
  ASSERT_EQ(here("SLURM_CPUS_PER_TASK=3 SLURM_ARRAY_TASK_ID=1 PATH=\"$PWD/bin:$PATH\" bash job.sh"), 0)
      << output;
  EXPECT_EQ(output, "--threads\n3\nstudy\n" + name + "\n--out\no $(touch marker)\n--shard\n1/2\n");
  // The command in the comment is meant to be copied.
  const std::string script = read(at("job.sh")), from = "done: ";
  const std::size_t at_command = script.find(from) + from.size();
  ASSERT_EQ(here("PATH=\"$PWD/bin:$PATH\"; " +
                 script.substr(at_command, script.find('\n', at_command) - at_command)),
            0);
  EXPECT_EQ(output, "study\nmerge\no $(touch marker)\n");
}

// What a folder of somebody else holds in the place of files. `timeout` ends with 124 what waits, and
// `ulimit` what eats.
class NoFile : public Attack, public testing::WithParamInterface<const char*> {
 protected:
  void make(const std::string& name) const {
    fs::remove_all(at(name));
    if (GetParam() == std::string("pipe")) {
      ASSERT_EQ(::mkfifo(at(name).c_str(), 0600), 0);
    }
    if (GetParam() == std::string("device")) fs::create_symlink("/dev/zero", at(name));
    if (GetParam() == std::string("folder")) fs::create_directory(at(name));
    if (GetParam() == std::string("large")) fs::resize_file(write(name, "x"), std::uintmax_t{6} << 30U);
  }
  int limited(const std::string& line) {
    return here("ulimit -v 3000000; timeout -s KILL 60 " PHY_PROGRAM " " + line);
  }
  /// Refused with the name of the file and what it is.
  void expect_refused(const std::string& line, const std::string& file) {
    EXPECT_THAT(limited(line), testing::AnyOf(2, 3)) << line << "\n" << output;
    EXPECT_THAT(output, AllOf(HasSubstr(file), HasSubstr(says()))) << line;
  }
  static std::string says() {
    const std::string kind = GetParam();
    return kind == "pipe"     ? "it is a named pipe, not a file"
           : kind == "device" ? "it is a device, not a file"
           : kind == "folder" ? "name a file, not a folder"
                              : "it has 6144 MB";
  }
};

TEST_P(NoFile, IsRefusedWhereverAFileIsRead) {
  small_recipe();
  write("study.toml", "recipe = \"small.toml\"\n[[vary]]\nkey = \"matrix.mu\"\ntimes = [1, 2]\n");
  write("rock.toml", "data = \"odd.csv\"\n");
  write("model.toml", "data = \"table.csv\"\nrecipe = \"odd.toml\"\n");
  write("table.csv", "theta [deg],E [GPa]\n0,20\n45,22\n90,30\n");
  write("discs.toml", "[packing]\nfile = \"odd.csv\"\n");
  write("list.toml", "recipe = \"small.toml\"\ndesign = \"list\"\nfile = \"odd.csv\"\n");
  for (const char* name : {"odd.toml", "odd.csv"}) make(name);
  for (const char* line :
       {"recipe odd.toml", "run odd.toml --out out", "rock check odd.toml", "study odd.toml",
        "calibrate odd.toml --out out", "specimen odd.toml", "rock check model.toml"})
    expect_refused(line, "odd.toml");
  for (const char* line : {"rock check rock.toml", "specimen discs.toml", "study list.toml --dry-run"})
    expect_refused(line, "odd.csv");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_P(NoFile, IsRefusedInsideAResultAStudyAndACalibration) {
  ASSERT_EQ(phyllite("run " + small_recipe() + " --out out"), 0) << output;
  for (const char* name : {"result.json", "history.csv", "cracks.csv", "scene.bin"}) {
    fs::remove_all(at("other"));
    fs::copy(at("out/intact"), at("other"));
    make(std::string("other/") + name);
    for (const char* verb : {"show", "report"}) expect_refused(std::string(verb) + " other", name);
  }
  write("study.toml",
        "recipe = \"small.toml\"\nsolver = \"direct\"\n[[vary]]\nkey = \"matrix.mu\"\ntimes = [1, 2]\n");
  ASSERT_EQ(phyllite("study study.toml --out s"), 0) << output;
  if (GetParam() != std::string("large"))  // a database may be
    for (const char* name : {"s/study.sqlite-wal", "s/study.sqlite"}) {
      make(name);
      expect_refused("study status s", name);
      fs::remove_all(at(name));
    }
  fs::create_directory(at("c"));
  make("c/calibration.json");
  expect_refused("report c", "calibration.json");
}

TEST_P(NoFile, InTheCacheIsMadeAnew) {
  small_recipe();
  ASSERT_EQ(phyllite("specimen small.toml"), 0) << output;
  const std::string entry =
      "cache/phyllite/" + fs::directory_iterator(at("cache/phyllite"))->path().filename().string();
  make(entry);
  ASSERT_EQ(limited("specimen small.toml"), 0) << output;
  const bool kept = fs::is_regular_file(fs::symlink_status(at(entry)));
  EXPECT_EQ(kept, GetParam() != std::string("folder"));
  if (!kept) {
    EXPECT_THAT(output, AllOf(HasSubstr("not kept for the next run"),
                              HasSubstr(fs::path(entry).filename().string())));
  }
}

INSTANTIATE_TEST_SUITE_P(Each, NoFile, testing::Values("pipe", "device", "folder", "large"),
                         [](const auto& one) { return std::string(one.param); });

// A reader that is large on the stack ends a program in a batch system that gives it little.
TEST_F(Attack, AStackOfFewKilobytesIsEnough) {
  small_recipe();
  write("table.csv", "theta [deg],E [GPa]\n0,20\n45,22\n90,30\n");
  write("rock.toml", "data = \"table.csv\"\n");
  for (const char* line :
       {"recipe small.toml", "rock check rock.toml", "run small.toml --threads 1 --out out", "show out"})
    EXPECT_EQ(here("ulimit -s 64; " PHY_PROGRAM " " + std::string(line)), 0) << line << "\n" << output;
}

TEST_F(Attack, WhatIsDamagedIsToldWithoutNumbersOfALibrary) {
  ASSERT_EQ(phyllite("run " + small_recipe() + " --out out"), 0) << output;
  fs::remove(at("out/intact/.written-by-phyllite"));
  fs::create_directory(at("c"));
  const std::string whole = read(at("out/intact/result.json"));
  for (const std::string& text :
       {whole.substr(0, whole.size() / 2), std::string("{\"format\": 1}"),
        std::string("{\"format\": 1, \"rock\": 3, \"recipe\": 3, \"program\": 3}")}) {
    write("out/intact/result.json", text), write("c/calibration.json", text);
    EXPECT_EQ(phyllite("show out/intact"), 2);
    EXPECT_THAT(output, AllOf(HasSubstr("expected a result of format 1; "), Not(HasSubstr("exception"))));
    EXPECT_EQ(phyllite("report c"), 2);
    EXPECT_THAT(output,
                AllOf(HasSubstr("expected a calibration of format 2; "), Not(HasSubstr("exception"))));
  }
}

// Nothing is begun yet that would have to be kept.
TEST_F(Attack, AReadingEndsWithTheSignal) {
  std::string rows = "theta [deg],E [GPa]\n";
  while (rows.size() < 15'000'000) rows += "0,20\n45,22\n90,30\n";
  write("table.csv", rows);
  const pid_t child = start({"calibrate", write("rock.toml", "data = \"table.csv\"\n"), "--out", out()});
  ::usleep(50'000);  // a reading of 15 MB takes ten times as long
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, WNOHANG), 0) << "read before it could be stopped";
  const auto begin = std::chrono::steady_clock::now();
  ::kill(child, SIGTERM);
  while (::waitpid(child, &status, WNOHANG) == 0 &&
         std::chrono::steady_clock::now() - begin < std::chrono::seconds(20))
    ::usleep(10'000);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
  EXPECT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_FALSE(fs::exists(out()));
  ::kill(child, SIGKILL);
}

TEST_F(Attack, TheTerminalObeysNoResult) {
  ASSERT_EQ(phyllite("run " + small_recipe() + " --out out"), 0) << output;
  const std::string file = at("out/intact/result.json"), whole = read(file);
  fs::remove(at("out/intact/.written-by-phyllite"));  // a result of somebody else
  for (const char* key :
       {"\"reason\": \"", "\"unit\": \"", "\"definition\": \"", "\"specimen\": \"", "\"program\": \""}) {
    std::string changed = whole;
    changed.insert(changed.find(key) + std::string(key).size(), "\\u001b]0;stolen\\u0007\\u009b2J");
    write("out/intact/result.json", changed);
    for (const char* verb :
         {"show out", "show out/intact", "report out", "report out/intact --out page.html"}) {
      EXPECT_NE(phyllite(verb), 4) << output;
      EXPECT_THAT(output, AllOf(HasSubstr("expected text without control characters"), Not(HasSubstr("\x1b")),
                                Not(HasSubstr("\xC2\x9B"))))
          << key << verb;
    }
  }
  EXPECT_EQ(phyllite("show \"$(printf '\\033[31mred')\""), 3);
  EXPECT_THAT(output, AllOf(HasSubstr("\\x1b[31mred"), Not(HasSubstr("\x1b"))));
}

}  // namespace
