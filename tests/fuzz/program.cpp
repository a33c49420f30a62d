// The program itself, in this process: a command line, and folders that only verbs read.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "contract.hpp"

// Its main() by another name, so that it can be called.
#define main phyllite_main
#include "cli/main.cpp"
#undef main

namespace phy::fuzz {
namespace {

/// Nothing reaches the terminal while it lives.
class Silence {
 public:
  Silence() : nobody_(::open("/dev/null", O_RDWR | O_CLOEXEC)) {
    for (int i = 0; i < 2; ++i) exchange(i, ::dup(fd_[i]), nobody_);
  }
  ~Silence() {
    for (int i = 0; i < 2; ++i) {
      std::fflush(i == 0 ? stdout : stderr);
      ::dup2(kept_[i], fd_[i]), ::close(kept_[i]);
    }
    ::close(nobody_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static constexpr int fd_[2] = {STDOUT_FILENO, STDERR_FILENO};
  int nobody_, kept_[2] = {-1, -1};
  void exchange(int i, int kept, int other) {
    std::fflush(i == 0 ? stdout : stderr);
    kept_[i] = kept, ::dup2(other, fd_[i]);
  }
};

using Words = std::vector<std::string>;

/// The exit code.
int run_program(Words words) {
  const Silence silence;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int exit_code = phyllite_main(static_cast<int>(words.size()), argv.data());
  if (exit_code < 0 || exit_code > 3) throw Finding("exit code " + std::to_string(exit_code));
  return exit_code;
}

Words lines_of(const std::string& text) {
  Words lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

/// Nothing long is computed, and nothing written outside the folder: of steps a thousand at most, and no file
/// that could be a recipe.
bool is_harmless(const Words& words) {
  static const Words verbs = {"contact", "envelope", "recipe", "study", "show",  "figure",
                              "film",    "elastic",  "run",    "rock",  "report"};
  if (words.empty() || std::find(verbs.begin(), verbs.end(), words.front()) == verbs.end()) return false;
  std::error_code too_long;  // no file has such a name
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& w = words[i];
    for (const char* odd : {"--out", "..", "new", "twin", "verify", "calibrate"})
      if (w.find(odd) != w.npos) return false;
    if (w.starts_with('/') || (w.starts_with("--steps=") && w.size() > 11)) return false;
    if (i > 0 && words[i - 1] == "--steps" && w.size() > 3) return false;
    if (words.front() != "contact" && std::filesystem::is_regular_file(w, too_long)) return false;
  }
  return true;
}

}  // namespace

/// A word per line, the first a verb. Recipes, studies and rocks that they name are not there; corners.csv
/// is.
bool read_words(std::string_view bytes) {
  const Files files(bytes, {"words", "corners.csv"});
  Words words = lines_of(files.read("words"));
  const std::filesystem::path home = std::filesystem::current_path();
  std::filesystem::current_path(files.folder());
  const bool harmless = is_harmless(words);
  words.insert(words.begin(), "phyllite");
  const bool ok = harmless && run_program(words) == 0;
  std::filesystem::current_path(home);
  return ok;
}

/// The page of a folder: of a calibration, a study or a run.
bool read_report(std::string_view bytes) {
  const Files files(bytes, {"calibration.json", "calibrated.toml", "results.csv", "recipe.toml",
                            "effects.csv", "result.json", "history.csv", "cracks.csv", "scene.bin"});
  run_program({"phyllite", "show", files.folder()});
  return run_program({"phyllite", "report", files.folder(), "--out", files.at("page.html")}) == 0;
}

}  // namespace phy::fuzz
