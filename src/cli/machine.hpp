// What the verbs that run tests share: threads, instruction set, Ctrl-C, names of folders.
#pragma once
#include <atomic>
#include <string>

#include "cli/commands.hpp"
#include "study/scheduler.hpp"

namespace phy {

/// --threads, or all cores that this process may use.
int n_threads(const Session& session);

/// Those threads with the widest instructions of this processor.
MachineOptions machine_of(const Session& session);

/// From the first call on, the first Ctrl-C sets the flag that is returned and a second one ends at once:
/// what is finished is on disk already. Verbs call it before anything else.
const std::atomic<bool>* stop_on_interrupt();

/// The folder of a specimen or test, theta_45_deg of "theta = 45 deg": letters, digits, point and minus stay,
/// runs of anything else become one _.
std::string folder_name(const std::string& name);

}  // namespace phy
