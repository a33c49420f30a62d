#include "base/check.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

namespace phy {
namespace {

/// "recipe.toml:12" is line 12 of recipe.toml; line 0: the whole file, or no file at all.
std::pair<std::string_view, int> place_of(const Problem& p) {
  const std::string_view where = p.where;
  const std::size_t colon = std::min(where.rfind(':'), where.size());
  const char* end = where.data() + where.size();
  int line = 0;
  const bool has_line =
      colon + 1 < where.size() && std::from_chars(where.data() + colon + 1, end, line).ptr == end;
  return has_line ? std::pair(where.substr(0, colon), line) : std::pair(where, 0);
}

/// Files in the order in which they come up.
std::vector<Problem> by_line(const std::vector<Problem>& problems) {
  std::vector<std::string_view> files;
  std::vector<std::tuple<std::ptrdiff_t, int, std::size_t>> places;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const auto [file, line] = place_of(problems[i]);
    const auto known = std::find(files.begin(), files.end(), file);
    places.emplace_back(known - files.begin(), line, i);
    // Not by name: the recipe that was read first is mended first.
    if (known == files.end()) files.push_back(file);
  }
  // The place in the list breaks ties: problems of one line stay in order.
  std::sort(places.begin(), places.end());
  std::vector<Problem> sorted;
  for (const auto& place : places) sorted.push_back(problems[std::get<2>(place)]);
  return sorted;
}

/// Of a kind - one key or column of one file - the first ones, and how many more there are.
std::vector<Problem> limited(const std::vector<Problem>& problems) {
  constexpr std::size_t most = 50;
  std::map<std::pair<std::string_view, std::string>, std::size_t> counts;
  std::vector<Problem> told;
  for (const Problem& p : problems)
    // One wrong column repeats in every row of a table.
    if (++counts[{place_of(p).first, p.key}] <= most) told.push_back(p);
  for (const auto& [kind, n] : counts)
    if (n > most)
      told.push_back(
          {std::string(kind.first), kind.second, "", "", std::to_string(n - most) + " more of this kind"});
  return told;
}

std::string render(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) text += (text.empty() ? "" : "\n") + to_line(p);
  return text;
}

/// What somebody wrote, short enough to be read in a message: whole characters of UTF-8.
std::string shortened(const std::string& text) {
  constexpr std::size_t most = 200;
  if (text.size() <= most) return text;
  std::size_t end = most;
  // Back to the first byte of a character.
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "...";
}

}  // namespace

std::string to_line(const Problem& p) {
  std::string line = p.where;
  if (!p.key.empty()) line += (line.empty() ? "" : ": ") + shortened(p.key);
  if (!p.value.empty()) line += " = " + shortened(p.value);
  if (!p.expected.empty()) line += (line.empty() ? "" : ": ") + std::string("expected ") + p.expected;
  if (!p.remedy.empty()) line += (line.empty() ? "" : p.expected.empty() ? ": " : "; ") + p.remedy;
  return line;
}

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(render(problems = limited(by_line(problems)))), problems_(std::move(problems)) {}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

}  // namespace phy
