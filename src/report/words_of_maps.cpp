// What the maps of models say of a table before anything runs, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "report/words.hpp"

namespace phy::report {
namespace {

using F = const Finding&;
using Kind = FindingKind;

/// "E 1 to 7 %, nu 0.01 to 0.04": least and most of each property.
std::string errors_by_property(F f) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i + 1 < f.numbers.size(); i += 2) {
    const MeasuredProperty& p = *find_property(f.numbers[i].name);
    const double scale = p.absolute ? 1.0 : 100.0;
    items.push_back(fmt::format("{} {}{}", p.name,
                                range_text(scale * f.numbers[i].value, scale * f.numbers[i + 1].value,
                                           p.absolute ? "{:.2f}" : "{:.0f}"),
                                p.absolute ? "" : " %"));
  }
  return list_text(items);
}

std::string forecast(F f, const std::string& end) {
  return fmt::format("Forecast with {}: a calibration will probably {}. Expected errors (rms): {}.",
                     f.names.front(), end, errors_by_property(f));
}

std::string ratio(F f) {
  const Cell& c = f.cells.front();
  const std::string reached =  // names of models have commas of their own
      f.names.empty() ? "No mapped model reaches it."
      : f.number("models") == static_cast<double>(f.names.size())
          ? "Every mapped model reaches it."
          : fmt::format("Reached with: {}.", fmt::join(f.names, "; "));
  return fmt::format("UCS/{}{} is {:.1f} in the table; mapped specimens have {}. {}", to_string(c.property),
                     at_text({c.theta}), f.number("laboratory"),
                     range_text(f.number("low"), f.number("high"), "{:.1f}"), reached);
}

const std::vector<Wording> forecasts = {
    {Kind::forecast_calibrated, [](F f) { return forecast(f, "end calibrated, or with few exceptions"); }},
    {Kind::forecast_excepted,
     [](F f) {
       return forecast(f, f.cells.empty()
                              ? "miss some values of the table"
                              : "miss values of the table that contradict others: " + cells_text(f.cells));
     }},
    {Kind::forecast_unresolved,
     [](F f) { return forecast(f, "meet the table, with too few specimens to show it"); }},
    {Kind::forecast_out_of_reach, [](F f) { return forecast(f, "end out of reach"); }},
    {Kind::forecast_none,
     [](F) -> std::string { return "No forecast: no model was mapped for the tests of this table."; }},
    {Kind::forecast_missed, [](F f) { return "expected " + miss_text(f) + "."; }, true},
    {Kind::forecast_beyond_map,
     [](F) -> std::string {
       return "E lies where nothing was mapped, though planes in an isotropic rock have such E.";
     }},
    {Kind::forecast_unmapped,
     [](F) -> std::string { return "not in the forecast, because the maps lack this test."; }, true},
    {Kind::forecast_record,
     [](F f) {
       return fmt::format("No test has run. Of {:.0f} forecasts of synthetic rock {:.0f} {} wrong.",
                          f.number("of"), f.number("wrong"), f.number("wrong") == 1.0 ? "was" : "were");
     }},
    {Kind::forecast_on_rocks,
     [](F f) {
       return fmt::format(
           "Of {:.0f} errors of measured rocks {:.0f} came out in the expected range, {:.0f} below it.",
           f.number("of"), f.number("inside"), f.number("below"));
     }},
    {Kind::forecast_untried,
     [](F f) {
       return fmt::format("No test has run. Forecasts with {} have not been compared with known ends.",
                          f.names.front());
     }},
};

}  // namespace

const std::vector<Wording>& words_of_maps() {
  static const std::vector<Wording> list = [] {
    std::vector<Wording> all = {
        {Kind::map_nearest,
         [](F f) {
           return fmt::format(
               "Of {:.0f} mapped specimens with {} the nearest misses the table by {} (rms, "
               "its moduli and its strengths scaled to the table).",
               f.number("specimens"), f.names.front(), percent_text(f.number("error")));
         }},
        {Kind::map_ratio, ratio},
        {Kind::map_expected,
         [](F f) {
           const Property p = f.cells.front().property;
           return fmt::format("the maps expect {} of this model, where the table has {}.",
                              value_text(p, f.number("model")), value_text(p, f.number("laboratory")));
         },
         true},
    };
    all.insert(all.end(), forecasts.begin(), forecasts.end());
    return all;
  }();
  return list;
}

}  // namespace phy::report
