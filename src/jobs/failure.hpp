// Failures of the system in the words of this program.
#pragma once
#include <filesystem>
#include <string>

namespace phy::jobs {

/// A file whose folder is closed is no use to a reader: the folder is named.
inline std::string in_words(const std::filesystem::filesystem_error& e) {
  const std::filesystem::path folder = e.path1().parent_path();
  const bool closed = e.code() == std::errc::permission_denied && !folder.empty();
  return (closed ? "folder " + folder.string() + " cannot be read and written" : e.path1().string()) + ": " +
         e.code().message() + "; allow access to it, or choose another folder";
}
constexpr const char* internal = "internal error, please report it: ";

}  // namespace phy::jobs
