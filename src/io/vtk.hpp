// Files for ParaView, written without the VTK library: .vtp (XML with raw appended data) and .pvd (time
// series). Positions are the present ones [m]. Bytes are little-endian, as everywhere this program runs.
// docs/formats.md.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::io {

/// Grains as points: radius, displacement, rotation.
std::string grains_vtp(const Packing& packing, const Snapshot& shot);
/// Contacts as lines between centres: F_n, F_s, kind, broken.
std::string contacts_vtp(const Packing& packing, const Snapshot& shot);
/// Cracks as segments across their normal: mode, place, strain (direct shear: displacement), energy.
std::string cracks_vtp(const std::vector<CrackEvent>& cracks, TestKind kind);
/// Acoustic events with a moment as points: magnitude, moment, volume share, type, cracks, strain, tensor.
std::string events_vtp(const std::vector<AcousticEvent>& events, TestKind kind);
/// Collection of files over axial strain (direct shear: displacement).
std::string collection_pvd(const std::vector<std::pair<double, std::string>>& files);

}  // namespace phy::io
