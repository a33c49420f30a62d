// Files, whole or not at all: content is written under a temporary name in the same folder, synced, and
// renamed onto its place. A reader therefore sees the old file or the new one, never a part, also after a
// power cut. Every failure is an IoError that names the file, the reason and what to do.
//
// Of a killed process the temporary names are left. They say so (".phyllite-part-" and the number of the
// thread), count for nothing, and the next process that writes into the folder removes them: those whose
// thread is no more and whose lock, which ends with its process, is free - also on a disk that other machines
// write to.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/largest_file.hpp"

namespace phy::io {

/// A file of the disk, open for reading. Whatever stands under a name may have been put there by somebody
/// else: a pipe, a device, a socket and a folder are refused at once, and nothing is waited for.
class InputFile {
 public:
  /// Throws IoError.
  explicit InputFile(std::string path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  std::size_t size() const { return size_; }
  /// At most `n` bytes from a place on; fewer where the file ends. Throws IoError.
  std::string read(std::size_t from, std::size_t n) const;
  /// The descriptor, which the caller closes from here on.
  int release() { return std::exchange(fd_, -1); }

 private:
  std::string path_;
  int fd_ = -1;
  std::size_t size_ = 0;
};

/// The content of a file as InputFile takes it. Throws IoError, also where it has more than `largest` bytes:
/// none of them is read then.
std::string read_file(const std::string& path, std::size_t largest = largest_file);

/// As read_file, of what need not be there and is no input of the program (was_read); nothing: it is not
/// there, or cannot be read.
std::optional<std::string> read_if_file(const std::string& path, std::size_t largest = largest_file);

/// Throws IoError where something else than a file stands under a name that another library will open.
void refuse_unless_file(const std::string& path);

/// Whether this process has read the file so, under whatever name: a link to it is the same file.
bool was_read(const std::string& path);

/// What a folder holds: paths, sorted.
std::vector<std::string> list_folder(const std::string& path);

/// A temporary name of this program: of something in the making, or left of a killed process.
bool is_temporary(const std::string& path);
/// Removes from a folder what killed processes have left in the making.
void remove_leftovers(const std::string& folder);

/// A device or a pipe, such as /dev/stdout: it takes text as it comes, and nothing may be put in its place.
bool is_stream(const std::string& path);

/// Writes one file whole or not at all; makes the folder if it is missing. It takes the place of whatever had
/// the name, but of a folder.
void write_file(const std::string& path, const std::string& content);

/// Writes to what is_stream(): a pipe must be read by somebody within five seconds. Throws IoError.
void write_stream(const std::string& path, const std::string& content);

/// For what is written again soon: as write_file, but not synced, and what fails is not told.
void write_passing(const std::string& path, const std::string& content);

/// Makes the folder and those above it, as far as they are missing.
void make_folder(const std::string& path);

/// Makes the folder if needed and tries to write into it, before hours of work are lost. Removes leftovers.
void check_writable(const std::string& folder);

}  // namespace phy::io
