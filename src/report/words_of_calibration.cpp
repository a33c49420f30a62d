// What a verdict finds, in words: values, uses, causes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/nan.hpp"
#include "report/words.hpp"

namespace phy::report {

namespace {

using F = const Finding&;
using Kind = FindingKind;

Property property_of(F f) { return f.cells.front().property; }

std::string ranges(F f, const std::string& ratio, const char* format) {
  return fmt::format("{} is {} in the table and {} in the model.", ratio,
                     range_text(f.number("laboratory_low"), f.number("laboratory_high"), format),
                     range_text(f.number("model_low"), f.number("model_high"), format));
}

std::string tension_ratio(F f) {
  const Cell& c = f.cells.front();
  return fmt::format(
      "UCS/{0}{1} is {2:.1f} in the table; mapped specimens of this model have {3}. "
      "The model's UCS is off by {4:+.0f} %, its {0} by {5:+.0f} %.",
      to_string(c.property), at_text({c.theta}), f.number("laboratory"),
      range_text(f.number("low"), f.number("high"), "{:.1f}"), 100.0 * f.number("ucs"),
      100.0 * f.number("tension"));
}

/// "12 % too high, give or take 15 %": what the maps expect of a value.
std::string expected_text(F f) {
  const Property p = property_of(f);
  const double laboratory = f.number("laboratory"), off = miss(p, f.number("expected"), laboratory),
               error = f.number("error") * (measured(p).absolute ? laboratory : 1.0);
  return fmt::format("{} too {}, give or take {}", miss_text(p, std::fabs(off)), off < 0.0 ? "low" : "high",
                     miss_text(p, error));
}

std::string expected_in_maps(F f) {
  return fmt::format("{} is {}, {}. The maps expect it of this model: {}.", cells_text(f.cells), both_text(f),
                     miss_text(f), expected_text(f));
}

/// With what was ruled out, where no cause was found.
std::string farthest_value(F f) {
  const std::string text = fmt::format("Farthest off is {}, {}.", cells_text(f.cells), both_text(f));
  std::vector<std::string> ruled_out;
  if (f.has("expected")) ruled_out.push_back("the maps expect this model " + expected_text(f));
  if (f.has("packings"))
    ruled_out.push_back("packings differ by " +
                        (measured(property_of(f)).absolute
                             ? fmt::format("{:.3f}", f.number("packings"))
                             : percent_text(f.number("packings") / f.number("model"))));
  return ruled_out.empty() ? text
                           : text + fmt::format(" No cause was found: {}.", fmt::join(ruled_out, "; "));
}

std::string ends_ratio(F f, const char* ratio) {
  return fmt::format("{} is {:.2f} in the table and {:.2f} in the model.", ratio, f.number("laboratory"),
                     f.number("model"));
}

std::string weakest(F f) {
  return fmt::format("The rock is weakest at {:g} degrees, the model at {:g} degrees.", f.cells[0].theta,
                     f.cells[1].theta);
}

std::string nearest_in_maps(F f) {
  std::string numbers = fmt::format(
      "With free scales the model misses the table by {:.2f} tolerances (rms), the nearest of {:.0f} mapped "
      "specimens of {} by {:.2f}.",
      f.number("model"), f.number("specimens"), counted_text(f.number("models"), "model"),
      f.number("nearest"));
  numbers += f.cells.empty() ? "" : fmt::format(" Without {}, which the maps lack.", cells_text(f.cells));
  if (f.advice == Advice::none) return numbers + " The maps show no nearer model.";
  const std::string &model = f.names.front(),
                    again = fmt::format("Another search ({}, packing.seed)", option_text("effort"));
  return numbers + fmt::format(" {} may come nearer.", f.advice == Advice::search_again ? again
                                                       : f.advice == Advice::search_again_by
                                                           ? again + " with " + model
                                                           : fmt::format("A model with {} (layers, {})",
                                                                         model, option_text("matrix")));
}

std::string value_open(F f) {
  const Property p = property_of(f);
  const std::string text =
      fmt::format("not decided; an error of {} is not excluded.", miss_text(p, f.number("bound")));
  return !f.has("specimens") ? text
                             : text + fmt::format(" With {} it would be below {}.",
                                                  counted_text(f.number("specimens"), "more specimen"),
                                                  miss_text(p, f.number("coarsest")));
}

std::string values_judged(F f) {
  const double met = f.number("met"), values = f.number("values");
  if (values == 1.0)
    return fmt::format("the one value is {}.", met > 0.0                  ? "met"
                                               : f.number("missed") > 0.0 ? "missed"
                                               : f.number("open") > 0.0   ? "not decided"
                                                                          : "without an answer");
  std::string text = fmt::format("{} of {} {} met", met == 0.0 ? "none" : fmt::format("{:.0f}", met),
                                 counted_text(values, "value"), met <= 1.0 ? "is" : "are");
  const auto add = [&](const char* name, const char* word) {
    if (f.number(name) > 0.0)
      text += fmt::format(", {:.0f} {} {}", f.number(name), f.number(name) == 1.0 ? "is" : "are", word);
  };
  add("missed", "missed"), add("open", "not decided");
  text += ".";
  if (f.number("alone") > 0.0)
    text +=
        fmt::format(" Judged each by itself, {} {}; chance alone gives {} at most.",
                    counted_text(f.number("alone"), "value"), f.number("alone") == 1.0 ? "is off" : "are off",
                    f.number("by_chance") < 0.95 ? fmt::format("{:.1g}", f.number("by_chance"))
                                                 : fmt::format("about {:.0f}", f.number("by_chance")));
  return text;
}

/// "UCS at every angle of the table" where the finding has all its cells; of a lone one it says so.
std::string tests_text(F f) {
  const Cell& c = f.cells.front();
  const bool every = static_cast<double>(f.cells.size()) == f.number("of");
  if (every && f.cells.size() == 1 && std::isfinite(c.theta))
    return cells_text(f.cells) + ", its only value in the table";
  return every && f.cells.size() > 1 && std::isfinite(c.theta) ? test_text(c) + " at every angle of the table"
                                                               : cells_text(f.cells);
}

/// "UCS at 30 and 75 degrees, 11 to 13 % too high"
std::string tests_missed(F f) {
  double least = infinity, most = 0.0;
  bool low = false, high = false;
  for (const NamedNumber& q : f.numbers) {
    if (q.name != "miss") continue;
    (q.value < 0.0 ? low : high) = true;
    least = std::min(least, std::fabs(q.value)), most = std::max(most, std::fabs(q.value));
  }
  const bool absolute = measured(property_of(f)).absolute;
  const double unit = absolute ? 1.0 : 100.0;
  return fmt::format("{}, {}{} {}.", tests_text(f),
                     range_text(unit * least, unit * most,
                                absolute        ? "{:.2f}"
                                : most < 0.0995 ? "{:.1f}"
                                                : "{:.0f}"),
                     absolute ? "" : " %",
                     !high  ? "too low"
                     : !low ? "too high"
                            : "off");
}

std::string test_undetermined(F f) {
  const std::vector<std::string> open(f.names.begin() + 1, f.names.end());
  return f.names.front() + ": not determined by this table" +
         (open.empty() ? "" : " (" + list_text(open) + ")") + ".";
}

const std::vector<Wording> value_words = {
    {Kind::values_judged, values_judged},
    {Kind::value_missed,
     [](F f) { return fmt::format("{} is {}, {}.", cells_text(f.cells), both_text(f), miss_text(f)); }},
    {Kind::scatter_unstated,
     [](F f) {
       return fmt::format("The table does not show the scatter of {}: an error cannot be told from chance.",
                          list_text(f.names));
     }},
    {Kind::tests_met, [](F f) { return tests_text(f) + "."; }},
    {Kind::tests_alone,
     [](F f) {
       return fmt::format("{}, the only value of {} met.", cells_text(f.cells),
                          to_string(f.cells.front().property));
     }},
    {Kind::tests_missed, tests_missed},
    {Kind::tests_open, [](F f) { return tests_text(f) + ", not decided."; }},
    {Kind::tests_unanswered, [](F f) { return tests_text(f) + ", without an answer."; }},
    {Kind::test_determined, [](F f) { return f.names.front() + ", not in the table."; }},
    {Kind::test_undetermined, test_undetermined},
    {Kind::fit_unanswered,
     [](F) -> std::string {
       return "the model carries no load (`phyllite elastic` with calibrated.toml reports why).";
     },
     true},
    {Kind::value_unanswered, [](F) -> std::string { return "the model carries no load on unseen packings."; },
     true},
    {Kind::no_usable_peak,
     [](F f) { return fmt::format("no test on unseen packings has a usable peak ({}).", f.names.front()); },
     true},
    {Kind::search_unanswered,
     [](F) -> std::string { return "no test has a usable peak, so strengths were not fitted."; }, true},
    {Kind::value_open, value_open, true},
    {Kind::strengths_missed,
     [](F f) {
       return fmt::format("The strengths as a whole are {} off; the tables show the nearest model found.",
                          percent_text(f.number("rms")));
     }},
    {Kind::ratio_missed,
     [](F f) {
       return fmt::format("UCS/{}{} is {:.1f} in the table and {:.1f} in the nearest model.",
                          to_string(f.cells[1].property), at_text({f.cells[1].theta}), f.number("laboratory"),
                          f.number("model"));
     }},
    {Kind::parameter_at_edge,
     [](F f) {
       return fmt::format("{} lies at the end of its admissible range ({:.4g}).", f.names.front(),
                          f.number("value"));
     }},
    {Kind::nu_gave_way,
     [](F f) {
       return fmt::format("The fit prefers E to nu: with full weight on both, E was off by up to {}.",
                          percent_text(f.number("E_before")));
     }},
    {Kind::nearest_in_maps, nearest_in_maps},
    {Kind::next_step, [](F f) { return "Next: " + text(f.advice, f) + "."; }},
    {Kind::stopped, [](F) -> std::string { return "Stopped by the user; finished tests are in the store."; }},
};

const std::vector<Wording> cause_words = {
    {Kind::unanswered, [](F f) { return "The model has no answer for " + cells_text(f.cells) + "."; }},
    {Kind::nu_of_no_body,
     [](F f) {
       return fmt::format(
           "nu(90)/nu(0) is {:.2f} in the table; in a layered elastic body it equals E(90)/E(0), {:.2f}.",
           f.number("nu"), f.number("E"));
     }},
    {Kind::grains_for_nu,
     [](F f) {
       return fmt::format(
           "{} is off by up to {:.3f} on {:.0f} grains. With moduli fitted anew on {:.0f} smaller ones it is "
           "off by "
           "{:.3f}.",
           cells_text(f.cells), f.number("miss"), f.number("grains"), f.number("finer"),
           f.number("miss_finer"));
     }},
    {Kind::stiffening,
     [](F f) {
       return fmt::format(
           "Under confining stress E changes by {:+.0f} % in the table and by {:+.0f} % in the model, mean "
           "over "
           "the angles. Pressure closes cracks of the rock; the model has none at first.",
           100.0 * f.number("laboratory"), 100.0 * f.number("model"));
     }},
    {Kind::moduli_scaled,
     [](F f) { return fmt::format("E as a whole is {:.2f} times E of the table.", f.number("factor")); }},
    {Kind::modulus_ratio, [](F f) { return ends_ratio(f, "E(90)/E(0)"); }},
    {Kind::weakest_angle, weakest},
    {Kind::weakest_angle_no_plane,
     [](F f) { return weakest(f) + " No single weak plane is weakest there."; }},
    {Kind::ucs_ratio, [](F f) { return ends_ratio(f, "UCS(0)/UCS(90)"); }},
    {Kind::tension_ratio, tension_ratio},
    {Kind::expected_in_maps, expected_in_maps},
    {Kind::initiation_ratio, [](F f) { return ranges(f, "sigma_ci/UCS", "{:.2f}"); }},
    {Kind::grains_for_toughness,
     [](F f) {
       return fmt::format(
           "K_Ic as a whole is {:.2f} times K_Ic of the table; it grows with the root of the grain size.",
           f.number("factor"));
     }},
    {Kind::scattered_packings,
     [](F f) {
       return fmt::format(
           "Packings of this grain size differ by {} from each other; the model misses the table by {}.",
           percent_text(f.number("sd")), percent_text(f.number("miss")));
     }},
    {Kind::farthest_value, farthest_value},
    {Kind::strengths_of_recipe,
     [](F) -> std::string { return "strengths, which are the recipe's, not the rock's."; }},
    {Kind::gap_in_ucs,
     [](F f) {
       return fmt::format("No UCS was measured between {:g} and {:g} degrees.", f.number("from"),
                          f.number("to"));
     }},
};

}  // namespace

std::string both_text(const Finding& f) {
  return fmt::format("{} in the model and {} in the table", value_text(property_of(f), f.number("model")),
                     value_text(property_of(f), f.number("laboratory")));
}

const std::vector<Wording>& words_of_calibration() {
  static const std::vector<Wording> all = [] {
    std::vector<Wording> list;
    for (const auto* part : {&value_words, &cause_words}) list.insert(list.end(), part->begin(), part->end());
    return list;
  }();
  return all;
}

}  // namespace phy::report
