#include "report/words_of_events.hpp"

#include <fmt/format.h>

#include <cmath>

namespace phy::report {

std::string text_of_b_value(double b, double half_width, double thickness, bool trusted) {
  const std::string of = fmt::format("Magnitudes are of a thickness of {:.3g} mm.", 1e3 * thickness);
  if (!trusted) return "The test is untrusted: its b-value is not shown. " + of;
  if (!std::isfinite(b)) return "Too few events give no b-value. " + of;
  return fmt::format("b = {:.2f} ± {:.2f} (95 %). {}", b, half_width, of);
}

std::string text_of_counts(const events::CountsCompared& c) {
  constexpr double alike = 0.005;  // shown as 0 %
  if (!c.peaks) return "The counts cannot be compared: there is no trusted peak to compare up to.";
  if (!std::isfinite(c.difference))
    return "The counts cannot be compared: one curve has none before its peak.";
  if (std::fabs(c.difference) < alike) return "The counts run alike up to the peak.";
  return fmt::format(
      "The counts differ most at {:.0f} % of the strain at the peak: the model is {:.0f} % of "
      "all events {}.",
      100.0 * c.part, 100.0 * std::fabs(c.difference), c.difference > 0.0 ? "ahead" : "behind");
}

}  // namespace phy::report
