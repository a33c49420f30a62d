#include "jobs/contact_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/nan.hpp"
#include "base/option.hpp"
#include "base/units.hpp"
#include "io/file.hpp"

namespace phy::jobs {
namespace {

constexpr double degree = 0.017453292519943295;

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(at, from), text.size());
    std::string_view part = text.substr(from, to - from);
    // isspace of a negative char is undefined, and bytes of UTF-8 are negative.
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
  // from_chars reads "inf" and "nan", which no law can be driven with.
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
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
    // A bare number has no unit that could be forgotten; all others must carry it, as in recipes.
    const bool bare = std::string_view(p.unit) == "1";
    std::string_view number = rest;
    bool ok = bare || number.ends_with(p.unit);
    if (ok && !bare)
      number = split(number.substr(0, number.size() - std::string_view(p.unit).size()), ',').front();
    ok = ok && read_number(number, v[i]) && v[i] >= p.min && v[i] <= p.max;
    // Elements of a flat joint are counted: half of one would be cut off in silence.
    ok = ok && (!p.whole || v[i] == std::floor(v[i]));
    if (!ok)
      problems.push_back(option_problem(
          "set " + name, std::string(rest),
          fmt::format("{}{:g} to {:g}{}{}", p.whole ? "a whole number, " : "", p.min, p.max, bare ? "" : " ",
                      bare ? "" : p.unit),
          "for example " + option_set("set " + name, fmt::format("{:g}{}{}", p.typical, bare ? "" : " ",
                                                                 bare ? "" : p.unit))));
    return;
  }
  std::string known;
  for (const laws::ParameterInfo& p : law.parameters)
    known += (known.empty() ? "" : ", ") + std::string(p.name);
  // Without "=" the user forgot the value, with it the name is wrong: other remedies.
  if (text.find('=') == text.npos)
    problems.push_back(option_problem("set", text, "NAME=VALUE with a name of " + known, ""));
  else
    problems.push_back(
        option_problem("set " + name, std::string(rest), "a parameter of the law: " + known, ""));
}

}  // namespace

const lab::LawInfo& find_law(const std::string& name) {
  std::string known;
  for (const lab::LawInfo& law : lab::law_infos()) {
    if (name == law.name) return law;
    known += (known.empty() ? "" : ", ") + std::string(law.name);
  }
  throw InputError(option_problem("LAW", name, "one of " + known, "`phyllite contact` explains them"));
}

std::vector<double> parameters_of(const lab::LawInfo& law, const std::vector<std::string>& values,
                                  std::vector<Problem>& problems) {
  std::vector<double> v;
  // Whoever sets one parameter wants to see its effect, and need not know the others.
  for (const laws::ParameterInfo& p : law.parameters) v.push_back(p.typical);
  for (const std::string& text : values) set_parameter(law, text, v, problems);
  const auto value = [&](std::string_view name) {
    for (std::size_t i = 0; i < v.size(); ++i)
      if (name == law.parameters[i].name) return v[i];
    return nan;
  };
  if (value("tan_psi") > value("mu"))
    problems.push_back(option_problem("set tan_psi", fmt::format("{:g}", value("tan_psi")),
                                      "at most mu: otherwise slip would create energy",
                                      "lower tan_psi or raise mu"));
  return v;
}

ContactPoint read_corner(const std::string& text, std::vector<Problem>& problems) {
  ContactPoint p;
  const auto parts = split(text, ',');
  const std::array<double*, 3> fields = {&p.closure, &p.slide, &p.rotation};
  // Rotation may be left out: laws without bending have none.
  const bool counted = parts.size() == 2 || parts.size() == 3;
  std::string problem = counted ? "" : "two or three quantities";
  for (std::size_t i = 0; counted && i < parts.size(); ++i) {
    const Quantity q = parse_quantity(parts[i], i < 2 ? Dimension::length : Dimension::angle);
    // All wrong parts of a corner in one message.
    if (!q.ok) problem += (problem.empty() ? "" : "; ") + std::string(parts[i]) + " " + q.problem;
    *fields.at(i) = i < 2 ? q.value : q.value * degree;
  }
  if (!problem.empty())
    problems.push_back(option_problem("to", text, "\"CLOSURE, SLIDE[, ROTATION]\": " + problem,
                                      "for example " + option_set("to", "1 um, 8 um, 0 deg")));
  return p;
}

std::vector<ContactPoint> read_path(const std::string& file, std::vector<Problem>& problems) {
  std::vector<ContactPoint> corners;
  int number = 0;
  bool header = false;
  const std::string content = io::read_file(file);
  for (const std::string_view line : split(content, '\n')) {
    ++number;
    // Notes may stand in the file, as in tables of other programs.
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
    // SI units without words, as the header says: a file is written by programs.
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

std::vector<ContactPoint> default_path() {
  // Closed, slid both ways, opened by five times as much, closed again, slid and rotated.
  return {{1e-6, 0, 0},     {1e-6, 8e-6, 0}, {1e-6, -4e-6, 0},   {-5e-6, -4e-6, 0},
          {1e-6, -4e-6, 0}, {1e-6, 8e-6, 0}, {1e-6, 8e-6, 0.002}};
}

}  // namespace phy::jobs
