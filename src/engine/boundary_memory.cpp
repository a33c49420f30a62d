#include "engine/boundary_memory.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace phy::engine::group {
namespace {

// Gains of the servo (boundary.hpp): shares of the missing displacement, once as a direct correction and once
// added to the remembered displacement per block.
constexpr double servo_proportional = 0.6;
constexpr double servo_integral = 0.2;
constexpr double far_away = 1.0;  // m: gap of a body that is not there

/// One component of the servo (boundary.hpp): displacement per block from the mean force of the last one.
double servo_step(const Servo& servo, double mean_force, double displacement, double& memory, double block) {
  const double missing = (servo.force - servo.spring * displacement - mean_force) / servo.stiffness;
  const double most = servo.max_speed * block;
  memory = std::clamp(memory + servo_integral * missing, -most, most);
  return std::clamp(memory + servo_proportional * missing, -most, most);
}

/// Upper bound of a body's speed. In balance it is at most that of the fastest grain: moving all grains that
/// it touches moves it by as much.
double fastest_body(const BodyMotion& body, double fastest_grain) {
  const PrescribedMotion& d = body.prescribed;
  const double before = body.motion_time < d.ramp ? norm(d.before) : 0.0;
  return std::max(norm(d.velocity), before) + (d.servo_x.on ? d.servo_x.max_speed : 0.0) +
         (d.servo_y.on ? d.servo_y.max_speed : 0.0) +
         (d.balance_x.on || d.balance_y.on ? fastest_grain : 0.0);
}

}  // namespace

/// Row tables exist from the start, all zero: a group without boundary runs through the same loop and finds
/// empty ranges.
template <class T>
BoundaryMemory<T>::BoundaryMemory(const GrainMemory<T>& grains, int interval)
    : grains_(&grains),
      W_(grains.lanes()),
      n_steps_(static_cast<std::size_t>(interval)),
      lanes_(W_),
      row_touch_(static_cast<std::size_t>(grains.layout().n_rows()) + 1, 0),
      row_grip_(row_touch_),
      row_load_(row_touch_) {}

/// A gap that no motion closes stands for "no contact": the loop needs no branch for lanes without a body.
template <class T>
void BoundaryMemory<T>::clear(std::size_t l) {
  lanes_[l] = {};
  for (std::size_t p = 0; p < n_bodies_ * grains_->size(); ++p) {
    touch_gap_[p * W_ + l] = T(far_away);
    touch_shear_[p * W_ + l] = T(0);
  }
}

template <class T>
void BoundaryMemory<T>::copy(std::size_t l, BoundaryMemory<T>& to, std::size_t to_lane) const {
  to.lanes_[to_lane] = lanes_[l];
  for (std::size_t place = 0; place < n_bodies_ * grains_->size(); ++place) {
    to.touch_gap_[place * to.W_ + to_lane] = touch_gap_[place * W_ + l];
    to.touch_shear_[place * to.W_ + to_lane] = touch_shear_[place * W_ + l];
  }
}

/// Lanes of a group share the geometry of their boundary: it follows from the packing and the kind of test.
template <class T>
void BoundaryMemory<T>::adopt(const Boundary& boundary) {
  // The group's first specimen decides the geometry and the size of all buffers; later ones have to match it,
  // since one list of touches serves all lanes.
  if (boundary.bodies.empty() && !boundary.jacket.present()) return;
  if (n_bodies_ > 0 || jacket_.present()) {
    PHY_CHECK(boundary.bodies.size() == n_bodies_ && boundary.jacket.sides == jacket_.sides &&
                  boundary.jacket.hole.radius == jacket_.hole.radius,
              "lanes share one boundary");
    return;
  }
  jacket_ = boundary.jacket;
  n_bodies_ = boundary.bodies.size();
  const std::size_t per_step = n_steps_ * n_bodies_ * 2 * W_, n = grains_->size();
  // Motion and force of every step of a block are kept, not sums: the work is a sum over steps, and a crack
  // is given the travel of its own step.
  body_u_.assign(per_step), body_v_.assign(per_step), body_force_.assign(per_step), body_du_.assign(per_step);
  balance_on_.assign(n_bodies_ * 2 * W_), balance_force_.assign(n_bodies_ * 2 * W_);
  touch_gap_.assign(n_bodies_ * n * W_);
  touch_shear_.assign(n_bodies_ * n * W_);
  std::fill_n(touch_gap_.get(), n_bodies_ * n * W_, T(far_away));
  touch_normal_.assign(n_bodies_ * n, Vec2{});
  for (std::size_t t = 0; t < n_bodies_; ++t)
    for (const Touch& p : boundary.bodies[t].touches)
      touch_normal_[t * n + grains_->sorted_id(p.grain)] = p.normal;
  list_grips(boundary);
}

template <class T>
void BoundaryMemory<T>::list_grips(const Boundary& boundary) {
  for (std::size_t t = 0; t < n_bodies_; ++t)
    for (const Grip& p : boundary.bodies[t].grips)
      grip_.push_back({static_cast<std::int32_t>(grains_->sorted_id(p.grain)), static_cast<std::int32_t>(t),
                       p.x, p.y, p.rotation});
  // Sorted by grain, so that the grips of a row are one range. Stable: where bodies share a grain, the order
  // of the bodies stays, and with it the order of the sums.
  std::stable_sort(grip_.begin(), grip_.end(),
                   [](const GripPoint& p, const GripPoint& q) { return p.grain < q.grain; });
  for (std::size_t row = 0; row < row_grip_.size(); ++row)
    row_grip_[row] = static_cast<std::int32_t>(
        std::partition_point(grip_.begin(), grip_.end(),
                             [&](const GripPoint& p) { return p.grain < grains_->layout().row_grain[row]; }) -
        grip_.begin());
}

/// The ramp of a velocity starts again with every new prescription.
template <class T>
void BoundaryMemory<T>::prescribe(std::size_t l, std::size_t body, const PrescribedMotion& prescribed) {
  BodyMotion& motion = lanes_[l].bodies[body];
  motion.prescribed = prescribed;
  motion.motion_time = 0.0;
}

template <class T>
void BoundaryMemory<T>::place_body(std::size_t body, std::size_t l) {
  const std::size_t n = grains_->size();
  std::vector<double> gap(n, far_away);
  for (const Touch& p : lanes_[l].boundary->bodies[body].touches) gap[grains_->sorted_id(p.grain)] = p.gap;
  const Vec2* normal = touch_normal_.data() + body * n;
  // Mean displacement along the normal of the grains that touch from the start: by so much the surface has
  // moved away from the body since the packing was made.
  double sum = 0.0, count = 0.0;
  for (std::size_t g = 0; g < n; ++g)
    if (gap[g] <= 0.0) sum += dot(normal[g], grains_->displacement(g, l)), count += 1.0;
  const double mean = count > 0.0 ? sum / count : 0.0;
  for (std::size_t g = 0; g < n; ++g) {
    // closure = n.(U - u) - gap with U = 0 now (body_loop.hpp). -u makes it exactly zero where a grain
    // touches from the start. The others keep their gap from the surface as it has moved, but never less than
    // -u: nothing may be pressed before anything has moved.
    const double u = dot(normal[g], grains_->displacement(g, l));
    const std::size_t place = (body * n + g) * W_ + l;
    touch_gap_[place] = T(gap[g] <= 0.0 ? -u : std::max(gap[g] - mean, -u));
    touch_shear_[place] = T(0);
  }
}

template <class T>
void BoundaryMemory<T>::place(std::size_t l) {
  LaneBoundary& lane = lanes_[l];
  for (std::size_t t = 0; t < lane.boundary->bodies.size(); ++t) place_body(t, l);
  lane.bodies.assign(n_bodies_, BodyMotion{});
  lane.placed = true;
  lane.sides.swept = lane.hole.swept = 0.0;
}

template <class T>
void BoundaryMemory<T>::add_work(std::size_t l, double& work) {
  LaneBoundary& lane = lanes_[l];
  for (BodyMotion& t : lane.bodies) t.state.mean_force = {};
  for (std::size_t s = 0; s < n_steps_; ++s) {
    // Trapezoidal rule: mean of the forces before and after a step times the displacement in it. The force
    // before the first step is that of the last block's end.
    for (std::size_t t = 0; t < lane.bodies.size(); ++t) {
      BodyState& state = lane.bodies[t].state;
      const Vec2 force = body_vector(body_force_, s, t, l);
      const std::size_t i = body_at(s, t, l);
      work += dot(0.5 * (state.force + force), {body_du_[i], body_du_[i + W_]});
      state.force = force;
      state.mean_force = state.mean_force + (1.0 / static_cast<double>(n_steps_)) * force;
    }
  }
  if (!lane.placed) return;
  if (jacket_.sides) add_work(lane.sides, l, work);
  if (jacket_.hole.radius > 0.0) add_work(lane.hole, l, work);
}

template <class T>
bool BoundaryMemory<T>::missed(std::size_t l, const NeighbourList<T>& list) const {
  if (!acts(l)) return false;
  for (std::size_t g = 0; g < grains_->size(); ++g) {
    if (!list.beyond_range(l, g) || list.too_far(l, g)) continue;
    for (std::size_t body = 0; body < n_bodies_; ++body) {
      const std::size_t at = body * grains_->size() + g;
      const Vec2 n = touch_normal_[at];
      const Vec2 way = lanes_[l].bodies[body].state.displacement - grains_->displacement(g, l);
      if (dot(n, n) > 0.0 && dot(n, way) > static_cast<double>(touch_gap_[at * W_ + l])) return true;
    }
  }
  return false;
}

/// A point is listed for all lanes if any lane may need it; in the others its gap stays open and it adds
/// zero.
template <class T>
bool BoundaryMemory<T>::near(std::size_t body, std::size_t g, const NeighbourList<T>& list) const {
  const Vec2 n = touch_normal_[body * grains_->size() + g];
  if (n.x == 0.0 && n.y == 0.0) return false;
  // usual_range() is the part that the body may come nearer, range() what the grain may:
  // NeighbourList::outlived() renews the list before the two together are used up.
  for (std::size_t l = 0; l < W_; ++l) {
    if (!acts(l)) continue;
    const double gap = static_cast<double>(touch_gap_[(body * grains_->size() + g) * W_ + l]);
    const double reach = list.usual_range() + list.range(l, g);
    if (dot(n, lanes_[l].bodies[body].state.displacement - grains_->displacement(g, l)) - gap > -reach)
      return true;
  }
  return false;
}

template <class T>
void BoundaryMemory<T>::list_touches(const NeighbourList<T>& list) {
  touch_.clear();
  const Boundary* boundary = nullptr;
  for (std::size_t l = W_; l-- > 0;) {
    for (BodyMotion& t : lanes_[l].bodies) t.listed_at = t.state.displacement;
    // Counting down, so that the lowest lane's boundary is kept; all lanes have the same one.
    if (acts(l)) boundary = lanes_[l].boundary.get();
  }
  const std::vector<std::int32_t>& row_grain = grains_->layout().row_grain;
  for (std::size_t row = 0; row + 1 < row_touch_.size(); ++row) {
    row_touch_[row] = static_cast<std::int32_t>(touch_.size());
    // Row by row, then body by body: the loop keeps a body's sums over a row in registers and adds them once.
    if (boundary == nullptr) continue;
    for (std::size_t body = 0; body < n_bodies_; ++body)
      for (auto g = static_cast<std::size_t>(row_grain[row]);
           g < static_cast<std::size_t>(row_grain[row + 1]); ++g) {
        if (!near(body, g, list)) continue;
        const Vec2 n = touch_normal_[body * grains_->size() + g];
        touch_.push_back({static_cast<std::int32_t>(g), static_cast<std::int32_t>(body), T(n.x), T(n.y),
                          T(boundary->bodies[body].rough ? 1 : 0)});
      }
  }
  row_touch_.back() = static_cast<std::int32_t>(touch_.size());
}

/// Velocity of a body in the next block at full speed; 0 where it is in balance.
template <class T>
Vec2 BoundaryMemory<T>::block_velocity(LaneBoundary& lane, BodyMotion& body) const {
  const double block = lane.dt * static_cast<double>(n_steps_);
  const PrescribedMotion& d = body.prescribed;
  const BodyState& s = body.state;
  Vec2 v{d.balance_x.on ? 0.0 : d.velocity.x, d.balance_y.on ? 0.0 : d.velocity.y};
  if (d.servo_x.on)
    v.x = servo_step(d.servo_x, s.mean_force.x, s.displacement.x, body.memory.x, block) / block;
  if (d.servo_y.on)
    v.y = servo_step(d.servo_y, s.mean_force.y, s.displacement.y, body.memory.y, block) / block;
  return v;
}

/// What the loop has to know of bodies in balance: planned at rest, they are moved by it.
template <class T>
void BoundaryMemory<T>::plan_balance() {
  balanced_.clear(), balanced_touch_.clear();
  for (std::size_t t = 0; t < n_bodies_; ++t)
    for (std::size_t c = 0; c < 2; ++c) {
      bool any = false;
      for (std::size_t l = 0; l < W_; ++l) {
        const std::size_t i = body_at(0, t, l) + c * W_;
        // A lane without a boundary has no bodies; it is not in balance.
        const PrescribedMotion d =
            t < lanes_[l].bodies.size() ? lanes_[l].bodies[t].prescribed : PrescribedMotion{};
        const Balance& b = c == 0 ? d.balance_x : d.balance_y;
        balance_on_[i] = T(b.on ? 1 : 0), balance_force_[i] = T(b.force);
        any = any || b.on;
      }
      if (!any) continue;
      const auto first = static_cast<std::int32_t>(balanced_touch_.size());
      for (std::size_t i = 0; i < touch_.size(); ++i)
        // Touches without a component along this axis change neither its force nor its stiffness.
        if (touch_[i].body == static_cast<std::int32_t>(t) && (c == 0 ? touch_[i].nx : touch_[i].ny) != T(0))
          balanced_touch_.push_back(static_cast<std::int32_t>(i));
      balanced_.push_back({static_cast<std::int32_t>(t), static_cast<std::int32_t>(c), first,
                           static_cast<std::int32_t>(balanced_touch_.size())});
    }
}

/// plan_lane() has left these components at rest, so the state still holds the displacement at the start of
/// the block. Steps are differences of what the loop stored: the work then fits the motion that it used.
template <class T>
void BoundaryMemory<T>::read_balance() {
  for (const BalancePoint& p : balanced_) {
    const auto body = static_cast<std::size_t>(p.body), c = static_cast<std::size_t>(p.component);
    for (std::size_t l = 0; l < W_; ++l) {
      if (balance_on_[body_at(0, body, l) + c * W_] == T(0)) continue;
      Vec2& displacement = lanes_[l].bodies[body].state.displacement;
      double& u = c == 0 ? displacement.x : displacement.y;
      for (std::size_t s = 0; s < n_steps_; ++s) {
        const std::size_t i = body_at(s, body, l) + c * W_;
        const auto now = static_cast<double>(body_u_[i]);
        body_du_[i] = now - u;
        u = now;
      }
    }
  }
}

template <class T>
void BoundaryMemory<T>::plan_lane(std::size_t l) {
  LaneBoundary& lane = lanes_[l];
  for (std::size_t t = 0; t < lane.bodies.size(); ++t) {
    BodyMotion& body = lane.bodies[t];
    const PrescribedMotion& d = body.prescribed;
    const Vec2 full = block_velocity(lane, body);
    for (std::size_t s = 0; s < n_steps_; ++s) {
      // Velocities belong to half steps (leap-frog), so the ramp is read half a step on. A servo has no ramp:
      // its speed answers to a force.
      const double fraction = d.ramp > 0.0 ? std::min(1.0, (body.motion_time + 0.5 * lane.dt) / d.ramp) : 1.0;
      const Vec2 ramped = fraction < 1.0 ? d.before + fraction * (full - d.before) : full;
      const Vec2 v{d.servo_x.on ? full.x : ramped.x, d.servo_y.on ? full.y : ramped.y};
      const Vec2 du = lane.dt * v;
      body.motion_time += lane.dt;
      body.state.displacement = body.state.displacement + du;
      const std::size_t i = body_at(s, t, l);
      body_du_[i] = du.x, body_du_[i + W_] = du.y;
      body_v_[i] = T(v.x), body_v_[i + W_] = T(v.y);
      body_u_[i] = T(body.state.displacement.x), body_u_[i + W_] = T(body.state.displacement.y);
    }
  }
}

template <class T>
void BoundaryMemory<T>::plan() {
  plan_balance();
  // The loop adds to these sums.
  std::fill_n(body_force_.get(), n_steps_ * n_bodies_ * 2 * W_, T(0));
  for (std::size_t l = 0; l < W_; ++l) plan_lane(l);
}

template <class T>
double BoundaryMemory<T>::reach(std::size_t l, double fastest_grain, double block) const {
  double most = 0.0;
  for (const BodyMotion& t : lanes_[l].bodies)
    most = std::max(most, norm(t.state.displacement - t.listed_at) + fastest_body(t, fastest_grain) * block);
  return most;
}

template <class T>
void BoundaryMemory<T>::enter(GroupView<T>& v) {
  v.row_touch = row_touch_.data(), v.row_grip = row_grip_.data(), v.row_load = row_load_.data();
  v.n_bodies = static_cast<int>(n_bodies_);
  v.touch = touch_.data(), v.grip = grip_.data(), v.load = load_.data(), v.load_force = load_force_.get();
  v.touch_gap = touch_gap_.get(), v.touch_shear = touch_shear_.get();
  v.body_u = body_u_.get(), v.body_v = body_v_.get(), v.body_force = body_force_.get();
  v.n_balanced = static_cast<int>(balanced_.size()), v.balanced = balanced_.data();
  v.balanced_touch = balanced_touch_.data();
  v.balance_on = balance_on_.get(), v.balance_force = balance_force_.get();
}

template class BoundaryMemory<double>;
template class BoundaryMemory<float>;

}  // namespace phy::engine::group
