#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "system/terminal.hpp"

namespace phy::system {
namespace {

std::atomic<bool> stopped{false};

/// Not SIGHUP twice: of a terminal that closes, kernel and shell both tell.
void on_signal(int signal) {
  // Only flags and signals here: nothing else is allowed in a handler.
  if (!stopped.exchange(true) || signal == SIGHUP) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Under nohup SIGHUP comes ignored, and stays so.
bool catch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (signal != SIGHUP || action.sa_handler != SIG_IGN) std::signal(signal, on_signal);
  }
  return true;
}

}  // namespace

bool is_terminal(int descriptor) { return isatty(descriptor) != 0; }

TerminalSize terminal_size(int descriptor) {
  winsize size{};
  if (!is_terminal(descriptor) || ioctl(descriptor, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col, size.ws_row};
}

bool has_posix_shell() { return true; }

// /dev/null the wrong way round: reading and writing fail as they would have on the closed descriptor.
void guard_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(fd, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& stop_requested() {
  static const bool once = catch_signals();
  static_cast<void>(once);
  return stopped;
}

}  // namespace phy::system
