#include "io/disk.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/check.hpp"
#include "system/files.hpp"
#include "system/process.hpp"

namespace phy::io {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& doing, int error) {
  const bool reading = doing == "be read";
  std::string remedy;
  // What to do depends on why it failed; the text of the system says the rest.
  if (error == ENOENT) remedy = "; check the name";
  if (error == EFBIG && !reading) remedy = "; it is beyond the limit of a file's size (ulimit -f)";
  if (error == EISDIR) remedy = "; name a file, not a folder";
  if (system::is_full(error)) remedy = "; free some space, or choose another folder";
  if (error == EACCES || error == EROFS || error == EPERM)
    remedy = reading ? "; check the permissions" : "; check the permissions, or choose a folder of your own";
  if (error == EEXIST || error == ENOTDIR)
    remedy = reading ? "; name a folder, not a file"
                     : "; a file of that name is in the way: move it, or choose another name";
  throw IoError(path + ": cannot " + doing + ": " + std::strerror(error) + remedy);
}

[[noreturn]] void fail(const std::string& path, const std::string& doing, const std::error_code& error) {
  fail(path, doing, error.default_error_condition().value());  // which is an errno on every system
}

int write_and_close(int fd, const std::string& content) {
  int error = system::write_all(fd, content);
  // Synced before it is renamed: else a power cut could leave the new name with no content.
  if (error == 0) error = system::sync(fd);
  // Some network file systems report a full disk only on closing.
  if (system::close(fd) != 0 && error == 0) error = errno;
  return error;
}

int open_new(const std::string& real) {
  system::remove_file(real);
  return system::open_new(real);
}

void write_synced(const std::string& real, const std::string& path, const std::string& content) {
  const int fd = open_new(real);
  if (fd < 0) fail(path, "be written", errno);
  system::lock(fd);  // until it is closed: not left over
  const int error = write_and_close(fd, content);
  if (error == 0) return;
  // No half file stays, not even under its temporary name.
  system::remove_file(real);
  fail(path, "be written", error);
}

std::string parent_of(const std::string& path) { return fs::path(path).parent_path().string(); }

std::string beside(const std::string& path, const char* what) {
  return path + temporary_mark + what + "-" + std::to_string(system::thread_number());
}

}  // namespace phy::io
