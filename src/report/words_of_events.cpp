#include "report/words_of_events.hpp"

#include <fmt/format.h>

#include <cmath>

namespace phy::report {

std::string text_of_b_value(double b, double half_width, double thickness) {
  const std::string of = fmt::format("Magnitudes are of a thickness of {:.3g} mm.", 1e3 * thickness);
  if (!std::isfinite(b)) return "Too few events give no b-value. " + of;
  return fmt::format("b = {:.2f} ± {:.2f} (95 %). {}", b, half_width, of);
}

std::string text_of_counts(double difference, double part) {
  if (!std::isfinite(difference))
    return "The counts cannot be compared: one curve has no peak, or no event before it.";
  return fmt::format(
      "The counts differ most at {:.0f} % of the strain at the peak: the model is {:.0f} % of "
      "all events {}.",
      100.0 * part, 100.0 * std::fabs(difference), difference > 0.0 ? "ahead" : "behind");
}

}  // namespace phy::report
