// A figure of two stress-strain curves.
#pragma once
#include <string>

#include "records/result.hpp"
#include "report/gnuplot.hpp"

namespace phy::report {

/// The gnuplot script that draws both into `out`, one column of a journal wide. The names are those of the
/// key.
std::string comparison_script(const History& ours, const History& theirs, const std::string& our_name,
                              const std::string& their_name, FigureFormat format, const std::string& out);

}  // namespace phy::report
