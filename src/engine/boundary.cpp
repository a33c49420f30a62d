#include "engine/boundary.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace phy::engine::group {
namespace {

constexpr double servo_proportional = 0.6;
constexpr double servo_integral = 0.2;
constexpr double far_away = 1.0;  // m: gap of a tool that is not there

/// One component of the servo (rig.hpp): displacement per block from the mean force of the last one.
double servo_step(const Servo& servo, double mean_force, double displacement, double& memory, double block) {
  const double missing = (servo.force - servo.spring * displacement - mean_force) / servo.stiffness;
  const double most = servo.max_speed * block;
  memory = std::clamp(memory + servo_integral * missing, -most, most);
  return std::clamp(memory + servo_proportional * missing, -most, most);
}

/// Upper bound of a tool's speed. In balance it is at most that of the fastest grain: moving all grains that
/// it touches moves it by as much.
double fastest_tool(const Drive& d, double fastest_grain) {
  return norm(d.velocity) + (d.servo_x.on ? d.servo_x.max_speed : 0.0) +
         (d.servo_y.on ? d.servo_y.max_speed : 0.0) +
         (d.balance_x.on || d.balance_y.on ? fastest_grain : 0.0);
}

}  // namespace

template <class T>
Boundary<T>::Boundary(const GrainMemory<T>& grains, int interval)
    : grains_(&grains),
      W_(grains.lanes()),
      n_steps_(static_cast<std::size_t>(interval)),
      lanes_(W_),
      row_touch_(static_cast<std::size_t>(grains.layout().n_rows()) + 1, 0),
      row_grip_(row_touch_),
      row_load_(row_touch_) {}

template <class T>
void Boundary<T>::clear(std::size_t l) {
  lanes_[l] = {};
  for (std::size_t p = 0; p < n_tools_ * grains_->size(); ++p) {
    touch_gap_[p * W_ + l] = T(far_away);
    touch_shear_[p * W_ + l] = T(0);
  }
}

template <class T>
void Boundary<T>::copy(std::size_t l, Boundary<T>& to, std::size_t k) const {
  to.lanes_[k] = lanes_[l];
  for (std::size_t place = 0; place < n_tools_ * grains_->size(); ++place) {
    to.touch_gap_[place * to.W_ + k] = touch_gap_[place * W_ + l];
    to.touch_shear_[place * to.W_ + k] = touch_shear_[place * W_ + l];
  }
}

/// Lanes of a group share the geometry of their rig: it follows from the packing and the kind of test.
template <class T>
void Boundary<T>::adopt(const Rig& rig) {
  if (rig.tools.empty() && !rig.jacket) return;
  if (n_tools_ > 0 || jacket_) {
    PHY_CHECK(rig.tools.size() == n_tools_ && rig.jacket == jacket_, "lanes share one rig");
    return;
  }
  jacket_ = rig.jacket;
  n_tools_ = rig.tools.size();
  const std::size_t per_step = n_steps_ * n_tools_ * 2 * W_, n = grains_->size();
  tool_u_.assign(per_step), tool_v_.assign(per_step), tool_force_.assign(per_step), tool_du_.assign(per_step);
  balance_on_.assign(n_tools_ * 2 * W_), balance_force_.assign(n_tools_ * 2 * W_);
  touch_gap_.assign(n_tools_ * n * W_);
  touch_shear_.assign(n_tools_ * n * W_);
  std::fill_n(touch_gap_.get(), n_tools_ * n * W_, T(far_away));
  touch_normal_.assign(n_tools_ * n, Vec2{});
  for (std::size_t t = 0; t < n_tools_; ++t)
    for (const Touch& p : rig.tools[t].touches) touch_normal_[t * n + grains_->sorted_id(p.grain)] = p.normal;
  list_grips(rig);
}

template <class T>
void Boundary<T>::list_grips(const Rig& rig) {
  for (std::size_t t = 0; t < n_tools_; ++t)
    for (const Grip& p : rig.tools[t].grips)
      grip_.push_back({static_cast<std::int32_t>(grains_->sorted_id(p.grain)), static_cast<std::int32_t>(t),
                       p.x, p.y, p.rotation});
  std::stable_sort(grip_.begin(), grip_.end(),
                   [](const GripPoint& p, const GripPoint& q) { return p.grain < q.grain; });
  for (std::size_t row = 0; row < row_grip_.size(); ++row)
    row_grip_[row] = static_cast<std::int32_t>(
        std::partition_point(grip_.begin(), grip_.end(),
                             [&](const GripPoint& p) { return p.grain < grains_->layout().row_grain[row]; }) -
        grip_.begin());
}

template <class T>
void Boundary<T>::drive(std::size_t l, std::size_t tool, const Drive& drive) {
  ToolMotion& motion = lanes_[l].tools[tool];
  motion.drive = drive;
  motion.drive_time = 0.0;
}

template <class T>
void Boundary<T>::place_tool(std::size_t tool, std::size_t l) {
  const std::size_t n = grains_->size();
  std::vector<double> gap(n, far_away);
  for (const Touch& p : lanes_[l].rig->tools[tool].touches) gap[grains_->sorted_id(p.grain)] = p.gap;
  const Vec2* normal = touch_normal_.data() + tool * n;
  double sum = 0.0, count = 0.0;
  for (std::size_t g = 0; g < n; ++g)
    if (gap[g] <= 0.0) sum += dot(normal[g], grains_->displacement(g, l)), count += 1.0;
  const double mean = count > 0.0 ? sum / count : 0.0;
  for (std::size_t g = 0; g < n; ++g) {
    const double u = dot(normal[g], grains_->displacement(g, l));
    const std::size_t place = (tool * n + g) * W_ + l;
    touch_gap_[place] = T(gap[g] <= 0.0 ? -u : std::max(gap[g] - mean, -u));
    touch_shear_[place] = T(0);
  }
}

template <class T>
void Boundary<T>::place(std::size_t l) {
  LaneBoundary& lane = lanes_[l];
  for (std::size_t t = 0; t < lane.rig->tools.size(); ++t) place_tool(t, l);
  lane.tools.assign(n_tools_, ToolMotion{});
  lane.placed = true;
  lane.swept = 0.0;
}

template <class T>
void Boundary<T>::add_work(std::size_t l, double& work) {
  LaneBoundary& lane = lanes_[l];
  for (ToolMotion& t : lane.tools) t.state.mean_force = {};
  for (std::size_t s = 0; s < n_steps_; ++s) {
    for (std::size_t t = 0; t < lane.tools.size(); ++t) {
      ToolState& state = lane.tools[t].state;
      const Vec2 force = tool_vector(tool_force_, s, t, l);
      const std::size_t i = tool_at(s, t, l);
      work += dot(0.5 * (state.force + force), {tool_du_[i], tool_du_[i + W_]});
      state.force = force;
      state.mean_force = state.mean_force + (1.0 / static_cast<double>(n_steps_)) * force;
    }
  }
  if (!jacket_ || !lane.placed) return;
  const double swept = area_swept(l) - lane.swept_from;
  work += lane.pressure * swept;
  lane.swept += swept;
}

template <class T>
bool Boundary<T>::near(std::size_t tool, std::size_t g, const NeighbourList<T>& list) const {
  const Vec2 n = touch_normal_[tool * grains_->size() + g];
  if (n.x == 0.0 && n.y == 0.0) return false;
  for (std::size_t l = 0; l < W_; ++l) {
    if (!acts(l)) continue;
    const double gap = static_cast<double>(touch_gap_[(tool * grains_->size() + g) * W_ + l]);
    const double reach = list.usual_range() + list.range(l, g);
    if (dot(n, lanes_[l].tools[tool].state.displacement - grains_->displacement(g, l)) - gap > -reach)
      return true;
  }
  return false;
}

template <class T>
void Boundary<T>::list_touches(const NeighbourList<T>& list) {
  touch_.clear();
  const Rig* rig = nullptr;
  for (std::size_t l = W_; l-- > 0;) {
    for (ToolMotion& t : lanes_[l].tools) t.listed_at = t.state.displacement;
    if (acts(l)) rig = lanes_[l].rig.get();
  }
  const std::vector<std::int32_t>& row_grain = grains_->layout().row_grain;
  for (std::size_t row = 0; row + 1 < row_touch_.size(); ++row) {
    row_touch_[row] = static_cast<std::int32_t>(touch_.size());
    if (rig == nullptr) continue;
    for (std::size_t tool = 0; tool < n_tools_; ++tool)
      for (auto g = static_cast<std::size_t>(row_grain[row]);
           g < static_cast<std::size_t>(row_grain[row + 1]); ++g) {
        if (!near(tool, g, list)) continue;
        const Vec2 n = touch_normal_[tool * grains_->size() + g];
        touch_.push_back({static_cast<std::int32_t>(g), static_cast<std::int32_t>(tool), T(n.x), T(n.y),
                          T(rig->tools[tool].rough ? 1 : 0)});
      }
  }
  row_touch_.back() = static_cast<std::int32_t>(touch_.size());
}

/// Velocity of a tool in the next block at full speed; 0 where it is in balance.
template <class T>
Vec2 Boundary<T>::block_velocity(LaneBoundary& lane, ToolMotion& tool) const {
  const double block = lane.dt * static_cast<double>(n_steps_);
  const Drive& d = tool.drive;
  const ToolState& s = tool.state;
  Vec2 v{d.balance_x.on ? 0.0 : d.velocity.x, d.balance_y.on ? 0.0 : d.velocity.y};
  if (d.servo_x.on)
    v.x = servo_step(d.servo_x, s.mean_force.x, s.displacement.x, tool.memory.x, block) / block;
  if (d.servo_y.on)
    v.y = servo_step(d.servo_y, s.mean_force.y, s.displacement.y, tool.memory.y, block) / block;
  return v;
}

/// What the loop has to know of tools in balance: planned at rest, they are moved by it.
template <class T>
void Boundary<T>::plan_balance() {
  balanced_.clear(), balanced_touch_.clear();
  for (std::size_t t = 0; t < n_tools_; ++t)
    for (std::size_t c = 0; c < 2; ++c) {
      bool any = false;
      for (std::size_t l = 0; l < W_; ++l) {
        const std::size_t i = tool_at(0, t, l) + c * W_;
        const Drive d = t < lanes_[l].tools.size() ? lanes_[l].tools[t].drive : Drive{};
        const Balance& b = c == 0 ? d.balance_x : d.balance_y;
        balance_on_[i] = T(b.on ? 1 : 0), balance_force_[i] = T(b.force);
        any = any || b.on;
      }
      if (!any) continue;
      const auto first = static_cast<std::int32_t>(balanced_touch_.size());
      for (std::size_t i = 0; i < touch_.size(); ++i)
        if (touch_[i].tool == static_cast<std::int32_t>(t) && (c == 0 ? touch_[i].nx : touch_[i].ny) != T(0))
          balanced_touch_.push_back(static_cast<std::int32_t>(i));
      balanced_.push_back({static_cast<std::int32_t>(t), static_cast<std::int32_t>(c), first,
                           static_cast<std::int32_t>(balanced_touch_.size())});
    }
}

template <class T>
void Boundary<T>::read_balance() {
  for (const BalancePoint& p : balanced_) {
    const auto tool = static_cast<std::size_t>(p.tool), c = static_cast<std::size_t>(p.component);
    for (std::size_t l = 0; l < W_; ++l) {
      if (balance_on_[tool_at(0, tool, l) + c * W_] == T(0)) continue;
      Vec2& displacement = lanes_[l].tools[tool].state.displacement;
      double& u = c == 0 ? displacement.x : displacement.y;
      for (std::size_t s = 0; s < n_steps_; ++s) {
        const std::size_t i = tool_at(s, tool, l) + c * W_;
        const auto now = static_cast<double>(tool_u_[i]);
        tool_du_[i] = now - u;
        u = now;
      }
    }
  }
}

template <class T>
void Boundary<T>::plan_lane(std::size_t l) {
  LaneBoundary& lane = lanes_[l];
  for (std::size_t t = 0; t < lane.tools.size(); ++t) {
    ToolMotion& tool = lane.tools[t];
    const Drive& d = tool.drive;
    const Vec2 full = block_velocity(lane, tool);
    for (std::size_t s = 0; s < n_steps_; ++s) {
      const double fraction = d.ramp > 0.0 ? std::min(1.0, (tool.drive_time + 0.5 * lane.dt) / d.ramp) : 1.0;
      const Vec2 v{d.servo_x.on ? full.x : full.x * fraction, d.servo_y.on ? full.y : full.y * fraction};
      const Vec2 du = lane.dt * v;
      tool.drive_time += lane.dt;
      tool.state.displacement = tool.state.displacement + du;
      const std::size_t i = tool_at(s, t, l);
      tool_du_[i] = du.x, tool_du_[i + W_] = du.y;
      tool_v_[i] = T(v.x), tool_v_[i + W_] = T(v.y);
      tool_u_[i] = T(tool.state.displacement.x), tool_u_[i + W_] = T(tool.state.displacement.y);
    }
  }
}

template <class T>
void Boundary<T>::plan() {
  plan_balance();
  std::fill_n(tool_force_.get(), n_steps_ * n_tools_ * 2 * W_, T(0));
  for (std::size_t l = 0; l < W_; ++l) plan_lane(l);
}

template <class T>
double Boundary<T>::reach(std::size_t l, double fastest_grain, double block) const {
  double most = 0.0;
  for (const ToolMotion& t : lanes_[l].tools)
    most = std::max(most,
                    norm(t.state.displacement - t.listed_at) + fastest_tool(t.drive, fastest_grain) * block);
  return most;
}

template <class T>
void Boundary<T>::enter(GroupView<T>& v) {
  v.row_touch = row_touch_.data(), v.row_grip = row_grip_.data(), v.row_load = row_load_.data();
  v.n_tools = static_cast<int>(n_tools_);
  v.touch = touch_.data(), v.grip = grip_.data(), v.load = load_.data(), v.load_force = load_force_.get();
  v.touch_gap = touch_gap_.get(), v.touch_shear = touch_shear_.get();
  v.tool_u = tool_u_.get(), v.tool_v = tool_v_.get(), v.tool_force = tool_force_.get();
  v.n_balanced = static_cast<int>(balanced_.size()), v.balanced = balanced_.data();
  v.balanced_touch = balanced_touch_.data();
  v.balance_on = balance_on_.get(), v.balance_force = balance_force_.get();
}

template class Boundary<double>;
template class Boundary<float>;

}  // namespace phy::engine::group
