#include "calibrate/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/lines.hpp"
#include "calibrate/elastic_verdict.hpp"
#include "calibrate/margin.hpp"

namespace phy::calibrate {
namespace {

constexpr double chance_limit = 2.0;  // and in units of what the scatter of laboratory and packings explains
constexpr double hopeless = 0.20;     // the same whatever the scatter

/// UCS over tension at each angle that has both and where they differ: the laboratory's and, where the
/// strengths are out of reach, the nearest that the search found.
void report_ratios(Calibration& result) {
  for (const Comparison& t : result.verification)
    for (const Comparison& u : result.verification)
      if (is_tensile(t.target.property) && u.target.property == Property::ucs &&
          t.target.theta == u.target.theta &&
          std::fabs((1.0 + u.error()) / (1.0 + t.error()) - 1.0) > strength_limit)
        result.verdict.findings.push_back(fmt::format(
            "UCS/{}({:g}) = {:.1f} in the laboratory, {:.1f} in the nearest model",
            to_string(t.target.property), t.target.theta, u.target.mean / t.target.mean, u.mean / t.mean));
}

/// Strengths on unseen packings that miss the table by more than their margin, and how far off all of them
/// are together.
void judge_strength(Calibration& result) {
  double squares = 0.0, scaled = 0.0;  // of the errors; of the errors over what chance explains
  int n = 0;
  for (const Comparison& c : result.verification) {
    if (!is_strength(c.target.property)) continue;
    if (!c.answered()) {
      result.verdict.status = VerdictStatus::out_of_reach;
      add_line(result.verdict.findings, cell_name(c.target),
               fmt::format("no test on unseen packings gave a usable peak ({})", c.missing));
      continue;
    }
    const double packing = std::isfinite(c.sd) ? c.sd / std::sqrt(static_cast<double>(c.n_packings)) : 0.0;
    const double noise = std::hypot(c.target.normal_error(), packing) / c.target.mean;
    squares += c.error() * c.error(), scaled += c.error() * c.error() / (noise * noise), ++n;
    if (!misses(c)) continue;
    const ShownUnit unit = shown_unit(c.target.property);
    const int digits = c.target.property == Property::fracture_toughness ? 2 : 1;
    result.verdict.findings.push_back(
        fmt::format("{} = {:.{}f} {} on unseen packings, {:+.1f} % from {:.{}f} {}", cell_name(c.target),
                    c.mean * unit.factor, digits, unit.name, 100.0 * c.error(), c.target.mean * unit.factor,
                    digits, unit.name));
  }
  const double error = n > 0 ? std::sqrt(squares / n) : 0.0, beyond = n > 0 ? std::sqrt(scaled / n) : 0.0;
  if (error > hopeless || (error > strength_limit && beyond > chance_limit)) {
    result.verdict.status = VerdictStatus::out_of_reach;
    result.verdict.findings.push_back(fmt::format(
        "the strengths as a whole are {:.0f} % off: the nearest that were found stand in the table",
        100.0 * error));
    report_ratios(result);
  }
}

/// E and nu on unseen packings that miss the table by more than they may, where the fit itself does not: then
/// it is packings of this size that differ.
void judge_moduli(Calibration& result, const ElasticFit& elastic) {
  for (std::size_t i = 0; i < std::min(result.verification.size(), elastic.comparisons.size()); ++i) {
    const Comparison& c = result.verification[i];
    const Target& t = c.target;
    if (!c.answered() && elastic.comparisons[i].answered()) {
      result.verdict.status = VerdictStatus::out_of_reach;
      add_line(result.verdict.findings, cell_name(t), "no answer on unseen packings");
    }
    if (!misses(c) || misses(elastic.comparisons[i])) continue;  // the fit has told its own limits
    const double mean_sd = c.sd / std::sqrt(static_cast<double>(c.n_packings));
    result.verdict.findings.push_back(
        t.property == Property::E
            ? fmt::format("{} = {:.2f} GPa on unseen packings, {:+.1f} % from the laboratory's {:.2f} "
                          "(tolerated: {:.1f} %): packings of this size differ by {:.1f} %, the mean of {} "
                          "by {:.1f} %",
                          cell_name(t), c.mean * 1e-9, 100.0 * c.error(), t.mean * 1e-9, 100.0 * margin(c),
                          100.0 * c.sd / c.mean, c.n_packings, 100.0 * mean_sd / c.mean)
            : fmt::format("{} = {:.3f} on unseen packings instead of {:.3f}: packings of this size differ "
                          "by {:.3f}, the mean of {} by {:.3f}",
                          cell_name(t), c.mean, t.mean, c.sd, c.n_packings, mean_sd));
  }
}

/// "22 %", with a digit more where that would read as the limit; nu has no unit.
std::string in_words(Property p, double miss) {
  const double scale = p == Property::nu ? 1.0 : 100.0;
  const int digits = p == Property::nu ? 2 : 0;
  const auto text = [&](double x, int n) { return fmt::format("{:.{}f}", scale * x, n); };
  const bool alike = miss > coarsest(p) && text(miss, digits) == text(coarsest(p), digits);
  return text(miss, alike ? digits + 1 : digits) + (p == Property::nu ? "" : " %");
}

/// Rows that are met only because they are too coarse, with what they resolve and what would help. True if
/// there are any.
bool report_unresolved(Calibration& result) {
  bool any = false;
  for (const Comparison& c : result.verification) {
    if (!c.answered() || misses(c) || !unresolved(c)) continue;
    any = true;
    const Property p = c.target.property;
    const std::optional<int> more = specimens_missing(c);
    add_line(result.verdict.findings, cell_name(c.target),
             fmt::format("not resolved, a miss of {} would pass for chance; {}", in_words(p, margin(c)),
                         more ? fmt::format("{} more specimen{} would bring that to {}", *more,
                                            *more == 1 ? "" : "s", in_words(p, coarsest(p)))
                              : "packings of this size differ too much, smaller grains would help"));
  }
  return any;
}

/// Where the model is out of reach the interval of a row may leave out what was measured: it says what the
/// model can do, not where the rock is.
void withdraw_intervals(Calibration& result) {
  bool any = false;
  for (Comparison& c : result.fitted) {
    if (!(c.target.mean < c.low || c.target.mean > c.high)) continue;
    c.low = c.high = nan;
    any = true;
  }
  if (any)
    result.notes.emplace_back(
        "no interval of the rock is given where that of a model out of reach leaves out what was measured");
}

}  // namespace

void judge(Calibration& result, ElasticFit elastic, const Evidence& table, bool softened) {
  Verdict& v = result.verdict;
  // as the laboratory reads them
  std::copy_n(result.fitted.begin(), elastic.comparisons.size(), elastic.comparisons.begin());
  // and what unseen packings meet is met
  for (Comparison& c : elastic.comparisons)
    if (const Comparison* unseen = row_of(result.verification, c.target);
        unseen != nullptr && unseen->answered() && !misses(*unseen))
      c = *unseen;
  const ElasticVerdict moduli = judge_elastic(elastic, table, softened);
  v.findings.insert(v.findings.begin(), moduli.findings.begin(), moduli.findings.end());
  judge_moduli(result, elastic);
  judge_strength(result);
  if (moduli.out_of_reach) v.status = VerdictStatus::out_of_reach;
  if (v.status == VerdictStatus::calibrated && !v.findings.empty())
    v.status = VerdictStatus::calibrated_except;
  if (report_unresolved(result) && v.status == VerdictStatus::calibrated)
    v.status = VerdictStatus::not_resolved;
  if (v.status == VerdictStatus::out_of_reach) withdraw_intervals(result);
}

}  // namespace phy::calibrate
