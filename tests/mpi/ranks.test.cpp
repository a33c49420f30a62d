// The same study, and the same calibration, on threads and on MPI ranks of this machine: one store, hash for
// hash; one calibration.json.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../program.hpp"

namespace {

using testing::HasSubstr;

class RanksTest : public ProgramTest {
 protected:
  std::string study;
  void SetUp() override {
    ProgramTest::SetUp();
    small_recipe("max_strain = 0.03\n");
    study = write("study.toml",
                  "recipe = \"small.toml\"\npackings = [1, 2, 3]\n"
                  "[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n");
    if (run("study " + study + " --mpi --dry-run") == 2 && output.find("built with MPI") != output.npos)
      GTEST_SKIP() << "built without MPI; `make mpi` builds and tests with it";
  }
  int on_ranks(int n, const std::string& arguments) {
    return run_line("mpirun --allow-run-as-root --oversubscribe -n " + std::to_string(n) + " " + PHY_PROGRAM +
                    " " + arguments + " --mpi");
  }
};

TEST_F(RanksTest, GiveTheStoreOfThreads) {
  ASSERT_EQ(run("study " + study + " --threads 2 --out " + at("threads")), 0) << output;
  const std::string threads = hash();
  for (const int n : {2, 4}) {
    const std::string out = at("ranks" + std::to_string(n));
    ASSERT_EQ(on_ranks(n, "study " + study + " --threads 1 --out " + out), 0) << output;
    EXPECT_THAT(output, HasSubstr("21 run in"));
    EXPECT_THAT(output, HasSubstr("on other ranks"));
    EXPECT_EQ(hash(), threads) << n << " ranks";
  }
}

/// A table of the least specimen, and a budget that lasts from the search to the verification.
TEST_F(RanksTest, GiveTheCalibrationOfThreads) {
  write("start.toml",
        "[specimen]\nwidth = \"7 mm\"\nheight = \"14 mm\"\n[packing]\nn_grains = 253\n[[bedding]]\nspacing = "
        "\"2 mm\"\n");
  write("table.csv",
        "theta [deg],E [GPa],nu,UCS [MPa],n\n0,17.5,0.10,105,3\n60,21.0,0.5,45,3\n90,48,0.25,128,3\n");
  const std::string rock = write("rock.toml", "data = \"table.csv\"\nrecipe = \"start.toml\"\n");
  const auto calibrate = [&](const std::string& name) {
    return "calibrate " + rock + " --threads 1 --max-tests 54 --out " + at(name);  // the least
  };
  const auto left = [&](const std::string& name) {
    return read(at(name) + "/calibration.json") + read(at(name) + "/specimens/theta_60_deg/scene.bin");
  };
  ASSERT_THAT(run(calibrate("threads")), testing::AnyOf(0, 1)) << output;
  for (const int n : {1, 2, 4}) {
    const std::string name = "ranks" + std::to_string(n);
    ASSERT_THAT(on_ranks(n, calibrate(name)), testing::AnyOf(0, 1)) << output;
    EXPECT_EQ(output.find("tests on other ranks") != output.npos, n > 1) << output;
    EXPECT_EQ(left(name), left("threads")) << n << " ranks";
  }
}

TEST_F(RanksTest, AnErrorOfRank0EndsAll) {
  EXPECT_NE(on_ranks(2, "study " + study + " --out /proc/nowhere"), 0);
  EXPECT_THAT(output, HasSubstr("/proc/nowhere"));
  EXPECT_NE(on_ranks(2, "study " + at("missing.toml")), 0);
  EXPECT_THAT(output, HasSubstr("missing.toml"));
}

// A file system for half of the store: whoever meets its end, rank 0 tells it, and all ranks end.
TEST_F(RanksTest, AFullDiskEndsAll) {
  const std::string small = at("small");
  std::filesystem::create_directories(small);
  const std::string mount = "mount -t tmpfs -o size=400k none " + small;
  if (run_line("unshare -rm sh -c '" + mount + "'") != 0) GTEST_SKIP() << "no name spaces here: " << output;
  for (const char* threads : {"1", "2"}) {
    run_line("unshare -rm sh -c '" + mount + " && { mpirun --allow-run-as-root --oversubscribe -n 3 " +
             PHY_PROGRAM + " study " + study + " --threads " + threads + " --mpi --out " + small +
             "; echo code $?; }'");
    EXPECT_THAT(output, HasSubstr("full"));
    EXPECT_THAT(output, HasSubstr("code 3"));
    EXPECT_THAT(output, testing::Not(HasSubstr("terminate called")));
  }
}

}  // namespace
