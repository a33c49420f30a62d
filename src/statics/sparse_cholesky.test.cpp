#include "statics/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <map>
#include <utility>

#include "base/rng.hpp"

namespace phy::statics {
namespace {

/// Entries (i, j) with i <= j.
using Entries = std::map<std::pair<int, int>, double>;

struct Sparse {
  SymmetricPattern pattern;
  std::vector<double> values;
};
Sparse sparse_of(const Entries& entries, int n) {
  Sparse s;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i <= j; ++i)
      if (const auto e = entries.find({i, j}); e != entries.end())
        s.pattern.row.push_back(i), s.values.push_back(e->second);
    s.pattern.column.push_back(static_cast<std::int32_t>(s.pattern.row.size()));
  }
  return s;
}
Eigen::MatrixXd dense_of(const Entries& entries, int n) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [at, value] : entries) K(at.first, at.second) = K(at.second, at.first) = value;
  return K;
}

double draw(int test, int i, int j) {
  return normal(7, Stream::test, static_cast<std::uint32_t>(test), static_cast<std::uint32_t>(1000 * i + j));
}
/// Springs between neighbours that `near` names, each between all of `size` movements, and weak ones to the
/// ground.
template <class Near>
Entries springs(int test, int n_bodies, int size, const Near& near) {
  Entries K;
  for (int i = 0; i < size * n_bodies; ++i) K[{i, i}] = 1e-3;
  for (int a = 0; a < n_bodies; ++a)
    for (int b = a + 1; b < n_bodies; ++b) {
      if (!near(a, b)) continue;
      for (int spring = 0; spring < size; ++spring) {
        std::vector<std::pair<int, double>> row;
        for (int c = 0; c < size; ++c)
          row.emplace_back(size * a + c, draw(test, a, 100 * spring + c)),
              row.emplace_back(size * b + c, draw(test, b, 100 * spring + 10 + c));
        for (const auto& [i, x] : row)
          for (const auto& [j, y] : row)
            if (i <= j) K[{i, j}] += x * y;
      }
    }
  return K;
}

void expect_solved(const Entries& entries, int n) {
  const Sparse s = sparse_of(entries, n);
  SparseCholesky factor(s.pattern);
  ASSERT_TRUE(factor.factorise(s.values));
  const Eigen::MatrixXd K = dense_of(entries, n);
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(draw(99, i, n));
  const Eigen::VectorXd b = Eigen::Map<Eigen::VectorXd>(x.data(), n);
  factor.solve(x);
  const Eigen::VectorXd found = Eigen::Map<Eigen::VectorXd>(x.data(), n), wanted = K.llt().solve(b);
  EXPECT_LT((found - wanted).norm(), 1e-9 * wanted.norm());  // conditions reach 1e5
  EXPECT_LT((K * found - b).norm(), 1e-11 * b.norm() * K.norm());
}

TEST(SparseCholesky, SolvesWhatADenseFactorSolves) {
  for (int test = 0; test < 20; ++test) {
    const int n = 5 + 6 * test, size = 1 + test % 3;
    const auto random = [&](int a, int b) { return draw(test, a, 500 + b) > 1.5; };
    expect_solved(springs(test, n, size, random), n * size);
  }
}

TEST(SparseCholesky, SolvesALatticeInAnyOrder) {
  // Row by row fills a band; every other body first leaves separate ones; the middle first fills everything.
  const int width = 9, n = width * width;
  const auto lattice = [&](const std::vector<int>& order) {
    std::vector<int> place(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) place[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] = i;
    return springs(1, n, 3, [&](int a, int b) {
      const int p = order[static_cast<std::size_t>(a)], q = order[static_cast<std::size_t>(b)];
      return std::abs(p / width - q / width) + std::abs(p % width - q % width) == 1;
    });
  };
  std::vector<int> rows, alternating, inside_out;
  for (int i = 0; i < n; ++i) rows.push_back(i);
  for (int i = 0; i < n; i += 2) alternating.push_back(i);
  for (int i = 1; i < n; i += 2) alternating.push_back(i);
  for (int i = 0; i < n; ++i) inside_out.push_back((n / 2 + i) % n);
  for (const std::vector<int>* order : {&rows, &alternating, &inside_out})
    expect_solved(lattice(*order), 3 * n);
}

// A string of n unit masses under its weight, both ends held: u_i = i (n + 1 - i)/2.
TEST(SparseCholesky, AStringHangsInAParabola) {
  const int n = 200;
  Entries K;
  for (int i = 0; i < n; ++i) {
    K[{i, i}] = 2.0;
    if (i > 0) K[{i - 1, i}] = -1.0;
  }
  const Sparse s = sparse_of(K, n);
  SparseCholesky factor(s.pattern);
  ASSERT_TRUE(factor.factorise(s.values));
  std::vector<double> u(static_cast<std::size_t>(n), 1.0);
  factor.solve(u);
  for (int i = 0; i < n; ++i) EXPECT_NEAR(u[static_cast<std::size_t>(i)], 0.5 * (i + 1) * (n - i), 1e-8);
}

TEST(SparseCholesky, FactorisesAnewWithOtherValues) {
  const auto chain = [](int a, int b) { return b - a < 3; };
  const Sparse one = sparse_of(springs(1, 30, 3, chain), 90), other = sparse_of(springs(2, 30, 3, chain), 90);
  SparseCholesky twice(one.pattern), once(other.pattern);
  ASSERT_TRUE(twice.factorise(one.values) && twice.factorise(other.values) && once.factorise(other.values));
  std::vector<double> x(90, 1.0), y(90, 1.0);
  twice.solve(x), once.solve(y);
  EXPECT_EQ(x, y);
}

TEST(SparseCholesky, RefusesWhatIsNotPositiveDefinite) {
  const auto positive = [](const Entries& K) {
    const Sparse s = sparse_of(K, 2);
    return SparseCholesky(s.pattern).factorise(s.values);
  };
  EXPECT_TRUE(positive({{{0, 0}, 2.0}, {{0, 1}, 1.0}, {{1, 1}, 2.0}}));
  EXPECT_FALSE(positive({{{0, 0}, 1.0}, {{0, 1}, 2.0}, {{1, 1}, 1.0}}));
  EXPECT_FALSE(positive({{{0, 0}, 1.0}, {{0, 1}, 1.0}, {{1, 1}, 1.0}}));
  EXPECT_FALSE(positive({{{0, 0}, -1.0}, {{1, 1}, 1.0}}));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(positive({{{0, 0}, 1.0}, {{1, 1}, bad}}));
}

TEST(SparseCholesky, OfNothingAndOfSingleNumbers) {
  EXPECT_TRUE(SparseCholesky(SymmetricPattern{}).factorise({}));
  const Sparse s = sparse_of({{{0, 0}, 4.0}, {{1, 1}, 16.0}}, 2);
  SparseCholesky factor(s.pattern);
  ASSERT_TRUE(factor.factorise(s.values));
  std::vector<double> x = {1.0, 1.0};
  factor.solve(x);
  EXPECT_EQ(x, (std::vector<double>{0.25, 0.0625}));
}

}  // namespace
}  // namespace phy::statics
