// Files and folders as the system has them. Names are UTF-8. What fails leaves its reason in errno; io/ puts
// it into words.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace phy::system {

enum class Kind { file, folder, pipe, socket, device };
struct About {
  Kind kind;
  std::size_t size;
  /// Disk, number there, and time of the last change: the number of a deleted file is used again.
  std::array<std::uint64_t, 4> identity;
};
std::optional<About> about(const std::string& path);
std::optional<About> about(int descriptor);

/// Descriptors, which no child inherits; -1: it cannot be opened. A pipe is not waited for.
int open_to_read(const std::string& path);
int open_new(const std::string& path);
/// What is written goes to the end. A link is not followed.
int open_to_append(const std::string& path);
/// To write into what is no file. ENXIO: a pipe that nobody reads yet.
int open_stream(const std::string& path);

/// For the C library, which closes it; nullptr: not to be had.
std::FILE* as_stream(int descriptor);
/// As read(2) from a place on.
std::ptrdiff_t read_at(int descriptor, char* to, std::size_t n, std::size_t from);
/// All of a text; the errno of what failed, or 0.
int write_all(int descriptor, std::string_view text);
/// The errno of what failed, or 0; 0 also where the file system has no sync.
int sync(int descriptor);
int close(int descriptor);
/// Makes names in a folder durable. File systems that cannot sync folders are left to their own guarantees.
void sync_folder(const std::string& path);

/// Until it is closed, or its process ends. Who cannot have the lock goes on without.
void lock(int descriptor);
/// A descriptor that locks a folder; -1: it has no lock.
int lock_folder(const std::string& path);
/// False also of what cannot be locked. A link is not followed.
bool lock_is_free(const std::string& path);

/// One process at a time has this lock of a file, which is made if needed; it says when it was taken.
struct ProcessLock {
  int descriptor = -1;  ///< -1: there is no such lock here
  bool of_another = false;
};
ProcessLock lock_for_process(const std::string& path);
/// The process that has it; 0: none; below 0: one of another machine.
int locked_by(const std::string& path);

void remove_file(const std::string& path);
/// Renames a file onto another, in one moment, or a folder to a name that is free; the errno of what failed,
/// or 0.
int replace(const std::string& from, const std::string& to);
/// Exchanges two names in one moment; the errno of what failed, or 0.
int exchange(const std::string& one, const std::string& other);

/// Of an errno: the disk has no more space, or none for this user.
bool is_full(int error);
bool may_write(const std::string& file);
bool may_write_in(const std::string& folder);
/// False also where the system does not say.
bool on_network(const std::string& folder);
/// A new file or folder that only this user reads, under a name that nobody can have guessed: `name` and a
/// few letters.
std::optional<std::string> passing_file(std::string name);
std::optional<std::string> passing_folder(std::string name);

}  // namespace phy::system
