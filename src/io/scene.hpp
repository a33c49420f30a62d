// Scenes as bytes (docs/formats.md, "Scene"): a line of JSON, then one zlib stream. Small enough to travel
// inside a report: positions are rounded to 1/65000 of the specimen, displacements to 1/4 micrometre (or
// 1/32000 of the largest), forces to 127 steps of their square root.
//
// Grains move almost uniformly, so the second difference in time of a displacement is a few quanta. Numbers
// are stored zigzag (0, -1, 1, -2, ...) and byte plane by byte plane: the upper planes are zeros, which the
// compressor removes. Rejected: HDF5 (a browser cannot read it), VTK files (ten times the size).
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
