// Outputs that cannot be written and signals that ask for an end: what is finished is kept, whatever happens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const char* const many_discs =
    "[packing]\nn_grains = 0\nporosity = 0.16\n[specimen]\nwidth = \"152 mm\"\nheight = \"304 mm\"\n";

class Outputs : public ProgramTest {
 protected:
  static bool is_whole(const std::string& in) {
    for (const char* name : {"theta_45_deg", "theta_60_deg", "intact"})
      if (!fs::exists(fs::path(in) / name / "result.json")) return false;
    return fs::exists(fs::path(in) / "report.html");
  }
};

TEST_F(Outputs, ThatCannotBeWrittenLoseNoTest) {
  const std::string recipe = small_recipe();
  const std::pair<const char*, int> ways[] = {
      {"2>/dev/full", 0}, {"2>&-", 0}, {">/dev/full", 3}, {">&-", 3}, {"<&- >&- 2>&-", 3}};
  for (const auto& [way, code] : ways) {
    fs::remove_all(out());
    EXPECT_EQ(run("run " + recipe + " --out " + out() + " " + way), code) << way << output;
    EXPECT_TRUE(is_whole(out())) << way;
    EXPECT_THAT(output, Not(HasSubstr("terminate"))) << way;
  }
}

TEST_F(Outputs, AReaderThatLeavesLosesNoTest) {
  run_line("{ " + std::string(PHY_PROGRAM) + " run " + small_recipe() + " --out " + out() +
           "; echo code $? >&2; } | head -1");
  EXPECT_THAT(output, AllOf(HasSubstr("recipe    small"), HasSubstr("standard output cannot be written"),
                            HasSubstr("code 3")));
  EXPECT_TRUE(is_whole(out()));
}

TEST_F(Outputs, MessagesThatNobodyReadsKeepTheirExitCode) {
  const std::string wrong = write("wrong.toml", "[specimen]\nwidht = \"8 mm\"\n");
  for (const char* way : {"2>/dev/full", "2>&-"}) {
    EXPECT_EQ(run("run " + wrong + " " + way), 2) << way;
    EXPECT_EQ(run("show " + at("absent") + " " + way), 3) << way;
    EXPECT_EQ(run("contact linear " + std::string(way)), 0) << way;
  }
  EXPECT_EQ(run("contact linear >&-"), 3);
}

// A store that gets the number of a closed descriptor would be printed into.
TEST_F(Outputs, AStoreIsNotPrintedInto) {
  small_recipe();
  const std::string study = write("study.toml", "recipe = \"small.toml\"\n");
  ASSERT_EQ(run("study " + study + " --out " + at("calm")), 0) << output;
  const std::string calm = hash();
  EXPECT_EQ(run("study " + study + " --out " + out() + " >&- 2>&-"), 3);
  EXPECT_EQ(run("study status " + out()), 0) << output;
  EXPECT_EQ(hash(), calm);
}

struct Long {
  const char* name;
  std::vector<std::string> arguments;
  int code;
  std::string says;
  long event = 3;  ///< at which the signal comes: the first writing into the cache of packings
};
void PrintTo(const Long& l, std::ostream* out) { *out << l.name; }

class Signals : public ProgramTest, public testing::WithParamInterface<Long> {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("slow.toml",
          "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[[bedding]]\n"
          "spacing = \"2 mm\"\n[test]\nangles = [\"0 deg\", \"45 deg\", \"90 deg\"]\nplaten_speed = \"0.001 "
          "m/s\"\n");
    write("study.toml", "recipe = \"slow.toml\"\npackings = [1, 2, 3]\n");
    write("direct.toml",
          "recipe = \"slow.toml\"\nsolver = \"direct\"\npackings = [1, 2, 3, 4, 5, 6, 7, 8, "
          "9]\n[[vary]]\nkey = "
          "\"bedding.k_n\"\ntimes = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 2, 3, 4, 5, 6, 7, 8, "
          "9]\n");
    write("table.csv",
          "theta [deg],E [GPa],nu,UCS [MPa],n\n0,17.5,0.10,105,3\n30,15.6,0.36,60,3\n"
          "60,21.0,0.5,45,3\n90,48,0.25,128,3\n");
    write("rock.toml", "data = \"table.csv\"\nrecipe = \"start.toml\"\n");
    write("start.toml",
          "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n"
          "[[bedding]]\nspacing = \"2 mm\"\n");
  }
  /// The exit code after the signal, which comes at the event of the case; 128 + signal if it killed.
  int after(int signal) {
    fs::remove_all(at("cache"));  // the same events every time
    std::string line = "--threads 1";
    for (const std::string& word : GetParam().arguments)
      line += " " + (word == "out" || word.ends_with(".toml") ? at(word) : word);
    return run_to_event(GetParam().event, signal, line);
  }
};

TEST_P(Signals, EndLikeCtrlC) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(after(signal), GetParam().code) << strsignal(signal) << "\n" << output;
    EXPECT_THAT(output, HasSubstr(GetParam().says)) << strsignal(signal);
    if (GetParam().says.find("nothing was written") != std::string::npos) {
      EXPECT_FALSE(fs::exists(out())) << "an empty folder is something";
    }
    fs::remove_all(out());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, Signals,
    testing::Values(
        Long{"run", {"run", "slow.toml", "--out", "out"}, 1, "no test was finished, nothing was written", 6},
        Long{"packing", {"run", "slow.toml", "--out", "out"}, 1, "a packing was made: nothing was written"},
        Long{"study",
             {"study", "study.toml", "--out", "out"},
             1,
             "specimens are left: phyllite study resume",
             30},
        Long{"envelope", {"envelope", "slow.toml", "--out", "out"}, 1, "stopped: no envelope is fitted", 6},
        Long{"calibrate", {"calibrate", "rock.toml", "--out", "out"}, 1, "to go on: phyllite calibrate", 30},
        Long{"direct", {"study", "direct.toml", "--out", "out"}, 1, "specimens are left", 30},
        Long{"twin", {"rock", "twin", "slow.toml", "out"}, 1, "stopped, nothing was written"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST_F(Outputs, UnderNohupATerminalThatClosesEndsNothing) {
  small_recipe();
  EXPECT_EQ(run_to_event(3, SIGHUP, "run " + at("small.toml") + " --out " + out(), "trap '' HUP; "), 0)
      << output;
  EXPECT_TRUE(is_whole(out()));
}

TEST_F(Outputs, ASignalEndsThePackingThatIsMade) {
  write("many.toml", many_discs);
  write("layered.toml", std::string(many_discs) + "[[bedding]]\nspacing = \"5 mm\"\n");
  write("table.csv", "theta [deg],E [GPa]\n0,17.5\n45,18\n90,48\n");
  write("rock.toml", "data = \"table.csv\"\nrecipe = \"layered.toml\"\n");
  const std::pair<std::vector<std::string>, const char*> lines[] = {
      {{"run", at("many.toml"), "--no-cache", "--out", out()}, "stopped while a packing was made"},
      {{"rock", "twin", at("many.toml"), out()}, "stopped, nothing was written"},
      {{"calibrate", at("rock.toml"), "--elastic", "--out", out()}, "to go on: phyllite calibrate"}};
  for (const auto& [line, says] : lines) {
    const pid_t child = start(line, at("log"));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    ::kill(child, SIGTERM);
    int status = 0;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << read(at("log"));
    EXPECT_LT(used.ru_utime.tv_sec, 4) << line.front() << ": as long as the packing takes";
    EXPECT_THAT(read(at("log")), AllOf(HasSubstr(says), Not(HasSubstr("porosity"))));
    EXPECT_TRUE(!fs::exists(out()) || !fs::is_empty(out())) << line.front();
    EXPECT_FALSE(fs::exists(out() + ".csv"));
    fs::remove_all(out());
  }
}

// In the middle of a block of cycles, which looks at no flag.
TEST_F(Outputs, ASecondSignalEndsAtOnce) {
  std::ofstream discs(at("discs.csv"));
  discs << "x [m],y [m],r [m]\n";
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 200; ++j) discs << (i + 0.5) * 1e-3 << "," << (j + 0.5) * 1e-3 << ",0.0005\n";
  discs.close();
  write("lattice.toml",
        "[specimen]\nwidth = \"200 mm\"\nheight = \"200 mm\"\n[packing]\nfile = \"discs.csv\"\n[test]\n"
        "history_interval = 10000\n");
  const pid_t child = start({"--threads", "1", "run", at("lattice.toml"), "--out", out()}, at("log"));
  for (int i = 0; i < 3000 && read(at("log")).find("press ") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ::kill(child, SIGHUP);  // of a terminal that closes: no second wish
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, WNOHANG), 0) << read(at("log"));
  ::kill(child, SIGINT);
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) << read(at("log"));
}

}  // namespace
