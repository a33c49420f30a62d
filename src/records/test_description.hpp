// What a laboratory test is, for all who meet its results: how its history is read, which number is its
// strength, what tables and texts say of it, which shape its specimen has. Tables, files, texts and guesses
// of cost ask here and know no test by name.
//
// Records says what a test is; the laboratory says which tests there are (lab/tests.cpp): it alone knows how
// they are done, and is above this room.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/rock.hpp"

namespace phy {

/// A number of the results in the table for the terminal.
struct TableColumn {
  const char* head;
  const char* unit;
  const char* number;  ///< its name among the numbers of a result
  double scale;        ///< from SI to `unit`
  int digits;
};

/// The number that a test is made for: what is drawn over the inclination of the bedding.
struct TestQuantity {
  std::string number, label;  ///< its name among the numbers of a result, and for people
  std::string unit = "MPa";
  double scale = 1e-6;  ///< from SI to `unit`
};

/// The curve of a test: which columns, in which direction and unit, and which number is its strength. The one
/// list for page, figures and films.
struct TestCurve {
  std::string strain = "axial strain", strain_unit = "%";
  double strain_factor = 100.0;                           ///< from the recorded value to `strain_unit`
  std::string stress = "axial stress";                    ///< drawn in MPa
  std::string strength = "ucs", strength_label = "UCS";   ///< number of the largest stress, and its name
  double sign = 1.0;                                      ///< -1: recorded as negative, as tension is
  double HistoryRow::*value = &HistoryRow::axial_stress;  ///< the column of the stress
  std::optional<TestQuantity> derived = std::nullopt;     ///< what the strength is a step to; none: nothing

  /// What the test is made for.
  TestQuantity quantity() const { return derived ? *derived : TestQuantity{strength, strength_label}; }
  /// Grow while the test loads. [1] (direct shear: m), [Pa]
  double strain_of(const HistoryRow& row) const { return sign * row.axial_strain; }
  double stress_of(const HistoryRow& row) const { return sign * (row.*value); }
};

/// For the guess of what a test will cost (study/expected.hpp). Rules of thumb from the paper's specimen
/// (docs/paper.md) and examples/lab.
struct ExpectedPeak {
  /// What the strain of the test refers to [m].
  double (*length)(const Recipe&) = [](const Recipe& r) { return r.specimen.height; };
  double strain_factor = 1.0;  ///< strain of an elastic specimen over strength / E
  double intact = 2.7;         ///< strength over the weaker bond strength, without bedding
  double bedded = 0.0;         ///< the same with bedding; 0: as Jaeger's strength of that inclination
};

/// How a test is loaded that answers a laboratory's value, its peak being where that value says.
struct PeakOfValue {
  /// Strain at the peak of an elastic specimen times its modulus [Pa]. `value`: of the table, in SI; `side`:
  /// the stress that the test keeps, with which its own begins [Pa].
  double (*strain_times_modulus)(const Recipe&, double value, double side) =
      [](const Recipe&, double value, double side) { return value - side; };
  /// Of a test whose specimen is a plane between rigid halves: displacement at the peak over the width of the
  /// specimen, by the stiffness of the plane; null: what is tested is a specimen.
  double (*strain_of_plane)(const Recipe&, double value) = nullptr;
  double wave_transits = 100.0;  ///< of a wave across the specimen, in the time until that peak
};

/// What is cut from the middle of the packing: a disc, or its upper half with the flat face down, which may
/// have a notch upwards from the middle of that face. Or a hole in the middle of the whole rectangle.
struct SpecimenCut {
  double diameter = 0.0;  ///< [m] 0: the whole rectangle
  bool half = false;
  double notch_length = 0.0;  ///< [m] 0: no notch
  double notch_width = 0.0;   ///< [m] at least; more where grains would touch across it
  double hole = 0.0;          ///< [m] its diameter; 0: no hole
};

/// A stress that the test keeps on the specimen's boundary, and its key in [test].
struct KeptStress {
  const char* key = "";
  double TestRecipe::*value = nullptr;  ///< [Pa]; null: no such stress
  bool needed = false;                  ///< without it there is no test
};

struct TestDescription {
  const char* name = "";                ///< the recipe's word
  const char* stress = "axial stress";  ///< on which the strength is read, in words
  const char* body = "platen";          ///< what pushes or pulls, in words
  const char* extent = "strain {} %";   ///< how far a test has come, of what its limits of strain are about
  HistoryColumns columns;               ///< of the history, one of them of HistoryRow::axial_strain
  /// Names of the columns that the hash of a history covers, in this order (hashed_fields). A column that is
  /// added or moved later changes no hash.
  std::vector<std::string> hashed;
  TestCurve curve;
  std::vector<TableColumn> table;
  bool runs_to_end = false;     ///< to test.max_strain, whatever happens, for what comes after the peak
  bool may_pre_strain = false;  ///< can start loaded (test.pre_strain)
  bool may_approach = true;     ///< its bodies may be faster at first (test.approach_strain)
  bool may_harden = false;      ///< by compression: its strength may be a knee (analysis/strength_rule.hpp)
  double closed_at = 0.0;       ///< closure of an opening that ends it, over the radius; 0: it has no opening
  KeptStress kept_stress = {};
  double TestRecipe::*friction = &TestRecipe::platen_friction;  ///< of the bodies that are rough
  ExpectedPeak expected = {};
  PeakOfValue peak_of_value = {};
  /// What is cut from the packing; null: the whole rectangle is tested.
  SpecimenCut (*cut)(const Recipe&) = nullptr;

  /// One sentence or more for the methods section of a paper: what loads the specimen, and how.
  std::string (*loading_text)(const Recipe&) = nullptr;
  const char* load_on_box = ", load along the height";        ///< after the size of the specimen
  const char* load_on_bedding = ", the load being vertical";  ///< after the inclination of the bedding

  /// The column that grows while the test loads, HistoryRow::axial_strain: what cracks, snapshots and frames
  /// are filed under.
  const HistoryColumn& loading_column() const { return column_of(&HistoryRow::axial_strain); }
  const HistoryColumn& stress_column() const { return column_of(&HistoryRow::axial_stress); }
  const HistoryColumn& column_of(double HistoryRow::*value) const;
  /// False where the loading column is a displacement [m]; the recipe's limits of strain are then limits of
  /// displacement over the specimen's width.
  bool loads_by_strain() const;
  /// What of a laboratory the curve stands beside; nothing: no table has it.
  std::optional<Property> property() const;
};

/// All tests, uniaxial compression first. Defined by the laboratory.
std::span<const TestDescription* const> laboratory_tests();

/// Fingerprint over the bits of the history's values that the test names (TestDescription::hashed), of every
/// crack and final position; not over times, host or threads.
std::string hash_of(const TestResult& result);

}  // namespace phy
