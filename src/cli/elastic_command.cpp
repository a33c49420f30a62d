// `phyllite elastic RECIPE`: E(theta), nu(theta), joint stiffnesses and sensitivities without time stepping.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/lines.hpp"
#include "cli/machine.hpp"
#include "cli/terminal.hpp"
#include "io/toml_in.hpp"
#include "records/jointed.hpp"
#include "study/elastic_study.hpp"
#include "study/press_check.hpp"

namespace phy::cli {
namespace {

struct ElasticArguments {
  std::string recipe;
  bool glued = false;
  bool modulus_loss = false;
  bool press = false;
};

/// A column with one cell per specimen, or per angle if `n` says so.
template <class Cell>
Column column(std::string head, std::string unit, std::size_t n, const Cell& cell) {
  std::vector<std::size_t> places(n);
  std::iota(places.begin(), places.end(), std::size_t{0});
  return column_of(std::move(head), std::move(unit), places, cell);
}

Column names_of(const study::ElasticStudy& study) {
  Column c =
      column("specimen", "", study.specimens.size(), [&](std::size_t i) { return study.one_sided[i].name; });
  c.left = true;
  return c;
}

std::string fixed(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

void print_moduli(const study::ElasticStudy& study, int width) {
  const auto of = [&](const char* head, const char* unit, const auto& cell) {
    return column(head, unit, study.specimens.size(),
                  [&](std::size_t i) { return cell(study.one_sided[i], study.bilateral[i]); });
  };
  using R = const ElasticResult&;
  const auto open = [](R r) {
    // A specimen that failed before its contacts were found has none: 0 %, not 0/0.
    return 100.0 * static_cast<double>(r.n_open) /
           static_cast<double>(std::max<std::int64_t>(1, r.n_contacts));
  };
  // NaN where the solution failed: the reason stands below the table.
  const auto number = [](double v, int digits) {
    return std::isfinite(v) ? fixed(v, digits) : std::string("-");
  };
  const Columns pushing = {of("E", "GPa", [&](R r, R) { return number(r.E_gauge * 1e-9, 3); }),
                           of("nu", "", [&](R r, R) { return number(r.nu_gauge, 4); }),
                           of("E platen", "GPa", [&](R r, R) { return number(r.E_platen * 1e-9, 3); }),
                           of("open", "%", [&](R r, R) { return fixed(open(r), 1); })};
  const Columns pulling = {of("E pulling", "GPa", [&](R, R b) { return number(b.E_gauge * 1e-9, 3); }),
                           of("nu", "", [&](R, R b) { return number(b.nu_gauge, 4); })};
  const Columns solution = {of("undec.", "", [](R r, R) { return std::to_string(r.n_alternating); }),
                            of("loose", "", [](R r, R) { return std::to_string(r.n_loose); }),
                            of("solut.", "", [](R r, R) { return std::to_string(r.n_iterations); }),
                            of("seconds", "", [](R r, R b) { return fixed(r.seconds + b.seconds, 2); })};
  print_out("\n{}", text_table(names_of(study), {pushing, pulling, solution}, width));
  print_wrapped(width, 0,
                "E, nu: gauge of the middle 60 %, contacts push only. Pulling: contacts also pull. Open: "
                "contacts that carry nothing beside their bond.\nUndec.: contacts without a consistent "
                "state. Loose: grains without load. Solut.: factorisations\n");
  if (study.recipe.matrix.gapped_fraction > 0.0)
    print_wrapped(
        width, 0,
        "interfaces that start open are taken as absent: the press, which closes some of them, is stiffer\n");
}

/// Reasons and advice of all results without an answer. Returns whether all were solved.
bool print_outcomes(const study::ElasticStudy& study, int width) {
  bool all_solved = true;
  for (const auto* results : {&study.one_sided, &study.bilateral}) {
    for (const ElasticResult& r : *results) {
      all_solved = all_solved && r.outcome.ok();
      if (r.outcome.ok()) continue;
      print_wrapped(width, 2, "{}{}: {}{}{}\n", r.name, r.bilateral ? " (pulling)" : "", r.outcome.reason,
                    r.outcome.advice.empty() ? "" : "; ", r.outcome.advice);
    }
  }
  const ElasticOutcome& intact = study.intact().outcome;
  // An answer may carry a reservation, which would be lost among those without one.
  if (study.has_intact() && intact.ok() && !intact.reason.empty())
    print_wrapped(width, 2, "intact: {}\n", intact.reason);
  return all_solved;
}

/// Equal reasons on one line.
void print_missing(const std::vector<study::NamedFit>& fits, int width) {
  std::vector<std::string> missing;
  for (const study::NamedFit& f : fits)
    if (!f.fit.ok()) add_line(missing, f.name, "no fit: " + f.fit.reason);
  // Without a fit the row has dashes; the reason does not fit into a column.
  for (const std::string& line : missing) print_wrapped(width, 2, "{}\n", line);
}

void print_fits(const study::ElasticStudy& study, bool modulus_loss, int width) {
  if (study.recipe.bedding.empty() || study.n_angles() == 0) return;
  // Eq. 1 is that of joints in isotropic rock: anything else it would fit with meaningless numbers.
  if (!jointed_isotropic(study.recipe)) {
    print_wrapped(width, 0, "\nno macro joint stiffness by Eq. 1: {}\n", no_weak_planes(study.recipe));
    return;
  }
  // Dispersed joints have no spacing: what Eq. 1 gives is left as it is, K delta.
  const BeddingRecipe& set = study.recipe.bedding[0];
  // Eq. 1 knows only K times delta: with a spacing, the stiffness of one plane follows.
  const double scale = set.has_planes() ? 1e-9 / set.spacing : 1e-9;
  const char* const per = set.has_planes() ? "GPa/m" : "GPa";
  const std::vector<study::NamedFit> fits =
      study::fit_all(study, modulus_loss ? theory::Eq1Loss::modulus : theory::Eq1Loss::compliance);
  const auto of = [&](const char* head, const char* unit, const auto& cell) {
    return column(head, unit, fits.size(),
                  [&](std::size_t i) { return fits[i].fit.ok() ? cell(fits[i].fit) : std::string("-"); });
  };
  using F = const theory::Eq1Fit&;
  // Three angles and three unknowns leave no degree of freedom, and so no standard error.
  const auto error = [&](double se) { return std::isfinite(se) ? fixed(se * scale, 1) : std::string("-"); };
  Column label = column("contacts, ref. E", "", fits.size(), [&](std::size_t i) { return fits[i].name; });
  label.left = true;
  const Columns normal = {of("E", "GPa", [](F f) { return fixed(f.rock.E * 1e-9, 2); }),
                          of(set.has_planes() ? "K_n" : "K_n delta", per,
                             [&](F f) { return fixed(f.rock.K_n_delta * scale, 1); }),
                          of("+-", per, [&](F f) { return error(f.se_K_n_delta); })};
  const Columns shear = {of(set.has_planes() ? "K_s" : "K_s delta", per,
                            [&](F f) { return fixed(f.rock.K_s_delta * scale, 1); }),
                         of("+-", per, [&](F f) { return error(f.se_K_s_delta); })};
  const Columns shape = {of("R2", "", [](F f) { return fixed(f.R2, 5); }), of("shoulder", "deg", [](F f) {
                           return f.shape.type == theory::CurveType::shoulder ? fixed(f.shape.theta_star, 1)
                                                                              : "none";
                         })};
  print_wrapped(width, 0, "\nmacro joint stiffness by Eq. 1, least squares in {}, {}\n",
                modulus_loss ? "modulus" : "compliance",
                set.has_planes() ? fmt::format("spacing {:g} mm", set.spacing * 1e3)
                                 : "joints dispersed, no spacing delta");
  print_out("{}", text_table(label, {normal, shear, shape}, width));
  print_missing(fits, width);
}

/// Parameters down, specimens across; the intact specimen has no joints, and so a shorter list.
void print_sensitivities(const study::ElasticStudy& study, int width) {
  const std::vector<ElasticResult>& results = study.one_sided;
  // Rows are those of the specimen with most parameters.
  const auto longest = std::max_element(results.begin(), results.end(), [](const auto& a, const auto& b) {
    return a.sensitivities.size() < b.sensitivities.size();
  });
  const std::size_t n = longest->sensitivities.size();
  if (n == 0) return;
  Column label = column("", "", n, [&](std::size_t row) {
    const std::string& name = longest->sensitivities[row].parameter;
    return name == "ks_over_kn" ? "both ks_over_kn" : name;
  });
  label.left = true;
  // Elasticities for the modulus, but absolute changes for nu: near zero a relative one says nothing.
  for (const bool modulus : {true, false}) {
    Columns columns;
    for (std::size_t i = 0; i < results.size(); ++i)
      columns.push_back(column(i < study.n_angles() ? fmt::format("{:g} deg", study.theta(i)) : "intact", "",
                               n, [&, &r = results[i]](std::size_t row) {
                                 // The intact specimen has another model: found by name, not by place.
                                 const auto s =
                                     std::ranges::find(r.sensitivities, longest->sensitivities[row].parameter,
                                                       &Sensitivity::parameter);
                                 if (s == r.sensitivities.end()) return std::string("-");
                                 return fixed(modulus ? s->dE * s->value / r.E_gauge : s->dnu * s->value, 4);
                               }));
    print_out(
        "\n{}\n{}",
        modulus ? "change of E in % per % of the parameter" : "change of nu in 0.01 per % of the parameter",
        text_table(label, {columns}, width));
  }
}

void print_packing(const study::ElasticStudy& study, int width) {
  // All specimens share one packing; any of them can speak for it.
  const Packing& p = *study.specimens.back().packing;
  print_wrapped(width, 8, "packing {} discs, porosity {:.4f}, coordination {:.3f}\n", p.discs.size(),
                p.report.porosity, p.report.coordination);
  // With locked-in stress contacts are pre-loaded, and which of them open depends on the load.
  if (!p.stress_free)
    print_wrapped(width, 8,
                  "        locked-in stress {:.3f} MPa: the answers hold for axial "
                  "stresses well above it\n",
                  p.report.stress_left * 1e-6);
  if (study.recipe.bedding.empty() || study.n_angles() == 0) return;
  const auto of = [&](const char* head, const char* unit, const auto& cell) {
    return column(head, unit, study.n_angles(), [&](std::size_t i) {
      return cell(study.specimens[i].bedding_report[0], study.one_sided[i].E_gauge);
    });
  };
  using B = const BeddingReport&;
  const Column theta = column("theta", "deg", study.n_angles(),
                              [&](std::size_t i) { return fmt::format("{:g}", study.theta(i)); });
  Columns bedding;
  // Bridges and overlap are measured along planes, which dispersed joints do not have.
  if (study.recipe.bedding[0].has_planes())
    bedding = {of("sum(A)/L", "", [](B b, double) { return fixed(b.overlap_ratio, 3); }),
               of("bridges", "%", [](B b, double) { return fixed(100.0 * b.bridge_fraction, 1); }),
               of("off the plane", "% of joints",
                  [](B b, double) { return fixed(100.0 * b.non_crossing_fraction, 1); })};
  else
    bedding = {of("joints", "% of contacts", [](B b, double) { return fixed(100.0 * b.joint_fraction, 1); })};
  if (study.has_intact())
    bedding.push_back(
        of("E/E_intact", "", [&](B, double E) { return fixed(E / study.intact().E_gauge, 4); }));
  print_out("\n{}", text_table(theta, {bedding}, width));
}

Columns direct_columns(const study::ElasticStudy& study) {
  const std::size_t n = study.specimens.size();
  return {column("E direct", "GPa", n,
                 [&](std::size_t i) { return fixed(study.one_sided[i].E_gauge * 1e-9, 3); }),
          column("nu", "", n, [&](std::size_t i) { return fixed(study.one_sided[i].nu_gauge, 4); })};
}

/// Moduli of the press and by how much they differ from the direct solution.
Columns press_columns(const study::ElasticStudy& study, const char* head,
                      const std::vector<study::PressModuli>& press) {
  const auto of = [&](const char* name, const char* unit, const auto& cell) {
    return column(name, unit, press.size(),
                  [&](std::size_t i) { return cell(press[i], study.one_sided[i]); });
  };
  using M = const study::PressModuli&;
  using D = const ElasticResult&;
  return {of(head, "GPa", [](M m, D) { return fixed(m.E * 1e-9, 3); }),
          of("+-", "%", [](M m, D d) { return fmt::format("{:+.2f}", 100.0 * (m.E / d.E_gauge - 1.0)); }),
          of("nu", "", [](M m, D) { return fixed(m.nu, 4); }),
          of("+-", "", [](M m, D d) { return fmt::format("{:+.4f}", m.nu - d.nu_gauge); })};
}

/// Runs the specimens under the press too, without and with slip and cracking. Returns whether all runs
/// ended.
bool print_press(const study::ElasticStudy& study, const study::MachineOptions& machine, int width) {
  const auto held = study::press_moduli(study.specimens, study.recipe, machine, true);
  // The same specimens twice: what differs is slip and cracking alone.
  const auto free = study::press_moduli(study.specimens, study.recipe, machine, false);
  const Columns slip = {
      column("cracks", "", free.size(), [&](std::size_t i) { return std::to_string(free[i].n_cracks); }),
      column("slip", "%", free.size(), [&](std::size_t i) { return fixed(100.0 * free[i].slip_share, 3); })};
  print_wrapped(width, 0, "\npress up to strain {:g}, overlaps stress-free, slopes of its upper half\n",
                study::press_check_strain);
  print_out("{}", text_table(names_of(study),
                             {direct_columns(study), press_columns(study, "E held", held),
                              press_columns(study, "E press", free), slip},
                             width));
  bool all_ended = true;
  for (const auto* moduli : {&held, &free})
    for (std::size_t i = 0; i < moduli->size(); ++i)
      if (const std::string& outcome = (*moduli)[i].outcome; !outcome.empty()) {
        all_ended = false;
        print_wrapped(width, 2, "{}: {}\n", study.one_sided[i].name, outcome);
      }
  print_wrapped(width, 0,
                "held: nothing breaks and nothing slips; +-: from the direct solution; slip: of the "
                "boundary work\n");
  return all_ended;
}

int elastic(const ElasticArguments& args, const Session& session) {
  const int threads = n_threads(session), width = session.terminal_width;
  const Recipe recipe = io::read_recipe(args.recipe);
  const study::ElasticStudy study = study::solve_recipe(
      recipe, args.glued ? statics::Platens::glued : statics::Platens::frictionless, threads);
  print_wrapped(width, 8, "recipe  {} ({}), {} platens\n", study.recipe.name, args.recipe,
                args.glued ? "glued" : "frictionless");
  print_notes(recipe.notes, width);
  print_packing(study, width);
  print_moduli(study, width);
  // Not a loop that ends at the first failure: moduli of other angles are of use without it.
  bool all_solved = print_outcomes(study, width);
  print_fits(study, args.modulus_loss, width);
  print_sensitivities(study, width);
  flush_out();  // the press takes long, and may be ended
  if (args.press) all_solved = print_press(study, machine_of(session), width) && all_solved;
  print_out("\n{:.2f} s for {} solutions\n", study.seconds, 2 * study.specimens.size());
  return all_solved ? 0 : 1;
}

}  // namespace

void add_elastic_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ElasticArguments>();
  CLI::App* verb =
      app.add_subcommand("elastic", "E(theta), nu(theta), K_n, K_s and sensitivities by direct solution");
  verb->add_option("recipe", args->recipe, "recipe file (TOML)")->required()->type_name("FILE");
  verb->add_flag("--glued", args->glued, "grains stick to the platens");
  verb->add_flag("--modulus-loss", args->modulus_loss, "fit Eq. 1 in modulus instead of compliance");
  verb->add_flag("--press", args->press, "compare with the press, without and with slip and cracking");
  verb->callback([args, &session] { session.exit_code = elastic(*args, session); });
}

}  // namespace phy::cli
