// The job script that `phyllite study --slurm` prints, on a real Slurm of one node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../program.hpp"

namespace {

class SlurmTest : public ProgramTest {
 protected:
  std::string node = PHY_SOURCE_DIR "/tests/soak/slurm_node.sh";
  bool up = false;
  void SetUp() override {
    ProgramTest::SetUp();
    if (::geteuid() != 0 || run_line("command -v slurmctld && command -v munged") != 0)
      GTEST_SKIP() << "needs root and Debian's slurm-wlm";
    up = true;
    ASSERT_EQ(run_line(node + " start " + at("slurm")), 0) << output;
  }
  void TearDown() override {
    if (up) run_line(node + " stop " + at("slurm"));
    ProgramTest::TearDown();
  }
};

TEST_F(SlurmTest, JobArrayGivesTheStoreOfOneRun) {
  small_recipe("max_strain = 0.03\n");
  const std::string study = write("study.toml",
                                  "recipe = \"small.toml\"\npackings = [1, 2, 3]\n"
                                  "[[vary]]\nkey = \"bedding.k_n\"\ntimes = [0.5, 1, 2]\n");
  ASSERT_EQ(run("study " + study + " --out " + at("whole")), 0) << output;
  const std::string whole = hash();
  ASSERT_EQ(run("--threads 1 study " + study + " --slurm 4 --out " + out()), 0) << output;
  const std::string job = write("job.sh", output);
  const std::string bin = std::filesystem::path(PHY_PROGRAM).parent_path().string();
  ASSERT_EQ(run_line("SLURM_CONF=" + at("slurm") + "/slurm.conf PATH=" + bin +
                     ":$PATH sbatch --wait --output=" + at("job-%a.log") + " " + job),
            0)
      << output;
  ASSERT_EQ(run("study merge " + out()), 0) << output;
  EXPECT_EQ(hash(), whole);
  EXPECT_EQ(run("study status " + out()), 0) << output;
}

}  // namespace
