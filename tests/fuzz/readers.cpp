#include "readers.hpp"

namespace phy::fuzz {

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all = {
      {"quantity", read_quantity},  // numbers with units, of files and of the command line
      {"recipe", read_recipe},      // and so draws of ensembles, recipes in results and stores
      {"readings", read_readings},  // CSV tables of a laboratory, and so every table of others
      {"workbook", read_workbook},  // tables of spreadsheet programs (.xlsx)
      {"discs", read_discs},        // imported packings
      {"series", read_series},      // history.csv, cracks.csv, events.csv
      {"scene", read_scene},        // scene.bin
      {"packing", read_packing},    // the cache of packings
      {"rock", read_rock},          // rock file, its table, its recipe
      {"study", read_study},        // study file, its recipe, points and regressions
      {"regressions", read_regressions},
      {"result", read_result},        // result folder, with the list of what was written
      {"variation", read_variation},  // results.csv of a study
      {"store", read_store},          // study.sqlite
      {"words", read_words},          // command line: units, lists, shards, laws, corners of a path
      {"report", read_report},        // calibration.json, effects.csv, and what pages make of results
  };
  return all;
}

}  // namespace phy::fuzz
