// Which program this is, as everything that it writes says.
#pragma once

namespace phy {

/// "X.Y.Z"; of a build between two releases "X.Y.Z-dev+COMMIT", and ".changed" where files differ from it.
extern const char* const version;

/// "phyllite " and the version.
extern const char* const program;

}  // namespace phy
