// Directions as laboratories write them: "parallel to bedding", "⊥", V and H, "30°".
#pragma once
#include <optional>
#include <string>

namespace phy::rock {

/// The inclination that words of a cell below a header mean [deg]: 90 where the layers are parallel to the
/// load, 0 where they are perpendicular. V and H say it of the layers, or of the axis of a plug in layers
/// that lie flat; nothing where the header does not say which.
std::optional<double> direction_in_words(const std::string& cell, const std::string& header);
/// A cell without its degree sign, "30°"; nothing where it has none.
std::optional<std::string> without_degree_sign(const std::string& cell);

}  // namespace phy::rock
