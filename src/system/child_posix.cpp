#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <utility>

#include "system/child.hpp"
#include "system/files.hpp"

namespace phy::system {
namespace {

/// Standard input, output and error of a new process, and what else it has open.
class Actions {
 public:
  Actions() { posix_spawn_file_actions_init(&actions_); }
  ~Actions() { posix_spawn_file_actions_destroy(&actions_); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

class GroupOfItsOwn {
 public:
  GroupOfItsOwn() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }
  ~GroupOfItsOwn() { posix_spawnattr_destroy(&attributes_); }
  GroupOfItsOwn(const GroupOfItsOwn&) = delete;
  GroupOfItsOwn& operator=(const GroupOfItsOwn&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

std::vector<char*> pointers(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<char*> all = {const_cast<char*>(name.c_str())};
  for (const std::string& a : arguments) all.push_back(const_cast<char*>(a.c_str()));
  all.push_back(nullptr);
  return all;
}

void close_once(int& descriptor) {
  if (const int open = std::exchange(descriptor, -1); open >= 0) ::close(open);
}

}  // namespace

FedProgram::FedProgram() : before_(std::signal(SIGPIPE, SIG_IGN)) {}

FedProgram::~FedProgram() {
  finish();
  close_once(ends_[0]);
  std::signal(SIGPIPE, before_);
}

int FedProgram::open_pipe() {
  // Closed on exec: the child must not hold the writing end, or it would never see the end of its input.
  return ::pipe2(ends_, O_CLOEXEC) != 0 ? errno : 0;
}

int FedProgram::start(const std::string& program, const std::vector<std::string>& arguments,
                      const std::string& said) {
  const std::vector<char*> argv = pointers(program, arguments);
  Actions actions;
  posix_spawn_file_actions_adddup2(actions.get(), ends_[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(actions.get(), STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), STDERR_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  const int error = ::posix_spawnp(&process_, program.c_str(), actions.get(), nullptr, argv.data(), environ);
  if (error != 0) process_ = 0;
  // Our copy of the reading end: with it open a child that has ended would not break the pipe.
  close_once(ends_[0]);
  return error;
}

bool FedProgram::write(const std::string& text) { return write_all(ends_[1], text) == 0; }

bool FedProgram::finish() {
  close_once(ends_[1]);
  const pid_t process = std::exchange(process_, 0);
  if (process == 0) return false;
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int start_again(const std::vector<std::string>& arguments, const std::string& log, int& process) {
  const std::string name = "phyllite";
  const std::vector<char*> argv = pointers(name, arguments);
  Actions actions;
  posix_spawn_file_actions_addopen(actions.get(), 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), 1, log.c_str(), O_WRONLY | O_APPEND, 0);
  posix_spawn_file_actions_adddup2(actions.get(), 1, 2);
  posix_spawn_file_actions_addclosefrom_np(actions.get(), 3);
  const GroupOfItsOwn group;
  return posix_spawn(&process, "/proc/self/exe", actions.get(), group.get(), argv.data(), environ);
}

std::optional<Ended> ended(int child) {
  int status = 0;
  if (::waitpid(child, &status, WNOHANG) == 0) return std::nullopt;
  if (WIFEXITED(status)) return Ended{false, WEXITSTATUS(status)};
  return Ended{true, WTERMSIG(status)};
}

bool ask_to_end(int process) { return ::kill(process, SIGTERM) == 0; }

bool kill(int process) { return ::kill(process, SIGKILL) == 0; }

bool is_there(int process) { return ::kill(process, 0) == 0; }

}  // namespace phy::system
