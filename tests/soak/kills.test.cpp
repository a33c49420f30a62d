// Twenty kills at random moments of every verb that computes, then the same once more: the same numbers, and
// nothing is left of the killed. PHY_KILLS: how many of each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <map>
#include <regex>
#include <thread>

#include "../program.hpp"
#include "base/rng.hpp"
#include "setting.hpp"

namespace {

namespace fs = std::filesystem;

struct Killed {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> again;  ///< what is added to go on
  int code;                        ///< largest of a whole run: a verdict may be 1
};
void PrintTo(const Killed& k, std::ostream* out) { *out << k.name; }

class KillsAtRandom : public ProgramTest, public testing::WithParamInterface<Killed> {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    const std::string grains =
        "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 330\n[matrix]\nsigma_c = "
        "\"40 MPa\"\ntau_c = \"40 MPa\"\n[[bedding]]\nspacing = \"2 mm\"\n";
    write("small.toml", grains +
                            "[test]\nangles = [\"30 deg\", \"60 deg\"]\nintact = true\nplaten_speed = "
                            "\"0.1 m/s\"\n");
    write("study.toml", "recipe = \"small.toml\"\npackings = [1, 2]\n");
    write("direct.toml",
          "recipe = \"small.toml\"\nsolver = \"direct\"\npackings = [1, 2, 3, 4, 5, 6]\n[[vary]]\nkey = "
          "\"bedding.k_n\"\ntimes = [0.1, 0.3, 1, 3, 9]\n");
    write("table.csv", "theta [deg],E [GPa],nu\n0,17.5,0.10\n30,15.6,0.36\n60,21.0,0.5\n90,48,0.25\n");
    write("rock.toml", "data = \"table.csv\"\nrecipe = \"start.toml\"\n");
    write("start.toml", grains);
  }
  std::vector<std::string> words(const std::string& out, bool again = false) const {
    std::vector<std::string> all;
    for (const std::string& word : GetParam().arguments)
      all.push_back(word == "OUT" ? out : word.ends_with(".toml") ? at(word) : word);
    if (again) all.insert(all.end(), GetParam().again.begin(), GetParam().again.end());
    return all;
  }
  /// Starts it and waits for its end, or kills it after so many seconds. The exit code; 128 + signal.
  int run_for(const std::vector<std::string>& line, double seconds) const {
    const pid_t child = start(line, at("log"));
    int status = 0;
    for (double waited = 0.0; ::waitpid(child, &status, WNOHANG) == 0; waited += 0.002) {
      if (waited >= seconds) ::kill(child, SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  /// All that says what came out: files of results, the hash of a study, and what is printed of elastic
  /// solutions. Not times.
  std::map<std::string, std::string> numbers(const std::string& out) const {
    std::map<std::string, std::string> found;
    std::string log = read(at("log"));
    if (const std::size_t hash = log.rfind("hash "); hash != log.npos) found["hash"] = log.substr(hash, 21);
    if (std::string(GetParam().name) == "elastic")
      found["log"] = std::regex_replace(log, std::regex("[0-9.]+\n|[0-9.]+ s for"), "");  // times
    if (!fs::exists(out)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
      const std::string name = entry.path().filename().string();
      for (const char* file :
           {"responses.csv", "history.csv", "cracks.csv", "envelope.csv", "fits.csv", "calibrated.toml"})
        if (name == file) found[fs::relative(entry.path(), out).string()] = read(entry.path());
      EXPECT_EQ(name.find(".phyllite-"), name.npos) << entry.path();
    }
    return found;
  }
  /// Names of what differs.
  static std::string different(const std::map<std::string, std::string>& a,
                               const std::map<std::string, std::string>& b) {
    std::string names;
    for (const auto& [name, text] : a)
      if (const auto it = b.find(name); it == b.end() || it->second != text) names += name + " ";
    for (const auto& [name, text] : b) names += a.contains(name) ? "" : name + " ";
    return names;
  }
};

TEST_P(KillsAtRandom, LeaveTheSameNumbers) {
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_LE(run_for(words(at("calm")), 1e9), GetParam().code) << read(at("log"));
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto calm = numbers(at("calm"));
  ASSERT_FALSE(calm.empty());
  const int n = static_cast<int>(phy::setting("PHY_KILLS", 20));
  int n_killed = 0;
  for (int i = 0; i < n; ++i) {
    fs::remove_all(out());
    if (i % 4 == 0) fs::remove_all(at("cache"));  // then packings are made, too
    const double moment = whole * phy::uniform(20, phy::Stream::test, static_cast<std::uint32_t>(i));
    n_killed += run_for(words(out()), moment) == 128 + SIGKILL ? 1 : 0;
    const bool begun = fs::exists(out());
    ASSERT_LE(run_for(words(out(), begun), 1e9), GetParam().code) << moment << " s\n" << read(at("log"));
    EXPECT_EQ(different(calm, numbers(out())), "") << "killed after " << moment << " of " << whole << " s";
    for (const auto& entry : fs::recursive_directory_iterator(at("cache")))
      EXPECT_EQ(entry.path().string().find(".phyllite-"), std::string::npos) << entry.path();
  }
  std::printf("%s: %d of %d killed within %.1f s\n", GetParam().name, n_killed, n, whole);
}

INSTANTIATE_TEST_SUITE_P(
    Each, KillsAtRandom,
    testing::Values(Killed{"run", {"run", "small.toml", "--out", "OUT"}, {}, 0},
                    Killed{"study", {"study", "study.toml", "--out", "OUT"}, {}, 1},
                    Killed{"direct", {"study", "direct.toml", "--out", "OUT"}, {}, 1},
                    Killed{"envelope",
                           {"envelope", "small.toml", "--confining", "0 MPa,5 MPa,10 MPa", "--out", "OUT"},
                           {},
                           1},
                    Killed{"elastic", {"elastic", "small.toml"}, {}, 1},
                    Killed{"calibrate", {"calibrate", "rock.toml", "--out", "OUT"}, {"--resume"}, 1}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
