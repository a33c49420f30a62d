// Where others use the same files: locks, and names that change in one moment.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "system/files.hpp"

namespace phy::system {
namespace {

/// On the whole file.
struct flock whole() {
  struct flock lock {};
  lock.l_type = F_WRLCK, lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

void lock(int descriptor) { ::flock(descriptor, LOCK_EX | LOCK_NB); }

int lock_folder(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd >= 0) lock(fd);
  return fd;
}

bool lock_is_free(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0) return false;
  const bool free = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  ::close(fd);
  return free;
}

ProcessLock lock_for_process(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0644);
  struct flock lock = whole();
  if (fd < 0) return {};
  if (::fcntl(fd, F_SETLK, &lock) == 0) {
    ::futimens(fd, nullptr);  // the work begins now
    return {fd, false};
  }
  if (errno != EACCES && errno != EAGAIN) return {fd, false};
  ::close(fd);
  return {-1, true};
}

int locked_by(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return 0;
  struct flock lock = whole();
  const bool known = ::fcntl(fd, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(fd);
  return known ? lock.l_pid : 0;
}

int replace(const std::string& from, const std::string& to) {
  return std::rename(from.c_str(), to.c_str()) != 0 ? errno : 0;
}

int exchange(const std::string& one, const std::string& other) {
  const int done = ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE);
  return done != 0 ? errno : 0;
}

}  // namespace phy::system
