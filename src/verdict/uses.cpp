// What a calibrated model may be used for, test by test.
#include <algorithm>
#include <cmath>
#include <span>

#include "verdict/causes.hpp"
#include "verdict/cells.hpp"

namespace phy::verdict {
namespace {

/// Tests that a table may lack, and the parameters that decide them, by symbol.
constexpr const char* frictions[] = {"mu", "mu_sj", "phi", "phi_sj"};
constexpr const char* ratios_of_tension[] = {"tau_c/sigma_c", "sigma_n,sj/C_sj", "r_t"};

/// The cells of one test with this outcome, out of all that the table has of it.
Finding cells_with(Outcome outcome, FindingKind kind, const std::vector<JudgedCell>& cells,
                   const Target& test) {
  Finding f{kind};
  double of = 0.0;
  for (const JudgedCell& c : cells) {
    if (!same_test(c.row.target, test)) continue;
    ++of;
    if (c.outcome != outcome) continue;
    f.cells.push_back(cell_of(c.row.target));
    if (outcome == Outcome::missed) f.numbers.push_back({"miss", miss_of(c.row)});
  }
  f.numbers.push_back({"of", of});
  return f;
}

void add_tests_of_table(const std::vector<JudgedCell>& cells, Verdict& v) {
  for (auto c = cells.begin(); c != cells.end(); ++c) {
    const Target& test = c->row.target;
    if (std::any_of(cells.begin(), c, [&](const JudgedCell& b) { return same_test(b.row.target, test); }))
      continue;
    const auto add = [&](std::vector<Finding>& list, Outcome outcome, FindingKind kind) {
      Finding f = cells_with(outcome, kind, cells, test);
      if (!f.cells.empty()) list.push_back(std::move(f));
    };
    Finding met = cells_with(Outcome::met, FindingKind::tests_met, cells, test);
    if (met.cells.size() == 1 && met.number("of") > 1.0) {
      met.kind = FindingKind::tests_alone;  // chance may have met it, and no other value says it has not
      v.not_good_for.push_back(std::move(met));
    } else if (!met.cells.empty()) {
      v.good_for.push_back(std::move(met));
    }
    add(v.not_good_for, Outcome::missed, FindingKind::tests_missed);
    add(v.not_good_for, Outcome::unanswered, FindingKind::tests_unanswered);
    add(v.not_good_for, Outcome::open, FindingKind::tests_open);
  }
}

/// A test that the table lacks: good where all parameters that decide it were sought and are determined, by a
/// model whose strengths in compression are met; open parameters rule it out whatever is met.
void add_other_test(const char* name, std::span<const char* const> symbols, const Calibration& c,
                    bool compression_met, Verdict& v) {
  Finding open{FindingKind::test_undetermined, {}, {}, {name}};
  bool any = false, all = true;
  for (const ParameterEstimate& e : c.parameters) {
    if (std::find(symbols.begin(), symbols.end(), e.symbol) == symbols.end()) continue;
    any = true, all = all && e.determined;
    if (!e.determined) open.names.push_back(e.symbol);
  }
  if (!any || !all)
    v.not_good_for.push_back(open);
  else if (compression_met)
    v.good_for.push_back({FindingKind::test_determined, {}, {}, {name}});
}

}  // namespace

void state_uses(const Calibration& c, Verdict& v) {
  v.good_for.clear(), v.not_good_for.clear();
  if (v.status == VerdictStatus::interrupted) return;
  const std::vector<JudgedCell> cells = judge_cells(c.verification.empty() ? c.fitted : c.verification);
  add_tests_of_table(cells, v);
  const auto any = [&](auto is) { return std::any_of(cells.begin(), cells.end(), is); };
  if (!any([](const JudgedCell& j) { return is_strength(j.row.target.property); })) {
    v.not_good_for.push_back({FindingKind::strengths_of_recipe});
    return;
  }
  const auto compression_is = [&](Outcome outcome) {
    return any(
        [&](const JudgedCell& j) { return is_compressive(j.row.target.property) && j.outcome == outcome; });
  };
  const bool met =
      !misses_table(v.status) && compression_is(Outcome::met) && !compression_is(Outcome::missed);
  if (!any([](const JudgedCell& j) { return j.row.target.property == Property::confined; }))
    add_other_test(measured(Property::confined).test_name, frictions, c, met, v);
  if (!any([](const JudgedCell& j) { return is_tensile(j.row.target.property); }))
    add_other_test("tension", ratios_of_tension, c, met, v);
}

}  // namespace phy::verdict
