#include "io/file.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "base/check.hpp"
#include "io/disk.hpp"
#include "io/reads.hpp"
#include "system/files.hpp"
#include "system/process.hpp"

namespace phy::io {

namespace {

namespace fs = std::filesystem;
constexpr std::chrono::seconds patience_for_reader{5};  // of a pipe

int open_stream(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const int fd = system::open_stream(path);
    if (fd >= 0) return fd;
    // A reader that was started at the same time may need a moment to open its end of the pipe.
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
  return !thread.empty() && !system::thread_lives(thread) && system::lock_is_free(path);
}

/// Files that have been read.
class FilesRead {
 public:
  void add(const system::About& s) {
    const std::lock_guard lock(mutex_);
    files_.insert(s.identity);
  }
  bool has(const system::About& s) {
    const std::lock_guard lock(mutex_);
    return files_.contains(s.identity);
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    files_.clear();
  }

 private:
  std::mutex mutex_;
  std::set<decltype(system::About::identity)> files_;
} files_read;

[[noreturn]] void refuse_kind(const std::string& path, system::Kind kind_there) {
  using system::Kind;
  if (kind_there == Kind::folder) fail(path, "be read", EISDIR);
  const char* kind = kind_there == Kind::pipe     ? "a named pipe"
                     : kind_there == Kind::socket ? "a socket"
                                                  : "a device";
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
  fd_ = system::open_to_read(path_);
  if (fd_ < 0) fail(path_, "be read", errno);
  const auto about = system::about(fd_);
  const int error = about ? 0 : errno;
  if (about && about->kind == system::Kind::file) {
    size_ = about->size;
    return;
  }
  system::close(fd_);
  error != 0 ? fail(path_, "be read", error) : refuse_kind(path_, about->kind);
}

InputFile::~InputFile() {
  if (fd_ >= 0) system::close(fd_);
}

std::string InputFile::read(std::size_t from, std::size_t n) const {
  std::string content(std::min(n, from < size_ ? size_ - from : 0), '\0');
  std::size_t done = 0;
  while (done < content.size()) {
    const auto some = system::read_at(fd_, content.data() + done, content.size() - done, from + done);
    if (some == 0) break;  // it has become shorter
    if (some > 0) done += static_cast<std::size_t>(some);
    if (some < 0 && errno != EINTR) fail(path_, "be read", errno);
  }
  content.resize(done);
  return content;
}

void refuse_unless_file(const std::string& path) {
  if (const auto about = system::about(path); about && about->kind != system::Kind::file)
    refuse_kind(path, about->kind);
}

std::string read_file(const std::string& path, std::size_t largest) {
  std::string content = content_of(path, largest);
  // Noted by identity and not by name: outputs must not replace an input through a link (io/output.hpp).
  if (const auto about = system::about(path)) files_read.add(*about);
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
  const auto about = system::about(path);
  return about && files_read.has(*about);
}

std::vector<std::string> list_folder(const std::string& path) {
  std::vector<std::string> entries;
  std::error_code error;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
    entries.push_back(entry->path().string());
  if (error) fail(path, "be read", error);
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
  if (error) fail(path, "be created", error);
  // The name may be taken by a file: create_directories does not complain about that.
  if (!fs::is_directory(path, error)) fail(path, "be used as a folder", ENOTDIR);
}

bool is_stream(const std::string& path) {
  using system::Kind;
  const auto about = system::about(path);
  // Everything that exists and is neither file nor folder: devices, pipes, sockets.
  return path == "/dev/stdout" || path == "/dev/stderr" || path.starts_with("/dev/fd/") ||
         (about && about->kind != Kind::file && about->kind != Kind::folder);
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
  // Not synced: the next writing comes before a power cut could matter.
  const bool whole = system::write_all(fd, content) == 0;
  system::close(fd);
  if (!whole || system::replace(part, path) != 0) system::remove_file(part);
}

void write_file(const std::string& path, const std::string& content) {
  make_folder(parent_of(path));
  // Beside its place: only within one file system is a rename atomic.
  const std::string part = beside(path, "part");
  write_synced(part, path, content);
  if (const int error = system::replace(part, path); error != 0) {
    system::remove_file(part);
    fail(path, "be replaced", error);
  }
  system::sync_folder(parent_of(path));
}

void check_writable(const std::string& folder) {
  make_folder(folder);
  // Tried out, as permissions do not show quotas, full disks or read-only mounts.
  remove_leftovers(folder);
  const std::string probe = beside((fs::path(folder) / "").string(), "test");
  write_synced(probe, "folder " + folder, "phyllite\n");
  system::remove_file(probe);
}

}  // namespace phy::io
