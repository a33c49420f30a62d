#include "verdict/judge.hpp"

#include <algorithm>
#include <cmath>

#include "verdict/margin.hpp"

namespace phy::verdict {
namespace {

constexpr double chance_limit = 2.0;  // in units of what the scatter of laboratory and packings explains
constexpr double rms_limit = 0.20;    // of the strengths, whatever the scatter
constexpr double near_edge = 0.01;    // of a logarithm

/// "model", "laboratory" and "margin" of a row.
Finding of_row(FindingKind kind, const Comparison& c) {
  return {
      kind, {cell_of(c.target)}, {{"model", c.mean}, {"laboratory", c.target.mean}, {"margin", margin(c)}}};
}

double sd_of_mean(const Comparison& c) {
  return std::isfinite(c.sd) ? c.sd / std::sqrt(static_cast<double>(c.n_packings)) : 0.0;
}

void report_edges(const std::vector<ParameterEstimate>& parameters, std::vector<Finding>& findings) {
  for (const ParameterEstimate& e : parameters)
    if (std::log(e.value / e.box_low) < near_edge || std::log(e.box_high / e.value) < near_edge)
      findings.push_back({FindingKind::parameter_at_edge, {}, {{"value", e.value}}, {e.symbol}});
}

/// Moduli that the fit itself misses, and why: what the table asks of any body of its kind; what nu had to
/// give for E.
void judge_fit(const Results& r, std::vector<Finding>& findings) {
  report_edges(r.parameters, findings);
  bool any_missed = false, nu_missed = false;
  for (const Comparison& c : r.moduli) {
    if (!c.answered()) {
      findings.push_back({FindingKind::fit_unanswered, {cell_of(c.target)}});
    } else if (misses(c)) {
      any_missed = true, nu_missed = nu_missed || c.target.property == Property::nu;
      findings.push_back(of_row(FindingKind::fit_missed, c));
    }
  }
  if (!any_missed) return;
  findings.insert(findings.end(), r.limits_of_table.begin(), r.limits_of_table.end());
  if (r.E_before_nu_gave_way && nu_missed)
    findings.push_back({FindingKind::nu_gave_way, {}, {{"E_before", *r.E_before_nu_gave_way}}});
}

/// E and nu on unseen packings that miss the table by more than they may, where the fit itself does not: then
/// it is packings of this size that differ.
void judge_moduli(const Results& r, Verdict& v) {
  for (std::size_t i = 0; i < std::min(r.verification.size(), r.moduli.size()); ++i) {
    const Comparison& c = r.verification[i];
    if (!c.answered() && r.moduli[i].answered()) {
      v.status = VerdictStatus::out_of_reach;
      v.findings.push_back({FindingKind::value_unanswered, {cell_of(c.target)}});
    }
    if (!misses(c) || misses(r.moduli[i])) continue;  // the fit has reported its own limits
    Finding f = of_row(FindingKind::packings_differ, c);
    f.numbers.insert(f.numbers.end(), {{"sd", c.sd}, {"packings", static_cast<double>(c.n_packings)}});
    v.findings.push_back(f);
  }
}

/// UCS over tension at each angle that has both and where they differ: the laboratory's and, where the
/// strengths are out of reach, the nearest that the search found.
void report_ratios(const std::vector<Comparison>& verification, std::vector<Finding>& findings) {
  for (const Comparison& t : verification)
    for (const Comparison& u : verification)
      if (is_tensile(t.target.property) && u.target.property == Property::ucs &&
          t.target.theta == u.target.theta &&
          std::fabs((1.0 + u.error()) / (1.0 + t.error()) - 1.0) > strength_limit)
        findings.push_back({FindingKind::ratio_missed,
                            {cell_of(u.target), cell_of(t.target)},
                            {{"model", u.mean / t.mean}, {"laboratory", u.target.mean / t.target.mean}}});
}

/// Strengths on unseen packings that miss the table by more than their margin, and how far off all of them
/// are together.
void judge_strength(const std::vector<Comparison>& verification, Verdict& v) {
  double squares = 0.0, scaled = 0.0;  // of the errors; of the errors over what chance explains
  int n = 0;
  for (const Comparison& c : verification) {
    if (!is_strength(c.target.property)) continue;
    if (!c.answered()) {
      v.status = VerdictStatus::out_of_reach;
      v.findings.push_back({FindingKind::no_usable_peak, {cell_of(c.target)}, {}, {c.missing}});
      continue;
    }
    const double noise = std::hypot(c.target.normal_error(), sd_of_mean(c)) / c.target.mean;
    squares += c.error() * c.error(), scaled += c.error() * c.error() / (noise * noise), ++n;
    if (misses(c)) v.findings.push_back(of_row(FindingKind::value_missed, c));
  }
  const double error = n > 0 ? std::sqrt(squares / n) : 0.0, beyond = n > 0 ? std::sqrt(scaled / n) : 0.0;
  if (error > rms_limit || (error > strength_limit && beyond > chance_limit)) {
    v.status = VerdictStatus::out_of_reach;
    v.findings.push_back({FindingKind::strengths_missed, {}, {{"rms", error}}});
    report_ratios(verification, v.findings);
  }
}

/// Rows that are met only because they are too coarse, with what they resolve and what would help. True if
/// there are any.
bool report_unresolved(const std::vector<Comparison>& verification, std::vector<Finding>& findings) {
  bool any = false;
  for (const Comparison& c : verification) {
    if (!c.answered() || misses(c) || !unresolved(c)) continue;
    any = true;
    Finding f{FindingKind::value_unresolved,
              {cell_of(c.target)},
              {{"margin", margin(c)}, {"coarsest", coarsest(c.target.property)}},
              {},
              Advice::smaller_grains};
    if (const std::optional<int> more = specimens_missing(c))
      f.numbers.push_back({"specimens", static_cast<double>(*more)}), f.advice = Advice::more_specimens;
    findings.push_back(f);
  }
  return any;
}

}  // namespace

bool moduli_out_of_reach(const std::vector<Comparison>& moduli) {
  return std::any_of(moduli.begin(), moduli.end(), [](const Comparison& c) {
    return !c.answered() ||
           (misses(c) && c.target.property == Property::E && std::fabs(c.error()) > modulus_limit);
  });
}

Verdict judge(Results r) {
  for (Comparison& c : r.moduli)  // what unseen packings meet is met
    if (const Comparison* unseen = row_of(r.verification, c.target);
        unseen != nullptr && unseen->answered() && !misses(*unseen))
      c = *unseen;
  Verdict v;
  judge_fit(r, v.findings);
  v.findings.insert(v.findings.end(), r.of_search.begin(), r.of_search.end());
  if (!r.of_search.empty()) v.status = VerdictStatus::out_of_reach;
  judge_moduli(r, v);
  judge_strength(r.verification, v);
  if (moduli_out_of_reach(r.moduli)) v.status = VerdictStatus::out_of_reach;
  if (v.status == VerdictStatus::calibrated && !v.findings.empty())
    v.status = VerdictStatus::calibrated_except;
  if (report_unresolved(r.verification, v.findings) && v.status == VerdictStatus::calibrated)
    v.status = VerdictStatus::not_resolved;
  return v;
}

bool withdraw_intervals(std::vector<Comparison>& fitted) {
  bool any = false;
  for (Comparison& c : fitted) {
    if (!(c.target.mean < c.low || c.target.mean > c.high)) continue;
    c.low = c.high = nan;
    any = true;
  }
  return any;
}

}  // namespace phy::verdict
