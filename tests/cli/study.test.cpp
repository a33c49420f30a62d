// Studies as a user meets them: the plan, the table, resumption, shards, and what a kill leaves behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <sstream>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class StudyCli : public ProgramTest {
 protected:
  /// 3 settings x 2 angles + intact, on each packing.
  std::string study(const std::string& more = "packings = [1, 2]\n") const {
    small_recipe("max_strain = 0.03\n");
    return write("study.toml", "recipe = \"small.toml\"\n" + more +
                                   "[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n");
  }
};

TEST_F(StudyCli, APackingOfTwoBatchesIsMadeOnce) {
  small_recipe();
  const std::string file = write(
      "precision.toml",
      "recipe = \"small.toml\"\n[[vary]]\nkey = \"engine.precision\"\nvalues = [\"double\", \"float\"]\n");
  ASSERT_EQ(run("study " + file + " --dry-run --out " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("1 packing(s) to make"));
}

TEST_F(StudyCli, TellsThePlanRunsItAndLeavesATable) {
  const std::string file = study();
  ASSERT_EQ(run("study " + file + " --dry-run --out " + out()), 0) << output;
  EXPECT_THAT(output,
              HasSubstr("3 points x 2 packing(s) x 1 bond seed(s) = 18 specimens, 14 of them distinct"));
  EXPECT_THAT(output, HasSubstr("2 packing(s) to make"));
  EXPECT_FALSE(fs::exists(out()));
  ASSERT_EQ(run("study " + file + " --threads 2 --out " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("14 run in"));
  const std::string first = hash();
  ASSERT_EQ(run("study status " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("14 of 14 finished"));
  EXPECT_EQ(hash(), first);
  ASSERT_EQ(run("study resume " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("0 run in"));
  EXPECT_EQ(hash(), first);
  ASSERT_EQ(run("study export " + out() + " --csv " + at("table.csv")), 0) << output;
  EXPECT_EQ(read(at("table.csv")), read(out() + "/results.csv"));
  const std::string table = read(at("table.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 19);
}

TEST_F(StudyCli, TellsWhatTheParametersDo) {
  ASSERT_EQ(run("study " + study() + " --out " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("ucs: change from the lowest to the highest level [%]"));
  const std::string effects = read(out() + "/effects.csv"), responses = read(out() + "/responses.csv");
  EXPECT_THAT(effects, HasSubstr("ucs,theta = 60 deg,bedding.k_n,R2,1,2,"));
  EXPECT_THAT(responses, HasSubstr("number,unit,specimen,point,bedding.k_n [Pa/m],replicates,mean,sd,"));
  ASSERT_EQ(run("study effects " + out() + " --out " + at("again")), 0) << output;
  EXPECT_THAT(output, HasSubstr("95 % of the mean over packings"));
  EXPECT_EQ(read(at("again") + "/effects.csv"), effects);
  EXPECT_EQ(read(at("again") + "/responses.csv"), responses);
}

TEST_F(StudyCli, ReadsBackInPandasOrTheStandardLibrary) {
  ASSERT_EQ(run("study " + study() + " --out " + out()), 0) << output;
  const std::string script =
      write("check.py",
            "import csv, sqlite3, sys, zlib\n"
            "rows = list(csv.DictReader(open(sys.argv[1] + '/results.csv')))\n"
            "assert len(rows) == 18 and all(float(r['ucs [Pa]']) > 1e6 for r in rows)\n"
            "db = sqlite3.connect(sys.argv[1] + '/study.sqlite')\n"
            "q = 'SELECT value, history FROM specimen JOIN number USING (key) WHERE number.name=?'\n"
            "for ucs, blob in db.execute(q, ('ucs',)):\n"
            "    h = csv.DictReader(zlib.decompress(blob).decode().splitlines())\n"
            "    assert max(float(r['axial_stress [Pa]']) for r in h) == ucs\n");
  EXPECT_EQ(std::system(("python3 " + script + " " + out()).c_str()), 0);
}

TEST_F(StudyCli, KilledAtTwentyEventsItEndsWithTheSameHash) {
  const std::string file = study("packings = [1, 2, 3]\nbond_seeds = [1, 2]\n");
  const long n = n_events("study " + file + " --threads 2 --out " + at("calm"));
  const std::string undisturbed = hash();
  std::minstd_rand moment(5);
  // All of them together are a quarter of the study: the last must not find it finished.
  for (int i = 0; i < 20; ++i) {
    const long event = 1 + static_cast<long>(moment()) % (n / 40);
    EXPECT_EQ(run_to_event(event, SIGKILL, "study " + file + " --threads 2 --out " + out()), 128 + SIGKILL)
        << "event " << event << " of " << n << "\n"
        << output;
  }
  ASSERT_EQ(run("study resume " + out()), 0) << output;
  EXPECT_EQ(hash(), undisturbed);
}

TEST_F(StudyCli, TwoProcessesShareTheWork) {
  const std::string file = study("packings = [1, 2, 3]\n");
  ASSERT_EQ(run("study " + file + " --threads 2 --out " + at("one")), 0) << output;
  const std::string alone = hash();
  const pid_t other = start({"study", file, "--threads", "1", "--out", out()});
  ASSERT_EQ(run("study " + file + " --threads 1 --out " + out()), 0) << output;
  EXPECT_EQ(hash(), alone);
  int status = 0;
  ::waitpid(other, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(StudyCli, ShardsMergeToTheSameStore) {
  const std::string file = study();
  ASSERT_EQ(run("study " + file + " --out " + at("whole")), 0) << output;
  const std::string whole = hash();
  for (const char* part : {"1/3", "2/3", "3/3"})
    ASSERT_EQ(run("study " + file + " --shard " + part + " --out " + out()), 0) << output;
  EXPECT_FALSE(fs::exists(out() + "/results.csv")) << "a part has no table of the whole";
  for (const char* verb : {"status", "effects", "export"}) {
    EXPECT_EQ(run(std::string("study ") + verb + " " + out()), 3);
    EXPECT_THAT(output, HasSubstr("phyllite study merge " + out()));
  }
  EXPECT_EQ(run("study merge " + out() + " " + at("none.sqlite")), 3);
  EXPECT_FALSE(fs::exists(out() + "/study.sqlite"));
  ASSERT_EQ(run("study merge " + out() + " " + out() + "/shard-1-of-3.sqlite"), 0) << output;
  EXPECT_THAT(output, HasSubstr("specimens are left"));
  ASSERT_EQ(run("study merge " + out()), 0) << output;
  EXPECT_EQ(hash(), whole);
  EXPECT_EQ(read(out() + "/responses.csv"), read(at("whole") + "/responses.csv"));
  EXPECT_EQ(run("study status " + out()), 0) << output;
  EXPECT_EQ(run("study " + file + " --shard 4/3"), 2);
  EXPECT_THAT(output, HasSubstr("i/n with 1 <= i <= n"));
  EXPECT_EQ(run("study " + file + " --slurm 8 --out " + out()), 0);
  EXPECT_THAT(output, HasSubstr("#SBATCH --array=1-8"));
}

TEST_F(StudyCli, AFolderHoldsOneStudyWhichMayGrow) {
  const auto with = [&](const std::string& name, const std::string& times, const std::string& more = "") {
    small_recipe("max_strain = 0.03\n");
    return write("study.toml", "name = \"" + name + "\"\nrecipe = \"small.toml\"\n" + more +
                                   "[[vary]]\nkey = \"bedding.k_n\"\ntimes = " + times + "\n");
  };
  const std::string line = " --out " + out();
  ASSERT_EQ(run("study " + with("A", "[0.5, 1]") + line), 0) << output;
  EXPECT_THAT(output, HasSubstr("5 run in"));
  const std::string first = hash();
  ASSERT_EQ(run("study " + with("A", "[0.5, 1, 2]") + line), 0) << output;
  EXPECT_THAT(output, HasSubstr("2 run in"));
  const std::string both = hash();
  EXPECT_NE(both, first);
  EXPECT_EQ(run("study " + with("B", "[2]") + line), 2);
  EXPECT_THAT(output, testing::AllOf(HasSubstr("name = A: expected B"), HasSubstr("use another --out")));
  EXPECT_EQ(run("study " + with("A", "[2]", "[set]\n\"matrix.mu\" = 0.5\n") + line), 2);
  EXPECT_THAT(output, HasSubstr("recipe.toml: matrix.mu = 0.8: expected 0.5"));
  const std::string speeds = "[by_angle]\n\"test.platen_speed\" = [\"0.1 m/s\", \"0.2 m/s\", \"0.3 m/s\"]\n";
  EXPECT_EQ(run("study " + with("A", "[2]", speeds) + line), 2);
  EXPECT_THAT(output, HasSubstr("study.toml: test.platen_speed at theta = 45 deg = "));
  ASSERT_EQ(run("study status " + out()), 0) << output;
  EXPECT_EQ(hash(), both) << "a study that is refused changes nothing";
  ASSERT_EQ(run("study " + with("A", "[0.5, 1]") + line), 0) << output;
  EXPECT_THAT(output, HasSubstr("0 run in"));
  EXPECT_EQ(hash(), first) << "of this plan, whatever else the store holds";
}

TEST_F(StudyCli, GrowsByAnglesThatHaveTheirOwnSpeeds) {
  const auto with = [&](const std::string& speeds) {
    return "study " + study("packings = [1]\n[by_angle]\n\"test.platen_speed\" = [" + speeds + "]\n") +
           " --out " + out();
  };
  ASSERT_EQ(run(with("\"0.2 m/s\", \"0.25 m/s\", \"0.3 m/s\"")), 0) << output;
  EXPECT_THAT(output, HasSubstr("7 run in"));
  const std::string line = with("\"0.2 m/s\", \"0.25 m/s\", \"0.1 m/s\", \"0.3 m/s\"");
  std::string base = read(at("small.toml"));
  base.insert(base.find("\"60 deg\"") + 8, ", \"90 deg\"");
  write("small.toml", base);
  ASSERT_EQ(run(line), 0) << output;
  EXPECT_THAT(output, HasSubstr("3 run in"));
}

TEST_F(StudyCli, PartsAreMergedBeforeTheWholeIsRun) {
  const std::string file = study("packings = [1]\n");
  ASSERT_EQ(run("study " + file + " --shard 1/2 --out " + out()), 0) << output;
  for (const std::string& line : {"study resume " + out(), "study " + file + " --out " + out()}) {
    EXPECT_EQ(run(line), 3) << output;
    EXPECT_THAT(output, testing::AllOf(HasSubstr("shard-1-of-2.sqlite"), HasSubstr("study merge " + out())));
    EXPECT_FALSE(fs::exists(out() + "/study.sqlite"));
  }
  ASSERT_EQ(run("study merge " + out()), 0) << output;
  ASSERT_EQ(run("study resume " + out()), 0) << output;
  EXPECT_THAT(output, HasSubstr("3 run in"));
}

TEST_F(StudyCli, NothingOnTheCommandLineIsPassedOver) {
  const std::string file = study();
  for (const char* shard : {"1/99999999999", "99999999999/1", "1/", "/2", "1/2x", "0/2", "2", "1/20000"}) {
    EXPECT_EQ(run("study " + file + " --dry-run --shard " + shard + " --out " + out()), 2) << shard;
    EXPECT_THAT(output, HasSubstr("i/n with 1 <= i <= n <= 10000"));
  }
  EXPECT_EQ(run("study " + file + " --slurm 3 --shard 1/2"), 2);
  EXPECT_THAT(output, HasSubstr("--shard excludes --slurm"));
  EXPECT_EQ(run("study status " + out() + " extra"), 2);
  EXPECT_THAT(output, HasSubstr("extra: expected one folder after phyllite study status"));
  EXPECT_EQ(run("study status " + out() + " --shard 1/2"), 2);
  EXPECT_THAT(output, HasSubstr("--shard = 1/2: expected an option of phyllite study status"));
  EXPECT_EQ(run("study " + file + " resume " + out()), 2);
  ASSERT_EQ(run("study " + file + " --shard 1/2 --out " + out()), 0) << output;
  EXPECT_EQ(run("study resume " + out() + " --shard 2/2 --dry-run"), 0) << output;
}

TEST_F(StudyCli, FailuresAreListedAndExitWith1) {
  const std::string file = study("packings = [1]\n[set]\n\"test.max_strain\" = 0.001\n");
  EXPECT_EQ(run("study " + file + " --out " + out()), 1) << output;
  EXPECT_THAT(output, HasSubstr("without a peak"));
  EXPECT_THAT(output, HasSubstr("left out: 7 of 7 specimens, which did not peak"));
  EXPECT_THAT(output, HasSubstr("raise test.max_strain"));
  EXPECT_EQ(run("study status " + out()), 1) << output;
}

TEST_F(StudyCli, MistakesHaveTheirExitCodes) {
  EXPECT_EQ(run("study " + write("bad.toml", "recipe = \"none.toml\"\ndesign = \"sobl\"\n")), 2);
  EXPECT_THAT(output, HasSubstr("bad.toml:1: recipe"));
  EXPECT_THAT(output, HasSubstr("did you mean \"sobol\""));
  EXPECT_EQ(run("study"), 2);
  EXPECT_EQ(run("study status " + at("nowhere")), 3);
  EXPECT_EQ(run("study merge " + folder.string()), 3);
  EXPECT_EQ(run("study " + at("missing.toml")), 3);
}

}  // namespace
