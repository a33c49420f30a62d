#include "cli/elastic_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "base/quote.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/terminal.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"
#include "study/stiffness_sweep.hpp"

namespace phy::cli {
namespace {

/// The paper's Eq. 2: K_n = 1.8135 k_n + 312.4 and K_s = 1.6895 k_s + 44.1, in GPa/m.
struct PaperLine {
  double slope, intercept, R2;
};
constexpr std::array<PaperLine, 2> eq2{{{1.8135, 312.4, 0.99999}, {1.6895, 44.1, 0.99965}}};
constexpr double giga = 1e-9;

/// All packings of one recipe under one rule.
struct Variant {
  std::string name;
  BeddingRule rule = BeddingRule::zone;
  std::vector<study::SweptPacking> packings;
};

const char* to_string(BeddingRule rule) { return rule == BeddingRule::zone ? "zone" : "crossing"; }
const char* to_string(study::Contacts c) { return c == study::Contacts::pushing ? "pushing" : "pulling"; }
const char* to_string(study::StrainReading s) {
  return s == study::StrainReading::gauge ? "gauge" : "platens";
}
const char* to_string(theory::Eq1Loss l) {
  return l == theory::Eq1Loss::compliance ? "compliance" : "modulus";
}
const char* to_string(theory::Eq1Reference r) {
  return r == theory::Eq1Reference::given         ? "intact"
         : r == theory::Eq1Reference::measured_90 ? "E(90)"
                                                  : "free";
}

/// The recipe itself, then the one it names, with the same sweep.
std::vector<Recipe> recipes_of(const Recipe& first, const std::string& path) {
  std::vector<Recipe> recipes{first};
  if (first.sweep.also.empty()) return recipes;
  std::string second = (std::filesystem::path(path).parent_path() / first.sweep.also).string();
  recipes.push_back(io::read_recipe(second));
  recipes.back().sweep = first.sweep;
  auto problems = cross_checks(recipes.back(), [&](const std::string&) { return second; });
  if (recipes.back().name == first.name)
    problems.push_back({second, "name", first.name, "another name than that of " + path,
                        "the tables tell the two by their names"});
  if (!problems.empty()) throw InputError(std::move(problems));
  return recipes;
}

/// Ctrl-C ends it after the packing at hand; what is complete is kept.
std::vector<Variant> sweep_all(const std::vector<Recipe>& recipes, int threads) {
  const std::atomic<bool>* stop = stop_on_interrupt();
  std::vector<Variant> variants;
  for (const Recipe& r : recipes) {
    const auto packings = study::sweep_packings(r, threads);
    std::vector<BeddingRule> rules{r.bedding[0].rule};
    if (r.sweep.both_rules)
      rules.push_back(rules[0] == BeddingRule::zone ? BeddingRule::crossing : BeddingRule::zone);
    for (const BeddingRule rule : rules) {
      Variant variant{r.name, rule, {}};
      for (std::size_t i = 0; i < packings.size() && !*stop; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const std::int64_t seed = r.packing.seed + static_cast<std::int64_t>(i);
        variant.packings.push_back(study::sweep_stiffness(packings[i], seed, r, rule, threads));
        const study::SweptPacking& p = variant.packings.back();
        print_out("swept   {}, seed {}, {} rule: {} sets at {} angles in {:.1f} s\n", r.name, seed,
                  to_string(rule), p.sets.size(), p.angles.size(), seconds_since(start));
        flush_out();
      }
      if (!variant.packings.empty()) variants.push_back(std::move(variant));
    }
  }
  return variants;
}

template <class Value>
Summary over_packings(const Variant& v, const Value& value) {
  std::vector<double> values;
  for (const study::SweptPacking& p : v.packings) values.push_back(value(p));
  return summarise(values);
}

/// E at 90 degrees over E of the intact specimen, at the recipe's own stiffnesses or those nearest to them.
double E90_ratio(const study::SweptPacking& p, study::Contacts contacts) {
  const auto c = static_cast<std::size_t>(contacts);
  const study::SweptSet& set = p.sets[p.swept[0][p.swept[0].size() / 2]];
  for (std::size_t i = 0; i < p.angles.size(); ++i)
    if (p.angles[i] == 90.0) return set.results[c][i].E_gauge / p.intact[c].E_gauge;
  return std::nan("");
}

std::string plus_minus(const Summary& s, double scale, int digits) {
  return s.n < 2 ? fmt::format("{:.{}f}", s.mean * scale, digits)
                 : fmt::format("{:.{}f} +- {:.{}f}", s.mean * scale, digits, s.half_width * scale, digits);
}

void print_variant(const Variant& v, int width) {
  const auto of = [&](double BeddingReport::*number) {
    return over_packings(v, [&](const study::SweptPacking& p) { return p.bedding.*number; });
  };
  const Summary porosity =
      over_packings(v, [](const study::SweptPacking& p) { return p.packing->report.porosity; });
  const Summary coordination =
      over_packings(v, [](const study::SweptPacking& p) { return p.packing->report.coordination; });
  const Summary intact = over_packings(v, [](const study::SweptPacking& p) { return p.intact[0].E_gauge; });
  const Summary ratio = over_packings(v, [](const study::SweptPacking& p) { return E90_ratio(p, {}); });
  print_wrapped(
      width, 0,
      "\n{}, {} rule, {} packing{}: porosity {:.3f}, coordination {:.2f}, sum(A)/L {}, bridges {:.1f} %,\n"
      "joints off the plane {:.1f} %, E intact {} GPa, E(90)/E intact {}\n",
      v.name, to_string(v.rule), v.packings.size(), v.packings.size() == 1 ? "" : "s", porosity.mean,
      coordination.mean, plus_minus(of(&BeddingReport::overlap_ratio), 1.0, 3),
      100.0 * of(&BeddingReport::bridge_fraction).mean,
      100.0 * of(&BeddingReport::non_crossing_fraction).mean, plus_minus(intact, giga, 2),
      plus_minus(ratio, 1.0, 3));
}

/// The readings that are printed: of the gauge, Eq. 1 in compliance.
std::vector<study::MacroReading> printed_readings() {
  std::vector<study::MacroReading> readings;
  for (const study::Contacts contacts : {study::Contacts::pushing, study::Contacts::pulling})
    for (const theory::Eq1Reference reference :
         {theory::Eq1Reference::given, theory::Eq1Reference::measured_90, theory::Eq1Reference::free})
      readings.push_back({contacts, study::StrainReading::gauge, theory::Eq1Loss::compliance, reference});
  return readings;
}

std::string name_of(const study::MacroReading& r) {
  return fmt::format("{}, {}", to_string(r.contacts), to_string(r.reference));
}

/// The line of one stiffness, "n" or "s", by every reading, below that of the paper. Why there is none goes
/// to `refused`.
report::Columns line_columns(const Variant& v, study::SweptStiffness what, std::string& refused) {
  const bool normal = what == study::SweptStiffness::normal;
  const PaperLine& paper = eq2[normal ? 0 : 1];
  report::Columns columns = {{normal ? "K_n/k_n" : "K_s/k_s", "", {fmt::format("{}", paper.slope)}},
                             {"intercept", "GPa/m", {fmt::format("{}", paper.intercept)}},
                             {"R2", "", {fmt::format("{:.5f}", paper.R2)}},
                             {normal ? "K_s" : "K_n", "%", {"-"}}};
  for (const study::MacroReading& reading : printed_readings()) {
    const study::MacroLine line = study::fit_macro_line(v.packings, what, reading);
    if (line.slope.n == 0) {
      for (report::Column& c : columns) c.cells.emplace_back("-");
      refused += fmt::format("{}: no line {}: {}\n", name_of(reading), normal ? "K_n(k_n)" : "K_s(k_s)",
                             line.refused);
      continue;
    }
    columns[0].cells.push_back(plus_minus(line.slope, 1.0, 4) + (line.refused.empty() ? "" : "*"));
    columns[1].cells.push_back(plus_minus(line.intercept, giga, 1));
    columns[2].cells.push_back(fmt::format("{:.5f}", line.R2.mean));
    columns[3].cells.push_back(fmt::format("{:.1f}", 100.0 * line.cross.mean));
  }
  return columns;
}

void print_lines(const Variant& v, int width) {
  report::Column label{"contacts, E ref.", "", {"paper, Eq. 2"}, true};
  for (const study::MacroReading& reading : printed_readings()) label.cells.push_back(name_of(reading));
  std::string refused;
  const report::Columns normal = line_columns(v, study::SweptStiffness::normal, refused),
                        shear = line_columns(v, study::SweptStiffness::shear, refused);
  print_out("{}", report::text_table(label, {normal, shear}, width));
  print_wrapped(width, 2, "{}", refused);
}

/// Calls `use` with every way to read and fit E(theta).
template <class Use>
void for_all_readings(const Use& use) {
  for (const study::Contacts contacts : {study::Contacts::pushing, study::Contacts::pulling})
    for (const study::StrainReading strain : {study::StrainReading::gauge, study::StrainReading::platens})
      for (const theory::Eq1Loss loss : {theory::Eq1Loss::compliance, theory::Eq1Loss::modulus})
        for (const theory::Eq1Reference reference :
             {theory::Eq1Reference::given, theory::Eq1Reference::measured_90, theory::Eq1Reference::free})
          use(study::MacroReading{contacts, strain, loss, reference});
}

std::string cells_of(const Variant& v, const study::MacroReading& r) {
  return fmt::format("{},{},{},{},{},{}", csv_cell(v.name), to_string(v.rule), to_string(r.contacts),
                     to_string(r.strain), to_string(r.loss), to_string(r.reference));
}
constexpr const char* reading_head = "recipe,rule,contacts,strain,loss,reference E";

std::string lines_csv(const std::vector<Variant>& variants) {
  std::string text = fmt::format(
      "{},line,packings,slope,slope +-,intercept [GPa/m],intercept +-,R2,"
      "change of the other K,refused\n",
      reading_head);
  for (const Variant& v : variants)
    for_all_readings([&](const study::MacroReading& r) {
      for (const study::SweptStiffness what : {study::SweptStiffness::normal, study::SweptStiffness::shear}) {
        const study::MacroLine l = study::fit_macro_line(v.packings, what, r);
        text += fmt::format("{},{},{},{:.4f},{:.4f},{:.2f},{:.2f},{:.6f},{:.4f},{}\n", cells_of(v, r),
                            what == study::SweptStiffness::normal ? "K_n(k_n)" : "K_s(k_s)", l.slope.n,
                            l.slope.mean, l.slope.half_width, l.intercept.mean * giga,
                            l.intercept.half_width * giga, l.R2.mean, l.cross.mean, csv_cell(l.refused));
      }
    });
  return text;
}

/// K_n and K_s of set number `point` of a sweep, mean over the packings that have them.
std::string point_cells(const Variant& v, const study::MacroReading& r, study::SweptStiffness what,
                        std::size_t point) {
  std::vector<double> K_n, K_s, R2;
  for (const study::SweptPacking& p : v.packings) {
    const theory::Eq1Fit fit = study::fit_macro(p, p.sets[p.swept[static_cast<std::size_t>(what)][point]], r);
    if (!fit.ok()) continue;
    K_n.push_back(fit.rock.K_n_delta / p.spacing), K_s.push_back(fit.rock.K_s_delta / p.spacing);
    R2.push_back(fit.R2);
  }
  const Summary n = summarise(K_n), s = summarise(K_s), quality = summarise(R2);
  return fmt::format("{},{:.2f},{:.2f},{:.2f},{:.2f},{:.5f}", n.n, n.mean * giga, n.half_width * giga,
                     s.mean * giga, s.half_width * giga, quality.mean);
}

/// The paper's Fig. 4 for the two stiffnesses: the varied one standardised by its base.
std::string fig4_csv(const std::vector<Variant>& variants, const std::vector<double>& factors) {
  std::string text = fmt::format(
      "{},varied,factor,k [GPa/m],packings,K_n [GPa/m],K_n +-,K_s [GPa/m],K_s +-,"
      "R2 of Eq. 1,Eq. 2 of the paper [GPa/m]\n",
      reading_head);
  for (const Variant& v : variants)
    for_all_readings([&](const study::MacroReading& r) {
      for (const study::SweptStiffness what : {study::SweptStiffness::normal, study::SweptStiffness::shear})
        for (std::size_t i = 0; i < factors.size(); ++i) {
          const auto w = static_cast<std::size_t>(what);
          const study::SweptSet& set = v.packings[0].sets[v.packings[0].swept[w][i]];
          const double k = (w == 0 ? set.k_n : set.k_s) * giga;
          text += fmt::format("{},{},{:g},{:g},{},{:.1f}\n", cells_of(v, r), w == 0 ? "k_n" : "k_s",
                              factors[i], k, point_cells(v, r, what, i), eq2[w].slope * k + eq2[w].intercept);
        }
    });
  return text;
}

void add_modulus(std::string& text, const Variant& v, const study::SweptPacking& p, const std::string& joints,
                 const std::string& theta, const ElasticResult& r) {
  text += fmt::format("{},{},{},{},{},{},{:.4f},{:.5f},{:.4f},{},{}\n", csv_cell(v.name), to_string(v.rule),
                      p.seed, joints, r.bilateral ? "pulling" : "pushing", theta, r.E_gauge * giga,
                      r.nu_gauge, r.E_platen * giga, r.n_alternating, csv_cell(r.outcome.reason));
}

std::string moduli_csv(const std::vector<Variant>& variants) {
  std::string text =
      "recipe,rule,seed,k_n [GPa/m],k_s [GPa/m],contacts,theta [deg],E gauge [GPa],nu gauge,E platens [GPa],"
      "undecided contacts,remark\n";
  for (const Variant& v : variants)
    for (const study::SweptPacking& p : v.packings)
      for (const std::size_t c : {0U, 1U}) {
        for (const study::SweptSet& set : p.sets)
          for (std::size_t i = 0; i < p.angles.size(); ++i)
            add_modulus(text, v, p, fmt::format("{:g},{:g}", set.k_n * giga, set.k_s * giga),
                        fmt::format("{:g}", p.angles[i]), set.results[c][i]);
        add_modulus(text, v, p, ",", "intact", p.intact[c]);
      }
  return text;
}

/// Specimens without an answer; true if there are none.
bool all_solved(const std::vector<Variant>& variants, int width) {
  bool solved = true;
  const auto check = [&](const Variant& v, const study::SweptPacking& p, const ElasticResult& r) {
    if (r.outcome.ok()) return;
    solved = false;
    print_wrapped(width, 2, "{}, {} rule, seed {}, {}: {}; {}\n", v.name, to_string(v.rule), p.seed, r.name,
                  r.outcome.reason, r.outcome.advice);
  };
  for (const Variant& v : variants)
    for (const study::SweptPacking& p : v.packings) {
      for (const ElasticResult& r : p.intact) check(v, p, r);
      for (const study::SweptSet& set : p.sets)
        for (const auto& results : set.results)
          for (const ElasticResult& r : results) check(v, p, r);
    }
  return solved;
}

struct SweepFiles {
  explicit SweepFiles(const std::filesystem::path& folder)
      : lines((folder / "lines.csv").string()),
        fig4((folder / "fig4.csv").string()),
        moduli((folder / "moduli.csv").string()),
        page((folder / "report.html").string()) {}
  std::string lines, fig4, moduli, page;
};

void write_tables(const std::vector<Variant>& variants, std::vector<double> factors,
                  const SweepFiles& files) {
  std::sort(factors.begin(), factors.end());
  io::write_output(files.lines, lines_csv(variants));
  io::write_output(files.fig4, fig4_csv(variants, factors));
  io::write_output(files.moduli, moduli_csv(variants));
}

}  // namespace

int run_elastic_sweep(const Recipe& recipe, const std::string& path, const std::string& out, int threads,
                      int width) {
  const std::vector<Recipe> recipes = recipes_of(recipe, path);
  const SweepFiles files(out);
  io::check_outputs({files.lines, files.fig4, files.moduli, files.page});
  io::check_writable(out);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Variant> variants = sweep_all(recipes, threads);
  if (variants.empty()) return print_out("stopped before any packing was finished; nothing was written\n"), 1;
  write_tables(variants, recipe.sweep.factors, files);  // before anything is printed: the output may be full
  for (const Variant& v : variants) {
    print_variant(v, width);
    print_lines(v, width);
  }
  print_wrapped(
      width, 0,
      "\nE by the gauge, Eq. 1 in compliance; +-: 95 % of the mean over the packings; K_s, K_n in %: change "
      "of "
      "the\nother stiffness from the smallest to the largest factor; *: packings without a line, see "
      "lines.csv\n");
  const bool solved = all_solved(variants, width), stopped = *stop_on_interrupt();
  if (stopped)
    print_wrapped(
        width, 0,
        "\nstopped: the tables hold the packings above; run the same command again for all of them\n");
  write_report(out);
  print_out("{:.1f} s in all; all readings in {}\n", seconds_since(start), out);
  return solved && !stopped ? 0 : 1;
}

}  // namespace phy::cli
