// The terminal, and what its user or the system tells a program to do.
#pragma once
#include <atomic>

namespace phy::system {

constexpr int standard_output = 1, standard_error = 2;

/// Zeros where there is no terminal, or none that says how large it is.
struct TerminalSize {
  int columns = 0, lines = 0;
};
bool is_terminal(int descriptor);
TerminalSize terminal_size(int descriptor);
/// Whether what people type commands into is a shell of POSIX.
bool has_posix_shell();

/// Before anything else is opened. Gives descriptors 0, 1 and 2 that came closed to nobody: the next file
/// would get their number, and be printed into. A closed pipe is an error of writing from here on, no signal,
/// and so is a file beyond the limit of its size (ulimit -f).
void guard_standard_streams();

/// From the first call on, Ctrl-C, what batch systems and `kill` send, and a terminal that closes set the
/// flag that is returned. The second one ends the program, as it would have without this.
const std::atomic<bool>& stop_requested();

}  // namespace phy::system
