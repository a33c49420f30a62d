// Lines that others found, to be held against those of a study (docs/formats.md, "Regressions").
#pragma once
#include <string>
#include <vector>

#include "io/document.hpp"
#include "records/variation.hpp"

namespace phy::io {

/// Of the copy in the folder of a study.
constexpr const char* regressions_file = "regressions.toml";

const Schema& regression_schema();
/// Throws IoError, or InputError with every problem.
std::vector<Regression> read_regressions(const std::string& path);
std::string write_regressions(const std::vector<Regression>& regressions);

}  // namespace phy::io
