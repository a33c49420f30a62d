#include "report/calibration_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <set>
#include <utility>

#include "base/text_table.hpp"
#include "report/baselines.hpp"
#include "report/calibration_summary.hpp"
#include "report/words.hpp"

namespace phy::report {
namespace {

/// Factor of the unit in which a property is printed.
double shown(Property p) { return shown_unit(p).factor; }

/// "38.0 [36.9, 39.2]": a number of the calibration's recipe and its interval in a friendly unit; one that
/// was not fitted stands alone, with the word for that. A calibration that was stopped may have been about to
/// fit it.
std::string cell(const Calibration& c, const double& number, double unit, const char* otherwise = "given") {
  for (const ParameterEstimate& e : c.parameters)
    // By address: the estimate names its place in the recipe, so no second list of names can disagree.
    if (e.number != nullptr && &e.number(c.recipe) == &number)
      return !e.has_interval() ? fmt::format("{:.4g}", number / unit)
                               : fmt::format("{:.4g} [{:.3g}, {:.3g}]{}", number / unit, e.low / unit,
                                             e.high / unit, e.determined ? "" : " open");
  if (c.verdict.status == VerdictStatus::interrupted) otherwise = "as in the recipe";
  return fmt::format("{:.4g} ({})", number / unit, otherwise);
}

const char* unit_head(Property p) { return shown_unit(p).name; }

/// Laboratory, model, error.
std::vector<std::string> cells_of(const Comparison& row) {
  const Property p = row.target.property;
  // nu by difference, as it is judged: 20 % of 0.2 sounds worse than it is.
  return {number_text(row.target.mean * shown(p)), number_text(row.mean * shown(p)),
          !row.answered()     ? "-"
          : p == Property::nu ? fmt::format("{:+.2f}", miss(row))
                              : fmt::format("{:+.1f}", 100.0 * miss(row))};
}

/// Has the model layers? The angles of a rock without any are one, which says nothing.
bool is_bedded(const Calibration& c) {
  return layered(c.recipe.matrix, c.recipe.bedding) ||
         std::any_of(c.fitted.begin(), c.fitted.end(),
                     [](const Comparison& r) { return r.target.theta != 0.0; });
}

/// Of the table as it was read: an inclination and a stress on the sides; discs of another size have a line
/// more.
struct Line {
  double theta = 0.0, confining = 0.0;
  int more = 0;
  // The order of the members is that of the rows: by angle, then by stress.
  auto operator<=>(const Line&) const = default;
  std::string name(bool bedded) const {
    const std::string stress = confining > 0.0 ? fmt::format("{:.3g} MPa", confining * 1e-6) : "";
    if (!bedded) return stress.empty() ? "none" : stress;
    return fmt::format("{:g}", theta) + (stress.empty() ? "" : ", " + stress);
  }
};

std::string number_cell(const Comparison& r, double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value * shown(r.target.property)) : std::string("-");
}
std::string value_cell(const Comparison* r) { return r != nullptr ? number_cell(*r, r->mean) : "-"; }
std::string error_cell(const Comparison* r) {
  if (r == nullptr || !r->answered()) return "-";
  return r->target.property == Property::nu ? fmt::format("{:+.3f}", miss(*r))
                                            : fmt::format("{:+.1f} %", 100.0 * miss(*r));
}

}  // namespace

std::string target_table(const std::vector<Target>& targets, bool bedded, int terminal_width) {
  std::map<Line, std::map<Property, const Target*>> lines;
  // A set, so that columns come in the order of the properties whatever the order of the table.
  std::set<Property> properties;
  bool assumed = false, sizes = false;  // discs of sizes of their own
  for (const Target& t : targets) {
    Line line{t.theta, t.confining, 0};
    // Two discs of different diameter share angle and stress, but no cell.
    while (lines[line].contains(t.property)) ++line.more;
    lines[line][t.property] = &t;
    properties.insert(t.property);
    assumed = assumed || t.sd_assumed, sizes = sizes || t.diameter > 0.0;
  }
  Column theta{bedded ? "theta" : "confinement", bedded ? "deg" : "", {}};
  for (const auto& [line, cells] : lines) theta.cells.push_back(line.name(bedded));
  std::vector<Columns> groups;
  for (const Property p : properties) {
    Column value{to_string(p), unit_head(p), {}}, scatter{"+- SD", unit_head(p), {}}, n{"n", "", {}},
        disc{"disc", "mm", {}};
    for (const auto& [line, cells] : lines) {
      const auto it = cells.find(p);
      const Target* t = it == cells.end() ? nullptr : it->second;
      value.cells.push_back(t == nullptr ? "-" : fmt::format("{:.4g}", t->mean * shown(p)));
      scatter.cells.push_back(
          t == nullptr ? "-" : fmt::format("{:.2g}{}", t->sd * shown(p), t->sd_assumed ? "*" : ""));
      n.cells.push_back(t == nullptr ? "-" : fmt::format("{}", t->n));
      disc.cells.push_back(t == nullptr || t->diameter == 0.0 ? "-" : fmt::format("{:g}", t->diameter * 1e3));
    }
    // A group stays together where the terminal breaks the table.
    groups.push_back({value, scatter, n});
    if (measured(p).of_discs && sizes) groups.back().push_back(disc);
  }
  return text_table(theta, groups, terminal_width) +
         wrapped(
             fmt::format("SD: scatter of single specimens. With few specimens a value is averaged with the "
                         "other cells and with usual scatter.{}\n",
                         assumed ? " *: mostly usual scatter." : ""),
             terminal_width, 2);
}

std::string identifiability_table(const std::vector<ParameterEstimate>& estimates, int terminal_width) {
  Column symbol{"parameter", "", {}, true}, determined{"determined", "", {}, true},
      interval{"expected interval", "", {}, true}, why{"rests on / next test", "", {}, true};
  for (const ParameterEstimate& e : estimates) {
    const std::string range =
        // As multiples of the value to come, which nobody knows before the fit.
        std::isfinite(e.low) ? fmt::format("x {:.2f} ... {:.2f}", e.low, e.high) : "known after the fit";
    symbol.cells.push_back(e.symbol);
    determined.cells.emplace_back(e.determined ? "yes" : "no");
    // An open parameter has expected ends, too, which would look like knowledge.
    interval.cells.push_back(e.determined || !std::isfinite(e.low) ? range : "wide");
    why.cells.push_back(e.determined                    ? text_of(e.rests_on)
                        : e.next.remedy == Remedy::none ? "no test of a table determines it"
                                                        : "next: " + text_of(e.next));
  }
  return wrapped(text_table(symbol, {{determined, interval}, {why}}, terminal_width), terminal_width,
                 symbol.width() + 2);
}

/// What the matrix has beside the bonds of the paper: the same everywhere and in every direction, the moment
/// counting in full, no friction.
std::vector<std::pair<std::string, std::string>> departures(const Calibration& c) {
  const MatrixRecipe& m = c.recipe.matrix;
  std::vector<std::pair<std::string, std::string>> rows;
  // Rows only for what departs from the paper's model: its tables stay comparable line by line.
  if (m.model == MatrixModel::parallel_bond && m.moment_contribution < 1.0)
    rows.emplace_back("Moment contribution beta_bar", cell(c, m.moment_contribution, 1.0));
  if (m.shear_strength == ShearStrength::cohesion_friction)
    rows.emplace_back("Friction angle phi [deg]", cell(c, m.phi, 1.0));
  if (m.unbonded_fraction > 0.0) rows.emplace_back("Share without a bond", cell(c, m.unbonded_fraction, 1.0));
  if (m.directional())
    rows.insert(rows.end(), {{"Stiffness along/across r_E", cell(c, m.stiffness_ratio, 1.0)},
                             {"Normal strength along/across r_t", cell(c, m.tension_ratio, 1.0)},
                             {"Shear strength along/across r_c", cell(c, m.cohesion_ratio, 1.0)},
                             {"Shear strength oblique q_c", cell(c, m.cohesion_oblique, 1.0)}});
  return rows;
}

/// Table 1 of the paper; flat joints are what contacts and bonds are in one.
std::vector<ParameterTable> matrix_tables(const Calibration& c) {
  using Rows = std::vector<std::pair<std::string, std::string>>;
  const MatrixRecipe& m = c.recipe.matrix;
  const double GPa = 1e9, MPa = 1e6;
  const Rows density = {{"Density [kg/m^3]", fmt::format("{:g} (given)", m.density)}},
             stiffness = {{"Modulus E_c [GPa]", cell(c, m.E_c, GPa)},
                          {"Stiffness ratio k_s/k_n", cell(c, m.ks_over_kn, 1.0)}},
             friction = {{"Friction coefficient mu", cell(c, m.mu, 1.0)}},
             strength = {{"Mean normal strength [MPa]", cell(c, m.sigma_c, MPa)},
                         {"Mean shear strength [MPa]", cell(c, m.tau_c, MPa)},
                         {"SD of both / mean", fmt::format("{:.3g} (given)", m.sigma_c_sd / m.sigma_c)}};
  const auto joined = [](const std::vector<Rows>& parts) {
    Rows all;
    for (const Rows& rows : parts) all.insert(all.end(), rows.begin(), rows.end());
    return all;
  };
  const char* title = "Table 1. Intact rock";
  if (m.model == MatrixModel::parallel_bond) {
    // A calibration seeks one modulus for contacts and bonds, printed in both places as the paper does. A
    // recipe whose moduli were not sought may have two.
    const bool one = m.E_b == m.E_c && m.bond_ks_over_kn == m.ks_over_kn;
    const Rows of_bonds = {{"Modulus E_b [GPa]", cell(c, m.E_b, GPa)},
                           {"Stiffness ratio k_s/k_n", cell(c, m.bond_ks_over_kn, 1.0)}};
    return {{title, "balls", joined({density, stiffness, friction})},
            {"", "parallel bonds", joined({one ? stiffness : of_bonds, strength})}};
  }
  const Rows elements = {{"Elements of an interface", fmt::format("{} (given)", m.elements)}};
  return {{title, "flat joints", joined({density, stiffness, friction, strength, elements})}};
}

std::vector<ParameterTable> parameter_rows(const Calibration& c) {
  const double GPa = 1e9, MPa = 1e6;
  std::vector<ParameterTable> tables = matrix_tables(c);
  if (auto more = departures(c); !more.empty()) tables.push_back({"", "bonds, more", std::move(more)});
  if (c.recipe.bedding.empty()) return tables;
  const BeddingRecipe& b = c.recipe.bedding.front();
  tables.push_back({"Table 2. Bedding",
                    b.rule == BeddingRule::crossing ? "joints on contacts that cross" : "smooth joints",
                    {{"Normal stiffness k_n,sj [GPa/m]", cell(c, b.k_n, GPa)},
                     {"Shear stiffness k_s,sj [GPa/m]", cell(c, b.k_s, GPa)},
                     {"Friction coefficient mu_sj", cell(c, b.mu, 1.0)},
                     {"Normal strength sigma_n,sj [MPa]", cell(c, b.sigma_n, MPa)},
                     {"Cohesion C_sj [MPa]", cell(c, b.cohesion, MPa)}}});
  auto& joints = tables.back().rows;
  if (b.phi > 0.0) joints.emplace_back("Friction angle, bonded, phi_sj [deg]", cell(c, b.phi, 1.0));
  if (b.persistence < 1.0) {
    joints.emplace_back("Persistence p", cell(c, b.persistence, 1.0, "not fitted"));
    if (b.patch_length > 0.0)
      joints.emplace_back("Length of a patch [mm]", fmt::format("{:.4g} (given)", b.patch_length * 1e3));
  }
  if (b.rule == BeddingRule::zone)
    joints.emplace_back("Thickness d [mm]", fmt::format("{:g} (given)", b.zone_thickness * 1e3));
  joints.emplace_back("Spacing [mm]", fmt::format("{:g} (given)", b.spacing * 1e3));
  return tables;
}

std::string parameter_tables(const Calibration& c, int terminal_width) {
  const bool intervals = c.method == CalibrationMethod::posterior;
  std::string text;
  for (const ParameterTable& t : parameter_rows(c)) {
    Column name{t.head, "", {}, true}, value{intervals ? "value [95 % interval]" : "value", "", {}, true};
    for (const auto& [n, v] : t.rows) name.cells.push_back(n), value.cells.push_back(v);
    text += (text.empty() ? "" : "\n") + (t.title.empty() ? "" : t.title + "\n") +
            text_table(name, {{value}}, terminal_width);
  }
  return text;
}

/// Rows of the calibration by test and angle, as unseen packings have them; what was compared alone comes
/// last.
std::vector<std::map<double, Comparison>> by_test(const Calibration& c) {
  std::vector<std::map<double, Comparison>> tests;
  std::vector<Comparison> rows = c.fitted;
  rows.insert(rows.end(), c.compared.begin(), c.compared.end());
  for (const Comparison& f : rows) {
    const Comparison* unseen = row_of(c.verification, f.target);
    auto it = std::find_if(tests.begin(), tests.end(), [&](const auto& cells) {
      return same_test(cells.begin()->second.target, f.target);
    });
    if (it == tests.end()) it = tests.insert(it, std::map<double, Comparison>());
    (*it)[f.target.theta] = unseen != nullptr ? *unseen : f;
  }
  return tests;
}

std::string angle_table(const Calibration& c, int terminal_width) {
  if (c.fitted.empty()) return "";
  const std::vector<std::map<double, Comparison>> tests = by_test(c);
  std::set<double> angles;
  for (const auto& cells : tests)
    for (const auto& [theta, row] : cells) angles.insert(theta);
  Column label{is_bedded(c) ? "theta [deg]" : "", "", {}, true};
  std::vector<Columns> columns;
  // Angles across: a table of a rock has seldom more than seven, but many tests.
  for (const double theta : angles)
    columns.push_back({{is_bedded(c) ? fmt::format("{:g}", theta) : "any direction", "", {}}});
  for (const std::map<double, Comparison>& cells : tests) {
    const Target& t = cells.begin()->second.target;
    const Property p = t.property;
    const std::string unit = unit_head(p);
    label.cells.push_back(to_string(p) + (unit.empty() ? "" : " [" + unit + "]") + particulars(t) +
                          (row_of(c.compared, t) != nullptr ? ", not fitted" : ""));
    label.cells.insert(label.cells.end(), {"  model", p == Property::nu ? "  error" : "  error %"});
    std::size_t i = 0;
    for (const double theta : angles) {
      const auto at = cells.find(theta);
      std::vector<std::string>& column = columns[i++].front().cells;
      if (at == cells.end()) {
        // A test need not have every angle of another.
        column.insert(column.end(), 3, "-");
        continue;
      }
      const std::vector<std::string> three = cells_of(at->second);
      column.insert(column.end(), three.begin(), three.end());
    }
  }
  const std::string which = c.verification.empty() ? "the packings of the fit" : "unseen packings";
  const bool E = std::any_of(c.fitted.begin(), c.fitted.end(),
                             [](const Comparison& f) { return f.target.property == Property::E; });
  return "Laboratory and model, on " + which + (E ? fmt::format("; E: {}\n", to_string(c.E_is)) : "\n") +
         text_table(label, columns, terminal_width);
}

std::string failure_table(const Calibration& c, int terminal_width) {
  const auto within = [](double mean, double sd, double unit) {
    if (!std::isfinite(mean)) return std::string("none");
    return fmt::format("{:.0f}", mean * unit) +
           (std::isfinite(sd) ? fmt::format(" +- {:.0f}", sd * unit) : "");
  };
  // Unseen packings where there are some: they have had no part in the choice of parameters.
  std::vector<Comparison> rows = c.verification.empty() ? c.fitted : c.verification;
  rows.insert(rows.end(), c.compared.begin(), c.compared.end());
  std::erase_if(rows, [](const Comparison& row) {  // a test is one line, whatever is read in it
    return row.failure.n_tests == 0 || measured(row.target.property).read_in;
  });
  if (rows.empty()) return "";
  using R = const Comparison&;
  Column test = column_of("how specimens fail", "", rows,
                          [&](R r) { return is_bedded(c) ? cell_name(r.target) : test_name(r.target); });
  test.left = true;
  const Columns columns = {
      column_of("cracks along bedding", "%", rows,
                [&](R r) { return within(r.failure.bedding_share, r.failure.bedding_share_sd, 100.0); }),
      column_of("failure plane", "deg", rows,
                [&](R r) { return within(r.failure.angle, r.failure.angle_sd, 1.0); }),
      column_of("seen in", "", rows,
                [](R r) { return fmt::format("{} of {}", r.failure.n_planes, r.failure.n_tests); })};
  return text_table(test, {columns}, terminal_width) +
         wrapped(
             "mean and SD between packings; the plane is inclined like theta, negative: against the "
             "bedding; none: the cracks do not line up\n",
             terminal_width, 2);
}

constexpr const char* at_half_of_ucs =
    "at 50 % UCS: fit and unseen are at small strain. This column is unseen times the effect of cracks, read "
    "in tests at 40 - 60 % of UCS (on one packing, where the others are hurried)\n";

std::string macro_table(const Calibration& c, int terminal_width) {
  const auto column = [&](const char* head, const auto& cell) {
    Column col{head, "", {}};
    for (const Comparison& f : c.fitted) col.cells.push_back(cell(f));
    return col;
  };
  using R = const Comparison&;
  Column label = column(is_bedded(c) ? "at theta [deg]" : "test", [&](R r) {
    const std::string unit = unit_head(r.target.property);
    return fmt::format("{:<3}{}{}{}", to_string(r.target.property),
                       is_bedded(c) ? fmt::format(" {:>4g}", r.target.theta) : "",
                       unit.empty() ? "" : " [" + unit + "]", particulars(r.target));
  });
  label.left = true;
  const Columns laboratory = {
      column("lab", [&](R r) { return number_cell(r, r.target.mean); }),
      column("+- se",
             [](R r) { return fmt::format("{:.2g}", r.target.standard_error() * shown(r.target.property)); }),
      column("rock, 95 %",
             [&](R r) { return fmt::format("{} ... {}", number_cell(r, r.low), number_cell(r, r.high)); })};
  Columns fit = {column("fit", [](R r) { return value_cell(&r); }),
                 column("error", [](R r) { return error_cell(&r); })};
  // Side by side with the fit: a model that only remembers its packings shows here.
  const Columns unseen = {column("unseen", [&](R r) { return value_cell(row_of(c.verification, r.target)); }),
                          column("error", [&](R r) { return error_cell(row_of(c.verification, r.target)); })};
  std::string legend = "rock, 95 %: of the mean, by laboratory and model together\n";
  if (!c.discrepancy.empty()) {
    fit.push_back(column("with discrepancy", [&](R r) { return number_cell(r, r.with_discrepancy); }));
    legend +=
        "with discrepancy: fit times what the model misses of the table, as a smooth function of theta\n";
  }
  std::vector<Columns> groups = {laboratory, fit, unseen};
  // The word E means three slopes in the literature, and a reader cannot see which.
  if (c.E_is != ModulusReading::small_strain)
    legend += fmt::format("E: {}, of the laboratory and of the press alike\n", to_string(c.E_is));
  if (!c.tangent_from_test.empty()) {
    groups.push_back(
        {column("at 50 % UCS", [&](R r) { return value_cell(row_of(c.tangent_from_test, r.target)); })});
    legend += at_half_of_ucs;
  }
  return text_table(label, groups, terminal_width) + wrapped(legend, terminal_width, 2);
}

std::string eq2_table(const Calibration& c, int terminal_width) {
  if (c.eq2.empty()) return "";
  using R = const PlaneStiffness&;
  const auto column = [&](const std::string& head, const char* unit, const char* format, auto number) {
    return column_of(head, unit, c.eq2, [=](R r) {
      const double x = number(r);
      // Of some bands Eq. 1 has no fit; the row stays, so that nobody takes it for forgotten.
      return std::isfinite(x) ? fmt::format(fmt::runtime(format), x) : std::string("-");
    });
  };
  Column label = column_of("planes", "", c.eq2, [](R r) { return r.planes; });
  label.left = true;
  std::vector<Columns> groups;
  const auto add = [&](const char* ratio, StiffnessRelation PlaneStiffness::*of) {
    groups.push_back(
        {column(ratio, "", "{:.2f}", [of](R r) { return (r.*of).ratio; }),
         column("slope", "", "{:.2f}", [of](R r) { return (r.*of).line.slope; }),
         column("intercept", "GPa/m", "{:.0f}", [of](R r) { return (r.*of).line.intercept * 1e-9; }),
         column("R2", "", "{:.4f}", [of](R r) { return (r.*of).line.R2; })});
  };
  add("K_n/k_n", &PlaneStiffness::normal), add("K_s/k_s", &PlaneStiffness::shear);
  return wrapped(
             "Eq. 2: stiffness K of the planes over k of their joints, and the line K = slope k + "
             "intercept\n",
             terminal_width, 2) +
         text_table(label, groups, terminal_width) +
         wrapped(
             "packings of the fit; lines through joints of half, once and twice the stiffness, the rest as "
             "calibrated, K/k at once. E(theta) by direct solutions whose contacts also pull, K by Eq. 1 "
             "with E at 90 degrees. The relation bends, the lower R2 the more; -: Eq. 1 does not hold\n",
             terminal_width, 2);
}

std::string error_table(const Calibration& c, int terminal_width) {
  if (c.fitted.empty()) return "";
  const std::vector<ErrorRow> rows = error_rows(c);
  Column label{"root mean square error", "", {}, true};
  for (const ErrorRow& r : rows) label.cells.push_back(r.of);
  std::vector<Columns> groups;
  for (std::size_t i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    // Only properties of the table: columns of dashes would crowd out the others.
    if (std::any_of(c.fitted.begin(), c.fitted.end(),
                    [&](const Comparison& row) { return row.target.property == p; }))
      groups.push_back(
          {column_of(to_string(p), "", rows, [&](const ErrorRow& r) { return miss_text(p, r.rms[i]); })});
  }
  std::string legend;
  // Rows of values left out come last.
  if (rows.back().is_left_out)
    legend = "left out: those with neighbours on both sides, each predicted from the others\n";
  for (const LeftOutErrors& e : left_out_errors(c))
    if (const std::string line = sentence(e); !line.empty()) legend += line + "\n";
  return text_table(label, groups, terminal_width) + wrapped(legend, terminal_width, 2);
}

std::string verdict_text(const Calibration& c, int terminal_width) {
  std::string text = fmt::format("verdict: {}\n", to_string(c.verdict.status));
  for (const std::string& line : sentences(c.verdict.findings)) text += "- " + line + "\n";
  for (const std::string& line : open_lines(c)) text += "- " + line + "\n";
  for (const std::string& line : sentences(c.notes)) text += "- " + line + "\n";
  return wrapped(text, terminal_width, 2);
}

std::string sentence_text(const Calibration& c, int terminal_width) {
  std::string text = wrapped(verdict_words(c) + "\n", terminal_width, 2);
  for (const std::string& line : verdict_lines(c)) text += wrapped(line + "\n", terminal_width, 2);
  return text;
}

std::string budget_text(const Calibration& c, int terminal_width) {
  if (c.verdict.status == VerdictStatus::interrupted)
    return "";  // the stage that was cut has counted nothing
  std::string text;
  const SimulatorCount& n = c.counts;
  if (n.tests > 0) {
    text = counted_text(static_cast<double>(n.compression()), "test") + " in compression";
    if (n.tension > 0)
      text += fmt::format(" and {} in {}", n.tension,
                          fmt::join(other_tests(c, {"tension", "bending", "direct shear"}), " or "));
    // A coarse test costs a fraction: without this word the counts of two calibrations cannot be compared.
    if (n.coarse > 0) text += fmt::format("; {} of all tests on coarse grains", n.coarse);
    text += "; ";
  }
  return wrapped(text + fmt::format("{} direct elastic solutions\n", n.solutions), terminal_width, 2);
}

}  // namespace phy::report
