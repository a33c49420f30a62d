// Figures of the specimens of a run.
#pragma once
#include <string>
#include <vector>

#include "records/rock.hpp"
#include "records/specimen_record.hpp"
#include "records/test_description.hpp"
#include "report/figure.hpp"

namespace phy::report {

/// "θ = 30°", or "intact".
std::string heading(const TestResult& result);
/// A series of one specimen, in its colour.
Series series_of(const TestResult& result, Mark mark, int item);
/// Axes of the curves of a test, without ends.
Panel curve_panel(const TestCurve& curve);

/// All curves, the angle at each peak, and where each first reaches its stresses of damage and its strength.
Figure stress_strain_figure(const RunRecord& run);
/// A panel per specimen: its stress, and cracks by kind on the right.
Figure damage_figure(const RunRecord& run);
/// Share of each kind of crack in each specimen.
Figure modes_figure(const RunRecord& run);
/// Directions of cracks, a panel per specimen: the area of a petal is proportional to their number.
Figure rose_figure(const RunRecord& run);
/// E, strength and nu of the specimens over the inclination, theory fitted to them, the laboratory. No panel
/// for a number that no specimen has.
Figure anisotropy_figure(const RunRecord& run, const std::vector<Target>& laboratory);

/// A curve of somebody else beside ours.
Figure two_curves_figure(const History& ours, const History& theirs, const std::string& their_name);

}  // namespace phy::report
