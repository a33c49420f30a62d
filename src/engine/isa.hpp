// What this processor can run.
#pragma once
#include <vector>

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
/// Numbers of lanes that a group may have: 1, and from what is worth it to a register full, 2, 4, 8 doubles
/// or 4, 8, 16 floats. More registers than one would be slower than more groups.
template <class T>
std::vector<int> lanes_of(Isa isa);

}  // namespace phy::engine
