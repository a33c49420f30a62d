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
  bool events = false;  ///< circles of the acoustic events, where the test has them
};

/// Draws the discs (moved as at axial strain `strain`, straight between frames) and the cracks up to it.
/// Needs a scene with at least one frame.
void draw_specimen(Canvas& canvas, const SpecimenRecord& test, const SpecimenView& view, double strain);

/// Of the circle of an event in a specimen of that width [m]: its area grows with the moment to the power
/// 2/3, and that of the largest magnitude is a tenth of the specimen wide.
double event_radius(const AcousticEvent& event, double largest, double width);

/// Strain of the last row, as draw_specimen takes it: positive, in the direction of the test
/// (records/test_description.hpp).
double last_strain(const SpecimenRecord& test);

}  // namespace phy::report
