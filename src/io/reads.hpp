// For a process that does one job after another: what the earlier ones have read, results of their own among
// it, is no input of the next.
#pragma once

namespace phy::io {

/// was_read() (io/file.hpp) counts from here on.
void forget_reads();

}  // namespace phy::io
