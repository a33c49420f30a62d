// Scenes as bytes, version 1: a line of JSON, then one zlib stream. Small enough to travel
// inside a report: positions are rounded to 1/65000 of the specimen, displacements to 1/4 micrometre (or
// 1/32000 of the largest), forces to 127 steps of their square root.
//
// Grains move almost uniformly, so the second difference in time of a displacement is a few quanta. Numbers
// are stored zigzag (0, -1, 1, -2, ...) and byte plane by byte plane: the upper planes are zeros, which the
// compressor removes. Rejected: HDF5 (a browser cannot read it), VTK files (ten times the size).
//
// The header names the size of the specimen and of the uncompressed stream, the quanta of lengths and
// displacements, and per frame its step, strain and stress. `forces` adds `F_max [N/m]`, `sections` is the
// list of [count, planes] in the order of the stream, `lost` counts what blew up. The sections:
//   1. x, y, r of the discs (packing order), in disc quanta (1/65000 of the specimen)
//   2. per frame: second differences in time of all u_x, then all u_y, in displacement quanta (before: 0)
//   3. links, ordered by their discs: first disc minus the one of the link before, second disc minus first,
//      kind (0 touching, 1 bonded, 2 joint)
//   4. per force field, for every link: q with F_n = q |q| F_max / 127^2, compression positive
// Zigzag is (v << 1) ^ (v >> 31): first the lowest bytes of all, then the next, as many planes as said.
#pragma once
#include <string>
#include <string_view>

#include "records/scene.hpp"

namespace phy::io {

/// The kind of test says what frames and forces are filed under (TestDescription::loading_column).
std::string pack_scene(const Scene& scene, TestKind kind);
/// Throws InputError, naming `where`, when the bytes are no scene.
Scene unpack_scene(std::string_view bytes, const std::string& where);

}  // namespace phy::io
