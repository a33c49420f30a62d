// What a calibration leaves behind: estimates with intervals, comparison with the laboratory, verdict,
// identifiability. Plain data, SI units.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/nan.hpp"
#include "base/option.hpp"
#include "base/stats.hpp"
#include "records/finding.hpp"
#include "records/lab_tests.hpp"
#include "records/quality.hpp"
#include "records/rock.hpp"

namespace phy {

/// A number of the recipe.
using RecipeNumber = const double&(const Recipe&);

/// How parameters were found: from a posterior, this program's own way, or step by step as the paper does.
enum class CalibrationMethod { posterior, sequence };

/// What the data say about one parameter. `low`, `high`: 95 % interval within the box of admissible values;
/// NaN where the method gives none.
struct ParameterEstimate {
  std::string key;     ///< of the recipe: "matrix.E_c", "bedding[0].k_n"; or a ratio, "tau_c/sigma_c"
  std::string symbol;  ///< "E_c"
  std::string unit;    ///< "Pa", "Pa/m", "1"
  double value = nan;
  double low = 0.0, high = 0.0;
  double box_low = 0.0, box_high = 0.0;  ///< values that the calibration admits
  bool determined = false;  ///< data have narrowed what was known before by half (LogBox::narrowed_to)
  Support rests_on;         ///< the data that determine it, or what stands in for them
  NextStep next;            ///< what would; nothing if it is determined
  /// Which number of the recipe it is; nullptr: a ratio of two.
  RecipeNumber* number = nullptr;
  bool has_interval() const { return std::isfinite(low); }
  bool open() const { return has_interval() && !determined; }  ///< left so by the data
};

/// How the model's specimens fail: means and scatter over the packings that have such a number
/// (analysis/failure_plane.hpp). NaN: no bedding, no packing whose cracks line up.
struct FailureMode {
  double bedding_share = nan, bedding_share_sd = nan;  ///< of all cracks
  /// [deg] of the failure plane, like theta; 0 ... 90 where both senses are alike, else negative where it
  /// leans the other way than the bedding.
  double angle = nan, angle_sd = nan;
  int n_tests = 0, n_planes = 0;  ///< on how many packings; of these, whose cracks line up
};

/// One row of the macro table: laboratory beside model.
struct Comparison {
  Target target;
  double mean = nan;  ///< of the model over packings
  double sd = nan;    ///< between packings
  /// `mean` with what the model misses at other angles; of a row of `fitted`, with what it misses here.
  double with_discrepancy = nan;
  /// 95 % interval of the rock's value by the fit; of a row of `left_out`, of the table's value.
  double low = nan, high = nan;
  int n_packings = 0;
  int n_invalid = 0;  ///< Brazilian: of these, first crack off the central third (lab/brazilian/reading.hpp)
  std::string missing;   ///< why the first packing without an answer has none
  QualityTally quality;  ///< warnings of the tests behind the mean
  FailureMode failure;   ///< of a strength
  double error() const { return mean / target.mean - 1.0; }
  /// The best prediction: with what the model misses, where that is known.
  double predicted() const { return std::isfinite(with_discrepancy) ? with_discrepancy : mean; }
  bool answered() const { return std::isfinite(mean); }  ///< false: no packing carried load, or none peaked
};

enum class VerdictStatus {
  calibrated,
  calibrated_except,
  not_calibrated,
  not_decided,
  out_of_reach,
  interrupted
};
const char* to_string(VerdictStatus status);
/// Does the model miss the table as a whole?
inline bool misses_table(VerdictStatus status) {
  return status == VerdictStatus::not_calibrated || status == VerdictStatus::out_of_reach;
}

/// What the numbers mean: the status (verdict/judge.hpp) with how many values are met, missed and open; each
/// limit that the model or the table ran into; what the model may and may not be used for; where most of the
/// misfit lies (the largest share first; of a model that meets its table, what is left open); and what to do
/// next: the advice of a finding of its own.
struct Verdict {
  VerdictStatus status = VerdictStatus::calibrated;
  std::vector<Finding> findings = {};
  std::vector<Finding> good_for = {}, not_good_for = {};
  std::vector<Finding> causes = {};
  Finding next{FindingKind::next_step};
  /// `values_judged`; without numbers: nothing was judged.
  Finding counts{FindingKind::values_judged};
};

/// The row of a target; nullptr if there is none.
const Comparison* row_of(const std::vector<Comparison>& rows, const Target& t);

/// "E(30)", "BTS(45, 54 mm)" where discs have sizes of their own, "sigma_1(45, 10 MPa)".
std::string cell_name(const Target& t);

/// What a test has of its own, ", 54 mm" of its disc, ", 10 MPa" on its sides; and the name with that.
std::string particulars(const Target& t);
std::string test_name(const Target& t);

/// What the table itself says of a row by a straight line between its neighbours in theta, the same property
/// (and disc) at the next lower and the next higher angle of `rows`; NaN at the ends.
double interpolated(const std::vector<Comparison>& rows, const Target& t);

/// How far the draws from a posterior can be trusted; of several parameters the worst.
struct Mixing {
  double effective = nan;  ///< independent draws that they are worth
  double r_hat = nan;      ///< spread of all draws over that inside parts of them; 1: all parts agree
};

/// Macro stiffness K of the planes over micro stiffness k of their joints [Pa/m].
struct StiffnessRelation {
  double ratio = nan;  ///< K/k of the joints as they are
  LineFit line;        ///< K = slope k + intercept about them: Eq. 2 of the paper
};
struct PlaneStiffness {
  std::string planes;  ///< "as calibrated", or what is otherwise: "spacing x 0.7"
  StiffnessRelation normal, shear;
};

/// What the calibrated model misses of a kind of test at an inclination: rock/model, with its 95 % interval.
struct AngleFactor {
  Target test;         ///< the kind; mean and angle are of one of its cells
  double theta = 0.0;  ///< [deg]
  double factor = 1.0, low = 1.0, high = 1.0;
};

/// A strength of the table against the calibrated model, in logarithms: laboratory less model
/// (calibrate/discrepancy.hpp).
struct StrengthResidual {
  Target target;
  double value = 0.0;                 ///< at the estimate
  double noise = 0.0;                 ///< variance of the laboratory
  double unknown = 0.0;               ///< variance of the model's own answer
  std::vector<double> of_draws = {};  ///< the value at every draw of the ensemble
};

/// What a search of strengths had less than a usual one (calibrate/effort.hpp).
struct Shortage {
  bool of_effort = false;   ///< points, for a lower effort
  bool of_tests = false;    ///< for too small a budget
  bool foreseen = false;    ///< a lower effort, because the forecast saw the table out of reach
  bool below_most = false;  ///< an effort above the usual one is left
  /// Its estimate no longer moved, or came no nearer to the table: more tests would not move it either.
  bool settled = false;
  std::int64_t tests = 0;  ///< in compression, that a usual search takes more
  bool any() const { return of_effort || of_tests; }
  bool may_be_longer() const { return any() || below_most; }
};

/// What a simulator was asked for and has answered.
struct SimulatorCount {
  std::int64_t tests = 0;      ///< runs of laboratory tests
  std::int64_t tension = 0;    ///< of these, direct tension, Brazilian, semi-circular bend, direct shear
  std::int64_t coarse = 0;     ///< of these, with magnified grains
  std::int64_t solutions = 0;  ///< direct elastic solutions
  std::int64_t compression() const { return tests - tension; }
};

/// Everything `phyllite calibrate` found.
struct Calibration {
  std::string rock;
  std::vector<SetOption> asked;  ///< what the user asked for: every option that changes the result
  CalibrationMethod method = CalibrationMethod::posterior;
  ModulusReading E_is = ModulusReading::small_strain;  ///< how E and nu of the table and below are read
  bool counts_from_load = false;                       ///< the table's angles are beta; ours are theta
  LayerModel layers = LayerModel::planes;              ///< of a rock with bedding
  bool model_chosen = false;                           ///< of matrix and layers, by the program, from rivals
  std::optional<Finding> rival;        ///< `rival_model`: the nearest of these that was not tried
  std::vector<std::string> discarded;  ///< models of other calibrations, whose tests are counted here too
  std::string effort;            ///< of the search of strengths (calibrate/effort.hpp); empty: there was none
  Shortage shortage;             ///< of that search
  Recipe recipe;                 ///< the calibrated model, ready to run
  std::vector<Recipe> ensemble;  ///< joint draws of what is known of it (calibrate/posterior_ensemble.hpp)
  std::vector<ParameterEstimate> parameters;
  std::vector<Comparison> fitted;           ///< on the packings of the fit
  std::vector<Comparison> verification;     ///< on packings that the fit has not seen
  std::vector<Comparison> left_out;         ///< each value predicted without it
  std::vector<AngleFactor> discrepancy;     ///< of the strengths, at every fifth degree
  std::vector<StrengthResidual> residuals;  ///< what `discrepancy` is learnt from
  /// K_Ic of a rock whose grain size nobody has stated, on unseen packings: beside the table, not fitted to
  /// it.
  std::vector<Comparison> compared;
  /// Where E_is is that of small strain: what is left of E (tangent), and added to nu, at 40 - 60 % of UCS,
  /// which is missing from `fitted` and `verification`: the latter times the ratio (nu: plus the difference)
  /// of test and direct solution on the first unseen packing. Where the table holds E or nu, and UCS.
  std::vector<Comparison> tangent_from_test;
  /// What the maps expect of each value and of UCS over tension by this model (maps/reach.hpp).
  std::vector<Finding> reach;
  std::vector<PlaneStiffness> eq2;  ///< and how far it moves with what is assumed of the planes
  Verdict verdict;
  std::vector<Finding> notes;  ///< what else there is to know of the way to it
  Mixing mixing;               ///< of the draws behind the strengths; NaN without these
  SimulatorCount counts;       ///< verification included, and the models that were discarded
  double seconds = 0.0;
};

/// Has its table tests of a part?
bool has_tests_of(const Calibration& calibration, Part part);

}  // namespace phy
