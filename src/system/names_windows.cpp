#include "system/names_windows.hpp"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace phy::system {

std::wstring wide(const std::string& text) {
  const int n = static_cast<int>(text.size());
  std::wstring out(static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, text.data(), n, nullptr, 0)),
                   L'\0');
  MultiByteToWideChar(CP_UTF8, 0, text.data(), n, out.data(), static_cast<int>(out.size()));
  return out;
}

std::string narrow(const wchar_t* text) {
  const int n = WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  std::string out(static_cast<std::size_t>(n), '\0');
  WideCharToMultiByte(CP_UTF8, 0, text, -1, out.data(), n, nullptr, nullptr);
  out.pop_back();  // the zero at the end
  return out;
}

std::wstring variable(const wchar_t* name) {
  const wchar_t* value = ::_wgetenv(name);
  return value != nullptr ? value : L"";
}

int last_error() {
  const DWORD error = GetLastError();
  if (error == ERROR_SHARING_VIOLATION || error == ERROR_LOCK_VIOLATION) return EACCES;
  if (error == ERROR_INVALID_NAME || error == ERROR_BAD_NETPATH) return ENOENT;
  const auto condition = std::system_category().default_error_condition(static_cast<int>(error));
  return condition.category() == std::generic_category() ? condition.value() : EIO;
}

std::wstring event_of(int process) { return L"Local\\phyllite-end-" + std::to_wstring(process); }

}  // namespace phy::system
