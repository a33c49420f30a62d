// How many small events come with a large one: log10 N = a - b M (Gutenberg & Richter).
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "base/nan.hpp"
#include "records/acoustic_event.hpp"
#include "records/result.hpp"

namespace phy::events {

/// Fewer events give no b-value.
constexpr std::size_t least_events = 30;

/// NaN where there are too few events.
struct BValue {
  double completeness = nan;  ///< magnitude from which on all events are counted
  std::size_t n = 0;          ///< events from there on
  double b = nan;             ///< log10(e) / (mean - completeness), most likely (Aki 1965)
  double error = nan;         ///< standard error (Shi & Bolt 1982)
  double half_width = nan;    ///< the 95 % interval is b +- half_width: the error times Student's t
};
BValue b_value(std::span<const double> magnitudes, double completeness);

/// The fullest bin of 0.1, counted from the largest magnitude, plus 0.2 (Wiemer & Wyss 2000; Woessner &
/// Wiemer 2005). NaN without events.
double completeness_of(std::span<const double> magnitudes);

/// Magnitudes of those that have one: an event may have no moment.
std::vector<double> magnitudes_of(std::span<const AcousticEvent> events);

/// n_events events_opening events_shear events_implosion largest_magnitude magnitude_of_completeness b_value
/// b_value_error b_value_half_width event_thickness.
std::vector<Number> event_numbers(std::span<const AcousticEvent> events, double thickness);

}  // namespace phy::events
