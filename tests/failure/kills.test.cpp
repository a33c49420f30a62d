// A run that is killed at any event leaves whole results, or none, and the next run is not disturbed by what
// is left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <map>
#include <nlohmann/json.hpp>

#include "../program.hpp"

namespace {

namespace fs = std::filesystem;

class Kills : public ProgramTest {
 protected:
  /// What killed runs have left under temporary names.
  std::size_t n_left(const std::string& in) const {
    std::size_t n = 0;
    for (const auto& entry : fs::recursive_directory_iterator(in))
      n += entry.path().filename().string().find(".phyllite-") != std::string::npos ? 1U : 0U;
    return n;
  }
  /// Folder of a specimen -> hash of its result; a folder under a temporary name is none.
  std::map<std::string, std::string> results(const std::string& in) const {
    std::map<std::string, std::string> hashes;
    if (!fs::exists(in)) return hashes;
    for (const auto& entry : fs::directory_iterator(in)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_directory() || name.find(".phyllite-") != name.npos) continue;
      const auto result = nlohmann::json::parse(read((entry.path() / "result.json").string()));
      EXPECT_TRUE(fs::exists(entry.path() / "history.csv")) << entry.path();
      hashes[name] = result.at("result_hash");
    }
    return hashes;
  }
};

TEST_F(Kills, ARunLeavesWholeResultsAndIsRunAgain) {
  const std::string line = "run " + small_recipe() + " --threads 2 --out ";
  ASSERT_EQ(run(line + at("first")), 0) << output;  // the packing is in the cache from now on
  const long n = n_events(line + at("calm"));
  const auto calm = results(at("calm"));
  ASSERT_EQ(calm.size(), 3U);
  for (long k = 0; k < 12; ++k) {
    const long event = 1 + k * (n - 12) / 11;
    fs::remove_all(out());
    EXPECT_EQ(run_to_event(event, SIGKILL, line + out()), 128 + SIGKILL) << event << " of " << n << "\n"
                                                                         << output;
    for (const auto& [name, hash] : results(out())) EXPECT_EQ(hash, calm.at(name)) << event;
    ASSERT_EQ(run(line + out()), 0) << "after event " << event << "\n" << output;
    EXPECT_EQ(results(out()), calm) << event;
    EXPECT_EQ(n_left(out()), 0U) << "after event " << event;
  }
}

// As a kill leaves it between the last file and the renaming.
TEST_F(Kills, WhatWasInTheMakingIsNoSpecimen) {
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  const std::string dead = out() + "/theta_60_deg.phyllite-part-999999999",
                    mine = out() + "/intact.phyllite-part-" + std::to_string(::getpid());
  fs::rename(out() + "/theta_60_deg", dead), fs::copy(dead, mine, fs::copy_options::recursive);
  EXPECT_EQ(run("show " + out()), 1) << output;
  EXPECT_THAT(output, testing::AllOf(testing::HasSubstr("theta = 60 deg: missing"),
                                     testing::Not(testing::HasSubstr("part"))));
  ASSERT_EQ(run("run " + at("small.toml") + " --out " + out()), 0) << output;
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(mine)) << "its process lives";
  EXPECT_EQ(n_left(out()), 1U);
}

}  // namespace
