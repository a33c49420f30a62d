// What the verbs that run tests share: threads, instruction set, Ctrl-C and its like.
#pragma once
#include <atomic>
#include <functional>
#include <string>

#include "cli/commands.hpp"
#include "records/recipe.hpp"
#include "study/mpi.hpp"
#include "study/work.hpp"

namespace phy::cli {

/// --threads, or all cores that this process may use.
int n_threads(const Session& session);

/// Those threads with the widest instructions of this processor.
study::MachineOptions machine_of(const Session& session);

/// "0.050 m/s per platen", or with the fast approach before it.
std::string speed_words(const TestRecipe& test);

/// From the first call on, the first Ctrl-C, SIGTERM or SIGHUP sets the flag that is returned and a second
/// one ends at once: what is finished is on disk already. Verbs call it when they have read their input,
/// before they compute or write: until then a signal ends the program, however long a file keeps it.
const std::atomic<bool>* stop_on_interrupt();

/// The exit code of a verb. `mpi`: on all ranks of mpirun, of which rank 0 runs it and the others work for
/// it, read no file and print nothing; else without ranks.
int on_ranks(bool mpi, const Session& session, const std::function<int(const study::Ranks*)>& verb);

/// make_file of io/program.hpp; a Ctrl-C leaves nothing behind, and is told as an IoError.
void make_file_or_stop(const std::string& path,
                       const std::function<void(const std::string& temporary)>& make);

}  // namespace phy::cli
