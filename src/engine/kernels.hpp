// The force loops that were compiled.
#pragma once
#include "contact/model.hpp"
#include "engine/advance_block.hpp"
#include "engine/isa.hpp"

namespace phy::engine {

/// Those of one instruction set: defined in group_isa.cpp, which is compiled once for each instruction set.
Kernel<double> double_kernel_sse2(std::size_t combination, int lanes);
Kernel<float> float_kernel_sse2(std::size_t combination, int lanes);
Kernel<double> double_kernel_avx2(std::size_t combination, int lanes);
Kernel<float> float_kernel_avx2(std::size_t combination, int lanes);
Kernel<double> double_kernel_avx512(std::size_t combination, int lanes);
Kernel<float> float_kernel_avx512(std::size_t combination, int lanes);

/// Contact models of a group with the force loops that were compiled for them, for one lane and for those of
/// lanes_of(). A specimen alone fills the register with its contacts (wide_loop.hpp), but in
/// double with SSE2, which is the scalar reference.
struct ContactPhysics {
  contact::Models models;
  Kernel<double> (*double_kernel)(Isa isa, int lanes);
  Kernel<float> (*float_kernel)(Isa isa, int lanes);
};
/// Those of a specimen with this matrix and bedding (contact/models.hpp).
const ContactPhysics& physics_of(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding);

}  // namespace phy::engine
