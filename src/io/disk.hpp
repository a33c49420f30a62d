// What files and folders in the making have in common: temporary names, and content that has reached the
// disk. For the files of io alone.
#pragma once
#include <string>
#include <system_error>

namespace phy::io {

constexpr const char* temporary_mark = ".phyllite-";

/// Throws IoError with the text of the system and what to do; `doing`: "be written".
[[noreturn]] void fail(const std::string& path, const std::string& doing, int error);
[[noreturn]] void fail(const std::string& path, const std::string& doing, const std::error_code& error);

/// Writes, syncs and closes; the errno of what failed, or 0.
int write_and_close(int fd, const std::string& content);

/// A new file under a temporary name; whatever stands there is not opened, but goes.
int open_new(const std::string& real);

/// `path` is what the user knows the file by, `real` where it is written.
void write_synced(const std::string& real, const std::string& path, const std::string& content);

std::string parent_of(const std::string& path);

/// A temporary name that no other thread of any process has: the number of the thread, in the first one that
/// of the process.
std::string beside(const std::string& path, const char* what);

}  // namespace phy::io
