// The verdict of a calibration, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/calibration_summary.hpp"
#include "report/words.hpp"

namespace phy::report {
namespace {

/// "E 1.7 %, UCS 3.7 %", of values with an answer.
std::string largest_misses(const Calibration& c) {
  std::vector<std::string> items;
  for (int i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    double most = -1.0;
    for (const Comparison& fit : c.fitted) {
      const Comparison& row = judged(c, fit);
      if (fit.target.property == p && row.answered()) most = std::max(most, std::fabs(miss(row)));
    }
    if (most >= 0.0) items.push_back(fmt::format("{} {}", to_string(p), miss_text(p, most)));
  }
  return list_text(items);
}

/// Why a table decides nothing, from the step that would help.
std::string why_open(const Verdict& v) {
  return v.next.advice == Advice::state_scatter
             ? "the table does not show the scatter of " + list_text(v.next.names)
         : v.next.advice == Advice::smaller_grains ? "packings of this grain size differ too much"
                                                   : "too few specimens";
}

bool strengths_are_of_recipe(const Verdict& v) {
  return first_of(v.not_good_for, FindingKind::strengths_of_recipe) != nullptr;
}

std::string status_words(const Calibration& c) {
  const std::string what = strengths_are_of_recipe(c.verdict) ? " in E and nu alone" : "";
  switch (c.verdict.status) {
    case VerdictStatus::calibrated: return "Calibrated" + what + ".";
    case VerdictStatus::calibrated_except: return "Calibrated" + what + ", with exceptions.";
    case VerdictStatus::not_calibrated: return "Not calibrated" + what + ".";
    case VerdictStatus::not_decided: return fmt::format("Not decided: {}.", why_open(c.verdict));
    case VerdictStatus::out_of_reach: return "Out of reach.";
    case VerdictStatus::interrupted: break;
  }
  return "Interrupted. Finished tests are in the store.";
}

/// Of findings as items of a line.
std::string items_text(const std::vector<Finding>& findings, const char* none) {
  std::vector<std::string> items;
  for (std::string& text : sentences(findings)) text.pop_back(), items.push_back(std::move(text));
  return items.empty() ? none : fmt::format("{}", fmt::join(items, "; "));
}

}  // namespace

std::string verdict_words(const Calibration& c) {
  const Verdict& v = c.verdict;
  std::string text = status_words(c);
  if (v.status == VerdictStatus::interrupted || !v.counts.has("values")) return text;
  if (!c.verification.empty()) text += " On packings that the fit has not seen:";
  text += " " + sentence(v.counts);
  if (v.status == VerdictStatus::calibrated || v.status == VerdictStatus::not_decided)
    text += fmt::format(" Largest errors: {}.", largest_misses(c));
  return text;
}

std::vector<std::string> verdict_lines(const Calibration& c) {
  if (c.verdict.status == VerdictStatus::interrupted) return {"Next: " + next_words(c) + "."};
  std::string why;
  for (const Finding& cause : c.verdict.causes) why += sentence(cause) + " ";
  return {"Good for: " + items_text(c.verdict.good_for, "nothing that the table could show") + ".",
          "Not good for: " + items_text(c.verdict.not_good_for, "nothing that the table speaks of") + ".",
          (why.empty() ? "" : "Why: " + why) + "Next: " + next_words(c) + "." +
              (c.counts_from_load ? " Angles are theta, 90 - beta of the table." : "")};
}

std::string next_words(const Calibration& c) {
  const Finding& next = c.verdict.next;
  if (next.advice == Advice::none) return "nothing is needed";
  if (next.advice == Advice::test_parameter)
    for (const ParameterEstimate& e : c.parameters)
      if (e.symbol == next.names.front()) return "test " + text_of(e.next);
  return text(next.advice, next);
}

}  // namespace phy::report
