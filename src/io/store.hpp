// Results on disk (docs/formats.md). A result is a folder that appears complete or not at all: it is written
// under a temporary name beside its place, synced, and renamed.
#pragma once
#include <string>

#include "io/csv.hpp"   // the other files that a command writes or reads:
#include "io/file.hpp"  // storing results needs these two as well
#include "records/file_key.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "records/specimen_record.hpp"

namespace phy::io {

/// Version of the result folder's layout, stored in every result.json.
constexpr int result_format = 1;

/// The folder of a specimen or test, theta_45_deg of "theta = 45 deg": letters, digits, point and minus stay,
/// runs of anything else become one _.
std::string folder_name(const std::string& name);

/// The text of a result.json.
std::string result_json(const SpecimenRecord& record);
/// Its keys, in their order.
const std::vector<FileObject>& result_keys();

/// Throws IoError where the folder of a result cannot be put, as check_place(): before hours of work are
/// lost.
void check_result_place(const std::string& folder);

/// Writes a result folder: result.json, history.csv, cracks.csv, recipe.toml, snapshots for ParaView, scene.
void write_result(const std::string& folder, const Recipe& recipe, const std::string& version,
                  const Specimen& specimen, const TestResult& result);

}  // namespace phy::io
