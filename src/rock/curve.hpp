// A stress-strain curve of somebody else - PFC, Yade, a laboratory - from a table (io/table.hpp).
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "records/result.hpp"

namespace phy::rock {

struct ForeignCurve {
  History history;  ///< strain, stress and cracks, NaN where the table has no column of them; zeros elsewhere
  std::vector<std::string> notes;  ///< how the table was understood
};

/// Columns are found by name: one of "axial_strain", "strain", "epsilon" in a unit of strain; one of
/// "axial_stress", "stress", "sigma" in a unit of pressure; and, if it is there, one of "n_cracks", "cracks",
/// "cumulative_counts", "counts", "hits", "events": so many up to there. Units (base/units.hpp) stand in
/// brackets, behind a comma or in a row of their own. Other columns are passed over. A curve whose
/// compression is negative is turned. Throws InputError with everything that is wrong; of a load or a
/// displacement it says what to compute from it.
ForeignCurve parse_curve(std::string_view text, const std::string& where);
/// The same of a file; throws IoError as well.
ForeignCurve read_curve(const std::string& path);

/// Names of columns of counts, the one that counts first.
std::vector<std::string> names_of_counts();

}  // namespace phy::rock
