// A specimen as pixels, at any moment of its test: for films and figures.
#pragma once
#include "records/specimen_record.hpp"
#include "report/canvas.hpp"

namespace phy::report {

struct SpecimenView {
  double left = 0.0, top = 0.0;  ///< of the undeformed specimen [pixels]
  double scale = 0.0;            ///< [pixels/m]
  double magnify = 1.0;          ///< of displacements
  bool cracks = true;
};

/// Draws the discs (moved as at axial strain `strain`, straight between frames) and the cracks up to it.
/// Needs a scene with at least one frame.
void draw_specimen(Canvas& canvas, const SpecimenRecord& test, const SpecimenView& view, double strain);

/// Strain of the last row, as draw_specimen takes it: positive, in the direction of the test
/// (records/test_description.hpp).
double last_strain(const SpecimenRecord& test);

}  // namespace phy::report
