// One line of progress on a terminal; plain lines, and few of them, elsewhere. Written to standard error.
#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace phy::cli {

class ProgressLine {
 public:
  ProgressLine();
  /// Shows `say(seconds since the start)` unless the last update was a moment ago.
  void show(const std::function<std::string(double)>& say);
  /// Lines to be drawn above the line of progress on a terminal, asked for with every drawing. The last ones
  /// stay.
  void draw_above(std::function<std::vector<std::string>()> lines) { lines_ = std::move(lines); }
  /// A message that stays.
  void note(const std::string& text);
  /// What begins now: a message on a terminal; on a pipe it may wait for the next line, so that there is one
  /// in ten seconds at most.
  void stage(const std::string& text);
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void clear();
  void draw_lines();
  void tell_stages();
  bool terminal_;            // asked once; its width with every line
  std::size_t n_drawn_ = 0;  // lines above
  std::string stage_;        // not told yet, each with "; " behind it
  std::function<std::vector<std::string>()> lines_;
  Clock::time_point start_, shown_;  // alike until a line is shown
};

}  // namespace phy::cli
