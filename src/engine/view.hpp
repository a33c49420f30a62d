// The memory that the force loop works on, and nothing else: plain numbers behind plain pointers, so that the
// loop can be compiled once per instruction set while everything else is compiled once.
//
// Layout. Lane vectors are W numbers side by side, one per specimen. A grain is nine lane vectors, a contact
// as many as its model asks for; what all lanes share (the packing's geometry) is a scalar. Grains are sorted
// into horizontal rows, and a contact belongs to the row of its upper grain; it joins grains of that row or
// of the row below (docs/architecture.md, "Life of a step").
#pragma once
#include <cstddef>
#include <cstdint>

namespace phy::engine {

/// Lane vectors of a grain, in this order: forces first, then places and velocities, three components each.
/// Where one specimen has a group to itself, its loop reads and writes them four at a time (wide_loop.hpp).
enum GrainField { g_fx, g_fy, g_tq, g_ux, g_uy, g_rot, g_vx, g_vy, g_w, n_grain_fields };

/// Lane vectors of a contact: which of the two models it belongs to, then the fields of that model
/// (contact/models.hpp).
enum ContactField {
  c_side,  ///< 0 = matrix; +-1 = interface, and the side of its grains
  c_fields
};

/// Lane constants: numerics and walls of each specimen.
enum LaneField {
  l_extra_strength,  // added to strengths while breakage is off
  l_dt,              // time step
  l_accel,           // time step / grain density
  l_damping,         // local damping coefficient
  l_grips,           // 1 where the boundary's grips hold, else 0
  l_wall,            // the first of the parameters of grains against bodies (contact/wall.hpp)
  n_lane_fields = l_wall + 4
};

/// Sums over the specimen at the end of a block, in double.
enum SampleField {
  s_strain_linear,
  s_strain_bond,
  s_strain_joint,
  s_strain_wall,
  s_contact_force,
  s_contacts,
  s_unbalanced,
  s_kinetic,
  s_gauge_axial,
  s_gauge_lateral,
  s_overlap,
  n_sample_fields
};

template <class T>
struct GrainConst {
  T inv_area;     ///< of a disc 1/(pi r^2): acceleration = force / (density area)
  T inv_inertia;  ///< of a disc 2/(pi r^4)
  T radius;
  T gauge_x, gauge_y;  ///< weights of the least-squares strain gauge [1/m]
};

template <class T>
struct ContactConst {
  std::int32_t a, b;   ///< sorted grain numbers, row(a) <= row(b)
  std::int32_t joint;  ///< row of the interfaces' parameters, -1 when no lane has an interface here
  T X, Y, d0;          ///< initial branch vector a -> b and its length
  T gap;               ///< closure needed before the grains press on each other
  T lever_a, lever_b;  ///< R + initial gap / 2
};

/// A grain near a body. Sorted by row, body, grain.
template <class T>
struct TouchPoint {
  std::int32_t grain, body;
  T nx, ny;  ///< normal, into the specimen
  T rough;   ///< 1: the lane's body friction, 0: none
};

/// A grain that a body holds, by component. Sorted by row.
struct GripPoint {
  std::int32_t grain, body;
  bool x, y, rotation;
};

/// A component of a body that is in balance in some lane (boundary.hpp).
struct BalancePoint {
  std::int32_t body, component;  ///< 0: x, 1: y
  std::int32_t first, end;       ///< its touches along the component, in `balanced_touch`
};

struct RawCrack {
  std::int32_t step;  ///< within the block
  std::int32_t contact, lane;
  std::int32_t part;   ///< of the contact (contact/step.hpp)
  std::int32_t shear;  ///< 0 tension, 1 shear
  double energy;
};

template <class T>
struct ContactSlip {
  std::int32_t contact;
  T work;
};
/// Grains that as many contacts of a row push.
struct PushedGrains {
  std::int32_t n_pushes;
  std::int32_t first, end;  ///< in `pushed`
  std::int32_t first_push;  ///< in `pushes`
};

/// Contacts of one specimen in the lanes (wide_contacts.hpp): batches of contacts of one row and one model. A
/// place is a lane of a batch. Empty places hold contacts of a first grain with itself that never press.
template <class T>
struct WideView {
  const std::int32_t* row_batch = nullptr;  ///< first batch of each row, n_rows + 1
  const std::int32_t* joint = nullptr;      ///< per batch: row of the interfaces' parameters, -1: matrix
  const std::int32_t* contact = nullptr;    ///< per place: number of its contact
  const std::int32_t *a = nullptr, *b = nullptr;  ///< per place: its grains
  const std::int32_t* place = nullptr;      ///< per contact: its place, counted from the first of its row
  const std::int32_t* row_group = nullptr;  ///< first of each row in `group`, n_rows + 1
  const PushedGrains* group = nullptr;
  const std::int32_t* pushed = nullptr;  ///< grains
  const std::int32_t* pushes = nullptr;  ///< forces on them in the order of the contacts, places in `push`
  const T* constants = nullptr;     ///< per batch, lane vectors: those of WideConstant, then the geometry
  T* state = nullptr;               ///< per batch, lane vectors: fields of the contacts
  T* push = nullptr;                ///< per place of a row: forces on both grains, a record of eight numbers
  T* sums = nullptr;                ///< per sum and place of a row: what the contact adds to it
  ContactSlip<T>* slips = nullptr;  ///< of the contacts of a row that slip in a step: room for all
  std::size_t most_places = 0;      ///< of a row
};
/// Lane vectors of constants of a contact.
enum WideConstant { wide_X, wide_Y, wide_d0, wide_gap, wide_lever_a, wide_lever_b, n_wide_constants };
/// Sums over contacts where samples are taken.
enum WideSum { wide_linear, wide_bond, wide_joint, wide_overlap, wide_force, n_wide_sums };

template <class T>
struct GroupView {
  int n_rows = 0;
  const std::int32_t* row_grain = nullptr;    ///< first grain of each row, n_rows + 1
  const std::int32_t* row_contact = nullptr;  ///< first contact of each row, n_rows + 1
  const std::int32_t* row_touch = nullptr;    ///< first of each row in `touch`, n_rows + 1
  const std::int32_t* row_grip = nullptr;     ///< the same in `grip`
  const std::int32_t* row_load = nullptr;     ///< the same in `load`
  const GrainConst<T>* grain_const = nullptr;
  const ContactConst<T>* contact_const = nullptr;
  const T* geometry = nullptr;  ///< per contact: numbers of the matrix model, then of the interface model
  T* grain = nullptr;
  T* contact = nullptr;
  const T* lane = nullptr;
  const T* matrix = nullptr;  ///< parameters of the matrix model, lane vectors
  const T* joint = nullptr;   ///< rows of parameters of the interface model
  int n_bodies = 0, n_grains = 0;
  const TouchPoint<T>* touch = nullptr;
  const GripPoint* grip = nullptr;
  const std::int32_t* load = nullptr;  ///< grains that the jacket presses in some lane, sorted
  const T* load_force = nullptr;       ///< on each of them along x, then y, lane vectors
  const T* touch_gap = nullptr;        ///< per body and grain: closure needed before the body acts
  T* touch_shear = nullptr;            ///< per body and grain: shear force
  T* body_u = nullptr;                 ///< per step, body, component: displacement
  T* body_v = nullptr;                 ///< per step, body, component: velocity
  T* body_force = nullptr;             ///< per step, body, component: force on the specimen
  int n_balanced = 0;
  const BalancePoint* balanced = nullptr;
  const std::int32_t* balanced_touch = nullptr;  ///< places in `touch`
  const T* balance_on = nullptr;     ///< per body and component: 1 in the lanes that are in balance
  const T* balance_force = nullptr;  ///< per body and component: force on the specimen
  T* slip = nullptr;                 ///< per step: slip work
  T* damping = nullptr;              ///< per step: 2/dt times the work of local damping
  double* sample = nullptr;          ///< n_sample_fields lane vectors
  RawCrack* cracks = nullptr;
  std::size_t n_cracks = 0;    ///< found, also where there was no more room
  std::size_t max_cracks = 0;  ///< room for
  int skew = 8;                ///< cycles per sweep; does not change any bit
  WideView<T> wide;            ///< where one specimen has the group to itself
};

}  // namespace phy::engine
