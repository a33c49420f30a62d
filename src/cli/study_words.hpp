// What `phyllite study` tells of a plan: before it runs, while it runs, and what did not succeed.
#pragma once
#include <string>

#include "cli/commands.hpp"
#include "study/effects.hpp"
#include "study/work.hpp"

namespace phy::cli {

/// The plan, how much of it is left and how long that will take.
void print_plan(const study::Plan& plan, const study::StudyRows& rows, const Session& session);

/// Outcomes other than a peak, with advice. Returns their number.
std::size_t print_failures(const study::Plan& plan, const study::StudyRows& rows, int width);

/// Tests of this part that have no result yet.
std::size_t n_unfinished(const study::Plan& plan, const study::StudyRows& rows);

/// How full the lanes were and how fast tests went in them; "" where none ran.
std::string lanes_text(const study::LaneUse& use);

}  // namespace phy::cli
