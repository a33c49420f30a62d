// The verdict of a calibration, in words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/calibration_summary.hpp"
#include "report/words.hpp"

namespace phy::report {
namespace {

/// "E within 1.7 %, UCS within 3.7 %", of values with an answer.
std::string largest_misses(const Calibration& c) {
  std::vector<std::string> items;
  for (int i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    double most = -1.0;
    for (const Comparison& fit : c.fitted) {
      const Comparison& row = judged(c, fit);
      if (fit.target.property == p && row.answered()) most = std::max(most, std::fabs(miss(row)));
    }
    if (most >= 0.0) items.push_back(fmt::format("{} within {}", to_string(p), miss_text(p, most)));
  }
  return list_text(items);
}

/// Which parameters of a model that meets its table are known.
std::string known(const Calibration& c) {
  if (c.method == CalibrationMethod::sequence) return " A sequence does not report what its data leave open.";
  if (const std::string open = open_parameters(c); !open.empty())
    return fmt::format(" The data do not determine {}.", open);
  const bool all = std::all_of(c.parameters.begin(), c.parameters.end(),
                               [](const ParameterEstimate& e) { return e.has_interval(); });
  return all ? " The data determine every fitted parameter." : "";
}

/// "73 % of the misfit is in BTS.", then the cause; causes without a share stand alone.
std::string cause_text(const Finding& cause) {
  std::string text;
  if (cause.has("share"))
    text =
        fmt::format(" {} in {}.",
                    cause.number("share") > 0.995 ? "The misfit is"
                                                  : percent_text(cause.number("share")) + " of the misfit is",
                    list_text(cause.names));
  return text + " " + sentence(cause);
}

std::string first_words(const Calibration& c) {
  std::size_t unresolved = 0;
  for (const Finding& f : c.verdict.findings) unresolved += f.kind == FindingKind::value_unresolved ? 1 : 0;
  const std::string where = c.verification.empty() ? "" : " on packings the fit has not seen";
  switch (c.verdict.status) {
    case VerdictStatus::calibrated:
      return fmt::format("Calibrated. The model has {} of the table{}.{}", largest_misses(c), where,
                         known(c));
    case VerdictStatus::not_resolved:
      return fmt::format(
          "Not resolved. The model has {} of the table, but for {} of {} too few specimens or too "
          "different packings hide errors that matter.",
          largest_misses(c), unresolved, counted_text(static_cast<double>(c.fitted.size()), "value"));
    case VerdictStatus::calibrated_except:
      return unresolved == 0 ? "Calibrated, with exceptions."
                             : fmt::format("Calibrated, with exceptions; not resolved: {} of {} values.",
                                           unresolved, c.fitted.size());
    case VerdictStatus::out_of_reach: return "Out of reach.";
    case VerdictStatus::interrupted: break;
  }
  return "Interrupted. Finished tests are in the store.";
}

}  // namespace

std::string verdict_words(const Calibration& c) {
  std::string text = first_words(c);
  for (const Finding& cause : c.verdict.causes) text += cause_text(cause);
  const bool missed =
      c.verdict.status == VerdictStatus::calibrated_except || c.verdict.status == VerdictStatus::out_of_reach;
  if (missed && c.verdict.causes.empty())
    for (const std::string& line : sentences(c.verdict.findings)) text += " " + line;
  const std::string next = next_words(c);
  return next.empty() ? text : text + " Next: " + next + ".";
}

std::string next_words(const Calibration& c) {
  const Finding& next = c.verdict.next;
  if (next.advice == Advice::test_parameter)
    for (const ParameterEstimate& e : c.parameters)
      if (e.symbol == next.names.front()) return "test " + text_of(e.next);
  return text(next.advice, next);
}

}  // namespace phy::report
