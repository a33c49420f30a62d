// What the program did not write it does not replace, whatever verb names the place, and it says so before it
// works. What it did write it writes anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class OwnFiles : public ProgramTest {
 protected:
  int here(const std::string& line) {
    return run_line("cd " + folder.string() + " && " PHY_PROGRAM " --threads 2 " + line);
  }
  std::string tiny(const std::string& more = "") const {
    return write(
        "tiny.toml",
        "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[[bedding]]\nspacing = "
        "\"2 mm\"\n[test]\nangles = [\"0 deg\", \"45 deg\", \"90 deg\"]\nplaten_speed = \"0.2 m/s\"\n"
        "max_strain = 0.03\n" +
            more);
  }
  std::string study() const {
    tiny();
    return write("study.toml", "recipe = \"tiny.toml\"\n[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1]\n");
  }
  /// A file of the user, once as a file and once as a link to one, is told and stays; nothing else appears.
  void keeps(const std::string& line, const std::string& file, const std::string& says = "") {
    const fs::path place = folder / file;
    const bool was_there = fs::exists(place);
    const std::string before = was_there ? read(place) : "";
    fs::create_directories(place.parent_path());
    for (const bool link : {false, true}) {
      fs::remove(place);
      write("mine", "ten years of work\n");
      link ? fs::create_symlink(folder / "mine", place) : fs::copy(folder / "mine", place);
      const std::set<std::string> entries = all();
      EXPECT_EQ(here(line), 2) << line << "\n" << output;
      EXPECT_THAT(output, AllOf(HasSubstr(file), HasSubstr(says.empty() ? "as this program left it" : says)));
      EXPECT_EQ(read(place), "ten years of work\n") << line;
      EXPECT_EQ(fs::is_symlink(place), link) << line;
      EXPECT_EQ(read(folder / "mine"), "ten years of work\n") << line;
      EXPECT_EQ(all(), entries) << line;
    }
    fs::remove(place);
    if (was_there) write(file, before);
  }
  std::set<std::string> all() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().string().find("/cache") == std::string::npos) names.insert(entry.path().string());
    return names;
  }
};

TEST_F(OwnFiles, OfARunAndItsPictures) {
  tiny();
  keeps("run tiny.toml --out out", "out/report.html");
  fs::remove_all(out());
  ASSERT_EQ(here("run tiny.toml --out out"), 0) << output;
  keeps("run tiny.toml --out out", "out/report.html");
  ASSERT_EQ(here("run tiny.toml --out out"), 0) << "its own page, left as it was: " << output;
  keeps("report out", "out/report.html");
  keeps("report out --out page.html", "page.html");
  for (const char* line : {"report out", "report out --out page.html", "report out --out page.html"})
    EXPECT_EQ(here(line), 0) << output;
  if (has("gnuplot")) {
    keeps("figure out --kind rose", "rose.svg");
    keeps("figure out --kind rose --out a/b.png", "a/b.png");
    for (const char* kind : {"rose", "cracks"})
      EXPECT_EQ(here(std::string("figure out --out picture.svg --kind ") + kind), 0) << output;
  }
  if (has("ffmpeg")) {
    keeps("film out --seconds 0.5 --width 320", "film.webm");
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(here("film out --seconds 0.5 --width 320 --out a.gif"), 0) << output;
  }
}

TEST_F(OwnFiles, AreThoseThatNobodyHasChanged) {
  tiny();
  ASSERT_EQ(here("run tiny.toml --out out"), 0) << output;
  write("out/report.html", read(out() + "/report.html") + "<!-- my notes -->");
  EXPECT_EQ(here("run tiny.toml --out out"), 2);
  EXPECT_THAT(read(out() + "/report.html"), HasSubstr("my notes"));
  fs::remove(out() + "/report.html");
  for (const char* name : {"notes.txt", "history.csv", "snapshots/notes.txt"}) {
    const std::string file = out() + "/theta_45_deg/" + name, before = read(file);
    write("out/theta_45_deg/" + std::string(name), "my notes");
    for (const char* line : {"run tiny.toml --out out", "run other.toml --replace --out out"}) {
      write("other.toml", read(tiny()) + "stop_at = 0.4\n");
      EXPECT_EQ(here(line), 3) << output;
      EXPECT_THAT(output, AllOf(HasSubstr("theta_45_deg/" + std::string(name)), HasSubstr("move it away")));
      EXPECT_EQ(read(file), "my notes");
      EXPECT_FALSE(fs::exists(out() + "/report.html")) << "nothing was run";
    }
    before.empty() ? void(fs::remove(file)) : void(write("out/theta_45_deg/" + std::string(name), before));
  }
  EXPECT_EQ(here("run tiny.toml --out out"), 0) << output;
}

TEST_F(OwnFiles, OfAStudy) {
  study();
  write("tiny.toml", "name = \"mine\"\n" + read(at("tiny.toml")));
  const std::string mine = read(at("study.toml"));
  EXPECT_EQ(here("study study.toml --out ."), 2) << output;
  EXPECT_THAT(output, AllOf(HasSubstr("study.toml"), HasSubstr("than those that are read")));
  EXPECT_EQ(read(at("study.toml")), mine);
  EXPECT_FALSE(fs::exists(at("study.sqlite")));
  for (const char* name :
       {"study.toml", "recipe.toml", "results.csv", "responses.csv", "effects.csv", "report.html"})
    keeps("study study.toml --out new", std::string("new/") + name);
  ASSERT_EQ(here("study study.toml --out out"), 0) << output;
  for (const char* verb : {"study resume out", "study merge out out/study.sqlite"})
    keeps(verb, "out/results.csv", "left it; move it away\n");
  keeps("study effects out", "out/effects.csv");
  keeps("study effects out --out other", "other/responses.csv");
  keeps("study export out --csv table.csv", "table.csv");
  EXPECT_EQ(here("study export out --csv out/study.toml"), 2) << "an input, though the program wrote it";
  for (const char* line :
       {"study study.toml --out out", "study out/study.toml --out out", "study resume out",
        "study effects out", "study effects out --out other", "study effects out --out other",
        "study export out --csv table.csv", "study export out --csv table.csv", "report out"})
    EXPECT_EQ(here(line), 0) << line << "\n" << output;
}

TEST_F(OwnFiles, OfACalibration) {
  tiny();
  write("table.csv", "theta [deg],E [GPa]\n0,17.5\n45,18\n90,48\n");
  write("rock.toml", "data = \"table.csv\"\nrecipe = \"tiny.toml\"\n");
  for (const char* name : {"request.toml", "calibrated.toml", "calibrated.p2dat", "calibrated-yade.py",
                           "calibration.json", "tables.txt", "report.html", "ensemble/07.toml"})
    keeps("calibrate rock.toml --elastic --out new", std::string("new/") + name);
  ASSERT_THAT(here("calibrate rock.toml --elastic --out out"), testing::AnyOf(0, 1)) << output;
  EXPECT_THAT(here("calibrate rock.toml --elastic --resume --out out"), testing::AnyOf(0, 1)) << output;
}

TEST_F(OwnFiles, OfTheOtherVerbs) {
  tiny();
  keeps("envelope tiny.toml --confining '0 MPa,1 MPa,2 MPa' --out new", "new/fits.csv");
  keeps("contact linear --out path.csv", "path.csv");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(here("contact linear --out path.csv"), 0) << output;
  for (const char* name : {"discs.csv", "contacts_theta_45_deg.csv"})
    keeps("specimen tiny.toml --out discs", std::string("discs/") + name);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(here("specimen tiny.toml --out discs"), 0) << output;
}

// By whatever name: a link of either kind is the file.
TEST_F(OwnFiles, AnInputIsNoOutput) {
  tiny();
  ASSERT_EQ(here("specimen tiny.toml --out discs"), 0) << output;
  write("imported.toml",
        "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nfile = \"discs/discs.csv\"\n");
  const std::string discs = read(at("discs/discs.csv"));
  EXPECT_EQ(here("specimen imported.toml --out discs"), 2);
  EXPECT_THAT(output, AllOf(HasSubstr("discs.csv"), HasSubstr("than those that are read")));
  EXPECT_EQ(read(at("discs/discs.csv")), discs);
  ASSERT_EQ(here("run tiny.toml --out out"), 0) << output;
  fs::create_hard_link(folder / "out/theta_45_deg/result.json", folder / "hard.html");
  fs::create_symlink(folder / "out/theta_45_deg/result.json", folder / "soft.html");
  for (const char* name : {"hard.html", "soft.html"}) {
    EXPECT_EQ(here(std::string("report out --out ") + name), 2) << name;
    EXPECT_THAT(output, HasSubstr("than those that are read")) << name;
  }
  // No page takes the place of a result, whose it may be.
  for (const char* name : {"out/../out/theta_45_deg/result.json", "calibrated.toml"}) {
    EXPECT_EQ(here(std::string("report out --out ") + name), 2) << name;
    EXPECT_THAT(output, HasSubstr("a name that ends in .html, .htm")) << name;
  }
  EXPECT_EQ(here("show out"), 0) << output;
}

TEST_F(OwnFiles, SomebodyElsesDatabaseIsNotChanged) {
  if (!has("python3")) GTEST_SKIP() << "no python3 here";
  study();
  fs::create_directories(folder / "out");
  const std::string make = "python3 -c \"import sqlite3; d = sqlite3.connect('" + at("out/study.sqlite") +
                           "'); d.execute('CREATE TABLE mine (x)'); d.commit()\"";
  ASSERT_EQ(run_line(make), 0) << output;
  const std::string before = read(at("out/study.sqlite"));
  EXPECT_EQ(here("study study.toml --out out"), 3);
  EXPECT_THAT(output, HasSubstr("is no store of phyllite"));
  EXPECT_TRUE(read(at("out/study.sqlite")) == before);
  EXPECT_FALSE(fs::exists(at("out/study.toml")));
}

}  // namespace
