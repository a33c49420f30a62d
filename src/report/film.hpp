// A film of a run: the specimens side by side through the test, their curves below with a dot each. Frames
// are drawn here and encoded by ffmpeg, which also writes the words.
#pragma once
#include <string>
#include <vector>

#include "records/specimen_record.hpp"
#include "records/test_description.hpp"
#include "report/specimen_picture.hpp"

namespace phy::report {

struct FilmOptions {
  int width = 1280;      ///< [pixels]
  double seconds = 8.0;  ///< length
  int per_second = 20;   ///< frames
  double magnify = 1.0;  ///< of displacements
};

class Film {
 public:
  /// Throws InputError when no specimen of the run has displacements. The run must outlive the film.
  Film(const RunRecord& run, const FilmOptions& options);
  int width() const { return options_.width; }
  int height() const { return height_; }
  int n_frames() const;
  Canvas frame(int i) const;
  /// Arguments of ffmpeg that turn the frames, raw and one after the other, into `out` (.webm or .gif by its
  /// ending).
  std::vector<std::string> encoder_arguments(const std::string& out) const;

 private:
  struct Place {
    const SpecimenRecord* test;
    SpecimenView view;
  };
  void draw_curves(Canvas& canvas, double strain) const;
  std::string labels() const;
  std::vector<Place> places_;
  FilmOptions options_;
  int height_ = 0;
  TestCurve axes_;
  double cell_ = 0.0, curve_top_ = 0.0;  // [pixels]
  double end_ = 0.0, strongest_ = 0.0;   // strain, stress [Pa] of the axes
};

}  // namespace phy::report
