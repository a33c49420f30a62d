#include "report/calibration_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "report/words.hpp"

namespace phy::report {
const Comparison& judged(const Calibration& c, const Comparison& fitted) {
  const Comparison* unseen = row_of(c.verification, fitted.target);
  // A calibration that was stopped has no verification; then the fit is all there is.
  return unseen != nullptr ? *unseen : fitted;
}

std::string open_parameters(const Calibration& c) {
  std::vector<std::string> open;
  for (const ParameterEstimate& e : c.parameters)
    if (e.open()) open.push_back(e.symbol);
  return list_text(open);
}

std::vector<std::string> other_tests(const Calibration& c, const std::array<const char*, 3>& words) {
  // Kinds of test as the table has them: "tension" would be untrue of a rock that was only sheared.
  const bool bends = has_tests_of(c, Part::toughness), shears = has_tests_of(c, Part::bedding);
  std::vector<std::string> some;
  if (has_tests_of(c, Part::tension) || !shears) some.emplace_back(words[0]);
  if (bends) some.emplace_back(words[1]);
  if (shears) some.emplace_back(words[2]);
  return some;
}

std::vector<std::string> open_lines(const Calibration& c) {
  std::vector<std::pair<std::string, std::vector<std::string>>>
      open;  // by the test that would determine them
  for (const ParameterEstimate& e : c.parameters) {
    if (!e.open()) continue;
    auto at =
        // By test: a reader plans a campaign, not parameters, and one test may settle several.
        std::find_if(open.begin(), open.end(), [&](const auto& o) { return o.first == text_of(e.next); });
    if (at == open.end()) at = open.insert(at, {text_of(e.next), {}});
    at->second.push_back(e.symbol);
  }
  std::vector<std::string> lines;
  for (const auto& [test, symbols] : open)
    lines.push_back(fmt::format("{}: not determined by this table; {}.", list_text(symbols),
                                test.empty() ? "no test of a table would" : "next: " + test));
  return lines;
}

}  // namespace phy::report
