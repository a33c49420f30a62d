#include "records/acoustic_event.hpp"

namespace phy {

const char* to_string(SourceType type) {
  switch (type) {
    case SourceType::implosion: return "implosion";
    case SourceType::shear: return "shear";
    default: return "opening";
  }
}

std::optional<SourceType> source_type_of(std::string_view name) {
  for (const SourceType type : all_source_types)
    if (name == to_string(type)) return type;
  return std::nullopt;
}

}  // namespace phy
