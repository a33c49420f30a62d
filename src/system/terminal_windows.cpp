#include <fcntl.h>
#include <io.h>

#include <cstdio>
#include <thread>

#include "system/names_windows.hpp"
#include "system/process.hpp"
#include "system/terminal.hpp"

namespace phy::system {
namespace {

constexpr DWORD before_it_is_ended = 5000;  // [ms] that Windows leaves a program whose console closes

std::atomic<bool> stopped{false};

/// Called on a thread of its own. False: as without this, which ends the program.
BOOL WINAPI on_event(DWORD event) {
  const bool first = !stopped.exchange(true);
  if (event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT) return first;
  Sleep(before_it_is_ended);  // the console closes or the user leaves: it ends as soon as this returns
  return TRUE;
}

/// Until the program ends.
void wait_to_be_asked(HANDLE event) {
  while (WaitForSingleObject(event, INFINITE) == WAIT_OBJECT_0) {
    if (on_event(CTRL_BREAK_EVENT) == FALSE) ExitProcess(static_cast<UINT>(STATUS_CONTROL_C_EXIT));
  }
}

bool catch_events() {
  SetConsoleCtrlHandler(on_event, TRUE);
  const HANDLE event = CreateEventW(nullptr, FALSE, FALSE, event_of(process_number()).c_str());
  if (event != nullptr) std::thread(wait_to_be_asked, event).detach();
  return true;
}

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

}  // namespace

bool is_terminal(int descriptor) {
  DWORD mode = 0;
  return GetConsoleMode(handle_of(descriptor), &mode);
}

TerminalSize terminal_size(int descriptor) {
  CONSOLE_SCREEN_BUFFER_INFO about{};
  if (!GetConsoleScreenBufferInfo(handle_of(descriptor), &about)) return {};
  const SMALL_RECT& w = about.srWindow;
  return {w.Right - w.Left + 1, w.Bottom - w.Top + 1};
}

bool has_posix_shell() { return false; }

// Bytes as they are, for consoles and files alike: UTF-8, lines that end as everywhere else, colours.
void guard_standard_streams() {
  for (const int fd : {0, 1, 2}) ::_setmode(fd, _O_BINARY);
  SetConsoleOutputCP(CP_UTF8);
  for (const int fd : {standard_output, standard_error}) {
    DWORD mode = 0;
    if (GetConsoleMode(handle_of(fd), &mode))
      SetConsoleMode(handle_of(fd), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
  }
}

const std::atomic<bool>& stop_requested() {
  static const bool once = catch_events();
  static_cast<void>(once);
  return stopped;
}

}  // namespace phy::system
