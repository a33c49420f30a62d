// The words of acoustic events.
#pragma once
#include <string>

#include "events/counts.hpp"

namespace phy::report {

/// The b-value with its interval, and the thickness that magnitudes are of. NaN: too few events.
std::string text_of_b_value(double b, double half_width, double thickness, bool trusted);
/// How the counts of a laboratory run beside ours, or why they cannot be compared.
std::string text_of_counts(const events::CountsCompared& c);

}  // namespace phy::report
