// In a browser every instance of the program has files of its own in memory: nobody else can be at them. What
// is finished gets its name at the end: then the page's worker learns what has changed.
#include <emscripten.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <ctime>

#include "system/files.hpp"

namespace phy::system {

void lock(int) {}

int lock_folder(const std::string&) { return -1; }

bool lock_is_free(const std::string&) { return true; }

ProcessLock lock_for_process(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT, 0644);
  if (fd < 0) return {};
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const timespec both[] = {now, now};
  ::futimens(fd, both);  // the work begins now; no times would be 1970 here
  return {fd, false};
}

int locked_by(const std::string&) { return 0; }

int replace(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) return errno;
  // Files are those of the first thread.
  // clang-format off
  MAIN_THREAD_EM_ASM({ if (Module["share"]) Module["share"](); });
  // clang-format on
  return 0;
}

int exchange(const std::string&, const std::string& other) { return about(other) ? ENOSYS : ENOENT; }

}  // namespace phy::system
