// Every law of the list against its closed form along random paths: what is stepped must be what is solved.
#include "verification/contact_witness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/rng.hpp"
#include "lab/contact_bench.hpp"

namespace phy::verification {
namespace {

constexpr double widest = 3e-4;  // [m] half length of interfaces, which open first at their ends

/// Corners of a random walk. Where `closed`, the contact is never opened.
std::vector<ContactPoint> random_corners(std::uint32_t path, bool closed) {
  std::vector<ContactPoint> corners;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const std::uint32_t k = 12 * path + i;
    ContactPoint p{4e-6 * normal(5, Stream::test, k, 0), 2e-5 * normal(5, Stream::test, k, 1),
                   2e-3 * normal(5, Stream::test, k, 2)};
    if (closed) p.closure = 1e-7 + std::fabs(p.closure) + widest * std::fabs(p.rotation);
    corners.push_back(p);
  }
  return corners;
}

std::vector<double> parameters_of(const lab::LawInfo& law) {
  std::vector<double> v;
  for (const laws::ParameterInfo& p : law.parameters) {
    const bool angle = std::string_view(p.name).starts_with("tan");
    v.push_back(angle ? 0.2 : p.typical);
  }
  return v;
}

struct Difference {
  double largest = 0.0, force = 0.0;
  bool broken = false;  ///< in the end
};

Difference compare(const lab::LawInfo& law, const std::vector<ContactPoint>& corners, int steps) {
  const std::vector<double> v = parameters_of(law);
  const auto contact = lab::bench_contact(law.name, v);
  const auto rows = lab::drive(*contact, corners, steps);
  const auto exact = witness(law.name, v, corners, steps);
  EXPECT_EQ(exact.size(), rows.size()) << law.name << " has no closed form";
  Difference d;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ContactForces &a = rows[i].forces, &b = exact[i];
    const double moment = 1e4;  // [1/m]: what a couple weighs against a force, 1/R of a grain
    d.force = std::max({d.force, std::fabs(b.F_n), std::fabs(b.F_s)});
    d.largest = std::max(
        {d.largest, std::fabs(a.F_n - b.F_n), std::fabs(a.F_s - b.F_s), moment * std::fabs(a.M - b.M)});
  }
  d.broken = contact->capacity() == 0.0;
  return d;
}

// On straight legs of a closed contact every law is exact for steps of any size: Coulomb's limit, the bond's
// strengths and the implicit dilation are all met at the end of the step in which they are reached.
TEST(ContactBench, EqualsTheClosedFormWhileClosed) {
  for (const lab::LawInfo& law : lab::law_infos()) {
    for (std::uint32_t path = 0; path < 50; ++path) {
      std::vector<ContactPoint> corners{{1e-7, 0.0, 0.0}};  // the approach, without slide
      for (const ContactPoint& p : random_corners(path, true)) corners.push_back(p);
      const Difference d = compare(law, corners, 40);
      EXPECT_LE(d.largest, 1e-11 * d.force) << law.name << ", path " << path;
    }
  }
}

// A contact that touches within a step slides for a part of it; the linear law counts the whole. The error is
// the slide of one step, so it must fall in proportion to the step.
TEST(ContactBench, ComesToTheClosedFormWhereContactsOpenAndClose) {
  for (const lab::LawInfo& law : lab::law_infos()) {
    double coarse = 0.0, fine = 0.0, force = 0.0;
    int n_broken = 0;
    for (std::uint32_t path = 0; path < 20; ++path) {
      const auto corners = random_corners(path, false);
      const Difference c = compare(law, corners, 200), f = compare(law, corners, 6400);
      coarse += c.largest, fine += f.largest, force = std::max(force, f.force);
      n_broken += f.broken ? 1 : 0;
    }
    EXPECT_LE(fine, std::max(coarse / 10.0, 1e-11 * force)) << law.name;
    const bool breaks = std::string_view(law.parameters.back().name) == "capacity";
    EXPECT_TRUE(!breaks || n_broken == 20) << law.name << ": every path is to break what can break";
  }
}

// Work put in = stored + dissipated + released along a fine path: the energy balance of the bench closes.
TEST(ContactBench, EnergyBalanceCloses) {
  for (const lab::LawInfo& law : lab::law_infos()) {
    const std::vector<double> v = parameters_of(law);
    const auto contact = lab::bench_contact(law.name, v);
    const auto rows = lab::drive(*contact, random_corners(3, false), 20000);
    double work = 0.0, most = 0.0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const ContactPoint d = rows[i].at - rows[i - 1].at;
      const ContactForces &a = rows[i - 1].forces, &b = rows[i].forces;
      work += 0.5 * ((a.F_n + b.F_n) * d.closure - (a.F_s + b.F_s) * d.slide - (a.M + b.M) * d.rotation);
      most = std::max(most, std::fabs(work));
    }
    const lab::BenchRow& end = rows.back();
    EXPECT_NEAR(work, end.stored + end.dissipated + end.released, 2e-3 * most) << law.name;
  }
}

TEST(ContactBench, UnknownLawIsNull) { EXPECT_EQ(lab::bench_contact("rubber", {}), nullptr); }

}  // namespace
}  // namespace phy::verification
