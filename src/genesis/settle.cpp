#include "genesis/settle.hpp"

#include <algorithm>
#include <cmath>

#include "base/vec.hpp"
#include "genesis/near_pairs.hpp"
#include "laws/linear/linear.hpp"

namespace phy::genesis {
namespace {

// FIRE's constants: the authors' (0.1, 0.99, 1.1, 0.5, 20), except the largest step, which is bounded by
// stability: unit masses and springs, six neighbours: omega_max <= 2.5, step < 2/omega_max = 0.8.
constexpr double mixing_start = 0.1;
constexpr double mixing_decay = 0.99;
constexpr double step_growth = 1.1;
constexpr double step_cut = 0.5;
constexpr double step_first = 0.1;
constexpr double step_max = 0.5;
constexpr double step_min = 0.002;
constexpr int steps_before_growth = 20;
constexpr int iterations_per_check = 10;
constexpr double skin_over_radius = 0.45;  // measured: the least time of 0.3, 0.45, 0.6

/// Sums over all contacts at one instant.
struct ContactSums {
  double force = 0.0;      // between discs and at walls
  double virial = 0.0;     // force times length
  double stiffness = 0.0;  // K l^2
  double overlap = 0.0;    // between discs
  long n_pairs = 0;        // between discs
  long n_walls = 0;
};

class Fire {
 public:
  Fire(const SettleBox& box, std::vector<Disc>& discs)
      : box_(box), discs_(discs), force_(discs.size()), velocity_(discs.size()) {
    double r = 0.0;
    for (const Disc& d : discs_) r += d.r;
    // In mean radii: pairs are looked for once in many steps.
    skin_ = skin_over_radius * r / static_cast<double>(discs_.size());
    find_pairs();
  }

  Equilibrium run(double tolerance, double loose_overlap, long max_iterations) {
    long n = 0;
    for (;; ++n) {
      const ContactSums sums = add_forces();
      if (n >= max_iterations || n % iterations_per_check == 0) {
        // Large packings take minutes, and Ctrl-C is not to wait for them.
        if (box_.stop && box_.stop()) throw Interrupted();
        Equilibrium e = measure(sums);
        e.n_iterations = n;
        const double mean_force = sums.force / static_cast<double>(std::max(1L, sums.n_pairs + sums.n_walls));
        // Discs that have found room push each other no more: there is nothing to relax.
        e.loose = mean_force <= loose_overlap;
        if (n >= max_iterations || e.loose || e.unbalanced <= tolerance) return e;
      }
      step();
    }
  }

 private:
  struct Spring {
    std::uint32_t a, b;
    double k;
  };

  void find_pairs() {
    // By pfc5 unequal discs are softer, and come to rest elsewhere.
    const bool pfc5 = box_.stiffness == StiffnessConvention::pfc5;
    springs_.clear();
    for (const Pair& p : near_pairs(discs_, skin_))
      springs_.push_back({p.a, p.b, laws::linear::stiffness_factor(pfc5, discs_[p.a].r, discs_[p.b].r)});
    at_search_ = discs_;
  }

  void add_wall(ContactSums& s, double overlap, double r, double& component, double direction) {
    if (overlap <= 0.0) return;
    // Of a modulus of 1: only ratios matter to where discs come to rest.
    const double f = laws::linear::wall_stiffness_factor * overlap;
    component += direction * f;
    s.force += f;
    s.virial += f * (r - overlap);
    s.stiffness += laws::linear::wall_stiffness_factor * r * r;
    ++s.n_walls;
  }

  ContactSums add_forces() {
    ContactSums s;
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      const Disc& d = discs_[i];
      Vec2 f;
      add_wall(s, d.r - d.x, d.r, f.x, 1.0);
      add_wall(s, d.r - (box_.width - d.x), d.r, f.x, -1.0);
      add_wall(s, d.r - d.y, d.r, f.y, 1.0);
      add_wall(s, d.r - (box_.height - d.y), d.r, f.y, -1.0);
      force_[i] = f;
    }
    for (const Spring& p : springs_) {
      const Disc& a = discs_[p.a];
      const Disc& b = discs_[p.b];
      const double dx = b.x - a.x, dy = b.y - a.y, l = a.r + b.r;
      const double d2 = dx * dx + dy * dy;
      if (d2 >= l * l) continue;
      const double d = std::sqrt(d2);
      const double f = p.k * (l - d);
      // Two discs drawn on one point: any direction parts them.
      const Vec2 push = d > 0.0 ? (f / d) * Vec2{dx, dy} : Vec2{f, 0.0};
      force_[p.a] = force_[p.a] - push;
      force_[p.b] = force_[p.b] + push;
      s.force += f;
      s.virial += f * d;
      s.stiffness += p.k * l * l;
      s.overlap += l - d;
      ++s.n_pairs;
    }
    return s;
  }

  Equilibrium measure(const ContactSums& s) const {
    Equilibrium e;
    double sum = 0.0;
    for (const Vec2& f : force_) sum += norm(f);
    const double mean_force = s.force / static_cast<double>(std::max(1L, s.n_pairs + s.n_walls));
    if (s.force > 0.0) e.unbalanced = sum / static_cast<double>(force_.size()) / mean_force;
    // Love-Weber in two dimensions: half of the trace of the stress.
    e.pressure = s.virial / (2.0 * box_.width * box_.height);
    e.stiffness = s.stiffness;
    e.mean_overlap = s.overlap / static_cast<double>(std::max(1L, s.n_pairs));
    e.n_contacts = s.n_pairs;
    return e;
  }

  /// Steers by the power force.velocity: downhill faster and faster, uphill a half step back and from rest.
  void steer() {
    double power = 0.0;
    for (std::size_t i = 0; i < force_.size(); ++i) power += dot(force_[i], velocity_[i]);
    if (power > 0.0) {
      if (++n_downhill_ <= steps_before_growth) return;
      dt_ = std::min(step_max, step_growth * dt_);
      mixing_ *= mixing_decay;
      return;
    }
    for (std::size_t i = 0; i < force_.size(); ++i) {
      discs_[i].x -= 0.5 * dt_ * velocity_[i].x;
      discs_[i].y -= 0.5 * dt_ * velocity_[i].y;
      velocity_[i] = {};
    }
    dt_ = std::max(step_min, step_cut * dt_);
    mixing_ = mixing_start;
    n_downhill_ = 0;
  }

  void step() {
    steer();
    double f2 = 0.0, v2 = 0.0, travel2 = 0.0;
    for (std::size_t i = 0; i < force_.size(); ++i) {
      velocity_[i] = velocity_[i] + dt_ * force_[i];
      f2 += dot(force_[i], force_[i]);
      v2 += dot(velocity_[i], velocity_[i]);
    }
    // FIRE bends velocities towards the forces without changing their size.
    const double turn = f2 > 0.0 ? mixing_ * std::sqrt(v2 / f2) : 0.0;
    for (std::size_t i = 0; i < force_.size(); ++i) {
      velocity_[i] = (1.0 - mixing_) * velocity_[i] + turn * force_[i];
      discs_[i].x += dt_ * velocity_[i].x;
      discs_[i].y += dt_ * velocity_[i].y;
      const Vec2 u{discs_[i].x - at_search_[i].x, discs_[i].y - at_search_[i].y};
      travel2 = std::max(travel2, dot(u, u));
    }
    // Two discs that come nearer by half the skin each might meet unseen.
    if (4.0 * travel2 >= skin_ * skin_) find_pairs();
  }

  SettleBox box_;
  std::vector<Disc>& discs_;
  std::vector<Disc> at_search_;
  std::vector<Vec2> force_, velocity_;
  std::vector<Spring> springs_;
  double skin_ = 0.0, dt_ = step_first, mixing_ = mixing_start;
  int n_downhill_ = 0;
};

}  // namespace

Equilibrium settle(const SettleBox& box, std::vector<Disc>& discs, double tolerance, double loose_overlap,
                   long max_iterations) {
  if (discs.empty()) return {};
  return Fire(box, discs).run(tolerance, loose_overlap, max_iterations);
}

double radius_change(double volume, double d_stress, double stiffness) {
  return 2.0 * volume * d_stress / stiffness;
}

}  // namespace phy::genesis
