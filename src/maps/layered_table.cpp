#include "maps/layered_table.hpp"

namespace phy::maps {

theory::Eq1Fit eq1_through(const Evidence& evidence) {
  std::vector<theory::ModulusReading> readings;
  for (const Target& t : of_property(least_confined(evidence.moduli), Property::E))
    readings.push_back({t.theta, t.mean});
  theory::Eq1Options options;
  options.reference = theory::Eq1Reference::free;
  return theory::fit_eq1(readings, options);
}

std::vector<theory::LayeredReading> layered_readings(const std::vector<Target>& targets) {
  std::vector<theory::LayeredReading> readings;
  for (const Target& t : least_confined(targets))
    if (!is_strength(t.property))
      readings.push_back({t.theta, t.property == Property::E, t.mean, counted_error(t)});
  return readings;
}

}  // namespace phy::maps
