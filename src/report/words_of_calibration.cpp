// What a calibration finds, in words.
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

/// Options as the command line spells them: files are the same whoever calibrates.
std::string option(const std::string& word) { return "--" + word; }
std::string option_set(const std::string& word, const std::string& value) {
  return option(word) + " " + value;
}

Property property_of(F f) { return f.cells.front().property; }

/// Model and laboratory in the unit of the cell.
std::string both(F f) {
  return fmt::format("{} in the model and {} in the table", value_text(property_of(f), f.number("model")),
                     value_text(property_of(f), f.number("laboratory")));
}

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
  return fmt::format("{} is {}, {}. The maps expect it of this model: {}.", cells_text(f.cells), both(f),
                     miss_text(f), expected_text(f));
}

/// With what was ruled out, where no cause was found.
std::string farthest_value(F f) {
  const std::string text = fmt::format("Farthest off is {}, {}.", cells_text(f.cells), both(f));
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
                    again = fmt::format("Another search ({}, packing.seed)", option("effort"));
  return numbers + fmt::format(" {} may come nearer.",
                               f.advice == Advice::search_again ? again
                               : f.advice == Advice::search_again_by
                                   ? again + " with " + model
                                   : fmt::format("A model with {} (layers, {})", model, option("matrix")));
}

/// Of a model that was calibrated, and what it came to.
std::string model_tried(F f) {
  const std::string result =
      f.number("unanswered") > 0.0
          ? counted_text(f.number("unanswered"), "value") + " without an answer"
          : fmt::format("{:.2g} tolerances off on unseen packings (rms)", f.number("tolerances"));
  return fmt::format("Calibrated with {}: {}, {}.", f.names.front(),
                     f.number("reached") > 0.0 ? "within reach" : "out of reach", result);
}

/// How a user asks for a rival model, by the last two names.
std::string options_of_rival(F f) {
  std::vector<std::string> options;
  if (const std::string& layers = f.names[2]; !layers.empty())
    options.push_back(
        fmt::format("layers = \"{}\" in the rock file{}", layers,
                    layers == to_string(LayerModel::directions) ? " (without bedding.spacing)" : ""));
  if (const std::string& matrix = f.names[3]; !matrix.empty())
    options.push_back(option_set("matrix", matrix));
  return list_text(options);
}

std::string rival_model(F f) {
  return fmt::format(
      "{} may do as well: before any test it missed the table by {}, {} with {}. To try it, take "
      "a new folder and {}.",
      f.names[0], percent_text(f.number("error")), percent_text(f.number("taken_error")), f.names[1],
      options_of_rival(f));
}

/// What would have allowed all points of a usual search.
std::string options_of_search(F f) {
  std::vector<std::string> options;
  if (f.number("of_effort") > 0.0) options.push_back(option_set("effort", "normal"));
  if (f.number("of_tests") > 0.0) options.push_back("a larger " + option("max-tests"));
  return list_text(options);
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

/// "UCS at every angle of the table" where the finding has all its cells.
std::string tests_text(F f) {
  const Cell& c = f.cells.front();
  const bool every = static_cast<double>(f.cells.size()) == f.number("of");
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

std::string toughness_grains(F f) {
  std::string text = fmt::format(
      "At the same strengths grain_size = \"{:.2g} mm\" in the rock file would meet K_Ic. The specimen then "
      "has "
      "some {:.0f} grains, {:.0f} in the radius of the half disc.",
      f.number("wanted") * 1e3, f.number("grains"), f.number("in_radius"));
  if (f.number("in_radius") < f.number("fewest"))
    text += fmt::format(" With fewer than {:g}, K_Ic comes out too small, and larger grains meet it.",
                        f.number("fewest"));
  return text;
}

std::string unsettled(const std::string& why) {
  return "The estimate of the strengths had not settled when the search ended: " + why + ".";
}

const std::vector<Wording> value_words = {
    {Kind::values_judged, values_judged},
    {Kind::value_missed,
     [](F f) { return fmt::format("{} is {}, {}.", cells_text(f.cells), both(f), miss_text(f)); }},
    {Kind::scatter_unstated,
     [](F f) {
       return fmt::format("The table states no scatter of {}: an error cannot be told from chance.",
                          list_text(f.names));
     }},
    {Kind::tests_met, [](F f) { return tests_text(f) + "."; }},
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
     [](F) -> std::string { return "strengths, which are those of the recipe, not of the rock."; }},
    {Kind::gap_in_ucs,
     [](F f) {
       return fmt::format("No UCS was measured between {:g} and {:g} degrees.", f.number("from"),
                          f.number("to"));
     }},
};

const std::vector<Wording> model_words = {
    {Kind::model_expected,
     [](F f) {
       std::vector<std::string> items;
       if (f.has("E")) items.push_back("E fitted to " + percent_text(f.number("E")));
       if (f.has("strengths"))
         items.push_back("strengths left out predicted to " + percent_text(f.number("strengths")));
       return fmt::format("Before any test, with {}: {}.", f.names.front(), list_text(items));
     }},
    {Kind::model_taken,
     [](F f) { return "Expected to do best, by the maps and before any test: " + f.names.front() + "."; }},
    {Kind::models_miss_modulus,
     [](F f) {
       return fmt::format("Models that miss E by more than {} are passed over.",
                          percent_text(f.number("limit")));
     }},
    {Kind::nested_models_stay,
     [](F f) {
       return fmt::format(
           "A model that contains whole planes is taken only if it misses less than {:g} of what they miss.",
           f.number("gain"));
     }},
    {Kind::flat_joints_rule,
     [](F f) {
       return fmt::format(
           "Flat joints are taken only if they alone are expected to meet the table. Where nothing is, they "
           "must "
           "miss less than {:g} of what others miss.",
           f.number("gain"));
     }},
    {Kind::model_without_rivals,
     [](F f) { return "A sequence compares no models; taken: " + f.names.front() + "."; }},
    {Kind::share_assumed,
     [](F f) {
       return fmt::format(
           "Joints on {:g} of the planes are assumed. A share is chosen where the table has four strengths "
           "without confinement, UCS among them.",
           f.number("share"));
     }},
    {Kind::share_interval,
     [](F f) {
       return fmt::format(
           "Joints lie on {:g} of the planes, {:g} to {:g} (95 %). Shares outside miss E, miss the table by "
           "{:g} times as much, or were not compared. All other numbers are of {:g}.",
           f.number("share"), f.number("low"), f.number("high"), f.number("factor"), f.number("share"));
     }},
    {Kind::model_tried, model_tried},
    {Kind::model_interrupted,
     [](F f) { return "The calibration with " + f.names.front() + " was interrupted."; }},
    {Kind::model_kept, [](F f) { return "Kept: " + f.names.front() + "."; }},
    {Kind::rival_model, rival_model},
    {Kind::no_modulus,
     [](F) -> std::string { return "The table has no E: the elastic parameters are those of the recipe."; }},
    {Kind::moduli_at_small_strain,
     [](F f) {
       return fmt::format(
           "E and nu are compared at small strain: without {} nothing shows how far a test softens "
           "(E_is = \"{}\").",
           f.names[1], f.names[0]);
     }},
    {Kind::elastic_only,
     [](F) -> std::string {
       return "The elastic part only: the strengths are those of the recipe, not calibrated.";
     }},
    {Kind::no_ucs,
     [](F) -> std::string {
       return "The table has no UCS: the strengths are those of the recipe, not calibrated.";
     }},
    {Kind::no_compression,
     [](F) -> std::string {
       return "The table has no strength in compression: the strengths are those of the recipe, not "
              "calibrated.";
     }},
    {Kind::intervals_withdrawn,
     [](F) -> std::string {
       return "The model is out of reach: intervals of the rock that exclude the measured value are left "
              "out.";
     }},
};

const std::vector<Wording> test_words = {
    {Kind::cracks_off_centre,
     [](F f) {
       return fmt::format(
           "in {:.0f} of {} on unseen packings the first crack lies outside the central third of the disc. "
           "Peak loads are compared all the same.",
           f.number("tests"), counted_text(f.number("of"), "test"));
     },
     true},
    {Kind::peaks_missing,
     [](F f) {
       return fmt::format("{:.0f} of {} on unseen packings gave no usable peak ({}).", f.number("tests"),
                          counted_text(f.number("of"), "test"), f.names.front());
     },
     true},
    {Kind::tests_marked,
     [](F f) {
       const auto limit = std::ranges::find_if(
           quality_limits(), [&](const QualityLimit& q) { return f.names.front() == q.number; });
       return fmt::format("A warning of {:.0f} of {} on unseen packings: {}.", f.number("tests"),
                          counted_text(f.number("of"), "test"),
                          limit != quality_limits().end() ? limit->says : f.names.front());
     }},
    {Kind::tests_unmarked,
     [](F f) {
       return fmt::format(
           "{:.0f} of {} on unseen packings come from an older version, without this assessment.",
           f.number("tests"), counted_text(f.number("of"), "test"));
     }},
    {Kind::tests_change_modulus,
     [](F f) {
       return fmt::format(
           "E and nu of the table are read at small strain (E_is). At half of UCS the tests measure E "
           "{:+.0f} "
           "% in the mean over the angles.",
           100.0 * f.number("change"));
     }},
    {Kind::modulus_without_test,
     [](F) -> std::string {
       return "no strength of the same test to read it with; the nearest tests of the table stand in.";
     },
     true},
    {Kind::packings_wanted,
     [](F) {
       return "Strengths of packings of this size differ much: a larger " + option("max-tests") +
              " takes more unseen ones.";
     }},
    {Kind::packings_added,
     [](F f) {
       return fmt::format(
           "Strengths of packings of this size differ so much that {:.0f} unseen ones were taken instead of "
           "{:.0f}.",
           f.number("packings"), f.number("usual"));
     }},
    {Kind::toughness_compared,
     [](F f) {
       return fmt::format("{} is compared, not fitted, with grains of {:.3g} mm: {}.", cells_text(f.cells),
                          f.number("grain_size") * 1e3,
                          std::isfinite(f.number("model")) ? both(f) + ", " + miss_text(f) : "no answer");
     }},
    {Kind::toughness_grains, toughness_grains},
    {Kind::toughness_grains_unfit,
     [](F f) {
       return fmt::format(
           "At the same strengths K_Ic asks for grains of {:.2g} mm, too {} for this specimen.",
           f.number("wanted") * 1e3, f.number("wanted") > f.number("grain_size") ? "large" : "many");
     }},
};

const std::vector<Wording> search_words = {
    {Kind::search_short,
     [](F f) {
       const std::string text = fmt::format(
           "The search was short ({} in compression{}){}", counted_text(f.number("tests"), "test"),
           f.number("models") > 1.0 ? " by " + counted_text(f.number("models"), "model") : std::string(),
           f.number("foreseen") > 0.0 ? ": the forecast saw the table out of reach" : "");
       const std::string more = f.number("more") > 0.0 ? fmt::format(" With {} it takes about {:.0f} more.",
                                                                     options_of_search(f), f.number("more"))
                                                       : std::string();
       return text + (f.advice == Advice::none ? "." : ", and its estimate had not settled.") + more;
     }},
    {Kind::search_cut,
     [](F f) {
       return fmt::format("{} paid for {:.0f} of the {:.0f} points of a {} search.", option("max-tests"),
                          f.number("paid"), f.number("points"), f.names.front());
     }},
    {Kind::draws_rough,
     [](F f) {
       return fmt::format(
           "The {:.0f} draws behind the intervals of the strengths are worth {:.0f} independent ones (R-hat "
           "{:.2f}): the ends are rough.",
           f.number("draws"), f.number("effective"), f.number("r_hat"));
     }},
    {Kind::peaks_left_out,
     [](F f) {
       return fmt::format("Left out, for want of a usable peak: {:.0f} of {} of the search.",
                          f.number("tests"), counted_text(f.number("of"), "test"));
     }},
    {Kind::unsettled_tests,
     [](F f) {
       return unsettled(
           fmt::format("tests there were {:.1f} tolerances off the prediction", f.number("tolerances")));
     }},
    {Kind::unsettled_known,
     [](F f) {
       return unsettled(
           fmt::format("its strengths are known to {:.1f} tolerances only", f.number("tolerances")));
     }},
    {Kind::unsettled_moved,
     [](F) { return unsettled("it moved to where less is known than where it was tried"); }},
    {Kind::rounds_no_nearer,
     [](F f) {
       return fmt::format("The search ended after {:.0f} rounds: the last came no nearer to the table.",
                          f.number("rounds"));
     }},
    {Kind::eq1_refused,
     [](F f) {
       return fmt::format("Eq. 1 does not fit the table ({}): the joints are as stiff as is admissible.",
                          f.names.front());
     }},
    {Kind::eq2_line,
     [](F f) {
       return fmt::format(
           "Eq. 2 on these packings: K_{0} = {1:.4g} k_{0} {2:+.4g} GPa/m, R2 = {3:.5f}. By Eq. 1 through "
           "the "
           "table K_{0} = {4:.4g} GPa/m.",
           f.names.front(), f.number("slope"), f.number("intercept") * 1e-9, f.number("R2"),
           f.number("wanted") * 1e-9);
     }},
    {Kind::sequence_unsettled,
     [](F f) {
       return fmt::format("The strengths still moved in round {:.0f}, the last.", f.number("rounds"));
     }},
    {Kind::peaks_skipped,
     [](F f) {
       return fmt::format(
           "{:.0f} of {} of the search gave no usable peak: the strength was left at the best so far.",
           f.number("tests"), counted_text(f.number("of"), "test"));
     }},
    {Kind::step_missed,
     [](F f) {
       return fmt::format("{} could not be met within {} by {}.", cells_text(f.cells),
                          percent_text(f.number("limit")), f.names.front());
     }},
    {Kind::values_unused,
     [](F f) { return fmt::format("The sequence compares {} and does not use them.", cells_text(f.cells)); }},
};

double wanted(F of) { return of.number("wanted") * 1e3; }  // diameter of grains [mm]

struct AdviceWording {
  Advice advice;
  const char* text;  ///< nullptr: it depends on the finding
  std::string (*made)(F) = nullptr;
};
const std::vector<AdviceWording> advice_words = {
    {Advice::see_findings, "see the findings"},
    {Advice::resume, "the same command with --resume"},
    {Advice::calibrate_strengths, "calibrate with strengths"},
    {Advice::test_parameter, nullptr, [](F of) { return "determine " + of.names.front(); }},
    {Advice::fill_gap, "test specimens in that gap"},
    {Advice::state_scatter, nullptr,
     [](F of) {
       std::vector<std::string> columns;
       for (const std::string& name : of.names) columns.push_back(name + "_sd");
       columns.emplace_back("n");
       return fmt::format(
           "state the scatter of the specimens in the columns {} of the table, or test three specimens of "
           "each",
           list_text(columns));
     }},
    {Advice::more_specimens, nullptr, [](F of) { return "test more specimens of " + cells_text(of.cells); }},
    {Advice::smaller_grains, "take smaller grains (grain_size in the rock file, or the radii of its recipe)"},
    {Advice::check_value, nullptr,
     [](F of) { return "check " + cells_text(of.cells) + " in the table, or test more specimens there"; }},
    {Advice::check_nu, "check how nu was measured (it counts in the plane of load and dip), or leave it out"},
    {Advice::check_E_is, "check E_is, the part of the curve that E of the table is read from"},
    {Advice::check_angles,
     "check the angles of the table and E_is, the part of the curve that E is read from"},
    {Advice::check_initiation,
     "check how sigma_ci was read (by crack volumetric strain here), or leave it out"},
    {Advice::one_confinement,
     "set `confining` in the rock file to the stress that matters; E and nu under others are left "
     "out"},
    {Advice::without_sequence, nullptr,
     [](F) {
       return fmt::format("calibrate without {}: then all moduli are fitted together",
                          option_set("method", "sequence"));
     }},
    {Advice::choose_layers,
     "set layers = \"choose\" in a rock file whose recipe has no layers: other models are compared"},
    {Advice::take_where_met, "take the model only at angles where it meets the table"},
    {Advice::leave_out_ucs, "take UCS from the table: the models that were compared do not meet it"},
    {Advice::leave_out_tension, "leave the tensile strengths out if compression is what matters"},
    {Advice::leave_out_toughness, nullptr,
     [](F of) {
       return fmt::format("leave K_Ic out: it asks for grains of {:.2g} mm, which this specimen cannot hold",
                          wanted(of));
     }},
    {Advice::other_grains, nullptr,
     [](F of) {
       return fmt::format("take grains of {:.2g} mm in place of {:.2g} mm", wanted(of),
                          of.number("grain_size") * 1e3);
     }},
    {Advice::flat_joints, nullptr,
     [](F) {
       return "try " + option_set("matrix", "flat_joint") + ": flat joints break in tension at less of UCS";
     }},
    {Advice::slits, nullptr,
     [](F) { return "try " + option_set("matrix", "flat_joint") + ": slits let cracks begin early"; }},
    {Advice::other_layers, "try another model (layers)"},
    {Advice::other_layers_or_matrix, nullptr,
     [](F) { return fmt::format("try another model (layers, {})", option("matrix")); }},
    {Advice::try_rival, nullptr,
     [](F of) { return fmt::format("try {} in a new folder, with {}", of.names[0], options_of_rival(of)); }},
    {Advice::longer_search, nullptr, [](F of) { return "start a new folder with " + options_of_search(of); }},
    {Advice::search_again, nullptr,
     [](F) { return fmt::format("search again ({}, packing.seed)", option("effort")); }},
    {Advice::search_again_by, nullptr,
     [](F of) {
       return fmt::format("search again ({}, packing.seed) with {}", option("effort"), of.names.front());
     }},
    {Advice::try_model, nullptr,
     [](F of) { return fmt::format("try {} (layers, {})", of.names.front(), option("matrix")); }},
    {Advice::more_tests, nullptr, [](F) { return "take a larger " + option("max-tests"); }},
};

}  // namespace

const std::vector<Wording>& words_of_calibration() {
  static const std::vector<Wording> all = [] {
    std::vector<Wording> list;
    for (const auto* part : {&value_words, &cause_words, &model_words, &test_words, &search_words})
      list.insert(list.end(), part->begin(), part->end());
    return list;
  }();
  return all;
}

std::string text(Advice advice, F of) {
  for (const AdviceWording& w : advice_words)
    if (w.advice == advice) return w.text != nullptr ? w.text : w.made(of);
  return advice == Advice::none ? "" : advice_of_table(advice, of);
}

}  // namespace phy::report
