#include "engine/group.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/check.hpp"
#include "contact/wall.hpp"

namespace phy::engine::group {
namespace {

template <class T>
Kernel<T> kernel_of(const ContactPhysics& contacts, const GroupOptions& options) {
  if constexpr (std::is_same_v<T, double>) return contacts.double_kernel(options.isa, options.lanes);
  if constexpr (std::is_same_v<T, float>) return contacts.float_kernel(options.isa, options.lanes);
}

}  // namespace

template <class T>
Group<T>::Group(std::shared_ptr<const Packing> packing, const GroupOptions& options)
    : options_(options),
      W_(static_cast<std::size_t>(options.lanes)),
      kernel_(kernel_of<T>(*options.contacts, options)),
      lanes_(W_),
      grains_(std::move(packing), W_, options.inertia),
      list_(grains_),
      contacts_(grains_, options.contacts->models),
      boundary_(grains_, options.interval) {
  // Buffers of steps are allocated once; nothing is allocated while the loop runs.
  PHY_CHECK(kernel_.advance != nullptr, "no kernel is built for this number of lanes");
  const contact::Models& models = contacts_.models();
  if (kernel_.contacts > 1)
    wide_.emplace(static_cast<std::size_t>(kernel_.contacts), models.n_geometry(),
                  c_fields + models.n_fields());
  lane_table_.assign(n_lane_fields * W_);
  sample_.assign(n_sample_fields * W_);
  slip_.assign(n_steps() * W_);
  damping_.assign(n_steps() * W_);
}

template <class T>
LaneSpecimens Group<T>::specimens() const {
  LaneSpecimens all;
  for (const Lane& lane : lanes_) all.push_back(lane.specimen.get());
  return all;
}

template <class T>
void Group<T>::clear(int lane) {
  const std::size_t l = index(lane);
  // Zeros everywhere: an empty lane takes part in all operations and adds nothing.
  lanes_[l] = Lane{};
  grains_.clear(l);
  list_.clear(l);
  contacts_.clear(l);
  boundary_.clear(l);
  dirty_ = true;
}

/// Constants of a contact are those of all lanes.
template <class T>
void Group<T>::check_neighbour(const Specimen& specimen) const {
  // Same packing: the lanes share initial branch vectors and rows. Same contact geometry: it is stored once
  // per contact, not per lane.
  PHY_CHECK(specimen.packing->hash == grains_.packing().hash, "lanes of a group share one packing");
  for (const contact::ContactModel* model : {contacts_.models().matrix, contacts_.models().interface}) {
    PHY_CHECK(model->describes(specimen.matrix, specimen.bedding),
              "a group has the contact models of its specimens");
    for (const Lane& l : lanes_)
      PHY_CHECK(!l.specimen || model->same_geometry(l.specimen->matrix, specimen.matrix),
                "lanes of a group share the geometry of their contacts");
  }
}

template <class T>
void Group<T>::load(int lane, std::shared_ptr<const Specimen> specimen, const LaneSetup& setup) {
  clear(lane);
  check_neighbour(*specimen);
  const std::size_t l = index(lane);
  Lane& info = lanes_[l];
  info.setup = setup;
  // Contacts are installed with the next list: only then all pairs have places.
  info.fresh = true;
  info.unbreakable = specimen->matrix.unbreakable;
  if (!info.setup.boundary) info.setup.boundary = std::make_shared<const Boundary>();
  boundary_.adopt(info.boundary());
  LaneBoundary& edge = boundary_.lane(l);
  edge.boundary = info.setup.boundary;
  edge.bodies.resize(info.boundary().bodies.size());
  edge.damping = setup.damping, edge.density = specimen->matrix.density;
  // The bound comes first, it gives the time step.
  info.bound.emplace(*specimen, initial_stiffnesses(contacts_.models(), *specimen), grains_.inertia(),
                     info.boundary(), info.setup.body_friction);
  for (const Contact& c : specimen->contacts) {
    // Those without a bond are in the list like pairs that meet later, and are counted once.
    if (c.kind == ContactKind::touching)
      info.created.emplace(grains_.key(c.a, c.b), initial_stiffness(contacts_.models(), *specimen, c));
    const Disc& a = grains_.packing().discs[c.a];
    const Disc& b = grains_.packing().discs[c.b];
    const bool touches = norm(Vec2{b.x - a.x, b.y - a.y}) <= a.r + b.r;
    info.n_contacts += c.kind != ContactKind::touching || touches ? 1 : 0;
  }
  info.specimen = std::move(specimen);
  set_step(l);
}

/// A running specimen changes its group: what belongs to its lane is copied. What both groups derive from
/// their lanes (lists, tables, constants) is made anew before their next block. A lane's bits never depended
/// on its group, so none changes.
template <class T>
void Group<T>::move_lane(int lane, LaneGroup& target, int to_lane) {
  auto* const to = dynamic_cast<Group<T>*>(&target);
  PHY_CHECK(to != nullptr && to != this && to->options_.interval == options_.interval &&
                to->options_.inertia == options_.inertia,
            "a lane moves between groups of one precision, masses and block");
  PHY_CHECK(at(lane).specimen && !to->at(to_lane).specimen, "a specimen moves into an empty lane");
  to->check_neighbour(*at(lane).specimen);
  const std::size_t from = index(lane), into = index(to_lane);
  // The target may never have had a boundary: adopt() makes its buffers before the lane is copied into them.
  to->boundary_.adopt(at(lane).boundary());
  to->at(to_lane) = at(lane);
  contacts_.copy(from, to->contacts_, into);
  grains_.copy(from, to->grains_, into);
  boundary_.copy(from, to->boundary_, into);
  // The target's list knows nothing of this lane: forget() forces a search at its next block.
  to->list_.forget(into);
  to->dirty_ = true;
  clear(lane);
}

template <class T>
void Group<T>::set_motion(int lane, std::uint32_t id, const GrainState& state, Vec2 velocity, double spin) {
  const std::size_t g = grains_.sorted_id(id), l = index(lane);
  grains_.set(g, g_ux, l, state.ux);
  grains_.set(g, g_uy, l, state.uy);
  grains_.set(g, g_rot, l, state.rotation);
  grains_.set(g, g_vx, l, velocity.x);
  grains_.set(g, g_vy, l, velocity.y);
  grains_.set(g, g_w, l, spin);
}

/// The field's energy is work of the laboratory: it enters the balance as such.
template <class T>
void Group<T>::start_moving(int lane, const std::function<Vec2(Vec2)>& velocity) {
  const std::size_t l = index(lane);
  Lane& info = lanes_[l];
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    const Vec2 v = velocity(grains_.start(g));
    grains_.set(g, g_vx, l, v.x);
    grains_.set(g, g_vy, l, v.y);
    info.energy.work += 0.5 * grains_.mass(g, info.specimen->matrix.density) * dot(v, v);
  }
}

template <class T>
void Group<T>::pre_strain(int lane, double axial_strain) {
  // Contacts have to exist before their affine start is set. Compression is positive: the specimen becomes
  // shorter along y and wider along x, about its centre.
  if (dirty_) rebuild();
  const std::size_t l = index(lane);
  Lane& info = lanes_[l];
  constexpr double lateral = 0.25;  // Poisson's ratio, a guess; the damped cycles that follow correct it
  const Packing& packing = grains_.packing();
  const auto field = [&](Vec2 x) {
    return Vec2{lateral * axial_strain * (x.x - 0.5 * packing.width),
                -axial_strain * (x.y - 0.5 * packing.height)};
  };
  for (std::size_t g = 0; g < grains_.size(); ++g) {
    const Vec2 u = field(grains_.start(g));
    grains_.set(g, g_ux, l, u.x);
    grains_.set(g, g_uy, l, u.y);
  }
  // Bodies go along with the ends of the specimen, so that the pre-strain opens or closes no gap there.
  const LoadAxis& axis = info.boundary().axial;
  const Vec2 closing = 0.5 * axial_strain * packing.height * axis.direction;
  std::vector<BodyMotion>& bodies = boundary_.lane(l).bodies;
  bodies[static_cast<std::size_t>(axis.lo)].state.displacement = closing;
  bodies[static_cast<std::size_t>(axis.hi)].state.displacement = -1.0 * closing;
  // What a contact remembers, such as a shear force, is summed from increments: displacing the grains alone
  // would leave it unchanged.
  contacts_.affine_start(l, *info.specimen, field);
  info.energy.settle();
  dirty_ = true;
}

template <class T>
bool Group<T>::at_strength(int lane) const {
  const std::size_t l = index(lane);
  const auto reached = [](const contact::ContactModel& model, const contact::Standing& now) {
    return model.at_strength(now);
  };
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (contacts_.with(c, l, *lanes_[l].specimen, reached)) return true;
  return false;
}

template <class T>
void Group<T>::place_boundary(int lane) {
  const std::size_t l = index(lane);
  // The test begins here: time, gauge strains, energies and cracks of the settling before it do not count.
  Lane& info = lanes_[l];
  boundary_.place(l);
  info.energy.begin(info.row);
  info.time = 0.0;
  info.step = 0;
  info.base_axial = info.row.axial_strain_gauge;
  info.base_lateral = info.row.lateral_strain_gauge;
  info.zero_travel = 0.0;
  info.cracks.clear();
  info.row = HistoryRow{};
  dirty_ = true;
}

template <class T>
void Group<T>::fill_lane_table() {
  for (std::size_t l = 0; l < W_; ++l) {
    const auto put = [&](int field, double value) {
      lane_table_[static_cast<std::size_t>(field) * W_ + l] = T(value);
    };
    for (int f = 0; f < n_lane_fields; ++f) put(f, 0.0);
    // Defaults for an empty lane: with dt and dt/density zero nothing in it moves.
    const Lane& lane = lanes_[l];
    const MatrixRecipe m = lane.specimen ? lane.specimen->matrix : MatrixRecipe{};
    double wall[contact::wall::n_parameters];
    contact::wall::parameters(m, lane.setup.body_friction, wall);
    for (int i = 0; i < contact::wall::n_parameters; ++i) put(l_wall + i, wall[i]);
    // Breakage is switched off by strengths out of reach, not by a branch.
    put(l_extra_strength, lane.unbreakable ? contact::unlimited : 0.0);
    if (!lane.specimen) continue;
    // Grips hold from the moment when the boundary is placed; before, grains are free to settle.
    put(l_grips, boundary_.lane(l).placed ? 1.0 : 0.0);
    put(l_dt, lane.dt), put(l_accel, lane.dt / m.density), put(l_damping, lane.setup.damping);
  }
  contacts_.fill_matrix_parameters(specimens());
}

template <class T>
GroupView<T> Group<T>::view() {
  GroupView<T> v;
  v.n_rows = grains_.layout().n_rows();
  v.n_grains = static_cast<int>(grains_.size());
  v.row_grain = grains_.layout().row_grain.data();
  v.grain_const = grains_.constants(), v.grain = grains_.data();
  contacts_.enter(v);
  boundary_.enter(v);
  v.lane = lane_table_.get();
  v.slip = slip_.get(), v.damping = damping_.get(), v.sample = sample_.get();
  // Room for the most cracks that a block can give: the loop only writes. If contacts join distant rows,
  // cycles cannot overlap (sweep.hpp).
  raw_cracks_.resize(contacts_.size() * W_ * contacts_.models().n_cracks());
  v.cracks = raw_cracks_.data(), v.max_cracks = raw_cracks_.size();
  v.skew = contacts_.far_rows() ? 1 : options_.skew;
  return v;
}

template <class T>
void Group<T>::run(GroupView<T>& view) {
  if (!wide_) return kernel_.advance(view, options_.interval);
  if (std::exchange(rearranged_, false)) wide_->arrange(view);
  wide_->enter(view);
  kernel_.advance(view, options_.interval);
  wide_->leave(view);
}

template <class T>
GroupView<T> Group<T>::run_block() {
  fill_lane_table();
  boundary_.plan();
  std::fill_n(sample_.get(), n_sample_fields * W_, 0.0);
  std::fill_n(slip_.get(), n_steps() * W_, T(0));
  std::fill_n(damping_.get(), n_steps() * W_, T(0));
  GroupView<T> v = view();
  run(v);
  // Displacements of bodies in balance are needed for the work.
  boundary_.read_balance();
  return v;
}

template <class T>
void Group<T>::keep() {
  grains_.keep(kept_.grains), contacts_.keep(kept_.contacts), boundary_.keep(kept_.boundary);
}

template <class T>
void Group<T>::restore() {
  grains_.restore(kept_.grains), contacts_.restore(kept_.contacts), boundary_.restore(kept_.boundary);
}

/// A grain that went farther than the lane's list reaches has met another, or a body, that it may not have
/// been held against. A pair of which one has gone too far for any list is left to the watchdog.
template <class T>
bool Group<T>::outran(std::size_t l, double farthest_way) const {
  const std::optional<PairKey> missed = missed_pair(l, farthest_way);
  if (!missed) return farthest_way > list_.usual_range() && boundary_.missed(l, list_);
  return !list_.too_far(l, static_cast<std::size_t>(key_a(*missed))) &&
         !list_.too_far(l, static_cast<std::size_t>(key_b(*missed)));
}

/// Lanes with such grains: from where the block began they need another list, which reaches as far as their
/// grains went in the blocks that failed.
template <class T>
bool Group<T>::some_outran(std::vector<int>& repeats) {
  constexpr int most_repeats = 3;  // of a block: who meets another grain flies elsewhere
  const auto most = list_.farthest();
  bool some = false;
  for (std::size_t l = 0; l < W_; ++l) {
    if (!may_outrun(l) || repeats[l] == most_repeats || !outran(l, most.moved[l])) continue;
    ++repeats[l];
    std::vector<double> way(grains_.size());
    for (std::size_t g = 0; g < way.size(); ++g) {
      const T* const before = kept_.grains.data() + g * n_grain_fields * W_ + l;
      const Vec2 began{static_cast<double>(before[g_ux * W_]), static_cast<double>(before[g_uy * W_])};
      way[g] = norm(grains_.displacement(g, l) - began);
    }
    list_.forget(l), list_.expect(l, way);
    some = true;
  }
  return some;
}

template <class T>
void Group<T>::advance() {
  // The order matters. The jacket may demand a new list; a new list may create contacts, which change the
  // time step that the lane table and the motion of bodies are made with; bodies in balance refer to the
  // points that the list has found.
  dirty_ = boundary_.fit_jackets(list_) || dirty_;
  if (dirty_) rebuild();
  bool may = false;
  for (std::size_t l = 0; l < W_; ++l) may = may || may_outrun(l);
  if (may) keep();
  GroupView<T> v = run_block();
  for (std::vector<int> repeats(W_); may && some_outran(repeats);) {
    restore();
    rebuild(true);
    keep();  // the contacts have other places
    v = run_block();
  }
  list_.accept();
  // Cracks in their fixed order for the sum of released energy.
  sort_cracks(v);
  // Judged before anything is created or renewed: the watchdog asks what the list of this block has missed.
  const auto most = list_.farthest();
  for (std::size_t l = 0; l < W_; ++l) {
    if (!lanes_[l].specimen) continue;
    keep_energy(l);
    const HistoryRow before = lanes_[l].row;
    write_row(l);
    watch(l, before, most.moved[l]);
  }
  // Created contacts may shorten the time step; whether the list lasts is asked for the next block's length.
  create_contacts();
  for (std::size_t l = 0; l < W_ && !dirty_; ++l)
    if (lanes_[l].specimen)
      dirty_ = list_.outlived(l, most, block(l), boundary_.reach(l, most.speed[l], block(l)));
}

template <class T>
Snapshot Group<T>::snapshot(int lane) const {
  const std::size_t l = index(lane);
  Snapshot shot;
  shot.step = lanes_[l].row.step;
  shot.grains = grains(lane);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const ContactState s = contacts_.state(c, l, *lanes_[l].specimen);
    // Listed pairs that do not touch are no contacts to anyone outside.
    if (s.kind != ContactKind::touching || s.F_n != 0.0) shot.contacts.push_back(s);
  }
  return shot;
}

template class Group<double>;
template class Group<float>;

}  // namespace phy::engine::group

namespace phy::engine {

std::unique_ptr<LaneGroup> make_group(std::shared_ptr<const Packing> packing, const GroupOptions& options) {
  if (options.precision == Precision::single_precision)
    return std::make_unique<group::Group<float>>(std::move(packing), options);
  return std::make_unique<group::Group<double>>(std::move(packing), options);
}

}  // namespace phy::engine
