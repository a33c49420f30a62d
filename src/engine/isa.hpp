// What this processor can run.
#pragma once
#include <vector>

#include "records/recipe.hpp"

namespace phy::engine {

/// Instruction sets in rising order; the hot loop is built for each.
enum class Isa { sse2, avx2, avx512 };

const char* to_string(Isa isa);
/// The best instruction set of this processor. PHYLLITE_ISA=sse2|avx2|avx512 in the environment lowers it.
/// Throws InputError: another word there.
Isa native_isa();
/// Lanes that fill a register: 2, 4, 8 doubles or 4, 8, 16 floats.
int native_lanes(Precision precision, Isa isa);
/// Numbers of lanes that a group may have: 1, and what is worth it up to native_lanes(), rising. More
/// registers than one would be slower than more groups.
std::vector<int> lanes_of(Precision precision, Isa isa);

}  // namespace phy::engine
