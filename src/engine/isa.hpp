// What this processor can run.
#pragma once
#include <vector>

#include "records/recipe.hpp"

namespace phy::engine {

/// Instruction sets in rising order; the hot loop is built for each. Processors of another kind than x86-64
/// have the first, which is written in portable vectors of 16 bytes.
enum class Isa { sse2, avx2, avx512 };

/// Those that a processor of this kind can have, in the order of Isa.
std::vector<const char*> isa_names();
const char* to_string(Isa isa);
/// The widest that this processor has (processor_x86.cpp, processor_other.cpp).
Isa best_isa();
/// That one, unless it is lowered. PHYLLITE_ISA=sse2|avx2|avx512 in the environment lowers it.
/// Throws InputError: another word there.
Isa native_isa();
/// Lanes that fill a register: 2, 4, 8 doubles or 4, 8, 16 floats.
int native_lanes(Precision precision, Isa isa);
/// Numbers of lanes that a group may have: 1, and what is worth it up to native_lanes(), rising. More
/// registers than one would be slower than more groups.
std::vector<int> lanes_of(Precision precision, Isa isa);

}  // namespace phy::engine
