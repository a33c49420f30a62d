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
#include <thread>
#include <tuple>
#include <utility>

#include "base/check.hpp"
#include "base/option.hpp"
#include "io/output.hpp"
#include "io/reads.hpp"

namespace phy::io {

int write_all(int fd, const std::string& text) {
  // A write may be partial, or interrupted by a signal: both go on where they stopped.
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(fd, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) return errno;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return 0;
}

namespace {

namespace fs = std::filesystem;
constexpr const char* temporary_mark = ".phyllite-";
constexpr std::chrono::seconds patience_for_reader{5};  // of a pipe

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

/// Writes, syncs and closes; the errno of what failed, or 0.
int write_and_close(int fd, const std::string& content) {
  int error = write_all(fd, content);
  // Synced before it is renamed: else a power cut could leave the new name with no content. EINVAL: the file
  // system has no sync.
  if (error == 0 && ::fsync(fd) != 0 && errno != EINVAL) error = errno;
  // Some network file systems report a full disk only on closing.
  if (::close(fd) != 0 && error == 0) error = errno;
  return error;
}

/// A new file under a temporary name; whatever stands there is not opened, but goes.
int open_new(const std::string& real) {
  ::unlink(real.c_str());
  return ::open(real.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
}

/// `path` is what the user knows the file by, `real` where it is written.
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

/// Makes names in a folder durable. File systems that cannot sync folders are left to their own guarantees.
void sync_folder(const std::string& path) {
  const int fd = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

/// "4 MB", and of what is more never less than a limit that it exceeds.
std::string megabytes(std::size_t bytes) {
  constexpr std::size_t one = 1U << 20U;
  return std::to_string((bytes + one - 1) / one) + " MB";
}

std::string parent_of(const std::string& path) { return fs::path(path).parent_path().string(); }
/// A temporary name that no other thread of any process has: the number of the thread, in the first one that
/// of the process.
std::string beside(const std::string& path, const char* what) {
  return path + temporary_mark + what + "-" + std::to_string(::gettid());
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
  write_synced(probe, folder, "phyllite\n");
  ::unlink(probe.c_str());
}

void check_place(const std::string& folder, const std::string& mark, const std::string& kind) {
  std::error_code none;
  // Symbolic links are not followed: a dangling one also occupies the name.
  if (!fs::exists(fs::symlink_status(folder, none))) return;
  if (!fs::is_directory(folder, none)) fail(folder, "be replaced", ENOTDIR);
  if (fs::is_empty(folder, none)) return;
  if (!fs::exists(fs::path(folder) / mark, none))
    throw IoError(folder + ": cannot be replaced: the folder holds no " + kind + " (no " + mark +
                  "); move it, or use another " + option("out"));
  if (!fs::exists(fs::path(folder) / written_list, none)) return;  // made before there were lists
  // Every file in it has to be ours and unchanged: the folder is replaced as a whole.
  for (fs::recursive_directory_iterator entry(folder, none), end; entry != end; entry.increment(none)) {
    const std::string name = entry->path().lexically_relative(folder).string();
    if (name != written_list && (entry->is_symlink(none) || !entry->is_directory(none)) &&
        !is_as_written(folder, name))
      throw IoError(entry->path().string() + ": stands in a " + kind +
                    " that would be replaced, and is not as this program left it; move it away, or use "
                    "another " +
                    option("out"));
  }
}

void remove_folder(const std::string& path) {
  // Renamed first: readers see the whole folder or none, though deleting takes time.
  const std::string old = beside(path, "old");
  std::error_code error;
  fs::rename(path, old, error);
  if (!error) fs::remove_all(old, error);
  if (error) fail(path, "be removed", error.value());
}

NewFolder::NewFolder(std::string folder, std::string mark, std::string kind)
    : folder_(std::move(folder)), mark_(std::move(mark)), kind_(std::move(kind)) {
  while (folder_.size() > 1 && folder_.back() == '/')
    folder_.pop_back();  // the part lies beside x/, not in it
  part_ = beside(folder_, "part");
  check_place(folder_, mark_, kind_);
  make_folder(parent_of(folder_));
  remove_leftovers(parent_of(folder_));
  // Left behind by a process of the same number that was killed.
  std::error_code ignored;
  fs::remove_all(part_, ignored);
  make_folder(part_);
  lock_ = ::open(part_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
}

NewFolder::~NewFolder() {
  if (lock_ >= 0) ::close(lock_);
  std::error_code ignored;
  fs::remove_all(part_, ignored);
}

void NewFolder::add(const std::string& name, const std::string& content) {
  const std::string real = (fs::path(part_) / name).string();
  make_folder(parent_of(real));
  // Errors name the final place, which the user knows.
  write_synced(real, (fs::path(folder_) / name).string(), content);
  folders_.insert(parent_of(real));
  list_ += list_line(name, content);
}

void NewFolder::publish() {
  write_synced((fs::path(part_) / written_list).string(), (fs::path(folder_) / written_list).string(), list_);
  for (const std::string& name : folders_) sync_folder(name);
  // Again: something may have been put there while the files were made.
  check_place(folder_, mark_, kind_);
  // An exchange leaves no moment without a result; the older one then has the temporary name and is removed.
  if (::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, folder_.c_str(), RENAME_EXCHANGE) != 0) {
    const bool older = errno != ENOENT;  // some file systems cannot exchange: step aside, then move in
    const std::string old = beside(folder_, "old");
    std::error_code error;
    if (older) fs::rename(folder_, old, error);
    if (!error) fs::rename(part_, folder_, error);
    if (error) {
      std::error_code ignored;
      // The older result goes back where the new one cannot take its place.
      if (older && !fs::exists(folder_, ignored)) fs::rename(old, folder_, ignored);
      fail(folder_, "be replaced", error.value());
    }
    fs::remove_all(old, error);
  }
  sync_folder(parent_of(folder_));
}

}  // namespace phy::io
