// What can be asked of a calibration: the one list of its options. The command line with its help, manual
// page and completion, the request that a folder keeps, Python's arguments and the page's controls are views
// of it.
#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/option.hpp"
#include "calibrate/calibration.hpp"
#include "io/document.hpp"

namespace phy::jobs {

/// Words that are empty have not been given.
struct CalibrationRequest {
  std::string rock;                         ///< the file, or what stands in its place in messages
  std::string out = "results/calibration";  ///< folder; empty: nothing is kept
  std::string effort{calibrate::auto_effort.name}, matrix, method = "posterior";
  std::int64_t max_tests = calibrate::CalibrationOptions().max_tests;
  bool elastic = false, with_untrusted = false, resume = false;
};

struct CalibrationOption {
  const char* key;    ///< "max_tests": in files and in Python
  const char* title;  ///< of its control on the page; empty: it has none
  const char* meaning;
  std::variant<bool CalibrationRequest::*, std::int64_t CalibrationRequest::*,
               std::string CalibrationRequest::*>
      place;
  std::vector<std::string> words = {};  ///< the only ones that are admitted; none: a folder
  std::int64_t most = 0;                ///< of a whole number, from 1 on
  /// Else it says where and how to work: nothing that a folder has to remember.
  bool changes_result = true;

  /// As messages name it (base/option.hpp): "max-tests".
  std::string word() const;
  /// As a key of a file: kind, range, meaning.
  Field field() const;
  OptionValue value(const CalibrationRequest& request) const;
};

const std::vector<CalibrationOption>& calibration_options();

/// Of keys with values, such as arguments of a function. Throws InputError with all problems.
CalibrationRequest request_of(io::TomlValue keys, const std::string& where);
/// Every option that changes the result and has a value.
std::vector<SetOption> asked(const CalibrationRequest& request);
/// The words that ask for it, after `phyllite`.
std::vector<std::string> command_line_of(const CalibrationRequest& request);

/// What a folder remembers of the calibration in it, and where.
constexpr const char* request_file = "request.toml";
struct KeptRequest {
  CalibrationRequest request;
  std::string name;          ///< of the rock
  std::string table, model;  ///< hashes of its targets; of the recipe, and of how the table is read
};
std::string kept_text(const KeptRequest& kept);
/// Throws InputError where it is damaged.
KeptRequest read_kept(const std::string& text, const std::string& file);

/// Options by which `request` asks for another result than the folder was begun for.
std::vector<Problem> differences(const CalibrationRequest& request, const CalibrationRequest& begun);

}  // namespace phy::jobs
