#include "gui/child.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "io/file.hpp"

namespace phy::gui {
namespace {

/// What the new process has open: nothing of this one's connections.
class Actions {
 public:
  explicit Actions(const std::string& log) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, 1, log.c_str(), O_WRONLY | O_APPEND, 0);
    posix_spawn_file_actions_adddup2(&actions_, 1, 2);
    posix_spawn_file_actions_addclosefrom_np(&actions_, 3);
  }
  ~Actions() { posix_spawn_file_actions_destroy(&actions_); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// A process group of its own: Ctrl-C on the terminal of `phyllite gui` reaches that alone, which passes it
/// on.
class Attributes {
 public:
  Attributes() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }
  ~Attributes() { posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

}  // namespace

Child::Child(const std::vector<std::string>& words, const std::string& log) {
  io::write_file(log, "$ " + command_of(words) + "\n");
  std::vector<std::string> arguments = {"phyllite"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& a : arguments) pointers.push_back(a.data());
  pointers.push_back(nullptr);
  const Actions actions(log);
  const Attributes attributes;
  if (const int error =
          posix_spawn(&process_, "/proc/self/exe", actions.get(), attributes.get(), pointers.data(), environ);
      error != 0)
    throw IoError("phyllite cannot be started once more: " + std::string(std::strerror(error)));
}

void Child::ended(int status) {
  running_ = false;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : ending.asked(process_) ? 1 : 128 + WTERMSIG(status);
}

bool Child::running() {
  int status = 0;
  if (running_ && waitpid(process_, &status, WNOHANG) != 0) ended(status);
  return running_;
}

Child::~Child() {
  for (; running(); std::this_thread::sleep_for(std::chrono::milliseconds(20))) ending.ask(process_);
}

bool Ending::ask(pid_t process) {
  const auto now = std::chrono::steady_clock::now();
  if (process != std::exchange(process_, process)) {
    since_ = now;
    return kill(process, SIGTERM) == 0;
  }
  // Another SIGTERM would do for one that is busy, but not for one that has been halted.
  return kill(process, now - since_ < patience ? 0 : SIGKILL) == 0;
}

}  // namespace phy::gui
