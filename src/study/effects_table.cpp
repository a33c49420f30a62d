// Effects as text and CSV (study/effects.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text_table.hpp"
#include "records/quality.hpp"
#include "records/test_description.hpp"
#include "study/effects.hpp"
#include "study/envelope.hpp"
#include "study/table.hpp"

namespace phy::study {
namespace {

/// Numbers whose effects are printed in the terminal: what the test is made for, and the moduli. The CSV
/// files hold all.
std::vector<std::string> printed_numbers(const Study& study) {
  if (study.solver == Solver::direct) return {"E_gauge", "nu_gauge"};
  return {study.base.test.kind->curve.quantity().number, "E_tangent", "nu"};
}

/// A way to K_n and K_s with its names: `name` in the tables, `title` of what is printed, if it is printed.
struct NamedReading {
  MacroReading reading;
  const char *name, *title;
};

/// The ways in which a study is read; the first is the usual one, the others show how much K depends on the
/// reference and on the strain at which E is read.
std::vector<NamedReading> all_readings(Solver solver) {
  using R = theory::Eq1Reference;
  if (solver == Solver::direct)
    return {{{"E_gauge", R::given}, "reference intact", "Eq. 1 on E_gauge, reference intact"},
            {{"E_gauge", R::measured_90}, "reference E(90)", "Eq. 1 on E_gauge, reference E(90)"},
            {{"E_gauge", R::free}, "reference free", "Eq. 1 on E_gauge, reference free"}};
  return {{{"E_tangent", R::given},
           "reference intact",
           "Eq. 1 on E_tangent (40-60 % of ucs), reference the intact rock"},
          {{"E_tangent", R::measured_90}, "reference E(90)", ""},
          {{"E_tangent", R::free}, "reference free", ""},
          {{"E_small", R::given}, "reference intact (E_small)", ""}};
}

/// The effect of a parameter that the design shows first, and how to print it.
struct Headline {
  const char* effect;
  const char* meaning;
  double scale;  ///< 0: of the response's own unit
};

Headline headline(Design design) {
  switch (design) {
    case Design::one_at_a_time: return {"change", "change from the lowest to the highest level [%]", 100.0};
    case Design::morris: return {"mu_star", "mean magnitude of the elementary effects, mu*", 0.0};
    case Design::saltelli: return {"S_total", "share of the variance, interactions included [%]", 100.0};
    default: return {"slope x range", "slope of the plane times the parameter's range", 0.0};
  }
}

/// GPa and the like for the terminal; the CSV files stay in SI units.
std::pair<double, std::string> readable(const std::string& unit) {
  if (unit == "Pa") return {1e-6, "MPa"};
  if (unit == "Pa/m") return {1e-9, "GPa/m"};
  if (unit == "Pa sqrt(m)") return {1e-6, "MPa sqrt(m)"};
  return {1.0, unit};
}

std::string with_interval(const Summary& s, double scale, int digits) {
  if (!std::isfinite(s.mean)) return "-";
  std::string text = fmt::format("{:.{}f}", s.mean * scale, digits);
  if (s.n > 1) text += fmt::format("+-{:.{}f}", s.half_width * scale, digits);
  return text;
}

const Effect* named(const std::vector<Effect>& effects, const std::string& name) {
  for (const Effect& e : effects)
    if (e.name == name) return &e;
  return nullptr;
}

/// Parameters down, responses across.
std::string effect_table(const Plan& plan, const std::vector<Response>& of, int terminal_width) {
  if (plan.study.vary.empty()) return "";
  const Headline h = headline(plan.study.design);
  const auto [own, unit] = readable(of.front().unit);
  const double scale = h.scale > 0.0 ? h.scale : own;
  Column keys{"", "", {}, true};
  for (const Factor& f : plan.study.vary) keys.cells.push_back(f.key.path());
  Columns columns;
  for (const Response& r : of) {
    // The angle alone as the head of a column: "30 deg".
    const bool at_angle = r.specimen.starts_with("theta = ");
    Column c{r.specimen == "all angles" ? r.number : at_angle ? r.specimen.substr(8) : r.specimen, "", {}};
    for (std::size_t k = 0; k < plan.study.vary.size(); ++k) {
      const auto effects = effects_of(plan, r, k);
      const Effect* e = named(effects, h.effect);
      c.cells.push_back(e != nullptr ? with_interval(e->value, scale, 1) : "-");
    }
    columns.push_back(std::move(c));
  }
  const std::string title =
      fmt::format("{}: {}{}", of.front().number, h.meaning, h.scale > 0.0 ? "" : " [" + unit + "]");
  return "\n" + wrapped(title, terminal_width) + "\n" + text_table(keys, {columns}, terminal_width);
}

/// The line K(k), and below it what others found.
std::string line_text(const Plan& plan, const Response& K, const std::string& field) {
  std::string text;
  const std::string k_name = field.substr(8);
  for (std::size_t k = 0; k < plan.study.vary.size(); ++k) {
    if (plan.study.vary[k].key.field->path() != field) continue;
    const auto effects = effects_of(plan, K, k);
    const auto value = [&](const char* name) { return named(effects, name)->value; };
    text += fmt::format("  {} = {} {} + {} GPa/m, R2 {}, standard errors {:.4f} and {:.1f}\n", K.number,
                        with_interval(value("slope"), 1.0, 4), k_name,
                        with_interval(value("intercept"), 1e-9, 1), with_interval(value("R2"), 1.0, 5),
                        value("slope se").mean, value("intercept se").mean * 1e-9);
    // Published lines under the study's own, in the same units.
    for (const Regression& r : plan.study.regressions)
      if (r.number == K.number && r.key == field)
        text += r.unit != K.unit
                    ? fmt::format("  {}: is in {}, not in Pa/m: not compared\n", r.source, r.unit)
                    : fmt::format("  {}: {} = {:.4f} {} + {:.1f} GPa/m, R2 {}\n", r.source, K.number, r.slope,
                                  k_name, r.intercept * 1e-9,
                                  std::isfinite(r.R2) ? fmt::format("{:.5f}", r.R2) : "-");
  }
  return text;
}

std::string joints_text(const Plan& plan, const StudyRows& rows, int terminal_width) {
  std::string text, table;
  const auto any = [](const Response& r) {
    for (const auto& of : r.values)
      for (const double v : of)
        if (std::isfinite(v)) return true;
    return false;
  };
  for (const NamedReading& named : all_readings(plan.study.solver)) {
    // Thousands of fits in a large study: only those that are printed are made.
    if (*named.title == '\0') continue;
    const JointFits fits = fit_joints(plan, rows, named.reading);
    if (!any(fits.K_n)) continue;
    std::string own = fmt::format(
        "\nmacro joint stiffness: {}\n  at the first point K_n = {}, K_s = {} GPa/m\n", named.title,
        with_interval(fits.K_n.at(0), 1e-9, 1), with_interval(fits.K_s.at(0), 1e-9, 1));
    if (plan.study.design == Design::one_at_a_time)
      own += line_text(plan, fits.K_n, "bedding.k_n") + line_text(plan, fits.K_s, "bedding.k_s");
    text += wrapped(own, terminal_width, 4);
    // The table of main effects once, by the first reading that has K; the others differ by their reference.
    if (table.empty()) table = effect_table(plan, {fits.K_n, fits.K_s}, terminal_width);
  }
  return text + table;
}

/// How many finished tests the effects do without, and how many of the others carry a warning.
std::string left_out_text(const StudyRows& rows, Solver solver) {
  // Answers, untrusted results, and what is left over: specimens without a peak or solution.
  std::size_t n_finished = 0, n_untrusted = 0, n_knees = 0;
  QualityTally tally;
  for (const auto& row : rows) {
    // Not yet run: not left out either.
    if (!row) continue;
    ++n_finished;
    if (has_answer(row->result.outcome.status)) tally.add(row->result.numbers);
    if (row->result.outcome.status == Status::untrusted) ++n_untrusted;
    // Untrusted ones that are counted all the same stand as peaked.
    const Status status = row->result.outcome.status;
    if (status == Status::knee ||
        (status == Status::peaked && rule_of(row->result) == analysis::StrengthRule::knee))
      ++n_knees;
  }
  std::string text;
  if (const std::size_t n = n_finished - tally.n_results - n_untrusted; n > 0)
    text += fmt::format("\nleft out: {} of {} specimens, which {}\n", n, n_finished,
                        solver == Solver::direct ? "have no elastic solution" : "did not peak");
  if (n_untrusted > 0)
    text +=
        fmt::format("\nleft out: {} of {} specimens, which are not to be trusted\n", n_untrusted, n_finished);
  if (n_knees > 0)
    text +=
        fmt::format("\nstrength at a knee: {} of {} specimens, which show no peak\n", n_knees, n_finished);
  return text + (tally.text().empty() ? "" : "\n" + tally.text() + "\n");
}

std::string cells(const Summary& s) {
  return fmt::format("{},{},{},{}", s.n, csv_cell(s.mean), csv_cell(s.sd), csv_cell(s.half_width));
}

}  // namespace

std::string effects_text(const Plan& plan, const StudyRows& rows, int terminal_width) {
  std::string text = joints_text(plan, rows, terminal_width);
  for (const std::string& name : printed_numbers(plan.study))
    if (const std::vector<Response> of = responses(plan, rows, name); !of.empty())
      text += effect_table(plan, of, terminal_width);
  // A study of one replicate has no interval, and needs no explanation of one.
  if (text.find("+-") != text.npos)
    text += wrapped("\n+-: 95 % of the mean over packings and bond seeds\n", terminal_width);
  return text + wrapped(left_out_text(rows, plan.study.solver), terminal_width);
}

StudyRows with_untrusted(StudyRows rows) {
  for (auto& row : rows)
    // The warnings remain in the numbers; only the exclusion is lifted.
    if (row && row->result.outcome.status == Status::untrusted) row->result.outcome.status = Status::peaked;
  return rows;
}

std::vector<Response> all_responses(const Plan& plan, const StudyRows& rows) {
  std::vector<Response> all;
  std::vector<std::string> names;
  for (const auto& row : rows)
    if (row)
      for (const Number& n : row->result.numbers)
        if (std::find(names.begin(), names.end(), n.name) == names.end()) names.push_back(n.name);
  for (const std::string& name : names)
    for (Response& r : responses(plan, rows, name)) all.push_back(std::move(r));
  for (const NamedReading& named : all_readings(plan.study.solver)) {
    JointFits fits = fit_joints(plan, rows, named.reading);
    std::vector<Response> of = std::move(fits.E);
    of.insert(of.end(), {fits.K_n, fits.K_s, fits.R2});
    for (Response& r : of) {
      r.specimen += fmt::format(", {}", named.name);
      all.push_back(std::move(r));
    }
  }
  return all;
}

std::string effects_csv(const Plan& plan, const std::vector<Response>& all) {
  std::string text = "number,specimen,parameter,effect,unit,replicates,mean,sd,half width of 95 %\n";
  for (const Response& r : all)
    for (std::size_t k = 0; k < plan.study.vary.size(); ++k) {
      std::vector<Effect> effects = effects_of(plan, r, k);
      const std::vector<Effect> beside = beside_regressions(plan, r, k, effects);
      effects.insert(effects.end(), beside.begin(), beside.end());
      for (const Effect& e : effects)
        text += fmt::format("{},{},{},{},{},{}\n", phy::csv_cell(r.number), phy::csv_cell(r.specimen),
                            plan.study.vary[k].key.path(), phy::csv_cell(e.name), phy::csv_cell(e.unit),
                            cells(e.value));
    }
  return text;
}

std::string responses_csv(const Plan& plan, const std::vector<Response>& all) {
  std::string text = "number,unit,specimen,point";
  for (const Factor& f : plan.study.vary) text += "," + csv_head(f.key);
  text += ",replicates,mean,sd,half width of 95 %\n";
  for (const Response& r : all)
    for (std::size_t p = 0; p < plan.points.size(); ++p) {
      text += fmt::format("{},{},{},{}", phy::csv_cell(r.number), phy::csv_cell(r.unit),
                          phy::csv_cell(r.specimen), p);
      for (std::size_t k = 0; k < plan.study.vary.size(); ++k)
        text += "," + csv_cell(plan.study.vary[k].key, plan.points[p].values[k]);
      text += "," + cells(r.at(p)) + "\n";
    }
  return text;
}

}  // namespace phy::study
