// The terminal behind standard output and standard error, and the only place that writes to them.
//
// Nothing here throws: an output that is full or closed ends no test. What standard output could not take is
// remembered, and main() tells it by the exit code; standard error carries progress and messages, which are
// dropped where nobody can read them.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text_table.hpp"

namespace phy::cli {

/// Text to standard output: names and messages of others in it cannot act on the terminal (base/quote.hpp).
void write_out(std::string_view text);
/// Text to standard error as it is, with the control sequences of progress: what others wrote goes through
/// terminal_text first.
void write_err(std::string_view text);
/// What is printed stands where the user looks, from here on.
void flush_out();
/// Flushes. The errno of the first text that standard output could not take; 0: it took all.
int lost_output();

/// Prints to standard output.
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  write_out(fmt::vformat(format, fmt::make_format_args(values...)));
}

/// Prints one line or several, broken at spaces where the terminal is narrower (0: no limit).
template <class... Values>
void print_wrapped(int terminal_width, std::size_t indent, fmt::format_string<Values...> format,
                   Values&&... values) {
  write_out(wrapped(fmt::format(format, std::forward<Values>(values)...), terminal_width, indent));
}

/// How a file was understood, below the line that names it.
void print_notes(const std::vector<std::string>& notes, int terminal_width);

}  // namespace phy::cli
