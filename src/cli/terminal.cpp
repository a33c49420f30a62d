#include "cli/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace phy {

TerminalSize terminal_size(int file_descriptor) {
  winsize size{};
  if (isatty(file_descriptor) == 0 || ioctl(file_descriptor, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col, size.ws_row};
}

}  // namespace phy
