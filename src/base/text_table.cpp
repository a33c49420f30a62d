#include "base/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace phy {
namespace {

constexpr std::size_t gap = 2;  // spaces between columns

std::size_t width_of(const Columns& columns) {
  std::size_t width = 0;
  // The last column has no gap behind it.
  for (const Column& c : columns) width += c.width() + gap;
  return width - gap;
}

Columns joined(Columns a, const Columns& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string render(const Columns& columns) {
  std::string text;
  const auto line = [&](auto&& cell) {
    std::string out;
    for (const Column& c : columns)
      out +=
          (c.left ? fmt::format("{:<{}}", cell(c), c.width()) : fmt::format("{:>{}}", cell(c), c.width())) +
          std::string(gap, ' ');
    // Blanks at the end would break the line of a terminal.
    text += out.substr(0, out.find_last_not_of(' ') + 1) + "\n";
  };
  line([](const Column& c) { return c.head; });
  if (std::any_of(columns.begin(), columns.end(), [](const Column& c) { return !c.unit.empty(); }))
    line([](const Column& c) { return c.unit; });
  line([&](const Column& c) {  // below sentences, which may be broken later, as long as their head
    return std::string(c.left && &c == &columns.back() ? c.head.size() : c.width(), '-');
  });
  for (std::size_t k = 0; k < columns.front().cells.size(); ++k)
    line([k](const Column& c) { return c.cells[k]; });
  return text;
}

/// Breaks one line, without its end.
std::string broken(std::string line, std::size_t width, std::size_t indent) {
  std::string text;
  while (line.size() > width) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    // The last blank that still fits.
    std::size_t space = line.rfind(' ', width);
    if (space == line.npos || space < begin) space = line.find(' ', std::max(begin, width));  // a long word
    const std::size_t next = line.find_first_not_of(' ', space);
    if (next == line.npos) break;
    text += line.substr(0, line.find_last_not_of(' ', space) + 1) + "\n";
    line = std::string(indent, ' ') + line.substr(next);
  }
  return text + line;
}

}  // namespace

std::size_t Column::width() const {
  std::size_t w = std::max(head.size(), unit.size());
  for (const std::string& c : cells) w = std::max(w, c.size());
  return w;
}

std::string text_table(const Column& label, const std::vector<Columns>& groups, int terminal_width) {
  const auto fits = [&](const Columns& c) {
    return terminal_width <= 0 || width_of(c) <= static_cast<std::size_t>(terminal_width);
  };
  std::string text;
  Columns part = {label};
  const auto end_part = [&] {
    text += (text.empty() ? "" : "\n") + render(part);
    part = {label};
  };
  for (const Columns& group : groups) {
    if (const Columns both = joined(part, group); fits(both)) {
      part = both;
      continue;
    }
    // A group stays together where it can; else it begins a table of its own.
    if (part.size() > 1) end_part();
    for (const Column& c : group) {
      if (part.size() > 1 && !fits(joined(part, {c}))) end_part();
      part.push_back(c);
    }
  }
  end_part();
  return text;
}

std::string wrapped(const std::string& text, int terminal_width, std::size_t indent) {
  if (terminal_width <= 0) return text;
  // On a terminal narrower than that nothing would be left beside the indent.
  const auto width = std::max(static_cast<std::size_t>(terminal_width), 2 * indent);
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    out += broken(text.substr(from, end - from), width, indent);
    if (end < text.size()) out += "\n";
    from = end + 1;
  }
  return out;
}

std::string joined_text(const std::vector<std::string>& items, const char* between, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "" : i + 1 == items.size() ? last : between) + items[i];
  return text;
}

}  // namespace phy
