// Cohesion and friction of one plane of weakness from strengths at several inclinations: least squares of
// Jaeger's theory (theory/jaeger.hpp), with the strength of the matrix as a cap.
//
//   minimise sum (ucs_i - min(matrix, sigma_1(c, phi; theta_i)))^2,   0 <= c <= matrix/2, 0 <= phi <= 60
//
// The sum has kinks where a specimen changes between plane and matrix, and may have several minima: a grid
// over phi and c, then finer grids around the best point, each 0.12 times as wide. Rejected: Gauss-Newton,
// which stops at kinks. Flat shoulders are part of the theory; rock is rounder (docs/theory/strength.md), so
// a low R2 is a finding.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "theory/jaeger.hpp"

namespace phy::theory {

struct StrengthReading {
  double theta = 0.0;    ///< [deg]
  double ucs = 0.0;      ///< peak sigma_1 [Pa]
  double sigma_3 = 0.0;  ///< confining stress [Pa]
};

struct JaegerFit {
  bool ok = false;
  std::string reason;  ///< why not, empty when ok
  Coulomb plane;
  double matrix_ucs = 0.0;  ///< [Pa] unconfined, as given or as fitted
  double R2 = 0.0;          ///< 1 - sum of squares / sum (ucs - mean)^2; NaN when all strengths are equal
  /// Why the strengths have no plane: `reason`, or that cohesion or friction lies at the end of its range,
  /// where they pull beyond what a plane can have; "": there is one. Predictions may use a plane at a limit,
  /// findings may not.
  std::string no_plane() const;
};

/// Needs readings at three inclinations, one of them between 20 and 80 degrees, one weaker than the matrix,
/// and a positive matrix strength [Pa].
JaegerFit fit_jaeger(const std::vector<StrengthReading>& readings, double matrix_ucs);
/// The same over confining stresses too; `matrix` gives the peak sigma_1 [Pa] of the matrix at a sigma_3
/// [Pa].
JaegerFit fit_jaeger(const std::vector<StrengthReading>& readings,
                     const std::function<double(double)>& matrix);
/// Unconfined, with the strength of the matrix fitted too: three numbers, so readings at four inclinations.
/// For a friction angle the sum is a parabola in c and in the matrix once it is known which inclinations
/// slip, and these are the ones that slip most easily: all such choices over a grid of angles are tried.
JaegerFit fit_jaeger_and_matrix(const std::vector<StrengthReading>& readings);

}  // namespace phy::theory
