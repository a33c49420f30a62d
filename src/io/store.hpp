// Results on disk (docs/formats.md). A result is a folder that appears complete or not at all: it is written
// under a temporary name beside its place, synced, and renamed.
#pragma once
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy {

/// Version of the result folder's layout, stored in every result.json.
constexpr int result_format = 1;

/// Creates the folder if needed and tries to write into it. Throws IoError before hours of work are lost.
void check_writable(const std::string& folder);

/// Writes one file whole or not at all.
void write_file(const std::string& path, const std::string& content);

/// Writes a result folder: result.json, history.csv, cracks.csv, recipe.toml, snapshots for ParaView.
void write_result(const std::string& folder, const Recipe& recipe, const std::string& version,
                  const Specimen& specimen, const TestResult& result);

/// Discs as CSV: "x [m],y [m],r [m]" after a comment line with the box. Reads back to the same bits.
std::string discs_csv(const Packing& packing);
/// Reads discs. Throws IoError, or InputError with every bad line.
std::vector<Disc> read_discs(const std::string& path);
/// Contacts as CSV: grains, kind, normal, gap, stiffnesses, strengths.
std::string contacts_csv(const Specimen& specimen);

}  // namespace phy
