#include "verdict/judge.hpp"

#include <algorithm>
#include <cmath>

#include "verdict/cells.hpp"

namespace phy::verdict {
namespace {

constexpr double chance_limit = 2.0;   // in units of what the scatter of laboratory and packings explains
constexpr double near_edge = 0.01;     // of a logarithm
constexpr double chance_alone = 0.05;  // that a single value of a true model is called missed

double sd_of_mean(const Comparison& c) {
  return std::isfinite(c.sd) ? c.sd / std::sqrt(static_cast<double>(c.n_packings)) : 0.0;
}

void report_edges(const std::vector<ParameterEstimate>& parameters, std::vector<Finding>& findings) {
  for (const ParameterEstimate& e : parameters)
    if (std::log(e.value / e.box_low) < near_edge || std::log(e.box_high / e.value) < near_edge)
      findings.push_back({FindingKind::parameter_at_edge, {}, {{"value", e.value}}, {e.symbol}});
}

/// Values without an answer: of the fit, on unseen packings.
void report_unanswered(const Results& r, std::vector<Finding>& findings) {
  for (const Comparison& c : r.moduli)
    if (!c.answered()) findings.push_back({FindingKind::fit_unanswered, {cell_of(c.target)}});
  for (const Comparison& c : r.verification) {
    if (c.answered()) continue;
    const Comparison* fit = row_of(r.moduli, c.target);
    if (is_strength(c.target.property))
      findings.push_back({FindingKind::no_usable_peak, {cell_of(c.target)}, {}, {c.missing}});
    else if (fit != nullptr && fit->answered())
      findings.push_back({FindingKind::value_unanswered, {cell_of(c.target)}});
  }
}

/// Why moduli are not met: what the table asks of any body of its kind; what nu had to give for an E that the
/// table can tell from another.
void report_limits(const Results& r, const std::vector<JudgedCell>& cells, std::vector<Finding>& findings) {
  bool moduli_met = true, nu_missed = false;
  double E_error = 0.0;
  for (const JudgedCell& c : cells) {
    const Property p = c.row.target.property;
    moduli_met = moduli_met && (is_strength(p) || c.outcome == Outcome::met);
    nu_missed = nu_missed || (p == Property::nu && c.outcome == Outcome::missed);
    if (p == Property::E) E_error = std::max({E_error, tolerance(p), 2.0 * c.error});
  }
  if (moduli_met) return;
  findings.insert(findings.end(), r.limits_of_table.begin(), r.limits_of_table.end());
  if (nu_missed && r.E_before_nu_gave_way && *r.E_before_nu_gave_way > E_error)
    findings.push_back({FindingKind::nu_gave_way, {}, {{"E_before", *r.E_before_nu_gave_way}}});
}

void report_missed(const std::vector<JudgedCell>& cells, std::vector<Finding>& findings) {
  for (const JudgedCell& c : cells)
    if (c.outcome == Outcome::missed)
      findings.push_back({FindingKind::value_missed,
                          {cell_of(c.row.target)},
                          {{"model", c.row.mean}, {"laboratory", c.row.target.mean}}});
}

/// What the data do not exclude of a value, and what would decide it: more specimens; smaller grains where
/// packings alone hide the answer; nothing that can be promised where the difference itself is large.
void report_open(const std::vector<JudgedCell>& cells, std::vector<Finding>& findings) {
  for (const JudgedCell& c : cells) {
    if (c.outcome != Outcome::open) continue;
    const double limit = coarsest(c.row.target.property);
    Finding f{FindingKind::value_open,
              {cell_of(c.row.target)},
              {{"bound", c.bound}, {"coarsest", limit}},
              {},
              Advice::more_specimens};
    if (const std::optional<int> more = specimens_missing(c))
      f.numbers.push_back({"specimens", static_cast<double>(*more)});
    else if (2.0 * c.of_packings > limit)
      f.advice = Advice::smaller_grains;
    findings.push_back(f);
  }
}

/// Only the usual scatter leaves these values open: the table states none.
std::optional<Finding> scatter_unstated(const std::vector<JudgedCell>& cells) {
  Finding f{FindingKind::scatter_unstated, {}, {}, {}, Advice::state_scatter};
  for (const JudgedCell& c : cells) {
    if (c.outcome != Outcome::open) continue;
    if (!c.row.target.sd_assumed) return {};
    if (const std::string name = to_string(c.row.target.property);
        std::find(f.names.begin(), f.names.end(), name) == f.names.end())
      f.names.push_back(name);
  }
  return f.names.empty() ? std::nullopt : std::optional(f);
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

/// Are the strengths missed as a whole? With how far off they are.
bool strengths_missed(const std::vector<Comparison>& verification, std::vector<Finding>& findings) {
  double squares = 0.0, scaled = 0.0;  // of the errors; of the errors over what chance explains
  int n = 0;
  for (const Comparison& c : verification) {
    if (!is_strength(c.target.property) || !c.answered()) continue;
    const double noise = std::hypot(c.target.normal_error(), sd_of_mean(c)) / c.target.mean;
    squares += c.error() * c.error(), scaled += c.error() * c.error() / (noise * noise), ++n;
  }
  const double error = n > 0 ? std::sqrt(squares / n) : 0.0, beyond = n > 0 ? std::sqrt(scaled / n) : 0.0;
  if (error <= strength_limit || beyond <= chance_limit) return false;
  findings.push_back({FindingKind::strengths_missed, {}, {{"rms", error}}});
  report_ratios(verification, findings);
  return true;
}

Finding counted(const std::vector<JudgedCell>& cells) {
  const auto n = [&](Outcome outcome) {
    return static_cast<double>(
        std::count_if(cells.begin(), cells.end(), [&](const JudgedCell& c) { return c.outcome == outcome; }));
  };
  const auto alone = std::count_if(cells.begin(), cells.end(), [](const JudgedCell& c) { return c.alone; });
  const auto values = static_cast<double>(cells.size());
  return {FindingKind::values_judged,
          {},
          {{"values", values},
           {"met", n(Outcome::met)},
           {"missed", n(Outcome::missed)},
           {"open", n(Outcome::open)},
           {"alone", static_cast<double>(alone)},
           {"by_chance", chance_alone * values}}};
}

/// Do the maps expect as much of this model, wherever its parameters lie?
bool missed_in_maps(const std::vector<Finding>& reach) {
  if (first_of(reach, FindingKind::forecast_out_of_reach) == nullptr) return false;
  double squares = 0.0;
  int n = 0;
  for (const Finding& f : reach)
    if (f.kind == FindingKind::map_expected && is_strength(f.cells.front().property))
      squares += std::pow(f.number("model") / f.number("laboratory") - 1.0, 2.0), ++n;
  return n > 0 && std::sqrt(squares / n) > strength_limit;
}

bool moduli_unanswered(const std::vector<Comparison>& moduli) {
  return std::any_of(moduli.begin(), moduli.end(), [](const Comparison& c) { return !c.answered(); });
}

bool modulus_out_of_reach(const JudgedCell& c, const Comparison* fit) {
  return c.outcome == Outcome::missed && c.row.target.property == Property::E &&
         std::fabs(c.row.error()) > modulus_limit &&
         (fit == nullptr || std::fabs(fit->error()) > modulus_limit);
}

}  // namespace

bool moduli_out_of_reach(const std::vector<Comparison>& moduli) {
  const std::vector<JudgedCell> cells = judge_cells(moduli);
  return std::any_of(cells.begin(), cells.end(), [](const JudgedCell& c) {
    return c.outcome == Outcome::unanswered || modulus_out_of_reach(c, nullptr);
  });
}

Verdict judge(const Results& r) {
  const std::vector<JudgedCell> cells = judge_cells(r.verification.empty() ? r.moduli : r.verification);
  Verdict v;
  v.counts = counted(cells);
  report_edges(r.parameters, v.findings);
  report_unanswered(r, v.findings);
  v.findings.insert(v.findings.end(), r.of_search.begin(), r.of_search.end());
  report_missed(cells, v.findings);
  report_limits(r, cells, v.findings);
  const bool strengths = strengths_missed(r.verification, v.findings);
  report_open(cells, v.findings);
  const auto any = [&](auto is) { return std::any_of(cells.begin(), cells.end(), is); };
  if ((strengths && (r.search_settled || missed_in_maps(r.reach))) || !r.of_search.empty() ||
      moduli_unanswered(r.moduli) ||
      any([](const JudgedCell& c) { return c.outcome == Outcome::unanswered; }) ||
      any([&](const JudgedCell& c) { return modulus_out_of_reach(c, row_of(r.moduli, c.row.target)); }))
    v.status = VerdictStatus::out_of_reach;
  else
    v.status = strengths ? VerdictStatus::not_calibrated : status_of(cells);
  if (const auto unstated = scatter_unstated(cells); unstated && v.status == VerdictStatus::not_decided)
    v.findings.insert(v.findings.begin(), *unstated);
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
