#include "events/b_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/stats.hpp"

namespace phy::events {
namespace {

constexpr double ln_10 = 2.302585092994045684;
constexpr double bins_per_unit = 10.0;  // of magnitudes
constexpr double beyond = 2.0;          // bins: the fullest one is not yet complete

}  // namespace

BValue b_value(std::span<const double> magnitudes, double completeness) {
  BValue found{completeness};
  double mean = 0.0, squares = 0.0;
  for (const double m : magnitudes)
    if (m >= completeness) ++found.n, mean += m;
  if (found.n < least_events) return found;
  const auto n = static_cast<double>(found.n);
  mean /= n;
  for (const double m : magnitudes)
    if (m >= completeness) squares += (m - mean) * (m - mean);
  // Magnitudes that are all alike tell no slope.
  if (!(mean > completeness)) return found;
  found.b = 1.0 / (ln_10 * (mean - completeness));
  found.error = ln_10 * found.b * found.b * std::sqrt(squares / (n * (n - 1.0)));
  found.half_width = student_t_95(found.n - 1) * found.error;
  return found;
}

double completeness_of(std::span<const double> magnitudes) {
  if (magnitudes.empty()) return nan;
  // Bins lie about the largest magnitude and not on a grid of their own: another thickness shifts all
  // magnitudes, and must not shift them into other bins.
  const double largest = *std::max_element(magnitudes.begin(), magnitudes.end());
  std::map<std::int64_t, std::size_t> bins;
  for (const double m : magnitudes) ++bins[std::llround((m - largest) * bins_per_unit)];
  // The first of equally full ones: fewer events are left out.
  const auto fullest = std::max_element(bins.begin(), bins.end(),
                                        [](const auto& p, const auto& q) { return p.second < q.second; });
  const double lower_edge = static_cast<double>(fullest->first) - 0.5;
  return largest + (lower_edge + beyond) / bins_per_unit;
}

std::vector<double> magnitudes_of(std::span<const AcousticEvent> events) {
  std::vector<double> all;
  for (const AcousticEvent& e : events)
    if (std::isfinite(e.magnitude)) all.push_back(e.magnitude);
  return all;
}

std::vector<Number> event_numbers(std::span<const AcousticEvent> events, double thickness) {
  const std::vector<double> magnitudes = magnitudes_of(events);
  const auto largest = std::max_element(magnitudes.begin(), magnitudes.end());
  // Small sources are as frequent as bonds are few: below the completeness no law is to be expected.
  const BValue b = b_value(magnitudes, completeness_of(magnitudes));
  const auto count = [&](SourceType type) {
    return static_cast<double>(
        std::count_if(events.begin(), events.end(), [&](const AcousticEvent& e) { return e.type == type; }));
  };
  const std::string few =
      std::isfinite(b.b) ? ""
                         : fmt::format("{} event{} from the magnitude of completeness on; at least {} give b",
                                       b.n, b.n == 1 ? "" : "s", least_events);
  return {{"n_events", static_cast<double>(events.size()), "1", "acoustic events: clusters of cracks", ""},
          {"events_opening", count(SourceType::opening), "1", "events with R > 30 %", ""},
          {"events_shear", count(SourceType::shear), "1", "events with R from -30 % to 30 %", ""},
          {"events_implosion", count(SourceType::implosion), "1", "events with R < -30 %", ""},
          {"largest_magnitude", largest == magnitudes.end() ? nan : *largest, "1",
           "largest 2/3 log10(M0 / N m) - 6, M0 of the thickness event_thickness",
           largest == magnitudes.end() ? "no event has a moment" : ""},
          {"magnitude_of_completeness", b.completeness, "1", "fullest bin of 0.1 of magnitudes, plus 0.2",
           magnitudes.empty() ? "no event has a moment" : ""},
          {"b_value", b.b, "1", "log10(e) / (mean magnitude - completeness), from completeness on", few},
          {"b_value_error", b.error, "1", "standard error of b_value after Shi and Bolt", few},
          {"b_value_half_width", b.half_width, "1", "half of the 95 % interval of b_value", few},
          {"event_thickness", thickness, "m", "thickness of the specimen that magnitudes are of", ""}};
}

}  // namespace phy::events
