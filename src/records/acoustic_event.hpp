// An acoustic event of a test: cracks that form together, and what they do to the rock around them.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/vec.hpp"

namespace phy {

/// Symmetric moment tensor in the plane, per metre of thickness [N m per m]. Forces that the source puts on
/// the rock around it count: opening is positive.
struct MomentTensor {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

/// By the share of its change of volume (Feignier & Young 1992).
enum class SourceType : std::uint8_t { implosion, shear, opening };
constexpr SourceType all_source_types[] = {SourceType::implosion, SourceType::shear, SourceType::opening};
const char* to_string(SourceType type);
/// The type of that name; nothing: there is none.
std::optional<SourceType> source_type_of(std::string_view name);

struct AcousticEvent {
  double time = 0.0;      ///< of its first crack [s]
  double strain = 0.0;    ///< axial_strain of the history then
  double duration = 0.0;  ///< from its first to its last crack [s]
  std::int64_t n_cracks = 0;
  Vec2 position;              ///< mean of its cracks [m]
  MomentTensor tensor;        ///< the largest by its moment while the event lasts
  double moment = 0.0;        ///< scalar moment per metre of thickness [N m per m]
  double thickness = 0.0;     ///< that the magnitude is of [m]
  double magnitude = 0.0;     ///< 2/3 log10(moment thickness / N m) - 6
  double volume_share = 0.0;  ///< R of Feignier & Young [%], -100 implosion ... 100 explosion
  SourceType type = SourceType::shear;
  double energy = 0.0;  ///< strain energy that its cracks have released [J per m thickness]
};

}  // namespace phy
