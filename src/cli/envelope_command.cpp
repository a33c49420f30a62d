// `phyllite envelope RECIPE`: strength under several confining stresses, and the envelopes that fit it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "analysis/analyse.hpp"
#include "base/check.hpp"
#include "base/units.hpp"
#include "cli/machine.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/file.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "study/envelope.hpp"
#include "study/table.hpp"

namespace phy {
namespace {

namespace fs = std::filesystem;

struct EnvelopeArguments {
  std::string recipe, out = "results/envelope";
  std::vector<std::string> confining = {"0 MPa", "5 MPa", "10 MPa", "20 MPa"};
};

std::vector<double> read_stresses(const std::vector<std::string>& words) {
  std::vector<double> stresses;
  std::vector<Problem> problems;
  for (const std::string& word : words) {
    const Quantity q = parse_quantity(word, Dimension::pressure);
    if (!q.ok)
      problems.push_back({"command line", "--confining", word, "a stress with its unit", q.problem});
    else if (!(q.value >= 0.0))
      problems.push_back(
          {"command line", "--confining", word, "0 or more", "a confining stress cannot pull"});
    stresses.push_back(q.value);
  }
  std::sort(stresses.begin(), stresses.end());
  const bool twice = std::adjacent_find(stresses.begin(), stresses.end()) != stresses.end();
  if (problems.empty() && (twice || stresses.size() < 3))
    problems.push_back({"command line", "--confining", std::to_string(words.size()) + " stresses",
                        "at least three, each once", "two unknowns and their errors need three stresses"});
  if (!problems.empty()) throw InputError(problems);
  return stresses;
}

std::string folder_of(double sigma_3, const std::string& name) {
  std::string specimen;
  for (const char c : name) specimen += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return fmt::format("sigma_3_{:g}_MPa/{}", sigma_3 * 1e-6, specimen);
}

std::string with_error(const Estimate& e, double scale, int digits) {
  if (!std::isfinite(e.value)) return "-";
  if (!std::isfinite(e.se)) return fmt::format("{:.{}f}", e.value * scale, digits);
  return fmt::format("{:.{}f} +- {:.{}f}", e.value * scale, digits, e.se * scale, digits);
}

void print_strengths(const EnvelopeTests& tests) {
  fmt::print("\nsigma_1 [MPa] at the peak\n{:<16}", "sigma_3 [MPa]");
  for (const double s : tests.confining) fmt::print(" {:>9g}", s * 1e-6);
  fmt::print("\n");
  for (std::size_t k = 0; k < tests.results.front().size(); ++k) {
    fmt::print("{:<16}", tests.results.front()[k].name);
    for (const auto& row : tests.results) {
      const Number* n = row[k].outcome.status == Status::peaked ? find(row[k].numbers, "sigma_1") : nullptr;
      fmt::print(" {:>9}",
                 n != nullptr && std::isfinite(n->value) ? fmt::format("{:.2f}", n->value * 1e-6) : "-");
    }
    fmt::print("\n");
  }
}

void print_fits(const Envelope& envelope, std::size_t n_stresses) {
  fmt::print("\n{:<16} {:>16} {:>16} {:>7} {:>18} {:>16} {:>7} {:>16}\n", "least squares", "c [MPa]",
             "phi [deg]", "R2", "ucs_hb [MPa]", "m_i", "R2", "k");
  std::string reasons;
  for (const SpecimenEnvelope& s : envelope.specimens) {
    const auto R2 = [](bool ok, double value) {
      return ok ? fmt::format("{:.4f}", value) : std::string("-");
    };
    fmt::print("{:<16} {:>16} {:>16} {:>7} {:>18} {:>16} {:>7} {:>16}\n", s.name,
               with_error(s.mohr_coulomb.cohesion, 1e-6, 2), with_error(s.mohr_coulomb.friction, 1.0, 2),
               R2(s.mohr_coulomb.ok, s.mohr_coulomb.R2), with_error(s.hoek_brown.ucs, 1e-6, 2),
               with_error(s.hoek_brown.m_i, 1.0, 2), R2(s.hoek_brown.ok, s.hoek_brown.R2),
               with_error(s.k, 1.0, 3));
    if (s.readings.size() < n_stresses)
      reasons += fmt::format(
          "{}: {} of {} tests peaked, the others give no reading (test.stop_at, test.max_strain)\n", s.name,
          s.readings.size(), n_stresses);
    if (!s.mohr_coulomb.ok)
      reasons += fmt::format("{}: no Mohr-Coulomb envelope: {}\n", s.name, s.mohr_coulomb.reason);
    if (!s.hoek_brown.ok)
      reasons += fmt::format("{}: no Hoek-Brown envelope: {}\n", s.name, s.hoek_brown.reason);
  }
  fmt::print(
      "+-: standard errors; k: m over that of the planes nearest to across the load (Saroglou & "
      "Tsiambaos)\n{}",
      reasons);
  if (envelope.plane.ok)
    fmt::print(
        "one plane of weakness (Jaeger) over all angles and stresses, matrix \"{}\": c = {:.2f} MPa, "
        "phi = {:.2f} deg, R2 = {:.4f}\n",
        envelope.matrix, envelope.plane.plane.cohesion * 1e-6, envelope.plane.plane.friction,
        envelope.plane.R2);
  else
    fmt::print("one plane of weakness (Jaeger): no fit: {}\n", envelope.plane.reason);
}

std::string strengths_csv(const EnvelopeTests& tests) {
  std::string text = "specimen,theta [deg],sigma_3 [Pa],sigma_1 [Pa],confinement_error,status,result_hash\n";
  for (std::size_t i = 0; i < tests.confining.size(); ++i)
    for (const TestResult& r : tests.results[i]) {
      const auto value = [&](const char* name) {
        const Number* n = find(r.numbers, name);
        return n == nullptr ? std::string() : csv_cell(n->value);
      };
      text += fmt::format("{},{},{},{},{},{},{}\n", r.name, r.intact ? "" : print_number(r.theta),
                          print_number(tests.confining[i]), value("sigma_1"), value("confinement_error"),
                          to_string(r.outcome.status), r.hash);
    }
  return text;
}

std::string fits_csv(const Envelope& envelope) {
  std::string text =
      "specimen,theta [deg],cohesion [Pa],cohesion_se [Pa],friction [deg],friction_se [deg],R2_mohr_coulomb,"
      "ucs_hb [Pa],ucs_hb_se [Pa],m_i,m_i_se,R2_hoek_brown,k,k_se\n";
  for (const SpecimenEnvelope& s : envelope.specimens) {
    text += s.name + "," + (s.intact ? "" : print_number(s.theta));
    for (const double v :
         {s.mohr_coulomb.cohesion.value, s.mohr_coulomb.cohesion.se, s.mohr_coulomb.friction.value,
          s.mohr_coulomb.friction.se, s.mohr_coulomb.R2, s.hoek_brown.ucs.value, s.hoek_brown.ucs.se,
          s.hoek_brown.m_i.value, s.hoek_brown.m_i.se, s.hoek_brown.R2, s.k.value, s.k.se})
      text += "," + csv_cell(v);
    text += "\n";
  }
  return text;
}

int envelope_of(const EnvelopeArguments& args, const Session& session) {
  const std::vector<double> confining = read_stresses(args.confining);
  const Recipe recipe = read_recipe(args.recipe);
  const fs::path out(args.out);
  check_writable(args.out);
  const auto packing = packing_of(recipe, default_cache_folder());
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (Specimen& s : make_specimens(packing, confined_recipe(recipe, confining.front())))
    specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  fmt::print("envelope  {} specimens of {} discs under {} confining stresses, sides: {}\n", specimens.size(),
             packing->discs.size(), confining.size(),
             recipe.test.confinement == Confinement::walls ? "walls" : "jacket");
  bool all_well = true;
  const auto on_result = [&](std::size_t i, std::size_t k, const TestResult& r) {
    all_well = all_well && r.outcome.status == Status::peaked;
    write_result((out / folder_of(confining[i], r.name)).string(), confined_recipe(recipe, confining[i]),
                 PHY_VERSION, *specimens[k], r);
    fmt::print("{:g} MPa, {}: {}: {}\n", confining[i] * 1e-6, r.name, to_string(r.outcome.status),
               r.outcome.reason);
    std::fflush(stdout);
  };
  const EnvelopeTests tests = run_envelope(specimens, recipe, confining, machine_of(session), on_result);
  const Envelope envelope = fit_envelope(tests);
  print_strengths(tests);
  print_fits(envelope, tests.confining.size());
  write_file((out / "envelope.csv").string(), strengths_csv(tests));
  write_file((out / "fits.csv").string(), fits_csv(envelope));
  fmt::print("results in {}: envelope.csv, fits.csv, one folder per test\n", args.out);
  return all_well ? 0 : 1;
}

}  // namespace

void add_envelope_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<EnvelopeArguments>();
  CLI::App* verb = app.add_subcommand(
      "envelope", "strength under several confining stresses: Mohr-Coulomb, Hoek-Brown, plane of weakness");
  verb->add_option("recipe", args->recipe, "recipe file (TOML); its test.kind does not matter")->required();
  verb->add_option("--confining", args->confining, "confining stresses with units, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_option("--out", args->out, "folder for the results")->capture_default_str();
  verb->callback([args, &session] { session.exit_code = envelope_of(*args, session); });
}

}  // namespace phy
