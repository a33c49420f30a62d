#include "io/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

#include "base/check.hpp"
#include "io/disk.hpp"
#include "io/reads.hpp"

namespace phy::io {

namespace {

namespace fs = std::filesystem;
constexpr std::chrono::seconds patience_for_reader{5};  // of a pipe

/// Opened without waiting, and then as usual: who reads may be slower than who writes.
int open_stream(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const int fd = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (fd >= 0) {
      ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) & ~O_NONBLOCK);
      return fd;
    }
    if (errno != ENXIO || std::chrono::steady_clock::now() - start > patience_for_reader) return -1;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// "4 MB", and of what is more never less than a limit that it exceeds.
std::string megabytes(std::size_t bytes) {
  constexpr std::size_t one = 1U << 20U;
  return std::to_string((bytes + one - 1) / one) + " MB";
}

/// The number of the thread that a temporary name tells; "" of other names.
std::string thread_in(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  const std::size_t mark = name.find(temporary_mark), number = name.rfind('-') + 1;
  const std::size_t end = std::min(name.find_first_not_of("0123456789", number), name.size());
  // Of a picture the ending stands behind it (io/program.hpp).
  const bool ours = mark != name.npos && end > number && (end == name.size() || name[end] == '.');
  return ours ? name.substr(number, end - number) : "";
}

/// True where nobody is at it any more. What cannot be locked is left alone.
bool is_left_over(const std::string& path) {
  const std::string thread = thread_in(path);
  std::error_code none;
  if (thread.empty() || fs::exists("/proc/" + thread, none)) return false;
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0) return false;
  const bool free = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  ::close(fd);
  return free;
}

/// Files that have been read, by device, inode and time. The time, because the inode number of a deleted file
/// is used again.
class FilesRead {
 public:
  void add(const struct stat& s) {
    const std::lock_guard lock(mutex_);
    files_.insert(key(s));
  }
  bool has(const struct stat& s) {
    const std::lock_guard lock(mutex_);
    return files_.contains(key(s));
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    files_.clear();
  }

 private:
  using Key = std::tuple<dev_t, ino_t, time_t, long>;
  static Key key(const struct stat& s) { return {s.st_dev, s.st_ino, s.st_mtim.tv_sec, s.st_mtim.tv_nsec}; }
  std::mutex mutex_;
  std::set<Key> files_;
} files_read;

[[noreturn]] void refuse_kind(const std::string& path, mode_t mode) {
  if (S_ISDIR(mode)) fail(path, "be read", EISDIR);
  const char* kind = S_ISFIFO(mode) ? "a named pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
  throw IoError(path + ": cannot be read: it is " + kind + ", not a file; name a file");
}

std::string content_of(const std::string& path, std::size_t largest) {
  const InputFile file(path);
  if (file.size() > largest)
    throw IoError(path + ": cannot be read: it has " + megabytes(file.size()) + ", and the limit is " +
                  megabytes(largest) + "; name another file");
  return file.read(0, file.size());
}

}  // namespace

InputFile::InputFile(std::string path) : path_(std::move(path)) {
  // Looked at before it is opened, which alone has effects on some devices; and after, as it may have
  // changed.
  refuse_unless_file(path_);
  fd_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (fd_ < 0) fail(path_, "be read", errno);
  struct stat about {};
  const int error = ::fstat(fd_, &about) != 0 ? errno : 0;
  size_ = static_cast<std::size_t>(about.st_size);
  if (error == 0 && S_ISREG(about.st_mode)) return;
  ::close(fd_);
  error != 0 ? fail(path_, "be read", error) : refuse_kind(path_, about.st_mode);
}

InputFile::~InputFile() {
  if (fd_ >= 0) ::close(fd_);
}

std::string InputFile::read(std::size_t from, std::size_t n) const {
  std::string content(std::min(n, from < size_ ? size_ - from : 0), '\0');
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t some =
        ::pread(fd_, content.data() + done, content.size() - done, static_cast<off_t>(from + done));
    if (some == 0) break;  // it has become shorter
    if (some > 0) done += static_cast<std::size_t>(some);
    if (some < 0 && errno != EINTR) fail(path_, "be read", errno);
  }
  content.resize(done);
  return content;
}

void refuse_unless_file(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) == 0 && !S_ISREG(about.st_mode)) refuse_kind(path, about.st_mode);
}

std::string read_file(const std::string& path, std::size_t largest) {
  std::string content = content_of(path, largest);
  // Noted by identity and not by name: outputs must not replace an input through a link (io/output.hpp).
  if (struct stat about{}; ::stat(path.c_str(), &about) == 0) files_read.add(about);
  return content;
}

std::optional<std::string> read_if_file(const std::string& path, std::size_t largest) {
  try {
    return content_of(path, largest);
  } catch (const IoError&) {
    return std::nullopt;
  }
}

void forget_reads() { files_read.clear(); }

bool was_read(const std::string& path) {
  struct stat about {};
  return ::stat(path.c_str(), &about) == 0 && files_read.has(about);
}

std::vector<std::string> list_folder(const std::string& path) {
  std::vector<std::string> entries;
  std::error_code error;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
    entries.push_back(entry->path().string());
  if (error) fail(path, "be read", error.value());
  // The order of a directory is arbitrary; results must not depend on it.
  std::sort(entries.begin(), entries.end());
  return entries;
}

bool is_temporary(const std::string& path) { return !thread_in(path).empty(); }

void remove_leftovers(const std::string& folder) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    if (std::error_code kept; is_left_over(entry->path().string())) fs::remove_all(entry->path(), kept);
}

void make_folder(const std::string& path) {
  if (path.empty()) return;
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail(path, "be created", error.value());
  // The name may be taken by a file: create_directories does not complain about that.
  if (!fs::is_directory(path, error)) fail(path, "be used as a folder", ENOTDIR);
}

bool is_stream(const std::string& path) {
  struct stat s {};
  // Everything that exists and is neither file nor folder: devices, pipes, sockets.
  return path == "/dev/stdout" || path == "/dev/stderr" || path.starts_with("/dev/fd/") ||
         (::stat(path.c_str(), &s) == 0 && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode));
}

void write_stream(const std::string& path, const std::string& content) {
  const int fd = open_stream(path);
  if (fd < 0 && errno == ENXIO)
    throw IoError(path + ": cannot be written: it is a pipe that nobody reads; read it, or name a file");
  const int error = fd < 0 ? errno : write_and_close(fd, content);
  if (error != 0) fail(path, "be written", error);
}

void write_passing(const std::string& path, const std::string& content) {
  const std::string part = beside(path, "part");
  const int fd = open_new(part);
  if (fd < 0) return;
  const bool whole = write_all(fd, content) == 0;
  ::close(fd);
  if (!whole || std::rename(part.c_str(), path.c_str()) != 0) ::unlink(part.c_str());
}

void write_file(const std::string& path, const std::string& content) {
  make_folder(parent_of(path));
  // Beside its place: only within one file system is a rename atomic.
  const std::string part = beside(path, "part");
  write_synced(part, path, content);
  if (std::rename(part.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(part.c_str());
    fail(path, "be replaced", error);
  }
  sync_folder(parent_of(path));
}

void check_writable(const std::string& folder) {
  make_folder(folder);
  // Tried out, as permissions do not show quotas, full disks or read-only mounts.
  remove_leftovers(folder);
  const std::string probe = beside((fs::path(folder) / "").string(), "test");
  write_synced(probe, "folder " + folder, "phyllite\n");
  ::unlink(probe.c_str());
}

}  // namespace phy::io
