// The source of an acoustic event as numbers: moment, magnitude, share of the change of volume, type.
//
// A model in the plane is a slice. Its tensor is one of forces per metre of thickness, so a moment is one per
// metre as well, and a magnitude needs a thickness. The third principal moment, across the plane, is unknown
// and counts as zero; means of the tensor are over two directions.
#pragma once
#include <array>

#include "records/acoustic_event.hpp"

namespace phy::events {

/// Principal moments, the larger first.
std::array<double, 2> principal_moments(const MomentTensor& tensor);
/// sqrt((m1^2 + m2^2) / 2): that of a double couple +-m is m (of contact forces Zhao et al. 2021).
double scalar_moment(const MomentTensor& tensor);
/// 2/3 log10(M0 / N m) - 6 (Hanks & Kanamori 1979). `moment` is in N m. -infinity: no moment.
double magnitude_of(double moment);
/// R = 100 tr / (|tr| + |m1*| + |m2*|) [%], m* without the mean (Feignier & Young 1992). 0: no moment.
double volume_share(const MomentTensor& tensor);
/// Implosion below -30 %, opening above 30 % (Feignier & Young 1992).
SourceType type_of(double volume_share);
/// All of these from tensor and thickness.
void describe(AcousticEvent& event);

}  // namespace phy::events
