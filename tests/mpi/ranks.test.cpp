// The same study on threads and on MPI ranks of this machine: one store, hash for hash.
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
