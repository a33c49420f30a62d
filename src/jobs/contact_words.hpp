// A contact on the bench in the words of the command line: its law, parameters and path.
#pragma once
#include <string>
#include <vector>

#include "base/check.hpp"
#include "lab/contact_bench.hpp"

namespace phy::jobs {

/// The head of a path as CSV.
constexpr const char* path_header = "closure [m],slide [m],rotation [rad]";

/// The law of that name; throws InputError where there is none.
const lab::LawInfo& find_law(const std::string& name);

/// Parameters of a law, by its schema: the usual ones, and over them `values` such as "k_n=38e9 N/m". What
/// does not fit goes to `problems`.
std::vector<double> parameters_of(const lab::LawInfo& law, const std::vector<std::string>& values,
                                  std::vector<Problem>& problems);

/// "1 um, 8 um, 0 deg": closure, slide and, where given, rotation.
ContactPoint read_corner(const std::string& text, std::vector<Problem>& problems);
/// Corners from a CSV file.
std::vector<ContactPoint> read_path(const std::string& file, std::vector<Problem>& problems);
/// Closes, slides to and fro, opens, closes again where it was, slides back.
std::vector<ContactPoint> default_path();

}  // namespace phy::jobs
