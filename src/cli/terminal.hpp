// The terminal behind standard output or standard error.
#pragma once
#include <fmt/format.h>

#include <utility>

#include "base/quote.hpp"
#include "report/text_table.hpp"

namespace phy {

/// Zeros where there is no terminal, or none that says how large it is.
struct TerminalSize {
  int columns = 0, lines = 0;
};
TerminalSize terminal_size(int file_descriptor);

/// Prints to standard output. Every verb prints through here: names and messages of others cannot act on the
/// terminal.
template <class... Values>
void print_text(fmt::format_string<Values...> format, Values&&... values) {
  fmt::print("{}", terminal_text(fmt::format(format, std::forward<Values>(values)...)));
}

/// Prints one line or several, broken at spaces where the terminal is narrower (0: no limit).
template <class... Values>
void print_wrapped(int terminal_width, std::size_t indent, fmt::format_string<Values...> format,
                   Values&&... values) {
  print_text("{}", wrapped(fmt::format(format, std::forward<Values>(values)...), terminal_width, indent));
}

}  // namespace phy
