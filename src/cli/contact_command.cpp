// `phyllite contact LAW`: one contact driven along a path, the law's answer beside the closed form, as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "cli/commands.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/output.hpp"
#include "jobs/contact_words.hpp"
#include "verification/contact_witness.hpp"

namespace phy::cli {
namespace {

struct ContactArguments {
  std::string law, path, out;
  std::vector<std::string> values, corners;
  int steps = 100;
};

std::vector<std::string> names_of_laws() {
  std::vector<std::string> names;
  for (const lab::LawInfo& law : lab::law_infos()) names.emplace_back(law.name);
  return names;
}

/// Typical values and PFC's names: users come with a PFC model, and would search the manual for both.
void explain_laws(int width) {
  for (const lab::LawInfo& law : lab::law_infos()) {
    print_wrapped(width, 2, "{}: {}\n", law.name, law.sentence);
    for (const laws::ParameterInfo& p : law.parameters)
      print_wrapped(width, 31, "  {:<9} {:<6} {:>10.4g}  ({:g} to {:g})  {}; PFC {}\n", p.name, p.unit,
                    p.typical, p.min, p.max, p.meaning, p.pfc_name);
  }
}

std::string table(const std::vector<lab::BenchRow>& rows, const std::vector<ContactForces>& exact) {
  std::string text =
      // Per metre of thickness, as the model has two dimensions; moments are N m per m, hence N.
      "step,closure [m],slide [m],rotation [rad],F_n [N/m],F_s [N/m],M [N],F_n exact [N/m],F_s exact [N/m],"
      "M exact [N],dissipated [J/m],released [J/m],stored [J/m],broke\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const lab::BenchRow& r = rows[i];
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", i, r.at.closure, r.at.slide,
                        r.at.rotation, r.forces.F_n, r.forces.F_s, r.forces.M, exact[i].F_n, exact[i].F_s,
                        exact[i].M, r.dissipated, r.released, r.stored,
                        r.broke == 1   ? "tension"
                        : r.broke == 2 ? "shear"
                                       : "");
  }
  return text;
}

std::string summary(const std::vector<lab::BenchRow>& rows, const std::vector<ContactForces>& exact) {
  // Absolute differences beside the largest value: a relative one would be infinite where a force passes
  // zero.
  ContactForces off, most;
  const auto widen = [](double& a, double b) { a = std::max(a, std::fabs(b)); };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ContactForces& f = rows[i].forces;
    widen(off.F_n, f.F_n - exact[i].F_n), widen(most.F_n, exact[i].F_n);
    widen(off.F_s, f.F_s - exact[i].F_s), widen(most.F_s, exact[i].F_s);
    widen(off.M, f.M - exact[i].M), widen(most.M, exact[i].M);
  }
  return fmt::format(
      "largest difference from the closed form, and largest value: F_n {:.2g} of {:.4g} N/m, F_s {:.2g} of "
      "{:.4g} N/m, M {:.2g} of {:.4g} N\n",
      off.F_n, most.F_n, off.F_s, most.F_s, off.M, most.M);
}

void contact(const ContactArguments& args, int width) {
  // Without a law there is nothing to drive, but the first question is which ones there are.
  if (args.law.empty()) return explain_laws(width);
  const lab::LawInfo& law = jobs::find_law(args.law);
  std::vector<Problem> problems;
  const std::vector<double> v = jobs::parameters_of(law, args.values, problems);
  std::vector<ContactPoint> corners;
  for (const std::string& text : args.corners) corners.push_back(jobs::read_corner(text, problems));
  // All problems of the command line at once.
  if (!args.path.empty()) corners = jobs::read_path(args.path, problems);
  if (!problems.empty()) throw InputError(problems);
  // A path with slip both ways, opening and rotation, so that the first try already draws something.
  if (corners.empty()) corners = jobs::default_path();
  // Before the drive: ten million steps are not computed for a file that cannot be written.
  if (!args.out.empty()) io::check_ending(args.out, {".csv", ".txt"}), io::check_outputs({args.out});
  const auto bench = lab::bench_contact(law.name, v);
  const std::vector<lab::BenchRow> rows = lab::drive(*bench, corners, args.steps);
  const std::vector<ContactForces> exact = verification::witness(law.name, v, corners, args.steps);
  // A law without its witness would print half a table.
  PHY_CHECK(exact.size() == rows.size(), "every law of the list has a closed form");
  const std::string text = table(rows, exact);
  if (args.out.empty())
    write_out(text);
  else
    io::write_output(args.out, text);
  // The table goes to standard output, the summary beside it to standard error: in this order.
  flush_out();
  write_err(summary(rows, exact));
}

}  // namespace

void add_contact_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ContactArguments>();
  CLI::App* verb = app.add_subcommand(
      "contact", "drive one contact along a path; the law's answer beside the closed form, as CSV");
  verb->add_option("law", args->law, "name of a law; without one, all laws and their parameters are listed")
      ->type_name("LAW")
      ->check(suggested(names_of_laws));
  // One value per --set: otherwise CLI11 would swallow the word behind it as another parameter.
  verb->add_option("--set", args->values, "a parameter: --set \"k_n=38e9 N/m\"")->allow_extra_args(false);
  verb->add_option("--to", args->corners, "next corner of the path: --to \"1 um, 8 um, 0 deg\"")
      ->allow_extra_args(false);
  verb->add_option("--path", args->path, std::string("corners as CSV with the header ") + jobs::path_header)
      ->type_name("FILE")
      ->excludes("--to");
  verb->add_option("--steps", args->steps, "steps from corner to corner")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  verb->add_option("--out", args->out, "file for the CSV; standard output without")->type_name("FILE");
  verb->callback([args, &session] {
    contact(*args, session.terminal_width);
    session.exit_code = 0;
  });
}

}  // namespace phy::cli
