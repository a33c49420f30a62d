// What columns of a laboratory's table are called, in headers as laboratories write them: "E [GPa]",
// "sigma_c (MPa)", "Brazilian tensile strength, MPa". Compared without case, blanks and signs; Greek letters
// are their names.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/units.hpp"
#include "records/rock.hpp"

namespace phy::io {

/// What a column holds. `scatter`: the standard deviation of the property. `cohesion` and `friction`: of a
/// Mohr-Coulomb envelope through strengths under `least_confining` to `most_confining`.
enum class Column {
  theta,
  beta,
  confining,
  diameter,
  n,
  value,
  scatter,
  cohesion,
  friction,
  least_confining,
  most_confining,
  intermediate,  ///< sigma_2, which has to be the confining stress
  passed,        ///< by the user's word, or beside replicates
  other
};

struct Head {
  Column kind = Column::other;
  Property property = Property::E;
  std::string name;                    ///< ours, "UCS" or "UCS_sd"; of other columns in lower case
  std::string unit;                    ///< as the program reads it: "deg" for a degree sign
  std::string title;                   ///< the header without its unit
  bool own = true;                     ///< the header is our name
  std::string replicate;               ///< of "UCS 2" or "UCS (S2)" what tells specimens of a row apart
  bool summary = false;                ///< "mean UCS", "UCS_sd", "SD": made of other cells
  bool deviatoric = false;             ///< the axial stress less the confining stress
  bool speaks_of_angles = false;       ///< a name that is not understood, with a word such as "dip" in it
  bool speaks_of_directions = false;   ///< the same with a word such as "plug" or "direction"
  bool speaks_of_values = false;       ///< the same with a word of what is read, "residual strength"
  std::optional<ModulusReading> E_is;  ///< what the header says of E

  /// For messages: the title, with our name where it is another.
  std::string shown() const {
    return own || kind == Column::other ? title : title + " (read as " + name + ")";
  }
};

/// What the header of a column says; `meant`: the name that the user gives the column, "-" to pass it over.
Head head_of(const std::string& cell, const std::string& meant = {});
Dimension dimension_of(const Head& head);
/// The unit that examples of a column are written in: "GPa" of E.
std::string usual_unit(const Head& head);
/// The inclination that words of a cell below a header mean [deg]: 90 where the layers are parallel to the
/// load, 0 where they are perpendicular. V and H say it of the layers, or of the axis of a plug in layers
/// that lie flat; nothing where the header does not say which.
std::optional<double> direction_in_words(const std::string& cell, const std::string& header);
/// "V", "H", "vertical", "horizontal".
bool is_upright_or_flat(const std::string& cell);
/// A cell without its degree sign, "30°"; nothing where it has none.
std::optional<std::string> without_degree_sign(const std::string& cell);

/// The header without its unit.
std::string title_of(const std::string& cell);
/// Does a title hold a power of ten, "E×10³"?
bool has_factor(const std::string& title);
/// A unit as cells below a header give it, "[MPa]" or "MPa", as the program reads it; "" where it is none.
std::string unit_of_cell(const std::string& cell);
/// Does a cell say that its row is no specimen, "Mean" or "SD"?
bool is_summary(const std::string& cell);
/// "SD", "St. dev.", "Standard deviation".
bool is_scatter(const std::string& cell);
/// The same of a row's name with more words: "Mean values (n = 3)", "Standard deviation".
bool begins_summary(const std::string& cell);

/// Our names of columns.
const std::vector<std::string>& column_names();

/// A column as docs/tables.md shows it.
struct ColumnRow {
  std::string name, unit, meaning;
  std::vector<std::string> others;
};
const std::vector<ColumnRow>& column_rows();

}  // namespace phy::io
