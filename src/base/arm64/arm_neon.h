// Stands before the compiler's <arm_neon.h> for 64-bit ARM (CMakeLists.txt). Eigen multiplies and adds at once
// there, by name, whatever -ffp-contract says; in two operations its sums are those of SSE2, bit for bit.
#pragma once
#include_next <arm_neon.h>
#define vfmaq_f64(sum, a, b) vaddq_f64(sum, vmulq_f64(a, b))
#define vfmaq_n_f64(sum, a, b) vaddq_f64(sum, vmulq_n_f64(a, b))
#define vfmaq_laneq_f64(sum, a, b, lane) vaddq_f64(sum, vmulq_laneq_f64(a, b, lane))
// Its products then have wider blocks too, and sums in another order. Eigen takes this file in before them,
// where users may add functors.
#define EIGEN_FUNCTORS_PLUGIN "base/arm64/eigen_blocks.hpp"
