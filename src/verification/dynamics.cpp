// The engine against closed forms of vibration, waves, damping and energy. All cases run the engine that
// users run, in double precision and one lane; that other lanes and sets give the same bits is proved in
// tests/determinism.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/exact_math.hpp"
#include "engine/lane_group.hpp"
#include "engine/stable_step.hpp"
#include "lab/boundaries.hpp"
#include "records/assembly.hpp"
#include "statics/system.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

/// One specimen in one lane, stepped one cycle at a time.
struct Bench {
  std::shared_ptr<const Specimen> specimen;
  std::unique_ptr<engine::LaneGroup> group;
  Bench(Specimen s, double damping, int interval = 1, double safety = 0.5) {
    specimen = std::make_shared<const Specimen>(std::move(s));
    engine::GroupOptions options;
    options.isa = engine::native_isa();
    options.interval = interval;
    options.contacts = &engine::physics_of(specimen->matrix, specimen->bedding);
    group = engine::make_group(specimen->packing, options);
    engine::LaneSetup setup;
    setup.damping = damping;
    setup.step_safety = safety;
    setup.boundary = std::make_shared<const engine::Boundary>(lab::platens(*specimen->packing).boundary);
    group->load(0, specimen, setup);
  }
  double dt() const { return group->time_step(0); }
  GrainState grain(std::size_t i) const { return group->snapshot(0).grains[i]; }
};

double mass(const Specimen& s, std::size_t i) {
  const double r = s.packing->discs[i].r;
  return s.matrix.density * pi * r * r;
}

/// Undamped frequency from three successive values of a free oscillation of the leap-frog:
/// u(n+1) + u(n-1) = 2 cos(w dt) u(n), and (2/dt) sin(w dt/2) is the frequency of the springs and masses.
template <class Read>
double frequency(Bench& b, const Read& read, int cycles) {
  std::vector<double> u{0.0};
  for (int i = 0; i < cycles; ++i) {
    b.group->advance();
    u.push_back(read(b));
  }
  // The relation holds for every triple; summed, the rounding of single ones evens out.
  double num = 0.0, den = 0.0;  // least squares over the whole record
  for (std::size_t i = 1; i + 1 < u.size(); ++i) num += (u[i + 1] + u[i - 1]) * u[i], den += u[i] * u[i];
  const double cosine = 0.5 * num / den;
  return std::sqrt(2.0 - 2.0 * cosine) / b.dt();
}

constexpr double R_disc = 1e-3;

Specimen bonded_pair() {
  Specimen s = assembly({{0.0, 0.0, R_disc}, {2.0 * R_disc, 0.0, R_disc}}, soft_contact());
  bond_touching(s);
  return s;
}

std::vector<Check> rigid_motion() {
  Specimen s = assembly(hexagonal(7, 7, R_disc), soft_contact());
  bond_touching(s);
  // Slow against the bonds, so that centrifugal forces stretch nothing.
  const double w0 = std::sqrt(s.matrix.E_b / mass(s, 0));
  const double spin = 1e-6 * w0;
  Bench b(std::move(s), 0.0, 100);
  const auto& discs = b.specimen->packing->discs;
  for (std::uint32_t i = 0; i < discs.size(); ++i)
    b.group->set_motion(0, i, {}, {1.0 - spin * discs[i].y, 0.5 + spin * discs[i].x}, spin);
  for (int i = 0; i < 50; ++i) b.group->advance();
  const HistoryRow& row = b.group->row(0);
  return {{"strain energy / kinetic energy after moving as a rigid body [-]", 0.0,
           row.strain_bond / row.kinetic, 1e-10}};
}

std::vector<Check> chain() {
  constexpr int n = 40;
  std::vector<Check> checks;
  // From the longest wave to the shortest, where neighbours move against each other.
  for (const int mode : {1, 7, 20, 39}) {
    std::vector<Disc> discs;
    for (int i = 0; i < n; ++i) discs.push_back({2.0 * R_disc * i, 0.0, R_disc});
    Specimen s = assembly(discs, soft_contact());
    bond_touching(s);
    // kb_n A of equal discs: modulus over length, times the width of the cement.
    const double K = s.matrix.E_b / (2.0 * R_disc) * 2.0 * R_disc, m = mass(s, 0);
    Bench b(std::move(s), 0.0);
    for (std::uint32_t i = 0; i < n; ++i)
      b.group->set_motion(0, i, {}, {1e-6 * std::cos(mode * pi * (i + 0.5) / n), 0.0}, 0.0);
    const double w = frequency(
        b, [](const Bench& x) { return x.grain(0).ux; }, 200);
    checks.push_back(
        {"angular frequency of mode " + std::to_string(mode) + " of a free chain of 40 discs [1/s]",
         2.0 * std::sqrt(K / m) * std::sin(mode * pi / (2.0 * n)), w, 1e-6});
  }
  return checks;
}

/// Frequencies of a pair that is held together by springs k_n, k_s [N/m per m] and k_m [N].
std::vector<Check> vibration_of(const Specimen& s, double k_n, double k_s, double k_m) {
  const auto run = [&](Vec2 va, double wa, Vec2 vb, double wb, auto read) {
    Bench b(s, 0.0);
    b.group->set_motion(0, 0, {}, va, wa);
    b.group->set_motion(0, 1, {}, vb, wb);
    return frequency(b, read, 400);
  };
  const double m = mass(s, 0), J = 0.5 * m * R_disc * R_disc;
  const double v = 1e-6;
  const double axial = run({-v, 0}, 0, {v, 0}, 0, [](const Bench& b) { return b.grain(0).ux; });
  const double bending =
      run({0, 0}, -v / R_disc, {0, 0}, v / R_disc, [](const Bench& b) { return b.grain(0).rotation; });
  // shear mode: both discs turn alike while they move apart across; m u R-amplitudes follow from K_s(2/m + 2
  // R^2/J)
  const double shear = run({0, -v}, -2.0 * v / R_disc, {0, v}, -2.0 * v / R_disc,
                           [](const Bench& b) { return b.grain(0).uy; });
  return {{"axial [1/s]", std::sqrt(2.0 * k_n / m), axial, 1e-6},
          {"bending [1/s]", std::sqrt(2.0 * k_m / J), bending, 1e-6},
          {"shear [1/s]", std::sqrt(6.0 * k_s / m), shear, 1e-6}};
}

std::vector<Check> pair_vibration() {
  const Specimen s = bonded_pair();
  const double E = s.matrix.E_b;  // over 2R, times the length 2R and the moment (2/3) R^3
  return vibration_of(s, E, s.matrix.bond_ks_over_kn * E, E * R_disc * R_disc / 3.0);
}

Specimen flat_pair(double r1, double r2) {
  MatrixRecipe m;
  m.model = MatrixModel::flat_joint;
  m.E_c = 76e9, m.sigma_c = m.tau_c = 1e30;
  Specimen s = assembly({{0.0, 0.0, r1}, {r1 + r2, 0.0, r2}}, m);
  bond_touching(s);
  return s;
}

std::vector<Check> flat_pair_vibration() {
  const Specimen s = flat_pair(R_disc, R_disc);
  return vibration_of(s, s.matrix.E_c, s.matrix.ks_over_kn * s.matrix.E_c,
                      s.matrix.E_c * R_disc * R_disc / 3.0);
}

/// Two discs turned as one body by 1 rad, in steps whose chords stand for their arcs: each slides by
/// L (sin(dphi) - dphi) then, in all by L dphi^2/6. Closure and rotation have no such error.
std::vector<Check> flat_pair_turned() {
  constexpr int steps = 10000;
  constexpr double turn = 1.0 / steps, r1 = 3e-4, r2 = 3.6e-4, L = r1 + r2;
  Bench b(flat_pair(r1, r2), 0.0, 1, 1e-6);  // its forces, however small, are to move nothing
  const auto place = [](int n) { return Vec2{L * std::cos(n * turn), L * std::sin(n * turn)}; };
  for (int n = 0; n < steps; ++n) {
    const Vec2 now = place(n), step = place(n + 1) - now;
    b.group->set_motion(0, 0, {0.0, 0.0, n * turn}, {}, turn / b.dt());
    b.group->set_motion(0, 1, {now.x - L, now.y, n * turn}, (1.0 / b.dt()) * step, turn / b.dt());
    b.group->advance();
  }
  const MatrixRecipe& m = b.specimen->matrix;
  const double k_n = m.E_c * 2.0 * r1 / L, k_s = m.ks_over_kn * k_n, k_m = k_n * r1 * r1 / 3.0;
  const ContactState c = b.group->snapshot(0).contacts.front();
  const double in_shear = 0.5 * c.F_s * c.F_s / k_s;
  return {
      {"rotation reached [rad]", 1.0, b.grain(0).rotation, 1e-9},
      {"normal force / (k_n 2R L) [-]", 0.0, c.F_n / (k_n * L), 1e-13},
      {"shear force k_s 2R L dphi^2/6 of steps of 1e-4 rad [N/m]", k_s * L * turn * turn / 6.0, c.F_s, 1e-5},
      {"energy of closure and bending / energy of 1 rad between them [-]", 0.0,
       (b.group->row(0).strain_bond - in_shear) / (0.5 * k_m), 1e-15}};
}

std::vector<Check> damped_oscillator() {
  constexpr double alpha = 0.7;
  Bench b(bonded_pair(), alpha, 1, 2e-4);
  b.group->set_motion(0, 0, {}, {-1e-6, 0}, 0);
  b.group->set_motion(0, 1, {}, {1e-6, 0}, 0);
  std::vector<double> extreme, when;
  double before = 0.0, last = 0.0;
  for (int i = 1; extreme.size() < 4; ++i) {
    b.group->advance();
    const double u = b.grain(1).ux;
    if (i > 2 && (last - before) * (u - last) < 0.0) {  // parabola through three points
      // Rows miss the extremum by up to half a step: its place and height follow from three of them.
      const double curve = u - 2.0 * last + before;
      const double shift = 0.5 * (before - u) / curve;
      extreme.push_back(std::fabs(last - 0.25 * (before - u) * shift));
      when.push_back((i - 1 + shift) * b.dt());
    }
    before = last, last = u;
  }
  const double w = std::sqrt(2.0 * b.specimen->matrix.E_b / mass(*b.specimen, 0));
  const double half = pi / (2.0 * w) * (1.0 / std::sqrt(1.0 - alpha) + 1.0 / std::sqrt(1.0 + alpha));
  const double ratio = std::sqrt((1.0 - alpha) / (1.0 + alpha));
  return {{"amplitude ratio per half cycle [-]", ratio, extreme[2] / extreme[1], 2e-4},
          {"amplitude ratio, next half cycle [-]", ratio, extreme[3] / extreme[2], 2e-4},
          {"half period [s]", half, when[2] - when[1], 2e-4}};
}

/// A chain of n discs with a joint across it before disc `at`, of a twentieth of the bonds' stiffness.
Specimen jointed_chain(int n, std::uint32_t at) {
  std::vector<Disc> discs;
  for (int i = 0; i < n; ++i) discs.push_back({2.0 * R_disc * i, 0.0, R_disc});
  Specimen s = assembly(discs, soft_contact());
  BeddingRecipe set;
  set.theta = 90.0;  // plane across the chain
  set.k_n = 0.05 * s.matrix.E_b / (2.0 * R_disc);
  set.k_s = set.k_n;
  set.sigma_n = set.cohesion = 1e30;
  s.bedding = {set};
  s.plane_label.assign(discs.size(), 0);
  bond_touching(s);
  for (Contact& c : s.contacts)
    // One contact of the chain becomes the joint.
    if (c.b == at) c.kind = ContactKind::joint, c.side = -1;  // n_j = (-1, 0) against the branch (1, 0)
  return s;
}

// A wave packet meets one smooth joint in a long chain. The system is linear, so the packet's component of
// wave number q before and after gives |T(q)| itself, whatever the packet's width.
std::vector<Check> wave_through_joint() {
  constexpr int n = 1200, at = 600;
  constexpr double q = 0.10, centre = 300.0, width = 40.0;  // phase per disc; disc numbers
  Specimen s = jointed_chain(n, at);
  // Per unit of thickness: stiffness of a bond and of the joint, whose areas are alike.
  const double K = s.matrix.E_b, m = mass(s, 0), k_j = s.bedding[0].k_n * 2.0 * R_disc;
  Bench b(std::move(s), 0.0, 50, 0.25);
  // The frequency of the leap-frog, which is above that of springs and masses.
  const double w = 2.0 / b.dt() * std::asin(b.dt() * std::sqrt(K / m) * std::sin(0.5 * q));
  const double speed = std::sqrt(K / m) * std::cos(0.5 * q);
  const auto wave = [&](double x, double t) {
    const double y = (x - centre - speed * t) / width;
    return 1e-6 * std::exp(-0.5 * y * y) * std::cos(q * (x - centre) - w * t);
  };
  double re = 0.0, im = 0.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    // Speeds are half a step behind positions: the difference of two places in time, not the derivative.
    const double u = wave(i, 0.0), v = (u - wave(i, -b.dt())) / b.dt();
    b.group->set_motion(0, i, {u, 0.0, 0.0}, {v, 0.0}, 0.0);
    re += u * std::cos(q * i), im += u * std::sin(q * i);
  }
  const double came = std::sqrt(re * re + im * im);
  const int blocks = static_cast<int>(2.0 * (at - centre) / (speed * b.dt() * 50));
  for (int i = 0; i < blocks; ++i) b.group->advance();
  // What has passed the joint; the reflected part is on the other side by now.
  re = im = 0.0;
  const Snapshot shot = b.group->snapshot(0);
  for (int i = at; i < n; ++i) {
    const double u = shot.grains[static_cast<std::size_t>(i)].ux;
    re += u * std::cos(q * i), im += u * std::sin(q * i);
  }
  const double Z = std::sqrt(K * m),
               x = 0.5 * (2.0 * std::sqrt(K / m) * std::sin(0.5 * q)) * Z * (1.0 / k_j - 1.0 / K);
  return {{"|T| at a phase of 0.1 per disc [-]", 1.0 / std::sqrt(1.0 + x * x),
           std::sqrt(re * re + im * im) / came, 3e-3}};
}

/// A small bonded block with one inclined joint set under the press until something has broken.
std::vector<Check> energy_balance() {
  MatrixRecipe m;
  m.sigma_c = m.tau_c = 20e6;
  Specimen s = assembly(hexagonal(16, 30, 3e-4), m);
  BeddingRecipe set;
  set.theta = 30.0;
  s.bedding = {set};
  bond_touching(s);
  joint_crossing(s);
  // As users run: usual damping, interval and step.
  Bench b(std::move(s), 0.7, 100, 0.92);
  b.group->place_boundary(0);
  const double ramp = 2e-5 * b.specimen->packing->height / 0.05;
  b.group->prescribe(0, 0, {{0.0, 0.05}, ramp, {}, {}});
  b.group->prescribe(0, 1, {{0.0, -0.05}, ramp, {}, {}});
  double worst = 0.0;
  std::size_t n = 0;
  for (int i = 0; i < 400 && n < 60; ++i) {
    b.group->advance();
    n = b.group->cracks(0).size();
    // At the start the work is next to nothing, and any error large beside it.
    if (i > 20) worst = std::max(worst, std::fabs(b.group->row(0).energy_error));
  }
  return {{"work not accounted for / boundary work, largest, through breakage [-]", 0.0, worst, 1e-3},
          {"something broke (1 = yes)", 1.0, n > 0 ? 1.0 : 0.0, 0.0}};
}

// Largest frequency by power iteration on the engine itself would be circular; a chain and a lattice have
// closed forms.
std::vector<Check> stable_step() {
  const auto ratio = [](const Specimen& s, double exact) {
    return engine::FrequencyBound(s, engine::initial_stiffnesses(contact::models_of(s), s),
                                  {*s.packing, GrainInertia::disc})
               .omega() /
           exact;
  };
  Specimen pair = bonded_pair();
  const double A = 2.0 * R_disc, m = mass(pair, 0), Kn = pair.matrix.E_b / A * A + pair.matrix.E_c;
  const double Ks = pair.matrix.bond_ks_over_kn * pair.matrix.E_b + pair.matrix.ks_over_kn * pair.matrix.E_c;
  // Stretch and shear of a pair; spins make the second stiffer.
  const double highest = std::sqrt(std::max(2.0 * Kn, 6.0 * Ks) / m);
  std::vector<Disc> discs;
  for (int i = 0; i < 200; ++i) discs.push_back({2.0 * R_disc * i, 0.0, R_disc});
  Specimen line = assembly(discs, soft_contact());
  bond_touching(line);
  // alternating spins: shear and bending act together, w^2 = (2/J)(2 K_s R^2 + 2 k_m), against 4 K_n/m along
  // the chain
  const double J = 0.5 * m * R_disc * R_disc,
               k_m = line.matrix.E_b / A * (2.0 / 3.0 * R_disc * R_disc * R_disc);
  const double top = std::sqrt(std::max(4.0 * Kn / m, std::max(4.0 * k_m / J, 12.0 * Ks / m)));
  return {{"bound / exact highest frequency of a pair, 1 to 1.2 [-]", 1.1, ratio(pair, highest), 1.0 / 11.0},
          {"bound / exact highest frequency of a chain, 1 to 1.2 [-]", 1.1, ratio(line, top), 1.0 / 11.0}};
}

// --- V28: waves in layered rock

/// A free column of lattice along `axis` (0: x, 1: y) with a joint after every fourth row; its rows lie along
/// x, so that the column runs along the layers (0) or across them (1).
struct Column {
  Specimen specimen;
  int axis = 1;
  double length = 0.0;     // [m]
  double line_mass = 0.0;  // per length [kg/m^2]
  double spacing = 0.0;    // of the joints [m]
  double at(std::size_t i) const {
    const Disc& d = specimen.packing->discs[i];
    return axis == 0 ? d.x : d.y;
  }
};

Column layered_column(int axis) {
  Column c;
  c.axis = axis;
  const double row = std::sqrt(3.0) * R_disc;
  const int n_x = axis == 0 ? 161 : 6, n_y = axis == 0 ? 12 : 184;
  c.specimen = assembly(hexagonal(n_x, n_y, R_disc), soft_contact());
  bond_touching(c.specimen);
  BeddingRecipe set;
  set.k_n = 33.6e11, set.k_s = 9.6e11, set.spacing = c.spacing = 4.0 * row;
  c.specimen.bedding.push_back(set);
  joint_crossing(c.specimen);
  c.length = axis == 0 ? 2.0 * R_disc * n_x : row * n_y;
  c.line_mass = mass(c.specimen, 0) * n_x * n_y / c.length;
  return c;
}

/// Force over strain of the column pulled at its ends, by the direct solution [N/m]: the strain of the middle
/// half, from the mean movements of two pieces that are a whole number of layers thick and apart.
double static_stiffness(const Column& c) {
  const statics::Network net = statics::make_network(c.specimen);
  statics::Boundary pull;
  const double end =
      (c.axis == 0 ? 4.0 : 1.5) * R_disc;  // both rows of a lattice that is pulled along its rows
  double last = 0.0, n_end = 0.0;
  for (std::size_t i = 0; i < net.n_grains; ++i) last = std::max(last, c.at(i));
  for (std::size_t i = 0; i < net.n_grains; ++i) n_end += c.at(i) < end ? 1.0 : 0.0;
  for (std::uint32_t i = 0; i < net.n_grains; ++i) {
    if (c.at(i) < end) pull.loads.push_back({{i, c.axis}, -1.0 / n_end});
    if (c.at(i) > last + R_disc - end) pull.loads.push_back({{i, c.axis}, 1.0 / n_end});
  }
  // The rigid motion; loads balance, so that this grain carries nothing.
  for (int component = 0; component < 3; ++component) pull.movements.push_back({{0, component}, 0.0});
  const statics::Movements u = statics::solve_once(net, pull).u;
  // Whole layers: a piece that ended within one would weigh soft and stiff unevenly.
  const double thick = 2.0 * c.spacing, apart = std::floor(0.5 * c.length / c.spacing) * c.spacing;
  const auto mean = [&](double from) {
    double sum = 0.0, n = 0.0;
    for (std::size_t i = 0; i < net.n_grains; ++i)
      if (c.at(i) >= from && c.at(i) < from + thick)
        sum += u[3 * i + static_cast<std::size_t>(c.axis)], n += 1.0;
    return sum / n;
  };
  const double first = 5.0 * c.spacing;
  return apart / (mean(first + apart) - mean(first));
}

/// Speed of a standing wave of `halves` half waves [m/s]: from the time of `halves` whole periods.
double speed_of_wave(const Column& c, int halves) {
  Bench b(c.specimen, 0.0);
  const std::size_t n = c.specimen.packing->discs.size();
  std::vector<double> shape(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    shape[i] = std::cos(
        halves * pi *
        (c.axis == 0 ? c.at(i) - 0.5 * R_disc : c.at(i) + R_disc * (0.5 * std::sqrt(3.0) - 1.0)) / c.length);
    const double v = 1e-6 * shape[i];
    b.group->set_motion(0, i, {}, c.axis == 0 ? Vec2{v, 0.0} : Vec2{0.0, v}, 0.0);
  }
  double before = 0.0;
  for (int step = 1, crossings = 0; step < 200000; ++step) {
    b.group->advance();
    const Snapshot s = b.group->snapshot(0);
    double now = 0.0;
    for (std::size_t i = 0; i < n; ++i) now += shape[i] * (c.axis == 0 ? s.grains[i].ux : s.grains[i].uy);
    if (before * now < 0.0 && ++crossings == 2 * halves) {
      const double periods = (step - now / (now - before)) * b.dt() / halves;
      return 2.0 * c.length / halves / periods;
    }
    before = now;
  }
  return 0.0;
}

std::vector<Check> layered_waves() {
  std::vector<Check> checks;
  for (const int axis : {1, 0}) {
    const Column c = layered_column(axis);
    const double expected = std::sqrt(static_stiffness(c) / c.line_mass);
    for (const int halves : {1, 4}) {
      const double spacings = 2.0 * c.length / halves / c.spacing;
      checks.push_back({std::string(axis == 1 ? "across" : "along") + " the layers, wavelength " +
                            std::to_string(static_cast<int>(spacings)) + " spacings: speed [m/s]",
                        expected, speed_of_wave(c, halves), 0.01});
    }
  }
  return checks;
}

}  // namespace

std::vector<VerificationCase> dynamics_cases() {
  return {
      {"V0", "A bonded patch that moves and turns as a rigid body stays unstressed", "kinematics",
       "the spin is 1e-6 of the lattice frequency, so centrifugal strain energy is about 1e-12 of the "
       "kinetic energy",
       rigid_motion},
      {"V6", "Standing waves of a bonded chain: w = 2 sqrt(K/m) sin(p pi/2N)",
       "lattice dynamics, closed form",
       "leap-frog frequency corrected exactly; the linear part of 1e-9 of the bond remains", chain},
      {"V7", "Transmission of a wave through one smooth joint",
       "|T| = [1 + (w Z/2 (1/k_j - 1/K))^2]^-1/2, Z = sqrt(K m)",
       "the closed form holds for long waves; at a phase of 0.1 its error is about 1e-3", wave_through_joint},
      {"V8", "Local damping: amplitude sqrt((1-a)/(1+a)) per half cycle, and its half period",
       "Cundall damping, closed form",
       "the closed form is for continuous time; some 10,000 cycles per half period are used",
       damped_oscillator},
      {"V15", "Free vibration of two bonded discs: axial, bending, shear", "closed form",
       "leap-frog frequency corrected exactly", pair_vibration},
      {"V24", "FJ0. Two discs with a flat joint, turned as one body by 1 rad", "kinematics",
       "rounding; slide is counted in steps, of which the chord is known", flat_pair_turned},
      {"V24", "FJ9. Flat joints: free vibration of two discs", "closed form",
       "leap-frog frequency corrected exactly", flat_pair_vibration},
      {"V17", "Energy balance of a press run through breakage", "first law",
       "the energy balance is kept per cycle; breakage is counted with the forces of the breaking cycle",
       energy_balance},
      {"V19", "The bound of the highest frequency is above it, and close", "Collatz-Wielandt bound",
       "a bound must never be below; how far above is a matter of speed", stable_step},
      {"V28", "Waves along a free column of layered lattice: sqrt(stiffness/mass) of the column at rest",
       "long-wave limit: a wave sees the mean stiffness and mass of many layers (Backus 1962)",
       "layers disperse a wave of 20 spacings by (2 pi/20)^2/24 = 0.4 %", layered_waves},
  };
}

}  // namespace phy::verification
