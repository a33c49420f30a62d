#include <array>

#include "engine/group.hpp"

namespace phy::group {
namespace {

constexpr double servo_proportional = 0.6;
constexpr double servo_integral = 0.2;

/// One component of the servo (rig.hpp): displacement per block from the mean force of the last one.
double servo_step(const Servo& servo, double mean_force, double displacement, double& memory, double block) {
  const double missing = (servo.force - servo.spring * displacement - mean_force) / servo.stiffness;
  const double most = servo.max_speed * block;
  memory = std::clamp(memory + servo_integral * missing, -most, most);
  return std::clamp(memory + servo_proportional * missing, -most, most);
}

}  // namespace

/// Lanes of a group share the geometry of their rig: it follows from the packing and the kind of test.
template <class T>
void Group<T>::adopt_rig(const Rig& rig) {
  if (rig.tools.empty() && !rig.jacket) return;
  if (n_tools_ > 0 || jacket_) {
    PHY_CHECK(rig.tools.size() == n_tools_ && rig.jacket == jacket_, "lanes share one rig");
    return;
  }
  jacket_ = rig.jacket;
  n_tools_ = rig.tools.size();
  const std::size_t per_step = n_steps() * n_tools_ * 2 * W_;
  tool_u_.assign(per_step), tool_v_.assign(per_step), tool_force_.assign(per_step), tool_du_.assign(per_step);
  balance_on_.assign(n_tools_ * 2 * W_), balance_force_.assign(n_tools_ * 2 * W_);
  touch_gap_.assign(n_tools_ * n_grains() * W_);
  touch_shear_.assign(n_tools_ * n_grains() * W_);
  std::fill_n(touch_gap_.get(), n_tools_ * n_grains() * W_, T(far_away));
  touch_normal_.assign(n_tools_ * n_grains(), Vec2{});
  for (std::size_t t = 0; t < n_tools_; ++t)
    for (const Touch& p : rig.tools[t].touches) touch_normal_[t * n_grains() + sorted_id(p.grain)] = p.normal;
  list_grips(rig);
}

template <class T>
void Group<T>::list_grips(const Rig& rig) {
  for (std::size_t t = 0; t < n_tools_; ++t)
    for (const Grip& p : rig.tools[t].grips)
      grip_.push_back({static_cast<std::int32_t>(sorted_id(p.grain)), static_cast<std::int32_t>(t), p.x, p.y,
                       p.rotation});
  std::stable_sort(grip_.begin(), grip_.end(),
                   [](const GripPoint& p, const GripPoint& q) { return p.grain < q.grain; });
  for (std::size_t row = 0; row < row_grip_.size(); ++row)
    row_grip_[row] = static_cast<std::int32_t>(
        std::partition_point(grip_.begin(), grip_.end(),
                             [&](const GripPoint& p) { return p.grain < layout_.row_grain[row]; }) -
        grip_.begin());
}

template <class T>
void Group<T>::drive(int lane, int tool, const Drive& drive) {
  ToolMotion& motion = at(lane).tools[static_cast<std::size_t>(tool)];
  motion.drive = drive;
  motion.drive_time = 0.0;
}

// Grains whose packing overlaps a tool's surface touch it from the start, stress-free; the others keep their
// gap.
template <class T>
void Group<T>::place_tool(std::size_t tool, std::size_t l) {
  const Tool& t = lanes_[l].rig().tools[tool];
  std::vector<double> gap(n_grains(), far_away);
  for (const Touch& p : t.touches) gap[sorted_id(p.grain)] = p.gap;
  const Vec2* normal = touch_normal_.data() + tool * n_grains();
  double sum = 0.0, count = 0.0;
  for (std::size_t g = 0; g < n_grains(); ++g)
    if (gap[g] <= 0.0) sum += dot(normal[g], displacement(g, l)), count += 1.0;
  const double mean = count > 0.0 ? sum / count : 0.0;
  for (std::size_t g = 0; g < n_grains(); ++g) {
    const double u = dot(normal[g], displacement(g, l));
    const std::size_t place = (tool * n_grains() + g) * W_ + l;
    touch_gap_[place] = T(gap[g] <= 0.0 ? -u : std::max(gap[g] - mean, -u));
    touch_shear_[place] = T(0);
  }
}

template <class T>
void Group<T>::place_rig(int lane) {
  const auto l = static_cast<std::size_t>(lane);
  Lane& info = at(lane);
  for (std::size_t t = 0; t < info.rig().tools.size(); ++t) place_tool(t, l);
  info.tools.assign(n_tools_, ToolMotion{});
  info.placed = true;
  info.work = info.slip = info.damping = info.released = 0.0;
  info.time = 0.0;
  info.step = 0;
  const HistoryRow& r = info.row;
  info.base_energy = r.kinetic + r.strain_linear + r.strain_bond + r.strain_joint;
  info.base_axial = r.axial_strain_gauge;
  info.base_lateral = r.lateral_strain_gauge;
  info.zero_travel = 0.0;
  info.swept = 0.0;
  info.cracks.clear();
  info.row = HistoryRow{};
  dirty_ = true;
}

template <class T>
void Group<T>::zero_strains(int lane) {
  Lane& info = at(lane);
  HistoryRow& r = info.row;
  info.zero_travel = info.travel();
  info.base_axial += r.axial_strain_gauge, info.base_lateral += r.lateral_strain_gauge;
  r.axial_strain_gauge = r.lateral_strain_gauge = 0.0;
}

template <class T>
void Group<T>::list_touches() {
  touch_.clear();
  for (std::size_t l = 0; l < W_; ++l)
    for (ToolMotion& t : lanes_[l].tools) t.listed_at = t.state.displacement;
  const auto near = [&](std::size_t tool, std::size_t g) {
    const Vec2 n = touch_normal_[tool * n_grains() + g];
    if (n.x == 0.0 && n.y == 0.0) return false;
    for (std::size_t l = 0; l < W_; ++l) {
      const Lane& lane = lanes_[l];
      if (!lane.specimen || !lane.placed) continue;
      const double gap = static_cast<double>(touch_gap_[(tool * n_grains() + g) * W_ + l]);
      const double reach = 0.5 * skin_ + lane.range[g];
      if (dot(n, lane.tools[tool].state.displacement - displacement(g, l)) - gap > -reach) return true;
    }
    return false;
  };
  const auto rig = [&]() -> const Rig* {
    for (const Lane& lane : lanes_)
      if (lane.specimen && lane.placed) return &lane.rig();
    return nullptr;
  }();
  for (int row = 0; row < layout_.n_rows(); ++row) {
    row_touch_[static_cast<std::size_t>(row)] = static_cast<std::int32_t>(touch_.size());
    if (rig == nullptr) continue;
    for (std::size_t tool = 0; tool < n_tools_; ++tool)
      for (auto g = static_cast<std::size_t>(layout_.row_grain[static_cast<std::size_t>(row)]);
           g < static_cast<std::size_t>(layout_.row_grain[static_cast<std::size_t>(row) + 1]); ++g) {
        if (!near(tool, g)) continue;
        const Vec2 n = touch_normal_[tool * n_grains() + g];
        touch_.push_back({static_cast<std::int32_t>(g), static_cast<std::int32_t>(tool), T(n.x), T(n.y),
                          T(rig->tools[tool].rough ? 1 : 0)});
      }
  }
  row_touch_.back() = static_cast<std::int32_t>(touch_.size());
}

/// Velocity of a tool in the next block at full speed; 0 where it is in balance.
template <class T>
Vec2 Group<T>::block_velocity(Lane& lane, ToolMotion& tool) const {
  const double block = lane.dt * options_.interval;
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
void Group<T>::plan_balance() {
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

/// Where the loop has put the tools in balance.
template <class T>
void Group<T>::read_balance() {
  for (const BalancePoint& p : balanced_) {
    const auto tool = static_cast<std::size_t>(p.tool), c = static_cast<std::size_t>(p.component);
    for (std::size_t l = 0; l < W_; ++l) {
      if (balance_on_[tool_at(0, tool, l) + c * W_] == T(0)) continue;
      Vec2& displacement = lanes_[l].tools[tool].state.displacement;
      double& u = c == 0 ? displacement.x : displacement.y;
      for (std::size_t s = 0; s < n_steps(); ++s) {
        const std::size_t i = tool_at(s, tool, l) + c * W_;
        const auto now = static_cast<double>(tool_u_[i]);
        tool_du_[i] = now - u;
        u = now;
      }
    }
  }
}

template <class T>
void Group<T>::plan_tools() {
  plan_balance();
  std::fill_n(tool_force_.get(), n_steps() * n_tools_ * 2 * W_, T(0));
  for (std::size_t l = 0; l < W_; ++l) {
    Lane& lane = lanes_[l];
    for (std::size_t t = 0; t < lane.tools.size(); ++t) {
      ToolMotion& tool = lane.tools[t];
      const Drive& d = tool.drive;
      const Vec2 full = block_velocity(lane, tool);
      for (std::size_t s = 0; s < n_steps(); ++s) {
        const double fraction =
            d.ramp > 0.0 ? std::min(1.0, (tool.drive_time + 0.5 * lane.dt) / d.ramp) : 1.0;
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
}

template class Group<double>;
template class Group<float>;

}  // namespace phy::group
