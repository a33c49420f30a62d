// How heavy the grains are. No equilibrium depends on it, only the way there: a test that is pressed slowly
// has the same strength whatever its grains weigh, as long as the rock as a whole weighs the same.
//
// `equal` gives every grain the mean mass and a moment of inertia m r^2, that of a ring (a disc has half of
// it): the small grains, whose frequencies limit the time step, become heavier and the large ones lighter.
// With the closer bound of stable_step.hpp the step of the paper's specimen is a third longer. Waves that are
// longer than a few grains run as before. What it does to strengths: docs/decisions/0016.
#pragma once
#include <algorithm>
#include <cstddef>

#include "base/exact_math.hpp"
#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::engine {

class Inertia {
 public:
  Inertia(const Packing& packing, GrainInertia kind) : packing_(&packing), kind_(kind) {
    for (const Disc& d : packing.discs) mean_area_ += pi * d.r * d.r;
    mean_area_ /= static_cast<double>(std::max<std::size_t>(1, packing.discs.size()));
  }
  GrainInertia kind() const { return kind_; }
  /// Mass of a grain (packing number) per metre of thickness [kg/m].
  double mass(std::size_t grain, double density) const {
    const double r = packing_->discs[grain].r;
    return kind_ == GrainInertia::equal ? density * mean_area_ : density * pi * r * r;
  }
  /// The same over density [m^2].
  double area(std::size_t grain) const {
    const double r = packing_->discs[grain].r;
    return kind_ == GrainInertia::equal ? mean_area_ : pi * r * r;
  }
  /// m r^2 over the moment of inertia.
  double roundness() const { return kind_ == GrainInertia::equal ? 1.0 : 2.0; }

 private:
  const Packing* packing_;
  GrainInertia kind_;
  double mean_area_ = 0.0;
};

}  // namespace phy::engine
