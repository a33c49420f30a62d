#include "cli/terminal.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>

#include "base/quote.hpp"

namespace phy::cli {
namespace {

int first_error = 0;  // of standard output

void note(bool written) {
  if (!written && first_error == 0) first_error = errno != 0 ? errno : EIO;
}

}  // namespace

TerminalSize terminal_size(int file_descriptor) {
  winsize size{};
  if (isatty(file_descriptor) == 0 || ioctl(file_descriptor, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col, size.ws_row};
}

// /dev/null the wrong way round: reading and writing fail as they would have on the closed descriptor.
void guard_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(fd, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void write_out(std::string_view text) {
  const std::string safe = terminal_text(text);
  errno = 0;
  note(std::fwrite(safe.data(), 1, safe.size(), stdout) == safe.size());
}

void write_err(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void flush_out() {
  errno = 0;
  note(std::fflush(stdout) == 0);
}

int lost_output() {
  flush_out();
  note(std::ferror(stdout) == 0);  // of what the parser of the command line has printed
  return first_error;
}

void print_notes(const std::vector<std::string>& notes, int terminal_width) {
  for (const std::string& note : notes) print_wrapped(terminal_width, 10, "          {}\n", note);
}

}  // namespace phy::cli
