#include "jobs/folder_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>

#include "base/check.hpp"
#include "base/option.hpp"

namespace phy::jobs {
namespace {

std::string lock_file(const std::string& folder) {
  return (std::filesystem::path(folder) / ".lock").string();
}

/// On the whole file.
struct flock whole() {
  struct flock lock {};
  lock.l_type = F_WRLCK, lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

FolderLock::FolderLock(const std::string& folder)
    : descriptor_(::open(lock_file(folder).c_str(), O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0644)) {
  struct flock lock = whole();
  if (descriptor_ < 0) return;
  if (::fcntl(descriptor_, F_SETLK, &lock) == 0) {
    ::futimens(descriptor_, nullptr);  // the work begins now
    return;
  }
  if (errno != EACCES && errno != EAGAIN) return;
  ::close(descriptor_);
  throw InputError(option_problem("out", folder, "a folder in which no other process works",
                                  "another does: wait for its end, or stop it"));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

pid_t working_in(const std::string& folder) {
  const int descriptor = ::open(lock_file(folder).c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return 0;
  struct flock lock = whole();
  const bool known = ::fcntl(descriptor, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(descriptor);
  return known ? lock.l_pid : 0;
}

double seconds_since_lock(const std::string& folder) {
  std::error_code none;
  const auto begun = std::filesystem::last_write_time(lock_file(folder), none);
  if (none) return 0.0;
  const std::chrono::duration<double> worked = std::filesystem::file_time_type::clock::now() - begun;
  return std::max(0.0, worked.count());
}

}  // namespace phy::jobs
