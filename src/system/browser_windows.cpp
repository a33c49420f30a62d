#include <cstdint>

#include "system/browser.hpp"
#include "system/names_windows.hpp"

#include <shellapi.h>

namespace phy::system {

bool has_desktop() { return variable(L"SSH_CONNECTION").empty(); }

bool open_in_browser(const std::string& what) {
  constexpr std::intptr_t last_refusal = 32;  // what it returns is a number and no handle (Microsoft)
  const HINSTANCE answer =
      ShellExecuteW(nullptr, L"open", wide(what).c_str(), nullptr, nullptr, SW_SHOWNORMAL);
  return reinterpret_cast<std::intptr_t>(answer) > last_refusal;
}

}  // namespace phy::system
