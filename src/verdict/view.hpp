// The table beside the model as rules of the verdict see it: every cell as it is judged, on unseen packings
// where there are some, and which part of the table holds how much of the misfit.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "verdict/cells.hpp"

namespace phy::verdict {

constexpr double z_one_sided_95 = 1.64;  ///< standard errors
constexpr double least_change = 0.10;    ///< of a ratio of strengths, from where on it is another one

/// Standard errors of the logarithm of a mean: of the laboratory, of the model.
double error_of_laboratory(const Comparison& row);
double error_of_model(const Comparison& row);

/// A value at 90 over that at 0 degrees, of table and model, with the standard error of their logarithms.
struct EndRatio {
  double laboratory, model, error_of_laboratory, error_of_model;
  double error() const;
  double difference() const;
};

struct View {
  const Calibration& of;
  std::vector<JudgedCell> cells;
  std::array<double, n_parts> misfit = {};  ///< of each part: sums of squares

  explicit View(const Calibration& calibration);
  /// With an answer, by angle as they come.
  std::vector<Comparison> answered(Property property) const;
  const Comparison* at(Property property, double theta) const;
  std::vector<Target> strengths() const;  ///< of the table
  /// What the maps say of this cell; nullptr: nothing.
  const Finding* in_maps(FindingKind kind, const Target& target) const;
  /// Of a part the value farthest off; nullptr: none has an answer.
  const JudgedCell* farthest(Part part) const;
  /// Is one of its values missed by more than passes by itself?
  bool misses_some(Property property) const;
  bool meets_some(Property property) const;
  bool moduli_alone() const;
  double share(Part part) const;
  /// Under one stress; nothing: the table lacks one of the two.
  std::optional<EndRatio> end_ratio(Property property) const;
};

}  // namespace phy::verdict
