#include "events/source.hpp"

#include <cmath>

#include "base/exact_math.hpp"

namespace phy::events {
namespace {

constexpr double ln_10 = 2.302585092994045684;
constexpr double mostly_volume = 30.0;  // [%] beyond it the source is one of volume

}  // namespace

std::array<double, 2> principal_moments(const MomentTensor& m) {
  const double mean = 0.5 * (m.xx + m.yy), half = 0.5 * (m.xx - m.yy);
  const double radius = std::sqrt(half * half + m.xy * m.xy);
  return {mean + radius, mean - radius};
}

double scalar_moment(const MomentTensor& tensor) {
  const auto [m1, m2] = principal_moments(tensor);
  return std::sqrt(0.5 * (m1 * m1 + m2 * m2));
}

double magnitude_of(double moment) {
  return moment > 0.0 ? 2.0 / 3.0 * (exact_log(moment) / ln_10) - 6.0 : -HUGE_VAL;
}

double volume_share(const MomentTensor& tensor) {
  const auto [m1, m2] = principal_moments(tensor);
  // Of two directions, as the third moment is unknown: a third of the trace would mix it in as zero.
  const double trace = m1 + m2, mean = 0.5 * trace;
  const double all = std::fabs(trace) + std::fabs(m1 - mean) + std::fabs(m2 - mean);
  return all > 0.0 ? 100.0 * trace / all : 0.0;
}

SourceType type_of(double share) {
  return share > mostly_volume    ? SourceType::opening
         : share < -mostly_volume ? SourceType::implosion
                                  : SourceType::shear;
}

void describe(AcousticEvent& event) {
  event.moment = scalar_moment(event.tensor);
  event.magnitude = magnitude_of(event.moment * event.thickness);
  event.volume_share = volume_share(event.tensor);
  event.type = type_of(event.volume_share);
}

}  // namespace phy::events
