#include <vector>

#include "system/links.hpp"
#include "system/names_windows.hpp"

// libstdc++ knows no links on Windows: std::filesystem::canonical() leaves a junction, which everybody may
// make, as it is.
namespace phy::system {

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
    if (n > 0 && n < most) return rest.empty() ? std::filesystem::path(name.data()) : name.data() / rest;
    if (!there.has_relative_path()) break;
    rest = rest.empty() ? there.filename() : there.filename() / rest;
    there = there.parent_path();
  }
  return std::nullopt;
}

}  // namespace phy::system
