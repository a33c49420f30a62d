#include <string>
#include <vector>

#include "system/links.hpp"
#include "system/names_windows.hpp"

// libstdc++ knows no links on Windows: std::filesystem::canonical() leaves a junction, which everybody may
// make, as it is.
namespace phy::system {
namespace {

/// Of the form without limit of length, which Windows answers with and std::filesystem cannot compare.
std::filesystem::path usual(std::wstring name) {
  if (name.starts_with(LR"(\\?\UNC\)")) return LR"(\\)" + name.substr(8);
  return name.starts_with(LR"(\\?\)") ? name.substr(4) : name;
}

}  // namespace

std::optional<std::filesystem::path> followed(const std::filesystem::path& path) {
  constexpr DWORD most = 32768;  // characters of a long path
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(path, error).lexically_normal(), rest;
  if (!there.has_filename()) there = there.parent_path();  // a separator at the end
  std::vector<wchar_t> name(most);
  while (!error && !there.empty()) {
    const Handle handle(CreateFileW(there.c_str(), 0, share_all, nullptr, OPEN_EXISTING,
                                    FILE_FLAG_BACKUP_SEMANTICS, nullptr));
    const DWORD n = handle ? GetFinalPathNameByHandleW(handle.get(), name.data(), most, 0) : 0;
    if (n > 0 && n < most) return rest.empty() ? usual({name.data(), n}) : usual({name.data(), n}) / rest;
    if (!there.has_relative_path()) break;
    rest = rest.empty() ? there.filename() : there.filename() / rest;
    there = there.parent_path();
  }
  return std::nullopt;
}

}  // namespace phy::system
