// Effects as text and CSV (study/effects.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "records/quality.hpp"
#include "report/text_table.hpp"
#include "study/effects.hpp"
#include "study/table.hpp"

namespace phy::study {
namespace {

constexpr const char* modulus = "E_tangent";
const std::vector<std::string> told = {"ucs", modulus, "nu"};

/// What the design tells first about a parameter, and how to print it.
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

/// GPa and the like for the terminal.
std::pair<double, std::string> readable(const std::string& unit) {
  if (unit == "Pa") return {1e-6, "MPa"};
  if (unit == "Pa/m") return {1e-9, "GPa/m"};
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
  report::Column keys{"", "", {}, true};
  for (const Factor& f : plan.study.vary) keys.cells.push_back(f.key.path());
  report::Columns columns;
  for (const Response& r : of) {
    const bool at_angle = r.specimen.starts_with("theta = ");
    report::Column c{r.specimen == "all angles" ? r.number
                     : at_angle                 ? r.specimen.substr(8)
                                                : r.specimen,
                     "",
                     {}};
    for (std::size_t k = 0; k < plan.study.vary.size(); ++k) {
      const auto effects = effects_of(plan, r, k);
      const Effect* e = named(effects, h.effect);
      c.cells.push_back(e != nullptr ? with_interval(e->value, scale, 1) : "-");
    }
    columns.push_back(std::move(c));
  }
  const std::string title =
      fmt::format("{}: {}{}", of.front().number, h.meaning, h.scale > 0.0 ? "" : " [" + unit + "]");
  return "\n" + report::wrapped(title, terminal_width) + "\n" +
         report::text_table(keys, {columns}, terminal_width);
}

std::string line_text(const Plan& plan, const Response& K, const std::string& field) {
  std::string text;
  for (std::size_t k = 0; k < plan.study.vary.size(); ++k) {
    if (plan.study.vary[k].key.field->path() != field) continue;
    const auto effects = effects_of(plan, K, k);
    const auto value = [&](const char* name) { return named(effects, name)->value; };
    text += fmt::format("  {} = {} {} + {} GPa/m, R2 {}, standard errors {:.4f} and {:.1f}\n", K.number,
                        with_interval(value("slope"), 1.0, 4), field.substr(8),
                        with_interval(value("intercept"), 1e-9, 1), with_interval(value("R2"), 1.0, 5),
                        value("slope se").mean, value("intercept se").mean * 1e-9);
  }
  return text;
}

std::string joints_text(const Plan& plan, const StudyRows& rows, int terminal_width) {
  const JointFits fits = fit_joints(plan, rows, modulus, theory::Eq1Reference::given);
  const auto any = [](const Response& r) {
    for (const auto& of : r.values)
      for (const double v : of)
        if (std::isfinite(v)) return true;
    return false;
  };
  if (!any(fits.K_n)) return "";
  std::string text = fmt::format(
      "\nmacro joint stiffness: Eq. 1 on {} (40-60 % of ucs), reference the intact rock\n"
      "  at the first point K_n = {}, K_s = {} GPa/m\n",
      modulus, with_interval(fits.K_n.at(0), 1e-9, 1), with_interval(fits.K_s.at(0), 1e-9, 1));
  if (plan.study.design == Design::one_at_a_time)
    text += line_text(plan, fits.K_n, "bedding.k_n") + line_text(plan, fits.K_s, "bedding.k_s");
  return report::wrapped(text, terminal_width, 4) + effect_table(plan, {fits.K_n, fits.K_s}, terminal_width);
}

/// All numbers of all specimens, then Eq. 1 on E at 50 % of ucs by every reference, and on E at small strain.
std::vector<Response> all_responses(const Plan& plan, const StudyRows& rows) {
  std::vector<Response> all;
  std::vector<std::string> names;
  for (const auto& row : rows)
    if (row)
      for (const Number& n : row->result.numbers)
        if (std::find(names.begin(), names.end(), n.name) == names.end()) names.push_back(n.name);
  for (const std::string& name : names)
    for (Response& r : responses(plan, rows, name)) all.push_back(std::move(r));
  const std::tuple<const char*, theory::Eq1Reference, const char*> fitted[] = {
      {modulus, theory::Eq1Reference::given, "reference intact"},
      {modulus, theory::Eq1Reference::measured_90, "reference E(90)"},
      {modulus, theory::Eq1Reference::free, "reference free"},
      {"E_small", theory::Eq1Reference::given, "reference intact (E_small)"}};
  for (const auto& [from, reference, name] : fitted) {
    JointFits fits = fit_joints(plan, rows, from, reference);
    std::vector<Response> of = std::move(fits.E);
    of.insert(of.end(), {fits.K_n, fits.K_s, fits.R2});
    for (Response& r : of) {
      r.specimen += fmt::format(", {}", name);
      all.push_back(std::move(r));
    }
  }
  return all;
}

/// How many finished tests the effects do without, and how many of the others carry a remark.
std::string left_out_text(const StudyRows& rows) {
  std::size_t n_finished = 0, n_untrusted = 0;
  QualityTally tally;
  for (const auto& row : rows) {
    if (!row) continue;
    ++n_finished;
    if (row->result.outcome.status == Status::peaked) tally.add(row->result.numbers);
    if (row->result.outcome.status == Status::untrusted) ++n_untrusted;
  }
  std::string text;
  if (const std::size_t n = n_finished - tally.n_results - n_untrusted; n > 0)
    text += fmt::format("\nleft out: {} of {} specimens, which did not peak\n", n, n_finished);
  if (n_untrusted > 0)
    text +=
        fmt::format("\nleft out: {} of {} specimens, which are not to be trusted\n", n_untrusted, n_finished);
  return text + (tally.text().empty() ? "" : "\n" + tally.text() + "\n");
}

std::string cells(const Summary& s) {
  return fmt::format("{},{},{},{}", s.n, csv_cell(s.mean), csv_cell(s.sd), csv_cell(s.half_width));
}

}  // namespace

std::string effects_text(const Plan& plan, const StudyRows& rows, int terminal_width) {
  std::string text = joints_text(plan, rows, terminal_width);
  for (const std::string& name : told)
    if (const std::vector<Response> of = responses(plan, rows, name); !of.empty())
      text += effect_table(plan, of, terminal_width);
  if (text.find("+-") != text.npos)
    text += report::wrapped("\n+-: 95 % of the mean over packings and bond seeds\n", terminal_width);
  return text + report::wrapped(left_out_text(rows), terminal_width);
}

StudyRows with_untrusted(StudyRows rows) {
  for (auto& row : rows)
    if (row && row->result.outcome.status == Status::untrusted) row->result.outcome.status = Status::peaked;
  return rows;
}

std::string effects_csv(const Plan& plan, const StudyRows& rows) {
  std::string text = "number,specimen,parameter,effect,unit,replicates,mean,sd,half width of 95 %\n";
  for (const Response& r : all_responses(plan, rows))
    for (std::size_t k = 0; k < plan.study.vary.size(); ++k)
      for (const Effect& e : effects_of(plan, r, k))
        text += fmt::format("{},{},{},{},{},{}\n", phy::csv_cell(r.number), phy::csv_cell(r.specimen),
                            plan.study.vary[k].key.path(), e.name, phy::csv_cell(e.unit), cells(e.value));
  return text;
}

std::string responses_csv(const Plan& plan, const StudyRows& rows) {
  std::string text = "number,unit,specimen,point";
  for (const Factor& f : plan.study.vary) text += "," + csv_head(f.key);
  text += ",replicates,mean,sd,half width of 95 %\n";
  for (const Response& r : all_responses(plan, rows))
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
