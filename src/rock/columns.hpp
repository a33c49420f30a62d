// What columns of a laboratory's table are called, in headers as laboratories write them: "E [GPa]",
// "sigma_c (MPa)", "Brazilian tensile strength, MPa". Compared without case, blanks and signs; Greek letters
// are their names.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/units.hpp"
#include "records/rock.hpp"
#include "rock/names.hpp"

namespace phy::rock {

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
  Subjects speaks_of;                  ///< a name that is not understood
  std::optional<ModulusReading> E_is;  ///< what the header says of E

  bool is_angle() const { return kind == Column::theta || kind == Column::beta; }
  /// Of an angle of this column, in degrees; and back.
  double theta_of(double angle) const { return kind == Column::theta ? angle : 90.0 - angle; }
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

/// The header without its unit.
std::string title_of(const std::string& cell);
/// Does a title hold a power of ten, "E×10³"?
bool has_factor(const std::string& title);
/// A unit as cells below a header give it, "[MPa]" or "MPa", as the program reads it; "" where it is none.
std::string unit_of_cell(const std::string& cell);
/// A column as docs/tables.md shows it.
struct ColumnRow {
  std::string name, unit, meaning;
  std::vector<std::string> others;
};
const std::vector<ColumnRow>& column_rows();

}  // namespace phy::rock
