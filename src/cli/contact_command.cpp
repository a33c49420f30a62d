// `phyllite contact LAW`: one contact driven along a path, the law's answer beside the closed form, as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "base/units.hpp"
#include "cli/commands.hpp"
#include "cli/terminal.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "lab/contact_bench.hpp"
#include "verification/contact_witness.hpp"

namespace phy::cli {
namespace {

constexpr const char* path_header = "closure [m],slide [m],rotation [rad]";
constexpr double degree = 0.017453292519943295;

struct ContactArguments {
  std::string law, path, out;
  std::vector<std::string> values, corners;
  int steps = 100;
};

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(at, from), text.size());
    std::string_view part = text.substr(from, to - from);
    while (!part.empty() && std::isspace(static_cast<unsigned char>(part.front())) != 0)
      part.remove_prefix(1);
    while (!part.empty() && std::isspace(static_cast<unsigned char>(part.back())) != 0) part.remove_suffix(1);
    parts.push_back(part);
    from = to + 1;
  }
  return parts;
}

bool read_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

const lab::LawInfo& find_law(const std::string& name) {
  std::string known;
  for (const lab::LawInfo& law : lab::law_infos()) {
    if (name == law.name) return law;
    known += (known.empty() ? "" : ", ") + std::string(law.name);
  }
  throw InputError(
      Problem{"command line", "LAW", name, "one of " + known, "`phyllite contact` explains them"});
}

/// One "name=number unit" onto the parameters; a problem when it does not fit.
void set_parameter(const lab::LawInfo& law, const std::string& text, std::vector<double>& v,
                   std::vector<Problem>& problems) {
  const std::string name = text.substr(0, text.find('='));
  const std::string_view rest =
      text.size() > name.size() ? std::string_view(text).substr(name.size() + 1) : "";
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const laws::ParameterInfo& p = law.parameters[i];
    if (name != p.name) continue;
    const bool bare = std::string_view(p.unit) == "1";
    std::string_view number = rest;
    bool ok = bare || number.ends_with(p.unit);
    if (ok && !bare)
      number = split(number.substr(0, number.size() - std::string_view(p.unit).size()), ',').front();
    ok = ok && read_number(number, v[i]) && v[i] >= p.min && v[i] <= p.max;
    ok = ok && (!p.whole || v[i] == std::floor(v[i]));
    if (!ok)
      problems.push_back({"command line", "--set " + name, std::string(rest),
                          fmt::format("{}{:g} to {:g}{}{}", p.whole ? "a whole number, " : "", p.min, p.max,
                                      bare ? "" : " ", bare ? "" : p.unit),
                          fmt::format("for example --set \"{}={:g}{}{}\"", name, p.typical, bare ? "" : " ",
                                      bare ? "" : p.unit)});
    return;
  }
  std::string known;
  for (const laws::ParameterInfo& p : law.parameters)
    known += (known.empty() ? "" : ", ") + std::string(p.name);
  problems.push_back({"command line", "--set", text, "NAME=VALUE with a name of " + known, ""});
}

std::vector<double> parameters_of(const lab::LawInfo& law, const ContactArguments& args,
                                  std::vector<Problem>& problems) {
  std::vector<double> v;
  for (const laws::ParameterInfo& p : law.parameters) v.push_back(p.typical);
  for (const std::string& text : args.values) set_parameter(law, text, v, problems);
  const auto value = [&](std::string_view name) {
    for (std::size_t i = 0; i < v.size(); ++i)
      if (name == law.parameters[i].name) return v[i];
    return nan;
  };
  if (value("tan_psi") > value("mu"))
    problems.push_back({"command line", "--set tan_psi", fmt::format("{:g}", value("tan_psi")),
                        "at most mu: otherwise slip would create energy", "lower tan_psi or raise mu"});
  return v;
}

ContactPoint read_corner(const std::string& text, std::vector<Problem>& problems) {
  ContactPoint p;
  const auto parts = split(text, ',');
  double* const fields[] = {&p.closure, &p.slide, &p.rotation};
  const bool counted = parts.size() == 2 || parts.size() == 3;
  std::string problem = counted ? "" : "two or three quantities";
  for (std::size_t i = 0; counted && i < parts.size(); ++i) {
    const Quantity q = parse_quantity(parts[i], i < 2 ? Dimension::length : Dimension::angle);
    if (!q.ok) problem += (problem.empty() ? "" : "; ") + std::string(parts[i]) + " " + q.problem;
    *fields[i] = i < 2 ? q.value : q.value * degree;
  }
  if (!problem.empty())
    problems.push_back({"command line", "--to", text, "\"CLOSURE, SLIDE[, ROTATION]\": " + problem,
                        "for example --to \"1 um, 8 um, 0 deg\""});
  return p;
}

std::vector<ContactPoint> read_path(const std::string& file, std::vector<Problem>& problems) {
  std::vector<ContactPoint> corners;
  int number = 0;
  bool header = false;
  const std::string content = io::read_file(file);
  for (const std::string_view line : split(content, '\n')) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::string where = file + ":" + std::to_string(number);
    if (!header) {
      header = true;
      if (line != path_header)
        problems.push_back({where, "", std::string(line), "the header line", path_header});
      continue;
    }
    const auto parts = split(line, ',');
    ContactPoint p;
    if (parts.size() == 3 && read_number(parts[0], p.closure) && read_number(parts[1], p.slide) &&
        read_number(parts[2], p.rotation))
      corners.push_back(p);
    else
      problems.push_back({where, "", std::string(line), "three numbers: " + std::string(path_header), ""});
  }
  if (corners.empty() && problems.empty())
    problems.push_back({file, "", "", "at least one corner", path_header});
  return corners;
}

/// Closes, slides to and fro, opens, closes again where it was, slides back.
std::vector<ContactPoint> default_path() {
  return {{1e-6, 0, 0},     {1e-6, 8e-6, 0}, {1e-6, -4e-6, 0},   {-5e-6, -4e-6, 0},
          {1e-6, -4e-6, 0}, {1e-6, 8e-6, 0}, {1e-6, 8e-6, 0.002}};
}

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
  if (args.law.empty()) return explain_laws(width);
  const lab::LawInfo& law = find_law(args.law);
  std::vector<Problem> problems;
  const std::vector<double> v = parameters_of(law, args, problems);
  std::vector<ContactPoint> corners;
  for (const std::string& text : args.corners) corners.push_back(read_corner(text, problems));
  if (!args.path.empty()) corners = read_path(args.path, problems);
  if (!problems.empty()) throw InputError(problems);
  if (corners.empty()) corners = default_path();
  if (!args.out.empty()) io::check_outputs({args.out});
  const auto bench = lab::bench_contact(law.name, v);
  const std::vector<lab::BenchRow> rows = lab::drive(*bench, corners, args.steps);
  const std::vector<ContactForces> exact = verification::witness(law.name, v, corners, args.steps);
  PHY_CHECK(exact.size() == rows.size(), "every law of the list has a closed form");
  const std::string text = table(rows, exact);
  if (args.out.empty())
    write_out(text);
  else
    io::write_output(args.out, text);
  flush_out();
  write_err(summary(rows, exact));
}

}  // namespace

void add_contact_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ContactArguments>();
  CLI::App* verb = app.add_subcommand(
      "contact", "drive one contact along a path; the law's answer beside the closed form, as CSV");
  verb->add_option("law", args->law, "name of a law; without one, all laws and their parameters are listed");
  verb->add_option("--set", args->values, "a parameter: --set \"k_n=38e9 N/m\"")->allow_extra_args(false);
  verb->add_option("--to", args->corners, "next corner of the path: --to \"1 um, 8 um, 0 deg\"")
      ->allow_extra_args(false);
  verb->add_option("--path", args->path, std::string("corners as CSV with the header ") + path_header)
      ->excludes("--to");
  verb->add_option("--steps", args->steps, "steps from corner to corner")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  verb->add_option("--out", args->out, "file for the CSV; standard output without");
  verb->callback([args, &session] {
    contact(*args, session.terminal_width);
    session.exit_code = 0;
  });
}

}  // namespace phy::cli
