// The linear system against closed forms of lattices (V1-V3, V13) and of a beam (V5), to 1e-10.
#include "statics/system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "records/assembly.hpp"

namespace phy::statics {
namespace {

constexpr double R = 1e-3;
const double root3 = std::sqrt(3.0);
constexpr double exact = 1e-10;

MatrixRecipe stiff_matrix() {
  MatrixRecipe m;
  m.E_c = 31e9, m.ks_over_kn = 0.25;
  m.E_b = 17e9, m.bond_ks_over_kn = 0.6;
  return m;
}
double K_n(const MatrixRecipe& m) { return m.E_c + m.E_b; }  // equal radii, lambda = 1, both conventions
double K_s(const MatrixRecipe& m) { return m.E_c * m.ks_over_kn + m.E_b * m.bond_ks_over_kn; }

/// All pairs that touch across the borders of a periodic cell too.
void bond_periodic(Specimen& s, Vec2 period) {
  const auto& d = s.packing->discs;
  const auto image = [](double x, double p) { return x - p * std::floor(x / p + 0.5); };
  for (std::uint32_t a = 0; a < d.size(); ++a)
    for (std::uint32_t b = a + 1; b < d.size(); ++b) {
      if (norm({image(d[b].x - d[a].x, period.x), image(d[b].y - d[a].y, period.y)}) > 2.0 * R * (1.0 + 1e-6))
        continue;
      Contact c;
      c.a = a, c.b = b, c.sigma_c = c.tau_c = 1e30;
      s.contacts.push_back(c);
    }
}

struct Cell {
  Specimen specimen;
  Vec2 period;
  double area() const { return period.x * period.y; }
};

Cell hexagonal_cell(int n_x, int n_y) {
  Cell cell{assembly(hexagonal(n_x, n_y, R), stiff_matrix()), {2.0 * R * n_x, root3 * R * n_y}};
  bond_periodic(cell.specimen, cell.period);
  return cell;
}

Eigen::Matrix3d stiffness_of(const Cell& cell) {
  const CellStiffness c = cell_stiffness(make_network(cell.specimen, cell.period), cell.area());
  EXPECT_TRUE(c.outcome.ok()) << c.outcome.reason;
  Eigen::Matrix3d C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) = c.C[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return C;
}

void expect_near(double found, double expected) { EXPECT_NEAR(found, expected, exact * std::fabs(expected)); }

TEST(Lattice, HexagonalPeriodicCellIsIsotropicWithTheClosedForm) {  // V1
  const Cell cell = hexagonal_cell(4, 4);
  const double n = K_n(cell.specimen.matrix), s = K_s(cell.specimen.matrix);
  const Eigen::Matrix3d C = stiffness_of(cell);
  const double q = root3 / 4.0;
  expect_near(C(0, 0), q * (3.0 * n + s));
  expect_near(C(1, 1), q * (3.0 * n + s));
  expect_near(C(0, 1), q * (n - s));
  expect_near(C(2, 2), q * (n + s));
  EXPECT_NEAR(C(0, 2), 0.0, exact * n);
  const Eigen::Matrix3d S = C.inverse();
  expect_near(1.0 / S(1, 1), 2.0 * root3 * n * (n + s) / (3.0 * n + s));
  expect_near(-S(0, 1) / S(1, 1), (n - s) / (3.0 * n + s));
}

TEST(Lattice, SquarePeriodicCell) {  // V2
  Cell cell{{}, {8.0 * R, 8.0 * R}};
  std::vector<Disc> discs;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) discs.push_back({R * (1.0 + 2.0 * i), R * (1.0 + 2.0 * j), R});
  cell.specimen = assembly(discs, stiff_matrix());
  bond_periodic(cell.specimen, cell.period);
  const double n = K_n(cell.specimen.matrix), s = K_s(cell.specimen.matrix);
  const Eigen::Matrix3d C = stiffness_of(cell), S = C.inverse();
  expect_near(1.0 / S(1, 1), n);
  EXPECT_NEAR(S(0, 1) / S(1, 1), 0.0, exact);
  expect_near(C(2, 2), 0.5 * s);
  const Eigen::Vector3d stress(0.5, 0.5, 0.5);  // 1 along the diagonal
  const Eigen::Vector3d strain = S * stress;    // (xx, yy, 2 xy)
  expect_near(2.0 / strain.sum(), 2.0 * n * s / (n + s));
}

/// The hexagonal cell with a row of joints above every m-th row of discs.
Cell jointed_cell(int n_x, int n_y, int m) {
  Cell cell = hexagonal_cell(n_x, n_y);
  BeddingRecipe set;
  set.k_n = 3360e9, set.k_s = 960e9;
  cell.specimen.bedding.push_back(set);
  for (Contact& c : cell.specimen.contacts) {
    const int row_a = static_cast<int>(c.a) / n_x, row_b = static_cast<int>(c.b) / n_x;
    if (row_a == row_b) continue;
    const bool wraps = row_b - row_a > 1;
    const int lower = wraps ? row_b : row_a;
    if ((lower + 1) % m != 0) continue;
    c.kind = ContactKind::joint;
    c.side = wraps ? -1 : 1;
  }
  return cell;
}

TEST(Lattice, HexagonalCellWithJointRows) {  // V3
  for (const int m : {2, 4, 8}) {
    const Cell cell = jointed_cell(4, 2 * m, m);
    const double n = K_n(cell.specimen.matrix), s = K_s(cell.specimen.matrix);
    const BeddingRecipe& set = cell.specimen.bedding[0];
    const double A = 2.0 * R, rows = m;
    const double a = root3 / 4.0 * (n - s) * R, b = (3.0 * n + s) / 4.0, c = (n + 3.0 * s) / 4.0;
    const double d = root3 / 4.0 * (n - s);
    Eigen::Matrix3d M;  // unknowns: lateral strain, opening of a bonded and of a joint row; stress 1
    M << a, b, 0.0, 0.0, 0.0, set.k_n * A, 2.0 * rows * R * n + (rows - 1.0) * c * R + set.k_s * A * R,
        (rows - 1.0) * d, 0.0;
    const Eigen::Vector3d x = M.fullPivLu().solve(Eigen::Vector3d(R, R, 0.0));
    const double expected = rows * root3 * R / ((rows - 1.0) * x[1] + x[2]);
    const Eigen::Matrix3d S = stiffness_of(cell).inverse();
    expect_near(1.0 / S(1, 1), expected);
    expect_near(S(0, 1), x[0]);
  }
}

TEST(Lattice, ForcesUnderUniaxialStress) {  // V13
  const Cell cell = hexagonal_cell(4, 4);
  const Network net = make_network(cell.specimen, cell.period);
  const MatrixRecipe& m = cell.specimen.matrix;
  const double n = K_n(m), s = K_s(m), stress = 1e6;
  const Eigen::Vector3d strain = stiffness_of(cell).inverse() * Eigen::Vector3d(0.0, -stress, 0.0);
  Boundary boundary;
  boundary.movements = {{{0, 0}, 0.0}, {{0, 1}, 0.0}};
  boundary.gradient = {strain[0], 0.5 * strain[2], 0.5 * strain[2], strain[1]};
  const LoadCase answer = solve_once(net, boundary);
  ASSERT_TRUE(answer.outcome.ok()) << answer.outcome.reason;
  for (const Link& l : net.links) {
    const auto q = forces(stiffness(l, true), strains(l, answer.u, boundary.gradient));
    if (std::fabs(l.n.y) < 0.1) {
      expect_near(q[0], -stress * R * (n - s) / (root3 * (n + s)));
      EXPECT_NEAR(q[1], 0.0, exact * stress * R);
    } else {
      expect_near(q[0], stress * R * (2.0 * n + s) / (root3 * (n + s)));
      expect_near(std::fabs(q[1]), stress * R * s / (n + s));
    }
    EXPECT_NEAR(q[2], 0.0, exact * stress * R * R);
  }
}

TEST(Lattice, PatchTestWithAffineBoundary) {
  const int n_x = 8, n_y = 9;
  Specimen s = assembly(hexagonal(n_x, n_y, R), stiff_matrix());
  bond_touching(s);
  const Network net = make_network(s);
  const Gradient g{1e-4, 3e-4, -2e-4, -5e-4};
  Boundary boundary;
  std::vector<char> inside(net.n_grains, 0);
  for (std::uint32_t i = 0; i < net.n_grains; ++i) {
    const int row = static_cast<int>(i) / n_x, column = static_cast<int>(i) % n_x;
    inside[i] = row > 0 && row + 1 < n_y && column > 0 && column + 1 < n_x;
    if (!inside[i]) move_with(boundary, net, i, g);
  }
  const LoadCase answer = solve_once(net, boundary);
  ASSERT_TRUE(answer.outcome.ok()) << answer.outcome.reason;
  for (std::uint32_t i = 0; i < net.n_grains; ++i) {
    const Vec2 u = g(net.x[i]);
    EXPECT_NEAR(answer.u[3 * i], u.x, exact * R);
    EXPECT_NEAR(answer.u[3 * i + 1], u.y, exact * R);
    EXPECT_NEAR(answer.u[3 * i + 2], 0.5 * (g.yx - g.xy), exact);
  }
}

/// N + 1 bonded discs in a row, the first one clamped.
Network beam(int n) {
  std::vector<Disc> discs;
  for (int i = 0; i <= n; ++i) discs.push_back({R + 2.0 * R * i, R, R});
  Specimen s = assembly(discs, stiff_matrix());
  bond_touching(s);
  return make_network(s);
}

TEST(Beam, CantileverUnderTipForceAndMoment) {  // V5
  const int n = 12;
  const double N = n;
  const Network net = beam(n);
  const Link& l = net.links[0];
  const double kn_I = l.k.bilateral.k_m, ks_A = l.k.bilateral.k_s;
  const std::vector<char> bonds_only(net.links.size(), 0);
  const std::size_t tip = 3 * static_cast<std::size_t>(n);
  Boundary boundary;
  move_with(boundary, net, 0, {});
  boundary.loads = {{{static_cast<std::uint32_t>(n), 1}, 5.0}};
  const LoadCase force = solve_once(net, boundary, bonds_only);
  ASSERT_TRUE(force.outcome.ok());
  expect_near(force.u[tip + 1], 5.0 * (N * (4.0 * N * N - 1.0) * R * R / (3.0 * kn_I) + N / ks_A));
  expect_near(force.u[tip + 2], 5.0 * N * N * R / kn_I);
  boundary.loads = {{{static_cast<std::uint32_t>(n), 2}, 7.0}};
  const LoadCase moment = solve_once(net, boundary, bonds_only);
  expect_near(moment.u[tip + 1], 7.0 * N * N * R / kn_I);
  expect_near(moment.u[tip + 2], 7.0 * N / kn_I);
}

TEST(System, ReactionsBalanceTheLoads) {
  const Network net = beam(5);
  Boundary boundary;
  move_with(boundary, net, 0, {});
  boundary.loads = {{{5, 0}, 3.0}, {{5, 1}, -4.0}, {{3, 2}, 2e-3}};
  const LoadCase answer = solve_once(net, boundary);
  const std::vector<double> f =
      inner_forces(net, stiffnesses(net, std::vector<char>(net.links.size(), 1)), answer.u);
  EXPECT_NEAR(f[0], -3.0, 1e-9);
  EXPECT_NEAR(f[1], 4.0, 1e-9);
  EXPECT_NEAR(f[2], -(2e-3 - 4.0 * 10.0 * R), 1e-9);
}

TEST(System, RigidMotionMakesNoForce) {
  const Cell cell = jointed_cell(4, 4, 2);
  Network net = make_network(cell.specimen);  // not periodic: distant pairs are long links, still rigid
  Movements u;
  for (const Vec2 x : net.x) u.insert(u.end(), {0.3 - 2.0 * x.y, -0.7 + 2.0 * x.x, 2.0});
  for (const Link& l : net.links)
    for (const double e : strains(l, u)) EXPECT_NEAR(e, 0.0, 1e-14);
}

// An interface that is broken over a part of its length couples force and moment. As two springs k_1, k_2 at
// distances h and -h from its middle, under a normal force P through the middle:
//   k_1 (c + h w) = k_2 (c - h w) = P/2,   so   c = P/4 (1/k_1 + 1/k_2),   w = P/(4 h) (1/k_1 - 1/k_2)
TEST(System, CoupledStiffnessTurnsWhatItIsPressedOn) {
  const double k_1 = 5e9, k_2 = 1e9, h = 0.3 * R, P = 1e3;
  Specimen s = assembly({{0.0, 0.0, R}, {2.0 * R, 0.0, R}}, stiff_matrix());
  bond_touching(s);
  Network net = make_network(s);
  laws::Tangent<double> k{k_1 + k_2, 4e9, (k_1 + k_2) * h * h};
  k.k_nm = (k_1 - k_2) * h;
  net.links[0].k = {{0.0, 0.0, 0.0}, k};
  Boundary boundary;
  move_with(boundary, net, 0, {});
  boundary.loads = {{{1, 0}, -P}};
  const LoadCase answer = solve_once(net, boundary);
  ASSERT_TRUE(answer.outcome.ok()) << answer.outcome.reason;
  expect_near(-answer.u[3], P / 4.0 * (1.0 / k_1 + 1.0 / k_2));
  expect_near(answer.u[5], P / (4.0 * h) * (1.0 / k_1 - 1.0 / k_2));
  // With one of them broken off the grain turns about the other without resistance.
  net.links[0].k.bilateral.k_n = k_1, net.links[0].k.bilateral.k_m = k_1 * h * h,
  net.links[0].k.bilateral.k_nm = k_1 * h;
  const auto loose = loose_bodies(net, stiffnesses(net, {1}), {{0, 0}, {0, 1}, {0, 2}});
  EXPECT_EQ(loose, (std::vector<char>{0, 1}));
}

TEST(System, RefusesStiffnessesThatAreNone) {
  Network net = beam(3);
  Boundary boundary;
  move_with(boundary, net, 0, {});
  const contact::ElasticPart sound = net.links[0].k;
  net.links[0].k.bilateral.k_n = -1e12;
  LoadCase answer = solve_once(net, boundary);
  EXPECT_EQ(answer.outcome.status, ElasticStatus::bad_stiffness);
  EXPECT_EQ(answer.outcome.grains, (std::vector<std::uint32_t>{0, 1}));
  net.links[0].k = sound, net.links[1].branch.x = std::nan("");
  answer = solve_once(net, boundary);
  EXPECT_EQ(answer.outcome.status, ElasticStatus::bad_stiffness);
  EXPECT_EQ(answer.outcome.grains, (std::vector<std::uint32_t>{1, 2}));
}

TEST(System, NamesTheLoadedMechanism) {
  Network net = beam(3);
  net.links.pop_back();
  Boundary boundary;
  move_with(boundary, net, 0, {});
  boundary.loads = {{{3, 1}, 1.0}};
  const LoadCase answer = solve_once(net, boundary);
  EXPECT_EQ(answer.outcome.status, ElasticStatus::mechanism);
  EXPECT_EQ(answer.outcome.grains, std::vector<std::uint32_t>{3});
}

TEST(Rigidity, OneJointIsAHingeTwoAreNot) {
  std::vector<Disc> discs{{0, 0, R}, {2 * R, 0, R}, {R, root3 * R, R}};
  Specimen s = assembly(discs, stiff_matrix());
  bond_touching(s);
  s.bedding.push_back({});
  for (Contact& c : s.contacts)
    if (c.b == 2) c.kind = ContactKind::joint, c.side = 1;
  Network net = make_network(s);
  const std::vector<Freedom> clamp{{0, 0}, {0, 1}, {0, 2}};
  const auto loose = [&] {
    return loose_bodies(net, stiffnesses(net, std::vector<char>(net.links.size(), 1)), clamp);
  };
  EXPECT_EQ(loose(), (std::vector<char>{0, 0, 0}));
  net.links.pop_back();
  EXPECT_EQ(loose(), (std::vector<char>{0, 0, 1}));
  net.links.pop_back();
  EXPECT_EQ(loose(), (std::vector<char>{0, 0, 1}));
}

}  // namespace
}  // namespace phy::statics
