// Result folders read back (docs/formats.md, "Result folder").
#pragma once
#include <string>
#include <vector>

#include "records/specimen_record.hpp"

namespace phy::io {

/// One result folder. A folder without cracks or scene (results of other programs) gives a record without
/// them. Throws IoError (unreadable), or InputError when a file is no result of this format.
SpecimenRecord read_result(const std::string& folder);

/// The result folders of a run: `path` itself or those in it. Throws IoError (unreadable).
std::vector<std::string> result_folders(const std::string& path);
/// The completed recipe of one result folder; throws as read_result.
Recipe read_result_recipe(const std::string& folder);

/// All results of a run: of `path` itself, or of the folders in it, angles ascending and intact rock last.
/// Specimens that the recipe names and that are not there, and folders that cannot be read, are listed in
/// `missing`. Throws InputError when there is no result at all.
RunRecord read_run(const std::string& path);

}  // namespace phy::io
