#include <fcntl.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "system/files.hpp"

namespace phy::system {
namespace {

// From linux/magic.h and the file systems' own headers; there is no portable test for "network".
constexpr long nfs_magic = 0x6969, smb_magic = static_cast<long>(0xFE534D42UL), lustre_magic = 0x0BD00BD0L;

Kind kind_of(mode_t mode) {
  if (S_ISREG(mode)) return Kind::file;
  if (S_ISDIR(mode)) return Kind::folder;
  if (S_ISFIFO(mode)) return Kind::pipe;
  return S_ISSOCK(mode) ? Kind::socket : Kind::device;
}

About about(const struct stat& s) {
  return {kind_of(s.st_mode),
          static_cast<std::size_t>(s.st_size),
          {std::uint64_t{s.st_dev}, std::uint64_t{s.st_ino}, static_cast<std::uint64_t>(s.st_mtim.tv_sec),
           static_cast<std::uint64_t>(s.st_mtim.tv_nsec)}};
}

const char* here_if_empty(const std::string& folder) { return folder.empty() ? "." : folder.c_str(); }

}  // namespace

std::optional<About> about(const std::string& path) {
  struct stat s {};
  if (::stat(path.c_str(), &s) != 0) return std::nullopt;
  return about(s);
}

std::optional<About> about(int descriptor) {
  struct stat s {};
  if (::fstat(descriptor, &s) != 0) return std::nullopt;
  return about(s);
}

int open_to_read(const std::string& path) {
  return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

int open_new(const std::string& path) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
}

int open_to_append(const std::string& path) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
}

int open_stream(const std::string& path) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  // From here on as usual: who reads may be slower than who writes.
  if (fd >= 0) ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) & ~O_NONBLOCK);
  return fd;
}

std::FILE* as_stream(int descriptor) { return ::fdopen(descriptor, "rb"); }

std::ptrdiff_t read_at(int descriptor, char* to, std::size_t n, std::size_t from) {
  return ::pread(descriptor, to, n, static_cast<off_t>(from));
}

int write_all(int descriptor, std::string_view text) {
  // A write may be partial, or interrupted by a signal: both go on where they stopped.
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) return errno;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return 0;
}

int sync(int descriptor) { return ::fsync(descriptor) != 0 && errno != EINVAL ? errno : 0; }

int close(int descriptor) { return ::close(descriptor); }

void sync_folder(const std::string& path) {
  const int fd = ::open(here_if_empty(path), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

void remove_file(const std::string& path) { ::unlink(path.c_str()); }

bool is_full(int error) { return error == ENOSPC || error == EDQUOT; }

bool may_write(const std::string& file) { return ::access(file.c_str(), W_OK) == 0; }

bool may_write_in(const std::string& folder) { return ::access(here_if_empty(folder), W_OK | X_OK) == 0; }

bool on_network(const std::string& folder) {
  struct statfs fs {};
  if (::statfs(here_if_empty(folder), &fs) != 0) return false;
  const auto type = static_cast<long>(fs.f_type);
  return type == nfs_magic || type == smb_magic || type == lustre_magic;
}

std::optional<std::string> passing_file(std::string name) {
  name += "-XXXXXX";
  const int fd = ::mkstemp(name.data());
  if (fd < 0) return std::nullopt;
  ::close(fd);
  return name;
}

std::optional<std::string> passing_folder(std::string name) {
  name += "-XXXXXX";
  return ::mkdtemp(name.data()) != nullptr ? std::optional(name) : std::nullopt;
}

}  // namespace phy::system
