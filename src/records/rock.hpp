// A rock as the laboratory saw it: the table of tests, and what the model takes as given.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/nan.hpp"
#include "records/measured_property.hpp"
#include "records/recipe.hpp"
#include "records/rock_model.hpp"

namespace phy {

/// How moduli measured on a cylinder are read in two dimensions (docs/calibration.md, "Plane stress").
enum class ElasticReading { plane_stress, plane_strain };

/// What the laboratory calls E. nu is that of 40 - 60 % of the strength, or of small strain
/// (docs/calibration.md, "Which E").
enum class ModulusReading { tangent_50, average, secant_50, secant_at_peak, small_strain };
const char* to_string(ModulusReading reading);
/// Throws std::out_of_range for another word.
ModulusReading modulus_reading_of(const std::string& word);

/// One cell of the table.
struct RockReading {
  Property property = Property::E;
  double theta = 0.0;      ///< [deg] inclination of the bedding, load along y, 0 ... 90; 0 without bedding
  double value = 0.0;      ///< SI
  double sd = nan;         ///< of single specimens, n >= 2; NaN: not given
  int n = 1;               ///< specimens behind the value
  double confining = 0.0;  ///< [Pa]
  int line = 0;            ///< of the table
  double diameter = 0.0;   ///< [m] of the disc of a BTS, of the half disc of a K_Ic; 0: the model's
  bool derived = false;    ///< from an envelope: no specimen has it
};

/// All cells of one property and angle together.
struct Target {
  Property property = Property::E;
  double theta = 0.0;       ///< [deg]
  double mean = 0.0;        ///< SI
  double sd = 0.0;          ///< scatter of single specimens, SI, > 0
  int n = 1;                ///< specimens
  bool sd_assumed = false;  ///< `sd` rests on what is usual more than on the table
  double diameter = 0.0;    ///< [m] of the disc of a BTS, of the half disc of a K_Ic; 0: the model's
  double confining = 0.0;   ///< [Pa] of a strength or of moduli under confinement
  int degrees = 0;          ///< degrees of freedom behind `sd`; 0: it is known
  std::vector<double> specimens = {};  ///< single ones of the table, SI; rows that stand for several are not
  /// `sd` as the table alone has it, without what is usual, where it has many degrees of freedom; else NaN.
  double stated_sd = nan;
  int stated_degrees = 0;
  double standard_error() const;  ///< sd/sqrt(n)
  double half_width() const;      ///< of the 95 % interval of the mean (Student)
  /// Standard error of the normal distribution with the same 95 % interval.
  double normal_error() const;
};

struct Rock {
  std::string name;
  bool bedded = true;
  bool counts_from_load = false;  ///< the table's angles are beta; `theta` of the readings is 90 - beta
  ElasticReading reading = ElasticReading::plane_stress;
  ModulusReading E_is = ModulusReading::small_strain;
  LayerModel layers = LayerModel::planes;
  /// What holds the grains of the model together; nothing: whichever predicts values of the table best that
  /// it was not shown.
  std::optional<MatrixModel> matrix = MatrixModel::parallel_bond;
  Recipe model;  ///< everything that is not calibrated: specimen, packing, bedding geometry, test, engine
  /// Somebody has said how large the model's grains are. K_Ic grows with the root of their size at the same
  /// strengths (Potyondy & Cundall 2004), so that without it K_Ic is no property of the model.
  bool grains_stated = false;
  std::vector<RockReading> readings;  ///< in the order of the table
  std::vector<std::string> notes;     ///< how the files were understood, for the user to see
};

/// Mean diameter of a model's grains [m], the middle of their range.
inline double grain_size(const Recipe& model) { return model.packing.radius_min + model.packing.radius_max; }

/// Intact rock: no bedding, no directions.
void remove_layers(Recipe& model);

/// Confining stresses [Pa] that a table means to be one: within 5 %; 0 is one of its own.
bool same_stress(double a, double b);

/// Are they one cell of the table; are they cells of one test at several angles?
bool same_cell(const Target& a, const Target& b);
bool same_test(const Target& a, const Target& b);

/// One target per property, angle, diameter of disc and confining stress, ordered in this way; stresses that
/// differ by less than 5 % are one, their mean. Replicates are
/// averaged, weighted by n. Scatter of single specimens: a scaled inverse chi-square distribution that begins
/// with the usual scatter of the property (records/measured_property.cpp), as if seen with four degrees of
/// freedom, and learns from all deviations inside the cells of the property. Other cells and prior together
/// lend a cell ten degrees of freedom at most: scatter may depend on the angle. A mean with its SD and n
/// counts as the n specimens behind it.
/// Moduli are converted to plane stress if `reading` says so.
std::vector<Target> targets_of(const Rock& rock);

/// E and nu under one stress whose load runs most nearly along the bedding: what the conversion to plane
/// stress takes for the rock that holds the strain out of the plane.
struct AlongBedding {
  const Target *E = nullptr, *nu = nullptr;
  bool complete() const { return E != nullptr && nu != nullptr; }
};
/// Under `confining` [Pa], else under the least stress that has both. Points into `targets`.
AlongBedding along_bedding(const std::vector<Target>& targets, double confining);

/// The targets of one property.
std::vector<Target> of_property(const std::vector<Target>& targets, Property property);

/// E and nu once for each angle, those under the least confining stress, and all else: what theories of
/// E(theta) without a stress on the sides are held against.
std::vector<Target> least_confined(const std::vector<Target>& targets);

}  // namespace phy
