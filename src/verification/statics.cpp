// The direct elastic solution against closed forms of lattices and of a beam.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/units.hpp"
#include "records/assembly.hpp"
#include "statics/system.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

constexpr double R_cell = 1e-3;
constexpr double exact = 1e-10;

MatrixRecipe parallel_bonds() {
  MatrixRecipe m;
  m.E_c = 31e9, m.ks_over_kn = 0.25, m.E_b = 17e9, m.bond_ks_over_kn = 0.6;
  return m;
}

/// Its E_c is k_n 2R of equal discs, as that of a linear contact; nothing lies beside it.
MatrixRecipe elastic_flat_joints() {
  MatrixRecipe m;
  m.model = MatrixModel::flat_joint;
  m.E_c = 43e9, m.ks_over_kn = 0.35;
  return m;
}

/// Periodic cell of equal discs; all pairs that touch across the borders too are bonded.
struct Cell {
  Specimen specimen;
  Vec2 period;
  double bond_modulus() const {
    return specimen.matrix.model == MatrixModel::flat_joint ? 0.0 : specimen.matrix.E_b;
  }
  double K_n() const { return specimen.matrix.E_c + bond_modulus(); }
  double K_s() const {
    const MatrixRecipe& m = specimen.matrix;
    return m.E_c * m.ks_over_kn + bond_modulus() * m.bond_ks_over_kn;
  }

  Cell(const std::vector<Disc>& discs, Vec2 size, const MatrixRecipe& m) : period(size) {
    specimen = assembly(discs, m);
    const auto nearest = [](double x, double p) { return x - p * std::floor(x / p + 0.5); };
    for (std::uint32_t a = 0; a < discs.size(); ++a) {
      for (std::uint32_t b = a + 1; b < discs.size(); ++b) {
        const Vec2 d{nearest(discs[b].x - discs[a].x, period.x), nearest(discs[b].y - discs[a].y, period.y)};
        // The nearest image: cells are at least three discs wide, so that it is the only one.
        if (norm(d) > 2.0 * R_cell * (1.0 + 1e-6)) continue;
        Contact c;
        c.a = a, c.b = b, c.sigma_c = m.sigma_c, c.tau_c = m.tau_c;
        specimen.contacts.push_back(c);
      }
    }
  }
  statics::Network network() const { return statics::make_network(specimen, period); }
  Eigen::Matrix3d stiffness() const {
    const statics::CellStiffness cell = statics::cell_stiffness(network(), period.x * period.y);
    Eigen::Matrix3d C;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) C(i, j) = cell.C[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return C;
  }
};

Cell hexagonal_cell(int n_x, int n_y, const MatrixRecipe& m = parallel_bonds()) {
  return {hexagonal(n_x, n_y, R_cell), {2.0 * R_cell * n_x, root3 * R_cell * n_y}, m};
}

std::vector<Check> moduli_of(const Cell& cell) {
  // Per unit of thickness, three contact directions at 60 degrees: sums of N N and T T over them.
  const double n = cell.K_n(), s = cell.K_s(), q = root3 / 4.0;
  const Eigen::Matrix3d C = cell.stiffness(), S = C.inverse();
  return {{"C11 [Pa]", q * (3.0 * n + s), C(0, 0), exact},
          {"C22 [Pa]", q * (3.0 * n + s), C(1, 1), exact},
          {"C12 [Pa]", q * (n - s), C(0, 1), exact},
          {"C66 [Pa]", q * (n + s), C(2, 2), exact},
          {"E [Pa]", 2.0 * root3 * n * (n + s) / (3.0 * n + s), 1.0 / S(1, 1), exact},
          {"nu [-]", (n - s) / (3.0 * n + s), -S(0, 1) / S(1, 1), exact}};
}

std::vector<Check> hexagonal_lattice() { return moduli_of(hexagonal_cell(4, 4)); }

// Three contact directions; their uniform spin against the lattice is the one that costs least energy. Voigt
// vectors of the normal and the tangential stretch of a contact at the angle phi: N and T.
std::vector<Check> directional_lattice() {
  std::vector<Check> checks;
  for (const double theta : {0.0, 25.0, 90.0}) {
    Cell cell = hexagonal_cell(4, 4);
    MatrixRecipe& m = cell.specimen.matrix;
    // Far from 1, so that terms of second order would show.
    m.stiffness_ratio = 2.2, m.foliation = theta;
    const double turn = theta * pi / 180.0, W = (1.0 - 2.2) / (1.0 + 2.2);
    Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
    Eigen::Vector3d spin = Eigen::Vector3d::Zero();
    double sum = 0.0;
    for (const double phi : {0.0, pi / 3.0, 2.0 * pi / 3.0}) {
      const double c = std::cos(phi), s = std::sin(phi), f = 1.0 - W * std::cos(2.0 * (phi - turn));
      const Eigen::Vector3d N(c * c, s * s, c * s), T(-c * s, c * s, 0.5 * (c * c - s * s));
      C += f * (cell.K_n() * N * N.transpose() + cell.K_s() * T * T.transpose());
      // Grains turn with the mean spin that minimises the energy of shear; equal stiffness in all directions
      // gives none.
      spin += f * T, sum += f;
    }
    C = 2.0 / root3 * (C - cell.K_s() * spin * spin.transpose() / sum);
    for (Contact& c : cell.specimen.contacts) {
      const auto& d = cell.specimen.packing->discs;
      double x = d[c.b].x - d[c.a].x, y = d[c.b].y - d[c.a].y;
      x -= cell.period.x * std::floor(x / cell.period.x + 0.5);
      y -= cell.period.y * std::floor(y / cell.period.y + 0.5);
      c.cos_2a = -std::cos(2.0 * (std::atan2(y, x) - turn));
    }
    const Eigen::Matrix3d found = cell.stiffness(), S = C.inverse(), S_found = found.inverse();
    const std::string at = " at " + print_number(theta) + " deg";
    checks.push_back({"C11" + at + " [Pa]", C(0, 0), found(0, 0), exact});
    checks.push_back({"C22" + at + " [Pa]", C(1, 1), found(1, 1), exact});
    checks.push_back({"C12" + at + " [Pa]", C(0, 1), found(0, 1), exact});
    checks.push_back({"C66" + at + " [Pa]", C(2, 2), found(2, 2), exact});
    if (theta == 25.0) checks.push_back({"C26" + at + " [Pa]", C(1, 2), found(1, 2), exact});
    checks.push_back({"E" + at + " [Pa]", 1.0 / S(1, 1), 1.0 / S_found(1, 1), exact});
  }
  return checks;
}

std::vector<Check> square_lattice() {
  std::vector<Disc> discs;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      discs.push_back({R_cell * (1.0 + 2.0 * column), R_cell * (1.0 + 2.0 * row), R_cell});
  const Cell cell(discs, {8.0 * R_cell, 8.0 * R_cell}, parallel_bonds());
  const double n = cell.K_n(), s = cell.K_s();
  const Eigen::Matrix3d C = cell.stiffness(), S = C.inverse();
  // S for a stress of 1 along the diagonal: (1/2, 1/2, 1/2) in Voigt's order.
  const Eigen::Vector3d along_diagonal = S * Eigen::Vector3d(0.5, 0.5, 0.5);
  return {{"E along the rows [Pa]", n, 1.0 / S(1, 1), exact},
          {"nu along the rows [-]", 0.0, -S(0, 1) / S(1, 1), exact},
          {"C66 [Pa]", 0.5 * s, C(2, 2), exact},
          {"E at 45 degrees [Pa]", 2.0 * n * s / (n + s), 2.0 / along_diagonal.sum(), exact}};
}

/// Joints between every m-th row and the next.
void add_joint_rows(Cell& cell, int n_x, int m) {
  BeddingRecipe set;
  set.k_n = 3360e9, set.k_s = 960e9;
  cell.specimen.bedding.push_back(set);
  for (Contact& c : cell.specimen.contacts) {
    const int row_a = static_cast<int>(c.a) / n_x, row_b = static_cast<int>(c.b) / n_x;
    // The pair across the border of the cell.
    const bool wraps = row_b - row_a > 1;
    if (row_a == row_b || ((wraps ? row_b : row_a) + 1) % m != 0) continue;
    c.kind = ContactKind::joint;
    c.side = wraps ? -1 : 1;
  }
}

std::vector<Check> joint_rows() {
  std::vector<Check> checks;
  for (const int m : {2, 4, 16}) {
    Cell cell = hexagonal_cell(4, 2 * m);
    add_joint_rows(cell, 4, m);
    const double n = cell.K_n(), s = cell.K_s(), A = 2.0 * R_cell, rows = m, q = root3 / 4.0;
    const BeddingRecipe& set = cell.specimen.bedding[0];
    Eigen::Matrix3d M;  // lateral strain, opening of a bonded row, opening of a joint row; stress 1
    M << q * (n - s) * R_cell, (3.0 * n + s) / 4.0, 0.0, 0.0, 0.0, set.k_n * A,
        2.0 * rows * R_cell * n + (rows - 1.0) * (n + 3.0 * s) / 4.0 * R_cell + set.k_s * A * R_cell,
        (rows - 1.0) * q * (n - s), 0.0;
    // Equilibrium sideways, along the load in a bonded row, and along it in a joint row.
    const Eigen::Vector3d x = M.fullPivLu().solve(Eigen::Vector3d(R_cell, R_cell, 0.0));
    const Eigen::Matrix3d S = cell.stiffness().inverse();
    // The period: all bonded rows and one joint row, each by its own opening.
    checks.push_back({"E across a joint row every " + std::to_string(m) + " rows [Pa]",
                      rows * root3 * R_cell / ((rows - 1.0) * x[1] + x[2]), 1.0 / S(1, 1), exact});
  }
  return checks;
}

/// k_s, k_m: of a contact.
std::vector<Check> cantilever_of(const MatrixRecipe& matrix, double k_s, double k_m) {
  constexpr std::uint32_t n = 12;
  const double N = n, P = 5.0;
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i <= n; ++i) discs.push_back({R_cell + 2.0 * R_cell * i, R_cell, R_cell});
  Specimen s = assembly(discs, matrix);
  bond_touching(s);
  const statics::Network net = statics::make_network(s);
  // Discs in a row that is bent open on one side: only the bonds are to answer.
  const std::vector<char> bonds_only(net.links.size(), 0);
  statics::Boundary boundary;
  statics::move_with(boundary, net, 0, {});
  // Two load cases: sag and turn of the end under each, four compliances of a beam.
  boundary.loads = {{{n, 1}, P}};
  const statics::Movements force = statics::solve_once(net, boundary, bonds_only).u;
  boundary.loads = {{{n, 2}, P}};
  const statics::Movements moment = statics::solve_once(net, boundary, bonds_only).u;
  const double sag = P * (N * (4.0 * N * N - 1.0) * R_cell * R_cell / (3.0 * k_m) + N / k_s);
  return {{"deflection under a tip force [m]", sag, force[3 * n + 1], exact},
          {"rotation under a tip force [rad]", P * N * N * R_cell / k_m, force[3 * n + 2], exact},
          {"deflection under an end moment [m]", P * N * N * R_cell / k_m, moment[3 * n + 1], exact},
          {"rotation under an end moment [rad]", N * P / k_m, moment[3 * n + 2], exact}};
}

/// k_m of a bond of length 2R between equal discs: E_b/(2R) (2/3) R^3.
std::vector<Check> cantilever() {
  const MatrixRecipe m;
  return cantilever_of(m, m.bond_ks_over_kn * m.E_b, m.E_b * R_cell * R_cell / 3.0);
}

std::vector<Check> forces_of(const Cell& cell) {
  const statics::Network net = cell.network();
  const double n = cell.K_n(), s = cell.K_s(), stress = 1e6;
  const Eigen::Vector3d e = cell.stiffness().inverse() * Eigen::Vector3d(0.0, -stress, 0.0);
  statics::Boundary boundary;
  boundary.movements = {{{0, 0}, 0.0}, {{0, 1}, 0.0}};
  // A symmetric gradient: the cell as a whole does not turn.
  boundary.gradient = {e[0], 0.5 * e[2], 0.5 * e[2], e[1]};
  const statics::Movements u = statics::solve_once(net, boundary).u;
  double inclined_n = 0.0, inclined_s = 0.0, level_n = 0.0, couple = 0.0, level = 0.0, inclined = 0.0;
  for (const statics::Link& l : net.links) {
    const auto q = statics::forces(statics::stiffness(l, true), statics::strains(l, u, boundary.gradient));
    couple = std::max(couple, std::fabs(q[2]) / (stress * R_cell * R_cell));
    // Contacts across the load are level; the other two directions are inclined by 60 degrees.
    if (std::fabs(l.n.y) < 0.1)
      level_n += q[0], level += 1.0;
    else
      inclined_n += q[0], inclined_s += std::fabs(q[1]), inclined += 1.0;
  }
  return {
      {"normal force, inclined contacts [N/m]", stress * R_cell * (2.0 * n + s) / (root3 * (n + s)),
       inclined_n / inclined, exact},
      {"shear force, inclined contacts [N/m]", stress * R_cell * s / (n + s), inclined_s / inclined, exact},
      {"normal force, contacts across the load [N/m]", -stress * R_cell * (n - s) / (root3 * (n + s)),
       level_n / level, exact},
      {"largest couple / (stress R^2) [-]", 0.0, couple, exact}};
}

std::vector<Check> contact_forces() { return forces_of(hexagonal_cell(4, 4)); }

/// V1, V5 and V13 over again; no contact only pushes, so they hold in tension as in compression.
std::vector<Check> lattice_of_flat_joints() {
  const Cell cell = hexagonal_cell(4, 4, elastic_flat_joints());
  const auto& links = cell.network().links;
  // A bonded interface pulls as it pushes; V1 holds then for tension, too.
  const auto n = std::count_if(links.begin(), links.end(), [](const auto& l) { return l.unilateral; });
  std::vector<Check> checks = {{"contacts that only push", 0.0, static_cast<double>(n), 0.0}};
  const MatrixRecipe& m = cell.specimen.matrix;
  for (const auto& part : {moduli_of(cell), forces_of(cell),
                           cantilever_of(m, m.ks_over_kn * m.E_c, m.E_c * R_cell * R_cell / 3.0)})
    checks.insert(checks.end(), part.begin(), part.end());
  return checks;
}

}  // namespace

std::vector<VerificationCase> statics_cases() {
  const std::string source = "derived by hand from the contact laws; docs/theory/statics.md";
  const std::string why = "one direct solution: rounding";
  return {
      {"V1", "Hexagonal lattice: isotropic, with the moduli of its contacts", source, why, hexagonal_lattice},
      {"V2", "Square lattice: moduli along the rows and across", source, why, square_lattice},
      {"V3", "Hexagonal lattice with rows of smooth joints", source, why, joint_rows},
      {"V5", "Cantilever of bonded discs", source, why, cantilever},
      {"V13", "Contact forces of a hexagonal lattice under uniaxial stress", source, why, contact_forces},
      {"V23", "Hexagonal lattice of a matrix with directions",
       "derived by hand: three contact directions, spin of least energy; docs/theory/directions.md", why,
       directional_lattice},
      {"V24", "FJ9. Flat joints: hexagonal lattice and cantilever", source, why, lattice_of_flat_joints}};
}

}  // namespace phy::verification
