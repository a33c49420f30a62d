#include "verdict/causes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/check.hpp"
#include "verdict/cells.hpp"

namespace phy::verdict {
namespace {

constexpr double min_share_reported = 0.15;  // of the misfit
constexpr std::size_t most_causes = 2;
constexpr double widest_gap = 30.0;  // [deg] between angles of UCS

/// Does an advice only say what to do without the part that is missed?
bool is_retreat(Advice advice) {
  return advice == Advice::take_where_met || advice == Advice::leave_out_ucs ||
         advice == Advice::leave_out_tension;
}

/// The property that a part is judged by first.
Property first_property(Part part) {
  const auto all = measured_properties();
  return std::find_if(all.begin(), all.end(), [&](const MeasuredProperty& p) { return p.part == part; })
      ->property;
}

/// Packings that differ by more than the tolerance, and by half of what is missed or more. A value
/// that is farther off than two means over as many packings may lie apart is missed for another reason, and
/// so is nu where E is met: what packings differ by is reported of E.
std::optional<Finding> scattered_packings(const View& v, Part part) {
  const double unit = tolerance(first_property(part));
  double squares = 0.0, missed = 0.0, missed_by_nu = 0.0;
  int n = 0;
  bool nu_missed = false, others_missed = false;
  for (const JudgedCell& cell : v.cells) {
    const Comparison& c = cell.row;
    if (measured(c.target.property).part != part || !c.answered() || !std::isfinite(c.sd)) continue;
    (c.target.property == Property::nu ? nu_missed : others_missed) |= std::fabs(cell.scaled_miss()) > 1.0;
    if (c.target.property == Property::nu) {
      missed_by_nu += std::pow(miss_of(c) / tolerance(Property::nu), 2.0);
      continue;
    }
    const double of_mean = c.sd / c.mean / std::sqrt(std::max(1, c.n_packings));
    if (std::fabs(c.error()) > z_99 * std::sqrt(2.0) * of_mean) return {};
    squares += std::pow(c.sd / c.mean / unit, 2.0), missed += std::pow(c.error() / unit, 2.0), ++n;
  }
  if (n == 0 || squares <= n || squares < 0.25 * missed || missed_by_nu > missed) return {};
  if (nu_missed && !others_missed) return {};
  return Finding{FindingKind::scattered_packings,
                 {},
                 {{"sd", unit * std::sqrt(squares / n)}, {"miss", unit * std::sqrt(missed / n)}},
                 {},
                 Advice::smaller_grains};
}

/// What no rule explains, with what was ruled out: packings, the maps, a search that was too short.
Finding farthest_value(const View& v, Part part) {
  const JudgedCell* worst = v.farthest(part);
  PHY_CHECK(worst != nullptr, "a part that misses has a value that was answered");
  Finding f{FindingKind::farthest_value,
            {cell_of(worst->row.target)},
            {{"model", worst->row.mean}, {"laboratory", worst->row.target.mean}},
            {},
            Advice::check_value};
  if (search_can_help(v)) return f;  // which is the cause then
  if (std::isfinite(worst->row.sd)) f.numbers.push_back({"packings", worst->row.sd});
  if (const Finding* maps = v.in_maps(FindingKind::map_expected, worst->row.target))
    f.numbers.insert(f.numbers.end(),
                     {{"expected", maps->number("model")}, {"error", maps->number("error")}});
  return f;
}

Finding cause_of(const View& v, Part part) {
  static const std::map<Part, std::vector<CauseRule*>> rules = {
      {Part::moduli, {nu_of_no_body, finer_grains, stiffening, of_no_body, moduli_scaled, modulus_ratio}},
      {Part::compression, {weakest_angle, ucs_ratio}},
      {Part::tension, {tension_ratio}},
      {Part::initiation, {initiation_ratio}},
      {Part::toughness, {grains_for_toughness}},
      {Part::bedding, {}}};
  for (CauseRule* rule : rules.at(part))
    if (const auto cause = rule(v)) return *cause;
  if (const auto cause = scattered_packings(v, part)) return *cause;
  if (const auto cause = expected_in_maps(v, part)) return *cause;
  return farthest_value(v, part);
}

/// Parts with a share that is reported, the largest first.
std::vector<Part> ranked(const View& v) {
  std::vector<Part> parts;
  for (int i = 0; i < n_parts; ++i)
    if (const auto p = static_cast<Part>(i); v.share(p) >= min_share_reported) parts.push_back(p);
  std::stable_sort(parts.begin(), parts.end(), [&](Part a, Part b) { return v.share(a) > v.share(b); });
  return parts;
}

/// "E", "nu": what the table has of a part.
std::vector<std::string> properties_of(const View& v, Part part) {
  std::vector<std::string> names;
  for (const JudgedCell& c : v.cells)
    if (const std::string name = to_string(c.row.target.property);
        measured(c.row.target.property).part == part &&
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

/// Values without any answer of the model.
std::vector<Cell> unanswered_cells(const View& v) {
  std::vector<Cell> cells;
  for (const Comparison& c : v.of.fitted) {
    const Comparison* unseen = row_of(v.of.verification, c.target);
    if (!c.answered() || (unseen != nullptr && !unseen->answered())) cells.push_back(cell_of(c.target));
  }
  return cells;
}

/// Neighbours in theta with UCS that nothing lies between for far.
std::optional<Finding> gap_in_ucs(const View& v) {
  std::vector<double> angles;
  for (const Comparison& c : v.answered(Property::ucs)) angles.push_back(c.target.theta);
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > widest_gap)
      return Finding{
          FindingKind::gap_in_ucs, {}, {{"from", angles[i - 1]}, {"to", angles[i]}}, {}, Advice::fill_gap};
  return {};
}

/// Of a search without all points of a usual one, or that a longer one may bring nearer.
std::optional<Finding> search_short(const View& v) {
  const Calibration& c = v.of;
  const bool may_help = search_can_help(v);
  if (!c.shortage.any() && !may_help) return {};
  return Finding{
      FindingKind::search_short,
      {},
      {{"tests", static_cast<double>(c.counts.compression())},
       {"models", static_cast<double>(c.discarded.size() + 1)},
       {"of_effort", c.shortage.of_effort ? 1.0 : 0.0},
       {"of_tests", c.shortage.of_tests ? 1.0 : 0.0},
       {"foreseen", c.shortage.foreseen ? 1.0 : 0.0},
       {"more", static_cast<double>(c.shortage.tests) * static_cast<double>(c.discarded.size() + 1)}},
      {},
      may_help ? Advice::longer_search : Advice::none};
}

/// The step that an advice of a finding is.
Finding step(const Finding& of) {
  return {FindingKind::next_step, of.cells, of.numbers, of.names, of.advice};
}
Finding step(Advice advice) { return {FindingKind::next_step, {}, {}, {}, advice}; }

/// What remains open of a model that meets its table, and which test would close most of it.
void explain_met(const View& v, Verdict& verdict) {
  const auto gap = gap_in_ucs(v);
  if (gap) verdict.causes.push_back(*gap);
  verdict.next = v.moduli_alone() ? step(Advice::calibrate_strengths) : gap ? step(*gap) : step(Advice::none);
  for (const ParameterEstimate& e : v.of.parameters)
    if (e.open() && e.next.remedy != Remedy::none) {
      verdict.next = {FindingKind::next_step, {}, {}, {e.symbol}, Advice::test_parameter};
      return;
    }
}

/// The causes of these parts, two at most.
void add_causes(const View& v, const std::vector<Part>& parts, std::vector<Finding>& causes) {
  for (const Part part : parts) {
    if (causes.size() == most_causes) break;
    causes.push_back(cause_of(v, part));
    causes.back().numbers.push_back({"share", v.share(part)});
    causes.back().names = properties_of(v, part);
  }
}

/// Is a value of it off by more than matters, whether or not chance explains that?
bool is_far_off(const View& v, Part part) {
  return std::any_of(v.cells.begin(), v.cells.end(), [&](const JudgedCell& c) {
    const Property p = c.row.target.property;
    return measured(p).part == part && c.row.answered() && std::fabs(miss_of(c.row)) > coarsest(p);
  });
}

/// A table that leaves values open: state the scatter; else more specimens, unless packings alone hide every
/// answer. Why a value is far off is said all the same.
void explain_open(const View& v, Verdict& verdict) {
  std::vector<Part> parts = ranked(v);
  std::erase_if(parts, [&](Part part) { return !is_far_off(v, part); });
  add_causes(v, parts, verdict.causes);
  if (search_can_help(v)) verdict.causes.push_back(*search_short(v));
  if (const Finding* unstated = first_of(verdict.findings, FindingKind::scatter_unstated)) {
    verdict.next = step(*unstated);
    return;
  }
  Finding next{FindingKind::next_step, {}, {}, {}, Advice::smaller_grains};
  for (const Finding& f : verdict.findings) {
    if (f.kind != FindingKind::value_open) continue;
    next.cells.push_back(f.cells.front());
    if (f.advice == Advice::more_specimens) next.advice = f.advice;
  }
  verdict.next = next;
}

/// What most of the misfit is about.
void explain_missed(const View& v, Verdict& verdict) {
  std::vector<Finding>& causes = verdict.causes;
  if (std::vector<Cell> cells = unanswered_cells(v); !cells.empty())
    causes.push_back({FindingKind::unanswered, std::move(cells), {}, {}, Advice::see_findings});
  const std::vector<Part> parts = ranked(v);
  add_causes(v, parts, causes);
  verdict.next = causes.empty() ? step(Advice::see_findings) : step(causes.front());
  if (verdict.status == VerdictStatus::out_of_reach && v.of.rival && is_retreat(verdict.next.advice))
    verdict.next = step(*v.of.rival);
  if (!search_can_help(v)) return;
  causes.push_back(*search_short(v));
  if (parts.empty() || parts.front() != Part::moduli)
    verdict.next = step(causes.back());  // no search of these
}

}  // namespace

void explain(Calibration& c) {
  Verdict verdict = c.verdict;
  verdict.causes.clear();
  const View view(c);
  state_uses(c, verdict);
  switch (verdict.status) {
    case VerdictStatus::interrupted: verdict.next = step(Advice::resume); break;
    case VerdictStatus::calibrated: explain_met(view, verdict); break;
    case VerdictStatus::not_decided: explain_open(view, verdict); break;
    case VerdictStatus::calibrated_except:
    case VerdictStatus::not_calibrated:
    case VerdictStatus::out_of_reach: explain_missed(view, verdict); break;
  }
  c.verdict = std::move(verdict);
  // What a longer search would take is worth a note where it is no cause; whether to search is the verdict's.
  if (!c.shortage.any() || first_of(c.verdict.causes, FindingKind::search_short) != nullptr) return;
  c.notes.push_back(*search_short(view));
  c.notes.back().advice = Advice::none;
}

}  // namespace phy::verdict
