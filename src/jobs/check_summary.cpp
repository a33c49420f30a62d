#include "jobs/check_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "base/check.hpp"
#include "base/text_table.hpp"
#include "calibrate/outlook.hpp"
#include "jobs/time_left.hpp"
#include "maps/candidates.hpp"
#include "report/calibration_tables.hpp"
#include "report/words.hpp"

namespace phy::jobs {
namespace {

using Kind = FindingKind;

Finding angles_of(const Evidence& evidence) {
  Finding f{Kind::table_angles};
  if (!evidence.rock.bedded) return f;
  std::set<double> angles;
  const bool beta = evidence.rock.counts_from_load;
  // As the laboratory counts, so that its people find their own numbers again.
  for (const Target& t : evidence.targets) angles.insert(beta ? 90.0 - t.theta : t.theta);
  if (!angles.empty())
    f.numbers = {{"angles", static_cast<double>(angles.size())},
                 {"from", *angles.begin()},
                 {"to", *angles.rbegin()},
                 {"from_load", beta ? 1.0 : 0.0}};
  return f;
}

/// Least and largest value of each property.
Finding values_of(const Evidence& evidence, bool strengths) {
  Finding f{strengths ? Kind::table_strengths : Kind::table_moduli};
  // Over all properties, though told beside the strengths: one line for the whole table is enough.
  double least_n = HUGE_VAL, most_n = 0.0;
  for (const MeasuredProperty& p : measured_properties()) {
    const std::vector<Target> targets = of_property(evidence.targets, p.property);
    for (const Target& t : targets) least_n = std::fmin(least_n, t.n), most_n = std::fmax(most_n, t.n);
    if (targets.empty() || is_strength(p.property) != strengths) continue;
    const auto [low, high] = std::ranges::minmax(targets, {}, &Target::mean);
    f.cells.push_back({p.property, std::nan("")});
    // Pairs in the order of the cells: the words read them by place.
    f.numbers.push_back({"low", low.mean}), f.numbers.push_back({"high", high.mean});
  }
  if (strengths) f.numbers.insert(f.numbers.end(), {{"least_n", least_n}, {"most_n", most_n}});
  // Tangent, secant or average: a wrong reading of E spoils every modulus, so it is always said.
  if (!strengths && evidence.has(Property::E)) f.names.emplace_back(to_string(evidence.rock.E_is));
  return f;
}

/// The test that settles most of what is open: all that are asked for of one property.
std::string best_test(const std::vector<ParameterEstimate>& open) {
  std::map<Property, std::vector<LabTests>> by_property;
  for (const ParameterEstimate& e : open)
    for (const LabTests& tests : e.next.tests)
      for (const LabTest& t : tests.any_of)
        // Counted by different tests of a property: one campaign in the laboratory can make them all.
        if (auto& list = by_property[t.property]; std::ranges::find(list, LabTests(t)) == list.end())
          list.emplace_back(t);
  const auto best =
      std::ranges::max_element(by_property, {}, [](const auto& tests) { return tests.second.size(); });
  if (best == by_property.end()) return "";
  std::vector<LabTests> asked;  // what is good anywhere is in what is asked for somewhere
  for (const LabTests& tests : best->second)
    if (best->second.size() == 1 || tests.any_of.front().where != Inclination::any) asked.push_back(tests);
  return names_of(asked);
}

Finding open_parameters(const std::vector<ParameterEstimate>& parameters) {
  std::vector<ParameterEstimate> open;
  for (const ParameterEstimate& e : parameters)
    if (!e.determined) open.push_back(e);
  if (open.empty()) return {Kind::parameters_known};
  Finding f{Kind::parameters_open, {}, {}, {best_test(open)}};
  for (const ParameterEstimate& e : open) f.names.push_back(e.symbol);
  return f;
}

void add_doubts(const RockCheck& check, std::vector<Finding>& lines) {
  const std::size_t n = std::min(most_doubts, check.doubts.size());
  lines.insert(lines.end(), check.doubts.begin(), check.doubts.begin() + static_cast<std::ptrdiff_t>(n));
  // The rest is in --all: a screen of doubts hides the worst among them.
  if (check.doubts.size() > n)
    lines.push_back({Kind::more_doubts, {}, {{"doubts", static_cast<double>(check.doubts.size() - n)}}});
}

/// A limit that a better model or another table would take away before anything runs.
bool to_be_known_first(const Finding& limit) {
  return limit.kind == Kind::few_grains_between || limit.kind == Kind::stiffer_under_confinement;
}

/// Properties of which no cell shows its scatter: their errors will not be told from chance.
std::optional<Finding> without_scatter(const RockCheck& check) {
  Finding f{Kind::scatter_unstated};
  for (const Finding& limit : check.limits)
    // Only where every cell lacks it: a single measured scatter already tells what chance does.
    if (limit.kind == Kind::scatter_assumed && double(limit.cells.size()) == limit.number("of"))
      f.names.emplace_back(to_string(limit.cells.front().property));
  return f.names.empty() ? std::nullopt : std::optional(f);
}

/// Tests, time and models of the calibration; nothing can be fitted of some tables.
void add_course(const RockCheck& check, int threads, std::vector<Finding>& lines) {
  try {
    calibrate::CalibrationOptions options;
    options.effort = calibrate::auto_effort;  // the default of a calibration
    lines.push_back(expected_course(calibrate::outlook_of(check.as_read, options), threads));
    // A check answers any table, also one from which no calibration could begin.
  } catch (const InputError&) {
    lines.push_back({Kind::nothing_to_fit});
    return;
  }
  Finding models{Kind::models_ahead};
  std::set<const RockModel*> kinds;
  for (const Rock& rock : maps::candidates_of(check.as_read))
    // Candidates differ in numbers too, such as the share of joints; a reader wants each kind once.
    if (const RockModel& model = maps::model_of(rock); kinds.insert(&model).second)
      models.names.push_back(text_of(model, std::nullopt));
  lines.push_back(models);
}

}  // namespace

std::vector<Finding> summary_of(const RockCheck& check, int threads) {
  std::vector<Finding> lines;
  // Doubts first: if the table is misread, nothing below is worth reading.
  add_doubts(check, lines);
  lines.push_back(angles_of(check.evidence));
  for (const bool strengths : {false, true})
    if (Finding values = values_of(check.evidence, strengths); !values.cells.empty())
      lines.push_back(std::move(values));
  if (const auto unstated = without_scatter(check))
    lines.push_back(*unstated);
  else if (check.doubts.empty())
    lines.push_back({Kind::no_doubts});
  for (const Finding& limit : check.limits)
    if (limit.kind == Kind::no_layered_body || limit.kind == Kind::one_cell_of_no_body) {
      lines.push_back({Kind::no_body_in_short,
                       {limit.cells.front()},
                       {{"with_nu", check.evidence.has(Property::nu) ? 1.0 : 0.0}}});
      break;
    }
  std::ranges::copy_if(check.limits, std::back_inserter(lines), to_be_known_first);
  if (check.neighbour) lines.push_back(*check.neighbour);
  if (!check.parameters.empty()) lines.push_back(open_parameters(check.parameters));
  lines.push_back(check.forecast.empty() ? Finding{Kind::forecast_none} : check.forecast.front());
  if (const Finding* left_out = first_of(check.forecast, Kind::forecast_unmapped)) lines.push_back(*left_out);
  add_course(check, threads, lines);
  return lines;
}

std::string rock_check(const Rock& read, const std::string& path, int width, int threads, bool all) {
  const RockCheck found = check(read);
  const Rock& rock = found.evidence.rock;
  std::string text = wrapped(fmt::format("{} ({})\n", rock.name, path), width, 2);
  const auto items = [&](const std::vector<std::string>& lines, const char* mark) {
    for (const std::string& line : lines) text += wrapped(mark + line + "\n", width, 2);
  };
  items(rock.notes, "");  // how the files were understood
  items(report::sentences(summary_of(found, threads)), "");
  if (!all) return text;
  text += "\n" + report::target_table(found.evidence.targets, rock.bedded, width) + "\n";
  if (found.doubts.size() > most_doubts)
    items(report::sentences({found.doubts.begin() + most_doubts, found.doubts.end()}), "- ");
  items(report::sentences(found.statements), "- ");
  text += "\n" + report::identifiability_table(found.parameters, width);
  items(found.models, "- ");
  std::vector<Finding> limits = found.limits;  // beside what the summary says of them
  std::erase_if(limits, to_be_known_first);
  items(report::sentences(limits), "- ");
  items(found.in_maps, "- ");
  std::vector<Finding> grounds = found.forecast;  // beside what the summary says of it
  std::erase_if(grounds, [&](const Finding& f) {
    return f.kind == found.forecast.front().kind || f.kind == Kind::forecast_unmapped;
  });
  items(report::sentences(grounds), "- ");
  return text;
}

}  // namespace phy::jobs
