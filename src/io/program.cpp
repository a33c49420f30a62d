#include "io/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/check.hpp"
#include "io/disk.hpp"
#include "io/file.hpp"
#include "io/output.hpp"

extern char** environ;

namespace phy::io {
namespace {

namespace fs = std::filesystem;

/// Ignores SIGPIPE while it lives: a program that ends early must not end this one.
struct NoPipeSignal {
  NoPipeSignal() : before(std::signal(SIGPIPE, SIG_IGN)) {}
  ~NoPipeSignal() { std::signal(SIGPIPE, before); }
  void (*before)(int);
};

/// A file in the folder for temporary files, under a name that nobody can have guessed; it goes with this
/// object.
struct Passing {
  std::string path = (fs::temp_directory_path() / "phyllite-XXXXXX").string();
  Passing() {
    const int fd = ::mkstemp(path.data());
    if (fd < 0) throw IoError(path + ": cannot be made: " + std::strerror(errno));
    ::close(fd);
  }
  Passing(const Passing&) = delete;
  Passing& operator=(const Passing&) = delete;
  ~Passing() { ::unlink(path.c_str()); }
};

struct Child {
  pid_t pid = 0;
  int input = -1;
};

/// Standard error goes to the file `said`, standard output nowhere.
Child start(const std::string& program, const std::vector<std::string>& arguments, const std::string& package,
            const std::string& said) {
  int ends[2];
  // Closed on exec: the child must not hold the writing end, or it would never see the end of its input.
  if (::pipe2(ends, O_CLOEXEC) != 0) throw IoError(program + ": cannot be started: " + std::strerror(errno));
  std::vector<char*> argv = {const_cast<char*>(program.c_str())};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  Child child;
  child.input = ends[1];
  const int error = ::posix_spawnp(&child.pid, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  // Our copy of the reading end: with it open a child that has ended would not break the pipe.
  ::close(ends[0]);
  if (error == 0) return child;
  ::close(ends[1]);
  throw IoError(program + ": cannot be started: " + std::strerror(error) + "; install it: apt install " +
                package);
}

std::string message_in(const std::string& file) {
  std::string text = read_file(file);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  // The end of a long text: the error comes last.
  return text.size() > 600 ? "..." + text.substr(text.size() - 600) : text;
}

}  // namespace

void run_program(const std::string& program, const std::vector<std::string>& arguments,
                 const std::string& package,
                 const std::function<void(const std::function<void(const std::string&)>& write)>& feed) {
  const NoPipeSignal quiet;
  const Passing said;
  const Child child = start(program, arguments, package, said.path);
  bool ok = true;
  try {
    // After a failed write the rest is not sent; the exit status tells why.
    feed([&](const std::string& text) { ok = ok && write_all(child.input, text) == 0; });
  } catch (...) {
    ::close(child.input);
    while (::waitpid(child.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
    throw;
  }
  // The end of input lets the program finish.
  ::close(child.input);
  int status = 0;
  while (::waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  const std::string message = message_in(said.path);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !ok)
    throw IoError(program + " did not succeed: " + (message.empty() ? "it said nothing" : message));
}

void make_file(const std::string& path, const std::function<void(const std::string& temporary)>& make) {
  const fs::path place(path);
  if (is_stream(path)) throw IoError(path + ": is no place for a picture; name a file with --out");
  check_outputs({path});
  // Before minutes of drawing.
  check_writable(place.has_parent_path() ? place.parent_path().string() : ".");
  // The ending stays last, as programs choose the format by it.
  const std::string part = (place.parent_path() / ("." + place.stem().string() + ".phyllite-part-" +
                                                   std::to_string(::getpid()) + place.extension().string()))
                               .string();
  std::error_code ignored;
  try {
    make(part);
    // Listed before it appears (io/output.hpp).
    list_written(path, part);
  } catch (...) {
    fs::remove(part, ignored);
    throw;
  }
  std::error_code error;
  fs::rename(part, place, error);
  if (!error) return;
  fs::remove(part, ignored);
  throw IoError(path + ": cannot be written: " + error.message() + "; check the folder");
}

}  // namespace phy::io
