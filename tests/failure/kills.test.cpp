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
  /// Folder of a specimen -> hash of its result; a folder under a temporary name is none.
  std::map<std::string, std::string> results(const std::string& in) const {
    std::map<std::string, std::string> hashes;
    if (!fs::exists(in)) return hashes;
    for (const auto& entry : fs::directory_iterator(in)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_directory() || name.find(".part-") != name.npos) continue;
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
  }
}

}  // namespace
