// A calibration for other programs: JSON for scripts, a file for Yade (PFC2D: pfc_commands.hpp). Reads
// records only.
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/file_key.hpp"

namespace phy::report {

/// Version of calibration.json (docs/formats.md).
constexpr int calibration_format = 2;

/// Everything but the times: the same calibration gives the same text.
std::string calibration_json(const Calibration& calibration, const std::string& version);
/// Its keys, of every kind of object in it (calibration_keys.cpp).
const std::vector<FileObject>& calibration_keys();

/// What pictures are drawn from, read back from that text: rock, method, `fitted`, `verification`,
/// `left_out`, `discrepancy`, and `residuals`, for predictions. Throws InputError that names `file` where it
/// is no calibration of this format.
Calibration comparisons_of(const std::string& json, const std::string& file);
/// The same, with `E_is`, and kind and names of what the verdict calls it not good for.
Calibration judged_from(const std::string& json, const std::string& file);

/// Head of calibrated.toml, as comments: the verdict, and which parameters its data do not constrain.
std::string recipe_comments(const Calibration& calibration);

/// Head of the file of an ensemble's recipe, as comments: `number` counts from 1.
std::string draw_comments(const Calibration& calibration, std::size_t number);

/// Python for Yade's JCFpm model: materials, and a function that marks the joints. Yade's spheres are another
/// model; the head of the file says where the two differ.
std::string yade_script(const Recipe& recipe);

}  // namespace phy::report
