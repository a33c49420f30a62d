// The words of acoustic events.
#pragma once
#include <string>

namespace phy::report {

/// The b-value with its interval, and the thickness that magnitudes are of. NaN: too few events.
std::string text_of_b_value(double b, double half_width, double thickness);
/// How the counts of a laboratory run beside ours; `part` of the strain at the peak. NaN: they cannot be
/// compared.
std::string text_of_counts(double difference, double part);

}  // namespace phy::report
