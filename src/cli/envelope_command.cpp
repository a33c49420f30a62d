// `phyllite envelope RECIPE`: strength under several confining stresses, and the envelopes that fit it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/analyse.hpp"
#include "base/check.hpp"
#include "base/lines.hpp"
#include "base/nan.hpp"
#include "base/quote.hpp"
#include "base/units.hpp"
#include "base/version.hpp"
#include "cli/ensemble.hpp"
#include "cli/machine.hpp"
#include "cli/progress.hpp"
#include "cli/stresses.hpp"
#include "cli/terminal.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "jobs/run_folder.hpp"
#include "jobs/study_folder.hpp"
#include "lab/load_path.hpp"
#include "records/quality.hpp"
#include "records/recipe_schema.hpp"
#include "study/envelope.hpp"
#include "study/table.hpp"
#include "study/worker.hpp"

namespace phy::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char *strengths_file = "envelope.csv", *fits_file = "fits.csv";

struct EnvelopeArguments {
  std::string recipe, out = "results/envelope";
  std::vector<std::string> confining = {"0 MPa", "5 MPa", "10 MPa", "20 MPa"};
  bool ensemble = false, with_untrusted = false;
};

/// Tests of one stress stand in a folder as `phyllite run` leaves it.
std::string folder_of(double sigma_3) { return io::folder_name("sigma_3 = " + stress_text(sigma_3)); }

/// NaN where there is no fit.
template <class Fit>
double R2_of(const Fit& fit) {
  // A failed fit leaves R2 at 0, which would read as a bad fit.
  return fit.ok ? fit.R2 : nan;
}

std::string with_error(const theory::Estimate& e, double scale, int digits) {
  if (!std::isfinite(e.value)) return "-";
  if (!std::isfinite(e.se)) return fmt::format("{:.{}f}", e.value * scale, digits);
  return fmt::format("{:.{}f} +- {:.{}f}", e.value * scale, digits, e.se * scale, digits);
}

Column names_of(const char* head, const study::Envelope& envelope) {
  Column c = column_of(head, "", envelope.specimens, [](const study::SpecimenEnvelope& s) { return s.name; });
  c.left = true;
  return c;
}

void print_strengths(const study::EnvelopeTests& tests, const study::Envelope& envelope, int width) {
  Columns strengths;
  bool knees = false;
  for (std::size_t i = 0; i < tests.confining.size(); ++i) {
    Column c{fmt::format("{:g}", tests.confining[i] * 1e-6), "", {}};
    for (const TestResult& r : tests.results[i]) {
      const Number* n = has_strength(r.outcome.status) ? analysis::find(r.numbers, "sigma_1") : nullptr;
      // A test that has not peaked has a largest stress, which is no strength.
      const bool known = n != nullptr && std::isfinite(n->value);
      // A knee has no fall behind it: more strain may bring a higher stress.
      const bool knee = known && r.outcome.status == Status::knee;
      knees = knees || knee;
      c.cells.push_back(known ? fmt::format("{:.2f}{}", n->value * 1e-6, knee ? "*" : "") : "-");
    }
    strengths.push_back(std::move(c));
  }
  print_out("\nsigma_1 [MPa] at the peak{}\n{}", knees ? "; *: at a knee" : "",
            text_table(names_of("sigma_3 [MPa]", envelope), {strengths}, width));
}

/// What to think of an envelope with knees in it.
std::string knees_text(const study::SpecimenEnvelope& s) {
  if (s.knees.size() == s.readings.size())
    return "an envelope of knees: not to be compared with one of peaks";
  std::vector<std::string> stresses;
  for (const double sigma_3 : s.knees) stresses.push_back(fmt::format("{:g}", sigma_3 * 1e-6));
  return fmt::format(
      "knees (at {} MPa) and peaks in one envelope: a knee lies below the peak that more strain may bring. "
      "phi and m_i mix both. Raise test.max_strain, or leave these confining stresses out",
      fmt::join(stresses, ", "));
}

void print_fits(const study::Envelope& envelope, int width) {
  using S = const study::SpecimenEnvelope&;
  const auto of = [&](const char* head, const char* unit, const auto& cell) {
    return column_of(head, unit, envelope.specimens, cell);
  };
  const Columns mohr_coulomb = {
      of("c", "MPa", [](S s) { return with_error(s.mohr_coulomb.cohesion, 1e-6, 2); }),
      of("phi", "deg", [](S s) { return with_error(s.mohr_coulomb.friction, 1.0, 2); }),
      of("R2", "", [](S s) { return with_error({R2_of(s.mohr_coulomb)}, 1.0, 4); })};
  const Columns hoek_brown = {of("ucs_hb", "MPa", [](S s) { return with_error(s.hoek_brown.ucs, 1e-6, 2); }),
                              of("m_i", "", [](S s) { return with_error(s.hoek_brown.m_i, 1.0, 2); }),
                              of("R2", "", [](S s) { return with_error({R2_of(s.hoek_brown)}, 1.0, 4); })};
  const Columns anisotropy = {of("k", "", [](S s) { return with_error(s.k, 1.0, 3); })};
  print_out("\n{}",
            text_table(names_of("least squares", envelope), {mohr_coulomb, hoek_brown, anisotropy}, width));
  print_wrapped(width, 0,
                "+-: standard errors; k: m over m of the planes nearest to across the load (Saroglou & "
                "Tsiambaos)\n");
  std::vector<std::string> findings;
  // By kind of finding, not by specimen: add_line joins specimens that have the same reason.
  for (S s : envelope.specimens)
    if (!s.mohr_coulomb.ok) add_line(findings, s.name, "no Mohr-Coulomb envelope: " + s.mohr_coulomb.reason);
  for (S s : envelope.specimens)
    if (!s.hoek_brown.ok) add_line(findings, s.name, "no Hoek-Brown envelope: " + s.hoek_brown.reason);
  for (S s : envelope.specimens)
    if (!s.knees.empty()) add_line(findings, s.name, knees_text(s));
  for (const std::string& line : findings) print_wrapped(width, 2, "{}\n", line);
  const std::string no_plane = envelope.plane.no_plane();
  if (no_plane.empty())
    print_wrapped(
        width, 2,
        "one plane of weakness (Jaeger) over all angles and stresses, matrix \"{}\": c = {:.2f} MPa, "
        "phi = {:.2f} deg, R2 = {:.4f}\n",
        envelope.matrix, envelope.plane.plane.cohesion * 1e-6, envelope.plane.plane.friction,
        envelope.plane.R2);
  else
    print_wrapped(width, 2, "one plane of weakness (Jaeger): no fit: {}\n", no_plane);
}

/// Tests without a peak, or with one not to be trusted, which give no reading: why, and what to do; tests
/// with a knee; warnings of those that give a reading.
void print_outcomes(const study::EnvelopeTests& tests, int width) {
  std::vector<std::string> findings;
  for (std::size_t i = 0; i < tests.confining.size(); ++i)
    for (const TestResult& r : tests.results[i])
      for (const QualityMark& mark : quality_marks(r.numbers))
        if (has_strength(r.outcome.status) && mark.limit->speaks_of("sigma_1"))
          add_line(findings, fmt::format("{} at {:g} MPa", r.name, tests.confining[i] * 1e-6),
                   fmt::format("warning: {}: {}; {}", mark.name(), mark.limit->says, mark.limit->advice));
  for (std::size_t i = 0; i < tests.confining.size(); ++i)
    for (const TestResult& r : tests.results[i])
      if (const Outcome& o = r.outcome; o.status != Status::peaked)
        add_line(
            findings, fmt::format("{} at {:g} MPa", r.name, tests.confining[i] * 1e-6),
            fmt::format("{}: {}{}{}", to_string(o.status), o.reason, o.advice.empty() ? "" : "; ", o.advice));
  for (const std::string& line : findings) print_wrapped(width, 2, "{}\n", line);
}

std::string strengths_csv(const study::EnvelopeTests& tests) {
  std::string text =
      "specimen,theta [deg],sigma_3 [Pa],sigma_1 "
      "[Pa],confinement_error,status,quality,result_hash,strength_rule\n";
  for (std::size_t i = 0; i < tests.confining.size(); ++i)
    for (const TestResult& r : tests.results[i]) {
      const bool stored = r.outcome.status != Status::interrupted;
      const auto value = [&](const char* name) {
        // An interrupted test has the largest stress so far, which a spreadsheet would take for a strength.
        const Number* n = stored ? analysis::find(r.numbers, name) : nullptr;
        return n == nullptr ? std::string() : study::csv_cell(n->value);
      };
      // A column of its own: envelopes of knees and of peaks must not be fitted together later on.
      const auto rule = stored ? study::rule_of(r) : std::nullopt;
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.name, r.intact ? "" : print_number(r.theta),
                          print_number(tests.confining[i]), value("sigma_1"), value("confinement_error"),
                          to_string(r.outcome.status), stored ? to_string(grade_of(r)) : "",
                          stored ? r.hash : "", rule ? to_string(*rule) : "");
    }
  return text;
}

std::string fits_csv(const study::Envelope& envelope) {
  std::string text =
      "specimen,theta [deg],cohesion [Pa],cohesion_se [Pa],friction [deg],friction_se [deg],R2_mohr_coulomb,"
      "ucs_hb [Pa],ucs_hb_se [Pa],m_i,m_i_se,R2_hoek_brown,k,k_se\n";
  for (const study::SpecimenEnvelope& s : envelope.specimens) {
    text += s.name + "," + (s.intact ? "" : print_number(s.theta));
    for (const double v :
         {s.mohr_coulomb.cohesion.value, s.mohr_coulomb.cohesion.se, s.mohr_coulomb.friction.value,
          s.mohr_coulomb.friction.se, R2_of(s.mohr_coulomb), s.hoek_brown.ucs.value, s.hoek_brown.ucs.se,
          s.hoek_brown.m_i.value, s.hoek_brown.m_i.se, R2_of(s.hoek_brown), s.k.value, s.k.se})
      text += "," + study::csv_cell(v);
    text += "\n";
  }
  return text;
}

/// Every specimen under every stress. Each test is on disk as soon as it has ended; Ctrl-C ends the others.
study::EnvelopeTests run_all(const study::Specimens& specimens, const Recipe& recipe,
                             const std::vector<double>& confining, const fs::path& out,
                             const study::MachineOptions& machine) {
  // One queue for all of them: the stresses are tested side by side, the longest tests first.
  const std::size_t n = specimens.size();
  study::Specimens all;
  std::vector<Recipe> recipes;
  for (const double sigma_3 : confining) {
    all.insert(all.end(), specimens.begin(), specimens.end());
    recipes.insert(recipes.end(), n, study::confined_recipe(recipe, sigma_3));
  }
  ProgressLine line;
  study::Hooks hooks;
  hooks.stop = stop_on_interrupt();
  hooks.on_progress = [&](const study::Progress& p) {
    line.show([&](double seconds) { return jobs::progress_text(p, seconds); });
  };
  hooks.on_result = [&](std::size_t i, const TestResult& r) {
    // What was cut short would stand beside finished tests as if it were one.
    if (r.outcome.status == Status::interrupted) return;
    const double sigma_3 = confining[i / n];
    io::write_result((out / folder_of(sigma_3) / io::folder_name(r.name)).string(), recipes[i], phy::version,
                     *all[i], r);
    line.note(fmt::format("{:g} MPa, {}: {}", sigma_3 * 1e-6, r.name, r.outcome.reason));
  };
  study::EnvelopeTests tests{confining, std::vector<std::vector<TestResult>>(confining.size())};
  std::vector<TestResult> results = study::run_tests(all, recipes, machine, hooks);
  for (std::size_t i = 0; i < results.size(); ++i) tests.results[i / n].push_back(std::move(results[i]));
  line.finish();
  return tests;
}

/// Before hours of work: nothing of another recipe or another hand is in the way.
void check_folders(const EnvelopeArguments& args, const Recipe& recipe,
                   const std::vector<double>& confining) {
  const fs::path out(args.out);
  std::vector<Problem> others;
  // Every stress is looked at before complaining: one list of everything that is in the way.
  for (const double sigma_3 : confining)
    for (Problem& p :
         jobs::problems_of_others((out / folder_of(sigma_3)).string(),
                                  study::confined_recipe(recipe, sigma_3), args.recipe, "use another --out"))
      others.push_back(std::move(p));
  if (!others.empty()) throw InputError(std::move(others));
  for (const double sigma_3 : confining)
    for (const std::string& name : specimen_names(recipe))
      io::check_result_place((out / folder_of(sigma_3) / io::folder_name(name)).string());
  io::check_outputs({(out / strengths_file).string(), (out / fits_file).string()});
  io::check_writable(args.out);
}

std::vector<std::shared_ptr<const Specimen>> specimens_of(const Recipe& recipe) {
  const auto packing = genesis::packing_of(recipe, genesis::default_cache_folder(),
                                           [stop = stop_on_interrupt()] { return stop->load(); });
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (Specimen& s : genesis::make_specimens(packing, recipe))
    specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  // All have the contacts of one packing.
  lab::check_load_path(*specimens.front(), recipe);
  return specimens;
}

int envelope_of(const EnvelopeArguments& args, const Session& session) {
  const std::vector<double> confining = read_stresses("--confining", args.confining);
  // Draws keep their tests in a store, so none of the folders below is made.
  if (args.ensemble) return run_ensemble({{args.recipe}, args.out, args.with_untrusted}, session, confining);
  const Recipe recipe = io::read_recipe(args.recipe);
  // From here on files are written, and Ctrl-C has to leave them whole.
  stop_on_interrupt();
  const fs::path out(args.out);
  const int width = session.terminal_width;
  check_folders(args, recipe, confining);
  // Packing and bedding do not depend on the stress: one set of specimens serves all.
  const auto specimens = specimens_of(study::confined_recipe(recipe, confining.front()));
  print_wrapped(width, 10, "envelope  {} specimens of {} discs under {} confining stresses, sides: {}\n",
                specimens.size(), specimens.front()->packing->discs.size(), confining.size(),
                recipe.test.confinement == Confinement::walls ? "walls" : "jacket");
  print_notes(recipe.notes, width);
  flush_out();
  const study::EnvelopeTests tests = run_all(specimens, recipe, confining, out, machine_of(session));
  const study::Envelope envelope =
      // Only the fit takes untrusted tests; the table of strengths shows each as it is.
      study::fit_envelope(args.with_untrusted ? study::with_untrusted(tests) : tests, recipe);
  io::write_output((out / strengths_file).string(), strengths_csv(tests));
  io::write_output((out / fits_file).string(), fits_csv(envelope));
  print_strengths(tests, envelope, width);
  print_outcomes(tests, width);
  // Three of four stresses would give a fit, but not the one that was asked for.
  if (stop_on_interrupt()->load())
    print_wrapped(width, 2, "\nstopped: no envelope is fitted; what was finished is in {}\n", args.out);
  else
    print_fits(envelope, width);
  print_wrapped(width, 2,
                "tests in {}: envelope.csv, fits.csv, a folder per stress with one per finished specimen\n",
                args.out);
  // Scripts learn by the exit code that a stress has no strength, whatever could be fitted.
  const bool all_have = std::ranges::all_of(tests.results, [](const std::vector<TestResult>& of_stress) {
    return std::ranges::all_of(of_stress, has_strength, [](const TestResult& r) { return r.outcome.status; });
  });
  return all_have ? 0 : 1;
}

}  // namespace

void add_envelope_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<EnvelopeArguments>();
  CLI::App* verb = app.add_subcommand(
      "envelope", "strength under several confining stresses: Mohr-Coulomb, Hoek-Brown, plane of weakness");
  verb->add_option("recipe", args->recipe, "recipe file (TOML); its test.kind does not matter")
      ->required()
      ->type_name("FILE");
  verb->add_option("--confining", args->confining, "confining stresses with units, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  verb->add_option("--out", args->out, "folder for the results")->capture_default_str()->type_name("FOLDER");
  verb->add_flag("--ensemble", args->ensemble,
                 "every draw of the calibration that the recipe is from, and the band of all "
                 "(docs/calibration.md)");
  verb->add_flag("--with-untrusted", args->with_untrusted,
                 "fit tests that have a strength but are not to be trusted (docs/reliability.md)");
  verb->callback([args, &session] { session.exit_code = envelope_of(*args, session); });
}

}  // namespace phy::cli
