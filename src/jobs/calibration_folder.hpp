// A calibration in a folder: begun or taken up again, and all that it leaves there.
#pragma once
#include <exception>
#include <optional>
#include <string>

#include "jobs/calibration_options.hpp"
#include "jobs/folder_lock.hpp"
#include "jobs/time_left.hpp"

namespace phy::jobs {

/// What was asked of the calibration that a folder holds, to go on with; nothing: it holds none, or a damaged
/// one. `rock` is as it was named then.
std::optional<CalibrationRequest> request_in(const std::string& folder);

/// The rock with the matrix that is asked for. Throws InputError where that cannot be.
Rock with_matrix(Rock rock, const CalibrationRequest& request);

/// Throws InputError where an effort is asked for and no search of strengths is made that it could be of.
calibrate::CalibrationOptions options_of(const CalibrationRequest& request);

/// The folder of a calibration while it is worked in.
struct BegunCalibration {
  std::string store;
  bool had_tests;  ///< of an earlier run of the same calibration
  FolderLock lock;
};

/// Makes the folder ready. An earlier calibration is used only when asked for, and only the same: else
/// InputError, as where another process works there.
BegunCalibration begin_calibration(const Evidence& evidence, const CalibrationRequest& request);

/// Throws where a file of a calibration cannot be put into the folder, which is made.
void check_calibration_outputs(const std::string& folder);

/// All files of a finished calibration but the page.
void write_calibration(const std::string& folder, const Calibration& calibration);

/// Folder of the calibrated rock as it broke (docs/formats.md, "Calibration").
std::string specimens_in(const std::string& folder);

/// Puts the specimens of a calibration there. Where something else, or a damaged result, is in the place of
/// one, it is left alone and reported by check(), so that no calibration is lost for the sake of its
/// pictures.
class SpecimenFolder : public calibrate::SpecimenSink {
 public:
  /// `folder`: of the calibration.
  explicit SpecimenFolder(const std::string& folder) : folder_(specimens_in(folder)) {}
  bool holds(const Recipe& recipe) override;
  void add(const Specimen& specimen, const Recipe& recipe, const TestResult& result) override;
  /// Throws the first InputError or IoError that came up.
  void check() const {
    if (problem_) std::rethrow_exception(problem_);
  }

 private:
  std::string folder_;
  std::exception_ptr problem_;
};

/// What a screen shows: the verdict first, parameters before comparisons.
std::string screen_of(const Calibration& calibration, int width);

/// How far the tests have come, and when the calibration will have ended.
std::string progress_text(const calibrate::TestProgress& progress, const TimeLeft& clock, double now);

/// File of draw k, from 0, in the folder of a calibration.
std::string ensemble_file(const std::string& folder, std::size_t k);

}  // namespace phy::jobs
