// Included first in every file for 64-bit ARM (CMakeLists.txt). Eigen multiplies and adds at once there, by
// name, whatever -ffp-contract says; in two operations its sums are those of SSE2, bit for bit.
#pragma once
#include <arm_neon.h>
#define vfmaq_f64(sum, a, b) vaddq_f64(sum, vmulq_f64(a, b))
#define vfmaq_n_f64(sum, a, b) vaddq_f64(sum, vmulq_n_f64(a, b))
#define vfmaq_laneq_f64(sum, a, b, lane) vaddq_f64(sum, vmulq_laneq_f64(a, b, lane))
