// Does an exception come back, and does everybody come home, also where there is no thread to be had?
#include "base/parallel.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <stdexcept>

namespace phy {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;  // whose own memory does not fit under a limit
#else
constexpr bool sanitized = false;
#endif

/// Room for about two more stacks, until the end of the scope.
class FewThreads {
 public:
  FewThreads() {
    ::getrlimit(RLIMIT_AS, &before_);
    rlimit stack{};
    ::getrlimit(RLIMIT_STACK, &stack);
    const rlim_t size = stack.rlim_cur == RLIM_INFINITY ? rlim_t{2} << 20U : stack.rlim_cur;
    rlimit now = before_;
    now.rlim_cur = in_use() + 5 * size / 2;
    ::setrlimit(RLIMIT_AS, &now);
  }
  ~FewThreads() { ::setrlimit(RLIMIT_AS, &before_); }
  FewThreads(const FewThreads&) = delete;
  FewThreads& operator=(const FewThreads&) = delete;

 private:
  rlimit before_{};
  static rlim_t in_use() {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * 4096;
  }
};

TEST(OnThreads, NobodyWaitsForOneWhoNeverCame) {
  if (sanitized) GTEST_SKIP() << "not under a sanitizer";
  constexpr std::size_t n = 16;
  std::atomic<bool> broken{false};
  std::atomic<std::size_t> n_started{0}, n_left{0};
  const FewThreads few;
  try {
    on_threads(
        n, broken,
        [&](std::size_t) {
          ++n_started;
          while (!broken) std::this_thread::yield();
        },
        [&] { ++n_left; });
    ADD_FAILURE() << "16 threads in the room of two";
  } catch (const std::system_error& e) {
    EXPECT_NE(std::string(e.what()).find("of 16 cannot be started; use fewer (--threads)"), std::string::npos)
        << e.what();
  }
  EXPECT_GE(n_started, 1U);
  EXPECT_LT(n_started, n);
  EXPECT_EQ(n_left, n);
}

TEST(ForAll, DoesEveryPieceOnce) {
  std::vector<std::atomic<int>> times(1000);
  for_all(times.size(), 4, [&] { return [&](std::size_t i) { ++times[i]; }; });
  for (const auto& t : times) EXPECT_EQ(t, 1);
}

TEST(ForAll, AfterAnExceptionNoPieceIsBegun) {
  std::atomic<std::size_t> n_begun{0};
  const auto worker = [&](std::size_t i) {
    ++n_begun;
    if (i == 3) throw std::runtime_error("piece 3");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  try {
    for_all(100000, 4, [&] { return worker; });
    ADD_FAILURE() << "the exception is lost";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "piece 3");
  }
  EXPECT_LT(n_begun, 1000U);
}

}  // namespace
}  // namespace phy
