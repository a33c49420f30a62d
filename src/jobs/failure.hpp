// Failures of the system in the words of this program.
#pragma once
#include <filesystem>
#include <string>

namespace phy::jobs {

inline std::string in_words(const std::filesystem::filesystem_error& e) {
  return e.path1().string() + ": " + e.code().message() + "; allow access to it, or choose another place";
}
constexpr const char* internal = "internal error, please report it: ";

}  // namespace phy::jobs
