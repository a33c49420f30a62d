// What the files of this room for Windows share. Names are UTF-8 for everyone else and UTF-16 for Windows:
// its functions for "char" take them for the code page of the machine.
#pragma once
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <string>

namespace phy::system {

std::wstring wide(const std::string& text);
std::string narrow(const wchar_t* text);
/// Of the environment; empty: not set.
std::wstring variable(const wchar_t* name);

/// The errno of what Windows has just refused.
int last_error();
/// Others may read, write, rename and delete what is open, as on other systems.
constexpr DWORD share_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/// Closes itself.
class Handle {
 public:
  explicit Handle(HANDLE handle) : handle_(handle == INVALID_HANDLE_VALUE ? nullptr : handle) {}
  ~Handle() {
    if (handle_ != nullptr) CloseHandle(handle_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  HANDLE get() const { return handle_; }
  explicit operator bool() const { return handle_ != nullptr; }

 private:
  HANDLE handle_;
};

/// The event by which a process is asked to end: a console reaches only what was started from it.
std::wstring event_of(int process);

}  // namespace phy::system
