// Which kernels this processor can run.
#pragma once
#include <string>

#include "contact/model.hpp"
#include "engine/advance_block.hpp"

namespace phy::engine {

/// Instruction sets in rising order; the hot loop is built for each.
enum class Isa { sse2, avx2, avx512 };

const char* to_string(Isa isa);
/// The best instruction set of this processor. PHYLLITE_ISA=sse2|avx2|avx512 in the environment lowers it.
/// Throws InputError: another word there.
Isa native_isa();
/// Lanes that fill a register: 2, 4, 8 doubles or 4, 8, 16 floats.
template <class T>
int native_lanes(Isa isa);
/// Contact models of a group with the force loops that were compiled for them, for 1, 2, 4, 8 lanes (double)
/// or 1, 4, 8, 16 (float). A specimen alone fills the register with its contacts (wide_loop.hpp), but in
/// double with SSE2, which is the scalar reference.
struct ContactPhysics {
  contact::Models models;
  Kernel<double> (*double_kernel)(Isa isa, int lanes);
  Kernel<float> (*float_kernel)(Isa isa, int lanes);
};
/// Those of a specimen with this matrix and bedding (contact/models.hpp).
const ContactPhysics& physics_of(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding);

}  // namespace phy::engine
