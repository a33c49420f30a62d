// What a test leaves behind: a history, the cracks, snapshots, numbers with their definitions, and how it
// ended. Signs: compression and shortening positive. Units: SI.
#pragma once
#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/acoustic_event.hpp"
#include "records/recipe.hpp"
#include "records/specimen.hpp"
#include "records/wall_point.hpp"

namespace phy {

enum class CrackMode : std::uint8_t { tension, shear };
enum class CrackPlace : std::uint8_t { matrix, bedding };

/// One broken bond or joint.
struct CrackEvent {
  std::int64_t step = 0;
  double time = 0.0;           ///< [s]
  double strain = 0.0;         ///< axial_strain of the history
  std::uint32_t a = 0, b = 0;  ///< grains
  CrackMode mode = CrackMode::tension;
  CrackPlace place = CrackPlace::matrix;
  Vec2 position;        ///< contact point [m]
  Vec2 normal;          ///< of the broken bond, or of the bedding plane
  double size = 0.0;    ///< length of the broken bond 2 R_bar [m]
  double energy = 0.0;  ///< strain energy that the bond held [J per m thickness]
};

/// One row of a test's history. Energies per metre of thickness.
struct HistoryRow {
  double step = 0.0;
  double time = 0.0;                  ///< [s]
  double axial_strain = 0.0;          ///< from the platens
  double axial_strain_gauge = 0.0;    ///< least squares over the grains of the middle 60 %
  double lateral_strain_gauge = 0.0;  ///< same fit, shortening positive (so negative in compression)
  double axial_stress = 0.0;          ///< mean of both platens over the initial width [Pa]
  double stress_top = 0.0, stress_bottom = 0.0;  ///< [Pa]
  double lateral_strain = 0.0;     ///< of the side walls or the jacket; direct shear: normal to the plane
  double lateral_stress = 0.0;     ///< [Pa]
  double deviatoric_stress = 0.0;  ///< axial - lateral [Pa]
  double volumetric_strain = 0.0;  ///< axial + lateral, of the boundary; positive: denser
  double n_cracks = 0.0;
  double boundary_work = 0.0;  ///< done by the platens [J/m]
  double kinetic = 0.0;        ///< [J/m]
  double strain_linear = 0.0, strain_bond = 0.0, strain_joint = 0.0, strain_wall = 0.0;  ///< stored [J/m]
  double slip = 0.0;           ///< dissipated by friction so far [J/m]
  double damping = 0.0;        ///< dissipated by local damping so far [J/m]
  double released = 0.0;       ///< strain energy of broken bonds so far [J/m]
  double energy_error = 0.0;   ///< (work - all the above) / total boundary work so far
  double unbalanced = 0.0;     ///< mean unbalanced grain force / mean contact force
  double load = 0.0;           ///< mean force of the loading and the supporting tools [N/m]
  double mouth_opening = 0.0;  ///< of a notch, since loading began [m]
  double excavated = 0.0;      ///< of an opening: share of the traction on its wall that is taken away
  double closure = 0.0;        ///< of an opening: mean displacement of its wall inwards / radius
  double borne_stress = 0.0;   ///< by an opening: vertical stress times the share excavated [Pa]
};

struct History {
  TestKind kind;
  double width = 0.0, height = 0.0;  ///< initial size the strains refer to [m]
  std::vector<HistoryRow> rows;
};

/// A column of the history table: the single place that names it for CSV, reports and hashes. Every test has
/// columns of its own (records/test_description.hpp), made from these and its own.
struct HistoryColumn {
  const char* name;
  const char* unit;
  const char* meaning;
  double HistoryRow::*value;
};
using HistoryColumns = std::vector<HistoryColumn>;
const HistoryColumns& clock_columns();    ///< cycle and time: the first of every test
const HistoryColumns& gauge_columns();    ///< strains of the middle of the specimen
const HistoryColumns& balance_columns();  ///< cracks, energies, bookkeeping: the last of every test
HistoryColumns joined(std::initializer_list<HistoryColumns> parts);
/// "axial_strain [1]": a column in the head of a table.
std::string heading(const HistoryColumn& column);

/// `untrusted`: it has a strength, but a measure of quality is so bad that its numbers are none of the rock
/// (quality.hpp). `solved`, `unsolved`: by the direct elastic solution, which knows no peak. `knee`: it
/// shows a knee and no peak; its strength is there (analysis/strength_rule.hpp).
enum class Status {
  peaked,
  not_peaked,
  not_settled,
  unstable,
  interrupted,
  untrusted,
  solved,
  unsolved,
  knee
};
constexpr Status all_statuses[] = {Status::peaked,   Status::not_peaked,  Status::not_settled,
                                   Status::unstable, Status::interrupted, Status::untrusted,
                                   Status::solved,   Status::unsolved,    Status::knee};
/// A test in time that has found a strength.
constexpr bool has_strength(Status status) { return status == Status::peaked || status == Status::knee; }
/// Its numbers are those of the rock.
constexpr bool has_answer(Status status) { return has_strength(status) || status == Status::solved; }
const char* to_string(Status status);
/// The status of that name; nothing: there is none.
std::optional<Status> status_of(std::string_view name);

/// How a test ended. Not an error: it is stored like any other result.
struct Outcome {
  Status status = Status::interrupted;
  std::string reason;  ///< what happened, with numbers
  std::string advice;  ///< which setting to change, empty when all went well
};

/// A result with its unit and the definition used.
struct Number {
  std::string name;    ///< "E_tangent", "ucs", ...
  double value = 0.0;  ///< SI; NaN = could not be determined, see note
  std::string unit;
  std::string definition;
  std::string note;
  bool upper_bound = false;  ///< the value is one, and the note says why; a store does not keep this
};

/// Grains and contacts at one moment.
struct GrainState {
  double ux = 0.0, uy = 0.0, rotation = 0.0;  ///< since the start of the test [m, m, rad]
};
struct ContactState {
  std::uint32_t a = 0, b = 0;
  ContactKind kind = ContactKind::touching;
  bool broken = false;          ///< a bond or joint that has broken
  double F_n = 0.0, F_s = 0.0;  ///< compression positive [N/m]
  Vec2 normal;
};
struct Snapshot {
  double step = 0.0;
  double axial_strain = 0.0, axial_stress = 0.0;
  std::vector<GrainState> grains;  ///< packing order
  std::vector<ContactState> contacts;
};

/// Displacements of all grains at one moment, for pictures; not part of the hash.
struct Frame {
  double step = 0.0;
  double axial_strain = 0.0, axial_stress = 0.0;  ///< [1], [Pa]
  std::vector<std::array<float, 2>> u;            ///< since the start of the test [m], packing order
};

struct TestResult {
  std::string name;  ///< specimen name
  TestKind kind;
  bool intact = true;
  double theta = 0.0;  ///< [deg] of bedding[0]
  Outcome outcome;
  std::vector<Number> numbers;
  History history;
  std::vector<CrackEvent> cracks;     ///< ordered by (step, a, b)
  std::vector<AcousticEvent> events;  ///< ordered by time; empty where the recipe asks for none
  std::vector<WallPoint> wall;        ///< of an opening, by moment and angle; empty of other tests
  std::vector<Snapshot> snapshots;    ///< the last one is the final state
  std::vector<Frame> frames;          ///< more of them, displacements only
  double dt = 0.0;                    ///< [s] at the start
  std::int64_t n_steps = 0;
  std::int64_t n_contacts = 0;  ///< bonded, joint or touching at the start
  std::int64_t n_grains = 0;    ///< of the specimen; not stored
  double seconds = 0.0;         ///< thread CPU time share of this specimen
  std::string hash;             ///< bits of history, cracks and final positions
};

/// Names of the columns that the hash of a history covers, in this order: clock, those of the test, balance.
std::vector<std::string> hashed_fields(std::initializer_list<const char*> of_the_test);

}  // namespace phy
