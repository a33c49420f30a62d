#include "cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/clock.hpp"
#include "base/quote.hpp"
#include "cli/terminal.hpp"
#include "system/terminal.hpp"

namespace phy::cli {
namespace {

/// A line that fills the terminal would push the cursor onto the next one.
std::size_t line_columns() {
  const int columns = system::terminal_size(system::standard_error).columns;
  // Standard error may be a terminal of unknown size; 79 fits everywhere.
  return static_cast<std::size_t>(columns > 1 ? columns - 1 : 79);
}

/// Of the first letters of a text: a cut inside one would show as rubbish.
std::size_t bytes_of(std::string_view text, std::size_t letters) {
  std::size_t end = 0;
  for (std::size_t n = 0; n < letters && end < text.size(); ++n)
    end += std::max<std::size_t>(1, utf8_length(text.substr(end)));
  return std::min(end, text.size());
}

// On a terminal the eye follows five drawings a second; a log of hours should stay readable.
constexpr double between_drawings = 0.2, between_lines = 10.0;  // [s] on a terminal, on a pipe

}  // namespace

ProgressLine::ProgressLine()
    : terminal_(system::is_terminal(system::standard_error)), start_(Clock::now()), shown_(start_) {}

void ProgressLine::show(const std::function<std::string(double)>& say) {
  if (seconds_since(shown_) < (terminal_ ? between_drawings : between_lines)) return;
  shown_ = Clock::now();
  // Names of recipes are in it, and must not reach the terminal as control sequences.
  std::string text = terminal_text(stage_ + say(seconds_since(start_)));
  stage_.clear();
  if (terminal_) {
    text.resize(bytes_of(text, line_columns()));
    clear();
    draw_lines();
    write_err(text);
  } else {
    write_err(text + "\n");
  }
}

void ProgressLine::clear() {
  if (!terminal_) return;
  if (n_drawn_ > 0) write_err(fmt::format("\033[{}A", n_drawn_));
  // To the end of the screen, not of the line: the cursor stands above the picture now.
  write_err("\r\033[J");
  n_drawn_ = 0;
}

void ProgressLine::draw_lines() {
  // A log has no cursor to go back with: the picture would stand in it hundreds of times.
  if (!terminal_ || !lines_) return;
  for (const std::string& line : lines_()) {
    write_err(line + "\n");
    ++n_drawn_;
  }
}

void ProgressLine::note(const std::string& text) {
  clear();
  const std::string safe = terminal_text(text);
  write_err((terminal_ ? wrapped(safe, static_cast<int>(line_columns()), 2) : safe) + "\n");
}

void ProgressLine::stage(const std::string& text) {
  if (terminal_) return note(text);
  if (stage_.find(text + "; ") == std::string::npos) stage_ += text + "; ";  // some come round again
  if (shown_ != start_ && seconds_since(shown_) < between_lines) return;     // the first is told at once
  tell_stages();
}

void ProgressLine::tell_stages() {
  if (stage_.empty()) return;
  note(stage_.substr(0, stage_.size() - 2));
  shown_ = Clock::now(), stage_.clear();
}

void ProgressLine::finish() {
  tell_stages();
  clear();
  draw_lines();
  n_drawn_ = 0;  // what stands now stays
}

}  // namespace phy::cli
