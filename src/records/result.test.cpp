// What a result's fingerprint covers, and how outcomes are named.
#include "records/result.hpp"
#include "records/test_description.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy {
namespace {

TestResult at_position(double ux, Status status) {
  TestResult r;
  r.outcome.status = status;
  r.snapshots.emplace_back();
  r.snapshots.back().grains.push_back({ux, 0.0, 0.0});
  return r;
}

TEST(ResultHash, CoversFinalPositionsUnlessTheTestBlewUp) {
  EXPECT_NE(hash_of(at_position(1e-6, Status::peaked)), hash_of(at_position(2e-6, Status::peaked)));
  EXPECT_EQ(hash_of(at_position(std::nan(""), Status::unstable)),
            hash_of(at_position(-std::nan(""), Status::unstable)));
}

TEST(Status, IsReadByTheNameThatIsWritten) {
  for (const Status s : all_statuses) EXPECT_EQ(status_of(to_string(s)), s);
  EXPECT_EQ(std::size(all_statuses), static_cast<std::size_t>(Status::knee) + 1);
  EXPECT_FALSE(status_of("cracked"));
}

}  // namespace
}  // namespace phy
