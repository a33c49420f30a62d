// Counts what a program does to files, and raises a signal at the n-th event: a kill that comes at the same
// place on every machine. Loaded before the C library (LD_PRELOAD); an event is a call that writes, renames,
// removes, makes or flushes something.
//   PHY_SIGNAL_AT=n PHY_SIGNAL=s   raises signal s just before the n-th event
//   PHY_COUNT_INTO=file            leaves the number of events there when the program ends by itself
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> n_events{0};

long number_in(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0 : std::atol(text);
}

void event() {
  static const long at = number_in("PHY_SIGNAL_AT");
  static const int what = static_cast<int>(number_in("PHY_SIGNAL"));
  if (++n_events == at) ::kill(::getpid(), what);
}

template <class Function>
Function* behind(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

struct Count {
  ~Count() {
    const char* path = std::getenv("PHY_COUNT_INTO");
    if (path == nullptr) return;
    if (std::FILE* file = std::fopen(path, "w"); file != nullptr) {
      std::fprintf(file, "%ld", n_events.load());
      std::fclose(file);
    }
  }
} count;

}  // namespace

#define COUNTED(result, name, parameters, ...)                  \
  extern "C" result name parameters {                           \
    static auto* const real = behind<result parameters>(#name); \
    event();                                                    \
    return real(__VA_ARGS__);                                   \
  }

COUNTED(ssize_t, write, (int fd, const void* data, size_t n), fd, data, n)
COUNTED(ssize_t, writev, (int fd, const iovec* parts, int n), fd, parts, n)
COUNTED(ssize_t, pwrite, (int fd, const void* data, size_t n, off_t at), fd, data, n, at)
COUNTED(ssize_t, pwrite64, (int fd, const void* data, size_t n, off64_t at), fd, data, n, at)
COUNTED(int, fsync, (int fd), fd)
COUNTED(int, fdatasync, (int fd), fd)
COUNTED(int, rename, (const char* from, const char* to), from, to)
COUNTED(int, unlink, (const char* path), path)
COUNTED(int, mkdir, (const char* path, mode_t mode), path, mode)
COUNTED(int, rmdir, (const char* path), path)
