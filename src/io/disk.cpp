#include "io/disk.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/check.hpp"
#include "base/option.hpp"

namespace phy::io {

namespace fs = std::filesystem;

int write_all(int fd, const std::string& text) {
  // A write may be partial, or interrupted by a signal: both go on where they stopped.
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(fd, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) return errno;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return 0;
}

[[noreturn]] void fail(const std::string& path, const std::string& doing, int error) {
  const bool reading = doing == "be read";
  std::string remedy;
  // What to do depends on why it failed; the text of the system says the rest.
  if (error == ENOENT) remedy = "; check the name";
  if (error == EFBIG && !reading) remedy = "; it is beyond the limit of a file's size (ulimit -f)";
  if (error == EISDIR) remedy = "; name a file, not a folder";
  if (error == ENOSPC || error == EDQUOT)
    remedy = "; free some space, or choose another folder with " + option("out");
  if (error == EACCES || error == EROFS || error == EPERM)
    remedy = std::string("; check the permissions") +
             (reading ? "" : ", or choose a folder of your own with " + option("out"));
  if (error == EEXIST || error == ENOTDIR)
    remedy = reading ? "; name a folder, not a file"
                     : "; a file of that name is in the way: move it, or use another " + option("out");
  throw IoError(path + ": cannot " + doing + ": " + std::strerror(error) + remedy);
}

int write_and_close(int fd, const std::string& content) {
  int error = write_all(fd, content);
  // Synced before it is renamed: else a power cut could leave the new name with no content. EINVAL: the file
  // system has no sync.
  if (error == 0 && ::fsync(fd) != 0 && errno != EINVAL) error = errno;
  // Some network file systems report a full disk only on closing.
  if (::close(fd) != 0 && error == 0) error = errno;
  return error;
}

int open_new(const std::string& real) {
  ::unlink(real.c_str());
  return ::open(real.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
}

void write_synced(const std::string& real, const std::string& path, const std::string& content) {
  const int fd = open_new(real);
  if (fd < 0) fail(path, "be written", errno);
  ::flock(fd, LOCK_EX | LOCK_NB);  // until it is closed: not left over
  const int error = write_and_close(fd, content);
  if (error == 0) return;
  // No half file stays, not even under its temporary name.
  ::unlink(real.c_str());
  fail(path, "be written", error);
}

void sync_folder(const std::string& path) {
  const int fd = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

std::string parent_of(const std::string& path) { return fs::path(path).parent_path().string(); }

std::string beside(const std::string& path, const char* what) {
  return path + temporary_mark + what + "-" + std::to_string(::gettid());
}

}  // namespace phy::io
