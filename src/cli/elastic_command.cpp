// `phyllite elastic RECIPE`: E(theta), nu(theta), joint stiffnesses and sensitivities without time stepping.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "cli/elastic_sweep.hpp"
#include "cli/machine.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/toml_in.hpp"
#include "statics/uniaxial.hpp"
#include "study/press_check.hpp"
#include "theory/eq1_fit.hpp"

namespace phy {
namespace {

struct ElasticArguments {
  std::string recipe;
  std::string out = "results/elastic";
  bool glued = false;
  bool modulus_loss = false;
  bool press = false;
};

/// The specimens of a recipe with both answers. The intact specimen is always there, as the last one.
struct ElasticStudy {
  Recipe recipe;
  std::vector<Specimen> specimens;
  std::vector<ElasticResult> one_sided, bilateral;
  double seconds = 0.0;

  std::size_t n_angles() const { return specimens.size() - 1; }
  double theta(std::size_t i) const { return specimens[i].bedding[0].theta; }
  const ElasticResult& intact() const { return one_sided.back(); }
};

ElasticStudy solve_recipe(const Recipe& recipe, const ElasticArguments& args, int threads) {
  ElasticStudy study;
  study.recipe = recipe;
  Recipe with_intact = study.recipe;
  with_intact.test.intact = true;
  with_intact.test.kind = TestKind::uniaxial;  // the whole specimen, whatever test the recipe names
  study.specimens = make_specimens(packing_of(recipe, default_cache_folder()), with_intact);
  const auto start = std::chrono::steady_clock::now();
  ElasticOptions options;
  options.platens = args.glued ? Platens::glued : Platens::frictionless;
  study.one_sided = solve_all(study.specimens, options, threads);
  options.bilateral = true;
  study.bilateral = solve_all(study.specimens, options, threads);
  study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return study;
}

void print_moduli(const ElasticStudy& study) {
  fmt::print("\n{:<16} {:>9} {:>7} {:>9} {:>7} {:>9} {:>7} {:>6} {:>6} {:>6} {:>7}\n", "specimen", "E", "nu",
             "E platen", "open", "E pulling", "nu", "undec.", "loose", "solut.", "seconds");
  fmt::print("{:<16} {:>9} {:>7} {:>9} {:>7} {:>9} {:>7}\n", "", "GPa", "", "GPa", "%", "GPa", "");
  for (std::size_t i = 0; i < study.specimens.size(); ++i) {
    const ElasticResult &r = study.one_sided[i], &b = study.bilateral[i];
    const double open =
        100.0 * static_cast<double>(r.n_open) / static_cast<double>(std::max<std::int64_t>(1, r.n_contacts));
    fmt::print("{:<16} {:>9.3f} {:>7.4f} {:>9.3f} {:>7.1f} {:>9.3f} {:>7.4f} {:>6} {:>6} {:>6} {:>7.2f}\n",
               r.name, r.E_gauge * 1e-9, r.nu_gauge, r.E_platen * 1e-9, open, b.E_gauge * 1e-9, b.nu_gauge,
               r.n_alternating, r.n_loose, r.n_iterations, r.seconds + b.seconds);
  }
  fmt::print(
      "E, nu: gauge of the middle 60 %, contacts push only; pulling: contacts also pull;\n"
      "open: contacts that carry nothing beside their bond; undec.: contacts without\n"
      "a consistent state; loose: grains without load; solut.: factorisations\n");
}

/// Reasons and advice of all results without an answer. Returns whether all were solved.
bool print_outcomes(const ElasticStudy& study) {
  bool all_solved = true;
  for (const auto* results : {&study.one_sided, &study.bilateral}) {
    for (const ElasticResult& r : *results) {
      all_solved = all_solved && r.outcome.ok();
      if (r.outcome.ok()) continue;
      fmt::print("{}{}: {}{}{}\n", r.name, r.bilateral ? " (pulling)" : "", r.outcome.reason,
                 r.outcome.advice.empty() ? "" : "; ", r.outcome.advice);
    }
  }
  const ElasticOutcome& intact = study.intact().outcome;
  if (intact.ok() && !intact.reason.empty()) fmt::print("intact: {}\n", intact.reason);
  return all_solved;
}

void print_fit(const char* contacts, const char* reference, const Eq1Fit& fit, double spacing) {
  fmt::print("{:<8} {:<18} ", contacts, reference);
  if (!fit.ok()) {
    fmt::print("no fit: {}\n", fit.reason);
    return;
  }
  const double scale = 1e-9 / spacing;
  const auto error = [&](double se) {
    return std::isfinite(se) ? fmt::format("{:.1f}", se * scale) : std::string("-");
  };
  fmt::print(
      "{:>8.2f} {:>9.1f} {:>7} {:>9.1f} {:>7} {:>9.5f}  {}\n", fit.rock.E * 1e-9, fit.rock.K_n_delta * scale,
      error(fit.se_K_n_delta), fit.rock.K_s_delta * scale, error(fit.se_K_s_delta), fit.R2,
      fit.shape.type == CurveType::shoulder ? fmt::format("shoulder at {:.1f} deg", fit.shape.theta_star)
                                            : "incremental");
}

void print_fits(const ElasticStudy& study, bool modulus_loss) {
  if (study.n_angles() == 0) return;
  fmt::print("\nmacro joint stiffness by Eq. 1, least squares in {}, spacing {:g} mm\n",
             modulus_loss ? "modulus" : "compliance", study.recipe.bedding[0].spacing * 1e3);
  fmt::print("{:<8} {:<18} {:>8} {:>9} {:>7} {:>9} {:>7} {:>9}\n", "contacts", "reference E", "E", "K_n",
             "+-", "K_s", "+-", "R2");
  fmt::print("{:<27} {:>8} {:>9} {:>7} {:>9} {:>7}\n", "", "GPa", "GPa/m", "GPa/m", "GPa/m", "GPa/m");
  for (const bool bilateral : {false, true}) {
    const std::vector<ElasticResult>& results = bilateral ? study.bilateral : study.one_sided;
    std::vector<ModulusReading> readings;
    for (std::size_t i = 0; i < study.n_angles(); ++i)
      readings.push_back({study.theta(i), results[i].E_gauge});
    const auto fit = [&](const char* name, Eq1Reference reference) {
      Eq1Options options;
      options.loss = modulus_loss ? Eq1Loss::modulus : Eq1Loss::compliance;
      options.reference = reference;
      options.E = results.back().E_gauge;
      print_fit(bilateral ? "pulling" : "pushing", name, fit_eq1(readings, options),
                study.recipe.bedding[0].spacing);
    };
    fit("intact specimen", Eq1Reference::given);
    fit("specimen at 90 deg", Eq1Reference::measured_90);
    fit("free", Eq1Reference::free);
  }
}

void print_sensitivities(const ElasticStudy& study) {
  for (const bool modulus : {true, false}) {
    fmt::print(
        "\n{}\n{:<24}",
        modulus ? "change of E in % per % of the parameter" : "change of nu in 0.01 per % of the parameter",
        "");
    for (std::size_t i = 0; i < study.n_angles(); ++i)
      fmt::print(" {:>8}", fmt::format("{:g} deg", study.theta(i)));
    fmt::print(" {:>8}\n", "intact");
    std::size_t longest = 0;  // the intact specimen has no joints
    for (const ElasticResult& r : study.one_sided) longest = std::max(longest, r.sensitivities.size());
    for (std::size_t row = 0; row < longest; ++row) {
      std::string name, line;
      for (const ElasticResult& r : study.one_sided) {
        if (row >= r.sensitivities.size()) {
          line += fmt::format(" {:>8}", "-");
          continue;
        }
        const Sensitivity& s = r.sensitivities[row];
        name = s.parameter;
        line += fmt::format(" {:>8.4f}", modulus ? s.dE * s.value / r.E_gauge : s.dnu * s.value);
      }
      fmt::print("{:<24}{}\n", name == "ks_over_kn" ? "both ks_over_kn" : name, line);
    }
  }
}

void print_packing(const ElasticStudy& study) {
  const Packing& p = *study.specimens.back().packing;
  fmt::print("packing {} discs, porosity {:.4f}, coordination {:.3f}\n", p.discs.size(), p.report.porosity,
             p.report.coordination);
  if (!p.stress_free)
    fmt::print("        locked-in stress {:.3f} MPa: the answers hold for axial stresses well above it\n",
               p.report.stress_left * 1e-6);
  for (std::size_t i = 0; i < study.n_angles(); ++i) {
    const BeddingReport& b = study.specimens[i].bedding_report[0];
    fmt::print(
        "{:>5g} deg  sum(A)/L {:.3f}  bridges {:>4.1f} %  joints off the plane {:>4.1f} %  E/E_intact "
        "{:.4f}\n",
        study.theta(i), b.overlap_ratio, 100.0 * b.bridge_fraction, 100.0 * b.non_crossing_fraction,
        study.one_sided[i].E_gauge / study.intact().E_gauge);
  }
}

/// Runs the specimens under the press too, without and with slip and cracking. Returns whether all runs
/// ended.
bool print_press(const ElasticStudy& study, const MachineOptions& machine) {
  const auto held = press_moduli(study.specimens, study.recipe, machine, true);
  const auto free = press_moduli(study.specimens, study.recipe, machine, false);
  fmt::print("\npress up to strain {:g}, overlaps stress-free, slopes of its upper half\n",
             press_check_strain);
  fmt::print("{:<16} | {:>9} {:>7} | {:>9} {:>6} {:>7} {:>7} | {:>9} {:>6} {:>7} {:>7} {:>7} {:>7}\n",
             "specimen", "E direct", "nu", "E held", "%", "nu", "+-", "E press", "%", "nu", "+-", "cracks",
             "slip %");
  bool all_ended = true;
  for (std::size_t i = 0; i < study.specimens.size(); ++i) {
    const ElasticResult& d = study.one_sided[i];
    fmt::print("{:<16} | {:>9.3f} {:>7.4f}", d.name, d.E_gauge * 1e-9, d.nu_gauge);
    for (const PressModuli* m : {&held[i], &free[i]})
      fmt::print(" | {:>9.3f} {:>+6.2f} {:>7.4f} {:>+7.4f}", m->E * 1e-9, 100.0 * (m->E / d.E_gauge - 1.0),
                 m->nu, m->nu - d.nu_gauge);
    fmt::print(" {:>7} {:>7.3f}\n", free[i].n_cracks, 100.0 * free[i].slip_share);
    for (const PressModuli* m : {&held[i], &free[i]}) {
      all_ended = all_ended && m->outcome.empty();
      if (!m->outcome.empty()) fmt::print("{}: {}\n", d.name, m->outcome);
    }
  }
  fmt::print("held: nothing breaks and nothing slips; slip %: of the boundary work\n");
  return all_ended;
}

int elastic(const ElasticArguments& args, const Session& session) {
  const int threads = n_threads(session);
  const Recipe recipe = read_recipe(args.recipe);
  if (!recipe.sweep.factors.empty()) return run_elastic_sweep(recipe, args.recipe, args.out, threads);
  const ElasticStudy study = solve_recipe(recipe, args, threads);
  fmt::print("recipe  {} ({}), {} platens\n", study.recipe.name, args.recipe,
             args.glued ? "glued" : "frictionless");
  print_packing(study);
  print_moduli(study);
  bool all_solved = print_outcomes(study);
  print_fits(study, args.modulus_loss);
  print_sensitivities(study);
  if (args.press) all_solved = print_press(study, machine_of(session)) && all_solved;
  fmt::print("\n{:.2f} s for {} solutions\n", study.seconds, 2 * study.specimens.size());
  return all_solved ? 0 : 1;
}

}  // namespace

void add_elastic_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ElasticArguments>();
  CLI::App* verb =
      app.add_subcommand("elastic", "E(theta), nu(theta), K_n, K_s and sensitivities by direct solution");
  verb->add_option("recipe", args->recipe, "recipe file (TOML)")->required();
  verb->add_option("--out", args->out, "folder for the tables of a sweep")->capture_default_str();
  verb->add_flag("--glued", args->glued, "grains stick to the platens");
  verb->add_flag("--modulus-loss", args->modulus_loss, "fit Eq. 1 in modulus instead of compliance");
  verb->add_flag("--press", args->press, "compare with the press, without and with slip and cracking");
  verb->callback([args, &session] { session.exit_code = elastic(*args, session); });
}

}  // namespace phy
