#include "calibrate/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/lines.hpp"
#include "calibrate/elastic_verdict.hpp"

namespace phy::calibrate {
namespace {

constexpr double ucs_tolerance = 0.06, tension_tolerance = 0.10;
constexpr double chance_limit = 2.0;  // and in units of what the scatter of laboratory and packings explains
constexpr double strength_limit = 0.10;  // root mean square, from which a table is out of reach
constexpr double hopeless = 0.20;        // the same whatever the scatter

/// UCS over tension at each angle that has both and where they differ: the laboratory's and, where the
/// strengths are out of reach, the nearest that the search found.
void report_ratios(Calibration& result) {
  for (const Comparison& t : result.verification)
    for (const Comparison& u : result.verification)
      if (is_strength(t.target.property) && t.target.property != Property::ucs &&
          u.target.property == Property::ucs && t.target.theta == u.target.theta &&
          std::fabs((1.0 + u.error()) / (1.0 + t.error()) - 1.0) > strength_limit)
        result.verdict.findings.push_back(fmt::format(
            "UCS/{}({:g}) = {:.1f} in the laboratory, {:.1f} in the nearest model",
            to_string(t.target.property), t.target.theta, u.target.mean / t.target.mean, u.mean / t.mean));
}

/// Strengths on unseen packings that miss the table by more than scatter explains: that of the packings and
/// that of the laboratory, where the table tells it. An assumed one excuses no single value, but a table as a
/// whole is not out of reach while it might be scatter.
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
    const Comparison* fitted = row_of(result.fitted, c.target);
    const double share = 1.0 / c.n_packings + (fitted != nullptr ? 1.0 / fitted->n_packings : 0.0);
    const double packing = (std::isfinite(c.sd) ? c.sd * std::sqrt(share) : 0.0) / c.target.mean;
    const double laboratory = c.target.standard_error() / c.target.mean;
    const double excused = std::hypot(excusing_error(c.target) / c.target.mean, packing),
                 noise = std::hypot(laboratory, packing);
    squares += c.error() * c.error(), scaled += c.error() * c.error() / (noise * noise), ++n;
    const double tolerance = c.target.property == Property::ucs ? ucs_tolerance : tension_tolerance;
    if (std::fabs(c.error()) <= std::max(tolerance, z_seven * excused)) continue;
    result.verdict.findings.push_back(fmt::format(
        "{}({:g}) = {:.1f} MPa on unseen packings, {:+.1f} % from {:.1f} MPa", to_string(c.target.property),
        c.target.theta, c.mean * 1e-6, 100.0 * c.error(), c.target.mean * 1e-6));
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
            ? fmt::format("E({:g}) = {:.2f} GPa on unseen packings, {:+.1f} % from the laboratory's {:.2f} "
                          "(tolerated: {:.1f} %): packings of this size differ by {:.1f} %, the mean of {} "
                          "by {:.1f} %",
                          t.theta, c.mean * 1e-9, 100.0 * c.error(), t.mean * 1e-9, 100.0 * modulus_limit(t),
                          100.0 * c.sd / c.mean, c.n_packings, 100.0 * mean_sd / c.mean)
            : fmt::format(
                  "nu({:g}) = {:.3f} on unseen packings instead of {:.3f}: packings of this size differ "
                  "by {:.3f}, the mean of {} by {:.3f}",
                  t.theta, c.mean, t.mean, c.sd, c.n_packings, mean_sd));
  }
}

}  // namespace

void judge(Calibration& result, ElasticFit elastic, const Evidence& table, bool softened) {
  Verdict& v = result.verdict;
  // as the laboratory reads them
  std::copy_n(result.fitted.begin(), elastic.comparisons.size(), elastic.comparisons.begin());
  const ElasticVerdict moduli = judge_elastic(elastic, table, softened);
  v.findings.insert(v.findings.begin(), moduli.findings.begin(), moduli.findings.end());
  judge_moduli(result, elastic);
  judge_strength(result);
  if (moduli.out_of_reach) v.status = VerdictStatus::out_of_reach;
  if (v.status == VerdictStatus::calibrated && !v.findings.empty())
    v.status = VerdictStatus::calibrated_except;
}

}  // namespace phy::calibrate
