// What a picture of a test needs: discs, how they moved, and the forces between them at a few moments. Kept
// beside the numbers of every result (scene.bin), with the rounding that io/scene.hpp states.
#pragma once
#include <cstdint>
#include <vector>

#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy {

/// Two discs that touched, or were bonded, in at least one of the moments.
struct SceneLink {
  std::uint32_t a = 0, b = 0;  ///< disc numbers, a < b
  ContactKind kind = ContactKind::touching;
};

/// Normal forces of all links at one moment.
struct ForceField {
  double step = 0.0;
  double axial_strain = 0.0, axial_stress = 0.0;  ///< [1], [Pa]
  std::vector<float> F_n;                         ///< compression positive [N/m], in the order of the links
};

struct Scene {
  double width = 0.0, height = 0.0;  ///< of the packing [m]
  std::vector<Disc> discs;
  std::vector<Frame> frames;     ///< ordered by step
  std::vector<SceneLink> links;  ///< ordered by (a, b)
  std::vector<ForceField> forces;
};

/// Scene of a finished test.
Scene scene_of(const Packing& packing, const TestResult& result);

}  // namespace phy
