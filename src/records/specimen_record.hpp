// Everything that a result folder says about one specimen, whether just computed or read back from disk: what
// tables, pages and figures read.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/scene.hpp"
#include "records/specimen.hpp"

namespace phy {

struct BeddingRecord {
  double theta = 0.0;  ///< [deg]
  BeddingReport report;
};

struct SpecimenRecord {
  std::string program;  ///< name and version
  Recipe recipe;
  std::string packing_hash;
  std::int64_t n_grains = 0;
  bool stress_free = true;
  PackingReport packing;
  std::vector<BeddingRecord> bedding;  ///< per set; empty for intact rock
  TestResult result;                   ///< without snapshots and frames: they are the scene
  Scene scene;
};

/// A specimen that a run should have and has not.
struct MissingTest {
  std::string name;         ///< "theta = 30 deg", or the folder
  std::string reason;       ///< why, and what to do
  bool unreadable = false;  ///< it is there, and cannot be read
};

/// The specimens of one run, intact rock last.
struct RunRecord {
  std::vector<SpecimenRecord> tests;
  std::vector<MissingTest> missing;
};

SpecimenRecord record_of(const Recipe& recipe, const std::string& version, const Specimen& specimen,
                         const TestResult& result);

/// What a specimen with layers is called: "theta = 30 deg".
std::string specimen_name(double theta);
/// What the specimens of a recipe are called, in its order; intact rock is "intact".
std::vector<std::string> specimen_names(const Recipe& recipe);

}  // namespace phy
