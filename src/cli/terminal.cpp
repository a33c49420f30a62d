#include "cli/terminal.hpp"

#include <cerrno>
#include <cstdio>
#include <string>

#include "base/quote.hpp"

namespace phy::cli {
namespace {

int first_error = 0;  // of standard output

// The first error is the cause; later ones often say only that the stream is broken.
void note(bool written) {
  // The C library need not set errno when a write fails.
  if (!written && first_error == 0) first_error = errno != 0 ? errno : EIO;
}

}  // namespace

void write_out(std::string_view text) {
  const std::string safe = terminal_text(text);
  errno = 0;
  note(std::fwrite(safe.data(), 1, safe.size(), stdout) == safe.size());
}

// Progress that cannot be shown must not end hours of tests: no error is kept.
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
