// The folder that the page works in. Everything is a file there, and nothing is anywhere else: a rock file
// and its table, the folders of its calibrations, and those of tests on the calibrated rock.
//
//   shale.toml, shale.csv          the rock
//   shale-calibration/             `phyllite calibrate`; begun afresh: shale-calibration-2/ and so on
//   shale-calibration.log          what it printed
//   shale-tests/name.toml          a recipe; shale-tests/name/ its results, shale-tests/name.log the output
//
// All paths count from the working directory, which is that folder.
#pragma once
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace phy::gui {

/// A rock as it lies on disk. `table`: nothing where it is no text that can be edited here.
struct RockFiles {
  std::string toml, table_file;
  std::optional<std::string> table;
  std::string stamp;  ///< of both files; "": neither is there, the texts are templates
};

/// The files have been changed since they were shown.
struct Changed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// False also where nobody can say.
bool exists(const std::string& path);

/// Throws InputError unless a rock or a test may have this name, which becomes part of file names.
void check_name(const std::string& name);

/// Names of the rock files: TOML with a key `data`.
std::vector<std::string> rock_names();
RockFiles read_rock_files(const std::string& name);
/// The table that a rock file names, if it is a text in this folder: a plain name of a CSV file.
std::string table_named_in(const std::string& toml, const std::string& otherwise);
/// Writes both; the new stamp. Throws Changed unless the files still have `stamp`; InputError, IoError.
std::string save_rock(const std::string& name, const std::string& toml,
                      const std::optional<std::string>& table, const std::string& stamp);

/// Folders of its calibrations, the newest first.
std::vector<std::string> calibrations_of(const std::string& rock);
/// The one that is meant: "" is the newest, or the first where there is none. Throws InputError.
std::string calibration_of(const std::string& rock, const std::string& chosen = "");
/// The one after that.
std::string next_calibration_of(const std::string& rock);

/// Throws InputError where a link leads out of the working directory.
void check_inside(const std::string& path);

std::string tests_of(const std::string& rock);
/// Recipes in that folder, by name.
std::vector<std::string> test_names(const std::string& rock);

/// A file of this folder as it may be served: within it whatever links and dots say, and not hidden. Nothing:
/// there is no such file.
std::optional<std::string> served_file(const std::string& path);
/// Of a served file, by its ending.
std::string content_type(const std::string& path);

}  // namespace phy::gui
