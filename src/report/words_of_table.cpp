// What a table says before anything runs, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "report/words.hpp"

namespace phy::report {
namespace {

using F = const Finding&;
using Kind = FindingKind;

constexpr std::size_t most_named = 4;  // cells of one sentence

/// The numbers of a name: one for each cell, or for each name of the finding.
std::vector<double> each(F f, std::string_view name) {
  std::vector<double> values;
  for (const NamedNumber& q : f.numbers)
    if (q.name == name) values.push_back(q.value);
  return values;
}

std::string angle_of(const Cell& c) { return at_text({c.theta}); }
std::string name_of(const Cell& c) { return cells_text({c}); }

/// "E is 0.023 GPa at 0 degrees and 0.015 GPa at 45 degrees": cells of one property.
template <class Text>
std::string values_of(F f, std::string_view name, const std::string& what, Text text) {
  const std::vector<double> values = each(f, name);
  std::vector<std::string> items;
  for (std::size_t i = 0; i < std::min(values.size(), most_named); ++i)
    items.push_back(text(f.cells[i], values[i]) + angle_of(f.cells[i]));
  if (values.size() > most_named) items.push_back(fmt::format("{} more", values.size() - most_named));
  return fmt::format("{} is {}", what, list_text(items));
}

/// What is found and, as a sentence of its own, what to do.
template <class... Values>
std::string say(F f, fmt::format_string<Values...> format, Values&&... values) {
  const std::string said = fmt::format(format, std::forward<Values>(values)...);
  std::string advice = text(f.advice, f);
  if (advice.empty()) return said;
  advice.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(advice.front())));
  return fmt::format("{} {}.", said, advice);
}

/// "48.0 MPa" of a number that is a stress.
std::string stress(F f, std::string_view name) { return value_text(Property::ucs, f.number(name)); }
double in_MPa(double stress) { return stress * 1e-6; }

// ---- doubts

std::string unusual_value(F f) {
  const Property p = f.cells.front().property;
  const ShownUnit unit = shown_unit(p);
  const auto value = [&](const Cell&, double v) { return value_text(p, v); };
  return say(f, "{}; hardly any rock lies outside {:g} to {:g} {}.",
             values_of(f, "value", to_string(p), value), f.number("least") * unit.factor,
             f.number("most") * unit.factor, unit.name);
}

std::string modulus_ratio(F f) {
  const auto ratio = [](const Cell&, double v) { return number_text(v); };
  return say(
      f, "{}; most rocks have 200 to 500, hardly any less than 80 or more than 2000 (Deere & Miller 1966).",
      values_of(f, "ratio", "E/UCS", ratio));
}

std::string unusual_tension(F f) {
  const auto ratio = [](const Cell& c, double v) { return fmt::format("{} {:.2g}", test_text(c), v); };
  return say(f, "{}; most rocks have about 0.1.", values_of(f, "ratio", "Tension over UCS", ratio));
}

std::string unusual_point_load(F f) {
  const auto ratio = [](const Cell&, double v) { return number_text(v); };
  return say(f, "{}; hardly any rock has less than 8 or more than 50, many about 24 (Broch & Franklin 1972).",
             values_of(f, "ratio", "UCS over I_s50", ratio));
}

/// A plane carries what it carried in a test of UCS, and no more than the rock itself.
std::string unusual_shear(F f) {
  const bool low = f.has("least");
  return say(f, "{} is {}; by {} the bedding carries {} {} there.", name_of(f.cells[0]),
             stress(f, "laboratory"), name_of(f.cells[1]), low ? "at least" : "at most",
             stress(f, low ? "least" : "most"));
}

std::string strength_falls(F f) {
  return say(
      f,
      "sigma_1 - sigma_3{} falls from {} under {:.3g} MPa to {} under {:.3g} MPa; confinement weakens no "
      "rock.",
      angle_of(f.cells[1]), stress(f, "from"), in_MPa(f.cells[0].confining), stress(f, "to"),
      in_MPa(f.cells[1].confining));
}

std::string off_envelope(F f) {
  return say(f, "{} is {}, but the line through its strengths under {:.3g} to {:.3g} MPa gives {}.",
             name_of(f.cells[0]), stress(f, "laboratory"), in_MPa(f.number("from")), in_MPa(f.number("to")),
             stress(f, "envelope"));
}

std::string narrow_angles(F f) {
  return say(f, "All angles lie between {:g} and {:g} degrees: they say little about the layers.",
             f.number("from"), f.number("to"));
}

std::string replicates_apart(F f) {
  const std::vector<double> lines = each(f, "line");
  return say(f, "{} of lines {:.0f} and {:.0f} differs by a factor of {:.2g}.", name_of(f.cells[0]), lines[0],
             lines[1], f.number("factor"));
}

/// "Lines 3 and 9 are the same: UCS at 30 degrees."
std::string rows_repeated(F f) {
  const std::vector<double> lines = each(f, "line"), copies = each(f, "copy");
  std::vector<std::string> pairs;
  for (std::size_t i = 0; i < std::min(lines.size(), most_named); ++i)
    pairs.push_back(fmt::format("{:.0f} and {:.0f}", lines[i], copies[i]));
  if (lines.size() > most_named) pairs.push_back(fmt::format("{} more pairs", lines.size() - most_named));
  return say(f, "Lines {} hold the same values ({}).", fmt::join(pairs, ", "), cells_text(f.cells));
}

std::string unusual_scatter(F f) {
  return say(f, "The SD of {} (line {:.0f}) is {:.2g} % of the value; hardly any rock scatters so {}.",
             name_of(f.cells[0]), f.number("line"), 100.0 * f.number("share"),
             f.number("share") > 0.1 ? "much" : "little");
}

std::string outlying_specimen(F f) {
  const Property p = f.cells[0].property;
  return say(
      f,
      "Outlier? Line {:.0f}: {} is {}, where {:.0f} others have a mean of {}. Chance does so in {:.1g} % "
      "of tables (t = {:.1f}).",
      f.number("line"), name_of(f.cells[0]), value_text(p, f.number("value")), f.number("others"),
      value_text(p, f.number("mean")), 100.0 * f.number("chance"), f.number("t"));
}

std::string outlying_cell(F f) {
  return say(f,
             "Outlier? {} is {}, {:+.0f} % off what the other angles predict ({:.1f} standard errors): the "
             "nearer of a straight line and Jaeger's plane.",
             name_of(f.cells[0]), stress(f, "value"), 100.0 * f.number("off"), f.number("errors"));
}

// ---- the sense of the angles

/// "UCS by 9 instead of 24 % and E by 3 instead of 19 %": what planes miss by one reading, and by the other.
std::string misses(F f, bool exchanged, const char* here, const char* other) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < f.names.size(); ++i)
    if ((each(f, "exchanged")[i] > 0.0) == exchanged)
      items.push_back(fmt::format("{} by {:.0f} instead of {:.0f} %", f.names[i], 100.0 * each(f, here)[i],
                                  100.0 * each(f, other)[i]));
  return list_text(items);
}

std::string columns(F f, bool exchanged) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < f.names.size(); ++i)
    if ((each(f, "exchanged")[i] > 0.0) == exchanged) items.push_back(f.names[i]);
  return list_text(items);
}

std::string angles_exchanged(F f) {
  const bool beta = f.number("from_load") > 0.0;
  return say(f, "These angles look like {}. With {} = 90 - angle, planes miss {}.", beta ? "theta" : "beta",
             beta ? "beta" : "theta", misses(f, true, "complement", "as_read"));
}

std::string columns_exchanged(F f) {
  const char *here = "the load", *there = "the horizontal";
  if (f.number("from_load") > 0.0) std::swap(here, there);
  return say(
      f,
      "It seems that {} counts from {}, but {} from {}. With 90 - angle planes miss {}. As written they "
      "miss {}.",
      columns(f, true), here, columns(f, false), there, misses(f, true, "complement", "as_read"),
      misses(f, false, "as_read", "complement"));
}

// ---- in short

std::string table_angles(F f) {
  if (!f.has("angles")) return "Read: rock without layers.";
  const char* from = f.number("from_load") > 0.0 ? "beta, counted from the load; below, theta = 90 - beta"
                                                 : "theta, counted from the horizontal";
  if (f.number("angles") == 1.0)
    return fmt::format("Read: one angle, {:g} degrees ({}).", f.number("from"), from);
  return fmt::format("Read: {:.0f} angles from {:g} to {:g} degrees ({}).", f.number("angles"),
                     f.number("from"), f.number("to"), from);
}

/// "E 20.0 to 40.0 GPa, UCS 50 to 110 MPa".
std::string least_and_most(F f) {
  const std::vector<double> low = each(f, "low"), high = each(f, "high");
  std::vector<std::string> items;
  for (std::size_t i = 0; i < f.cells.size(); ++i) {
    const Property p = f.cells[i].property;
    const ShownUnit unit = shown_unit(p);
    const std::string a = number_text(low[i] * unit.factor), b = number_text(high[i] * unit.factor),
                      number = a == b ? a : a + " to " + b;
    items.push_back(fmt::format("{} {}{}{}", to_string(p), number, *unit.name == '\0' ? "" : " ", unit.name));
  }
  return list_text(items);
}

std::string table_moduli(F f) {
  const std::string reading = f.names.empty() ? "" : fmt::format(" E is read as \"{}\".", f.names.front());
  return fmt::format("Moduli: {}.{}", least_and_most(f), reading);
}

std::string table_strengths(F f) {
  return fmt::format("Strengths: {}. Specimens per value: {}.", least_and_most(f),
                     range_text(f.number("least_n"), f.number("most_n"), "{:.0f}"));
}

std::string parameters_open(F f) {
  const std::string list = list_text({f.names.begin() + 1, f.names.end()});
  return fmt::format("Not determined: {}.{}", list,
                     f.names.front().empty() ? "" : fmt::format(" What helps most: {}.", f.names.front()));
}

// ---- closed forms

/// "50.0 +- 1.2 GPa"
std::string stiffness(F f, const char* name, const char* error) {
  const std::string spread =
      f.has(error) && std::isfinite(f.number(error)) ? fmt::format(" +- {:.2g}", f.number(error) * 1e-9) : "";
  return fmt::format("{:.3g}{} GPa", f.number(name) * 1e-9, spread);
}

std::string eq1(F f) {
  std::string text =
      fmt::format("Eq. 1 through E: E = {}, K_n delta = {}, K_s delta = {}, {}.", stiffness(f, "E", "se_E"),
                  stiffness(f, "K_n_delta", "se_K_n_delta"), stiffness(f, "K_s_delta", "se_K_s_delta"),
                  f.has("R2") ? fmt::format("R2 = {:.3f}", f.number("R2"))
                              : "through three angles exactly: R2 says nothing");
  if (f.has("spacing")) {
    const double delta = f.number("spacing");
    text += fmt::format(" With planes every {:.3g} mm, K_n = {:.0f} and K_s = {:.0f} GPa/m.", delta * 1e3,
                        f.number("K_n_delta") / delta * 1e-9, f.number("K_s_delta") / delta * 1e-9);
  }
  if (f.kind == Kind::eq1_incremental) return text + " Incremental type: E grows from 0 to 90 degrees.";
  return text + fmt::format(" Shoulder type: E is least at {:.0f} degrees, {}.", f.number("theta"),
                            value_text(Property::E, f.number("least_E")));
}

std::string jaeger_plane(F f) {
  return say(f,
             "Jaeger's plane of weakness through UCS: c_w = {}, phi_w = {:.0f} degrees, R2 = {:.2f}. It is "
             "weakest at {:.0f} degrees, {}, below shoulders of {}, and misses UCS by {:.0f} % (rms).",
             stress(f, "c_w"), f.number("phi_w"), f.number("R2"), f.number("theta"), stress(f, "least"),
             stress(f, "shoulders"), 100.0 * f.number("rms"));
}

std::string anisotropy(F f) {
  const std::vector<double> ratios = each(f, "ratio");
  std::vector<std::string> items;
  for (std::size_t i = 0; i < ratios.size(); ++i)
    items.push_back(fmt::format("{} {:.2f} ({:g} over {:g} degrees)", to_string(f.cells[2 * i].property),
                                ratios[i], f.cells[2 * i].theta, f.cells[2 * i + 1].theta));
  return "Largest value over least: " + list_text(items) + ".";
}

// ---- limits of the table

std::string scatter_assumed(F f) {
  const Property p = f.cells.front().property;
  const std::string least = miss_text(p, f.number("least")), most = miss_text(p, f.number("most"));
  return say(f, "{}: {} of {} have too few specimens to show their scatter. Usual scatter is taken: {}.",
             to_string(p), f.cells.size(), counted_text(f.number("of"), "cell"),
             least == most ? least : least + " to " + most);
}

/// "nu at 0 degrees is 0.150 (0.075 wanted, 7.5 standard errors)"
std::string misfits(F f) {
  const std::vector<double> laboratory = each(f, "laboratory"), wanted = each(f, "wanted"),
                            errors = each(f, "errors");
  std::vector<std::string> items;
  for (std::size_t i = 0; i < std::min(f.cells.size(), most_named); ++i) {
    const Property p = f.cells[i].property;
    items.push_back(fmt::format("{}, {} in place of {} ({:.1f} standard errors)", name_of(f.cells[i]),
                                value_text(p, laboratory[i]), value_text(p, wanted[i]), errors[i]));
  }
  if (f.cells.size() > most_named) items.push_back(fmt::format("{} more", f.cells.size() - most_named));
  return fmt::format("{}", fmt::join(items, "; "));
}

/// At which part of the curve the moduli are read, where that is no elastic body's. The names of a cause,
/// which has a share of the misfit, are properties.
std::string reading_of(F f) {
  return f.names.empty() || f.has("share")
             ? ""
             : fmt::format(" Read as {} (E_is), E and nu need not belong to an elastic body.",
                           f.names.front());
}

std::string no_layered_body(F f) {
  const char* which = f.kind == Kind::no_layered_body ? "Farthest from the nearest body:"
                      : f.cells.size() > 1            ? "By the other cells the odd one out is any of:"
                                                      : "By the other cells the odd one out is";
  const std::string moduli = f.advice == Advice::check_nu ? "E and nu" : "E";
  return say(
      f, "{}: chi-square is {:.0f}, and above {:.0f} in 1 % of tables. {} {}.{}",
      f.has("at_small_strain")
          ? fmt::format("Taken back to small strain, {} of the table belong to no layered elastic body",
                        moduli)
          : fmt::format("No layered elastic body has this {} within the errors", moduli),
      f.number("chi_square"), f.number("limit"), which, misfits(f), reading_of(f));
}

std::string no_planes(F f) {
  return say(f,
             "A layered elastic body has this E and nu, but no isotropic rock with planes: {}.{} Joints in "
             "place of bonds may come nearer.",
             misfits(f), reading_of(f));
}

std::string stiffer(F f) {
  return say(
      f,
      "E{} changes by {:+.0f} % from {:.3g} to {:.3g} MPa of confinement. Bonded grains that do not crack "
      "before E is read hardly change: 2 % up to 20 MPa. The model may lie between.",
      angle_of(f.cells[0]), 100.0 * f.number("change"), in_MPa(f.cells[0].confining),
      in_MPa(f.cells[1].confining));
}

std::string few_grains_between(F f) {
  return say(f,
             "{:.1f} grains lie between two planes ({:.3g} mm apart): fewer than {:g} blur the layers. With "
             "grain_size = \"{:.3g} mm\" there are enough.",
             f.number("grains"), f.number("spacing") * 1e3, f.number("fewest"), f.number("wanted") * 1e3);
}

std::string coarse_half_disc(F f) {
  return say(
      f,
      "K_Ic: {:.0f} grains in the radius of the half disc ({:.3g} mm) are too few. Below {:g} the notch "
      "is blunt and K_Ic too low.",
      f.number("grains"), f.number("radius") * 1e3, f.number("fewest"));
}

const std::vector<Wording> doubts = {
    {Kind::unusual_value, unusual_value},
    {Kind::unusual_modulus_ratio, modulus_ratio},
    {Kind::unusual_tension, unusual_tension},
    {Kind::unusual_point_load, unusual_point_load},
    {Kind::unusual_shear, unusual_shear},
    {Kind::strength_falls, strength_falls},
    {Kind::off_envelope, off_envelope},
    {Kind::narrow_angles, narrow_angles},
    {Kind::replicates_apart, replicates_apart},
    {Kind::rows_repeated, rows_repeated},
    {Kind::unusual_scatter, unusual_scatter},
    {Kind::outlying_specimen, outlying_specimen},
    {Kind::outlying_cell, outlying_cell},
    {Kind::angles_exchanged, angles_exchanged},
    {Kind::columns_exchanged, columns_exchanged},
    {Kind::along_bedding_taken,
     [](F f) {
       return say(f,
                  "{}: taken for the rock along its bedding, which the conversion of plane strain needs. The "
                  "table has no value nearer to 90 degrees.",
                  cells_text(f.cells));
     }},
    {Kind::not_converted,
     [](F f) {
       return say(f, "{}: not converted from plane strain, for want of E of the same test.",
                  cells_text(f.cells));
     }},
};

const std::vector<Wording> closed_forms = {
    {Kind::eq1_shoulder, eq1},
    {Kind::eq1_incremental, eq1},
    {Kind::table_dips,
     [](F f) { return say(f, "E of the table, however, is least at {:g} degrees.", f.cells[0].theta); }},
    {Kind::eq1_none, [](F f) { return say(f, "Eq. 1 through E: none, {}.", f.names.front()); }},
    {Kind::jaeger_plane, jaeger_plane},
    {Kind::jaeger_none,
     [](F f) { return say(f, "Jaeger's plane of weakness through UCS: none, {}.", f.names.front()); }},
    {Kind::no_plane_shows,
     [](F f) { return say(f, "UCS shows no plane of weakness (R2 = {:.2f}).", f.number("R2")); }},
    {Kind::weakest_off_plane,
     [](F f) {
       return say(f, "The table is weakest at {:g} degrees, where no single plane of weakness has its least.",
                  f.cells[0].theta);
     }},
    {Kind::anisotropy, anisotropy},
};

const std::vector<Wording> limits = {
    {Kind::scatter_assumed, scatter_assumed},
    {Kind::packings_not_counted,
     [](F f) {
       return say(
           f,
           "Expected intervals count the laboratory's scatter alone; the difference between packings of "
           "the model comes on top.");
     }},
    {Kind::no_layered_body, no_layered_body},
    {Kind::one_cell_of_no_body, no_layered_body},
    {Kind::no_planes_in_isotropic_rock, no_planes},
    {Kind::stiffer_under_confinement, stiffer},
    {Kind::few_grains_between, few_grains_between},
    {Kind::coarse_half_disc, coarse_half_disc},
};

}  // namespace

std::string advice_of_table(Advice advice, F of) {
  switch (advice) {
    case Advice::check_unit: return "check the unit in the header";
    case Advice::check_unit_and_column: return "check the unit and the column";
    case Advice::check_pressures: return "check pressures and angles";
    case Advice::check_envelope: return "check that c and phi are of this angle, and of peaks";
    case Advice::check_lines: return "check for a typing error, or another rock";
    case Advice::delete_copies: return "delete the copy, unless another specimen had these values";
    case Advice::rename_angles:
      return fmt::format("rename the column to {}, or keep it and ignore this",
                         of.number("from_load") > 0.0 ? "theta" : "beta");
    case Advice::rows_of_their_own:
      return fmt::format("give {} rows with 90 - angle, or keep the table and ignore this",
                         columns(of, true));
    case Advice::finer_half_disc:
      return fmt::format("take grains of {:g} mm, or a larger half disc", of.number("wanted") * 1e3);
    default: return "";
  }
}

namespace {

/// By each property the measured rock with the most similar curve; before that, whose values these are.
std::string nearest_rock(F f) {
  const std::vector<double> differences = each(f, "difference");
  const std::vector<std::string> same(f.names.begin() + 2 * std::ssize(f.cells), f.names.end());
  std::string text = same.empty() ? "" : fmt::format("These are values of {}. ", list_text(same));
  if (f.cells.empty())
    return text + fmt::format("No measured rock is near: the curves differ by {:.0f} % or more.",
                              100.0 * f.number("farthest"));
  std::vector<std::string> items;
  for (std::size_t i = 0; i < f.cells.size(); ++i)
    items.push_back(fmt::format("{} by {} (curves differ by {:.0f} %)", f.names[2 * i],
                                to_string(f.cells[i].property), 100.0 * differences[i]));
  std::vector<std::string> commands;
  for (std::size_t i = 0; i < f.cells.size(); ++i)
    if (std::string one = "phyllite rocks " + f.names[2 * i + 1];
        std::ranges::find(commands, one) == commands.end())
      commands.push_back(std::move(one));
  return text + fmt::format("Nearest in shape of the {} rocks: {}. See: {}.",
                            same.empty() ? "measured" : "other measured", list_text(items),
                            list_text(commands));
}

const std::vector<Wording>& words_in_short() {
  static const std::vector<Wording> list = {
      {Kind::table_angles, table_angles},
      {Kind::table_moduli, table_moduli},
      {Kind::table_strengths, table_strengths},
      {Kind::no_doubts, [](F) -> std::string { return "Doubts: none."; }},
      {Kind::more_doubts,
       [](F f) { return fmt::format("{} more.", counted_text(f.number("doubts"), "doubt")); }},
      {Kind::nearest_rock, nearest_rock},
      {Kind::parameters_open, parameters_open},
      {Kind::parameters_known,
       [](F) -> std::string { return "The table determines every parameter that is sought."; }},
      {Kind::no_body_in_short,
       [](F f) {
         return fmt::format("No layered elastic body has this E{}; farthest off is {}.",
                            f.number("with_nu") > 0.0 ? " and nu" : "", cells_text(f.cells));
       }},
      {Kind::models_ahead,
       [](F f) {
         return fmt::format("{}: {}.", f.names.size() > 1 ? "Models that may be tried" : "Model",
                            fmt::join(f.names, "; "));
       }},
      {Kind::nothing_to_fit,
       [](F) -> std::string { return "Nothing to fit: it takes E, or a strength in compression."; }},
  };
  return list;
}

}  // namespace

const std::vector<Wording>& words_of_table() {
  static const std::vector<Wording> all = [] {
    std::vector<Wording> list = doubts;
    for (const auto* more : {&words_in_short(), &closed_forms, &limits})
      list.insert(list.end(), more->begin(), more->end());
    return list;
  }();
  return all;
}

}  // namespace phy::report
