// How a front end uses the machine.
#pragma once
#include "study/work.hpp"

namespace phy::jobs {

/// As many threads as asked for; 0: all cores that this process may use.
int n_threads(int asked);

/// Those threads with the widest instructions of this processor.
study::MachineOptions machine_of(int asked_threads);

}  // namespace phy::jobs
