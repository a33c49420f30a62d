#include "calibrate/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rng.hpp"
#include "base/stats.hpp"

namespace phy::calibrate {
namespace {

using Chain = std::vector<double>;

/// Variances of several chains of one length: inside, and of everything.
struct Variances {
  double within = 0.0, total = 0.0;
};
Variances variances_of(const std::vector<Chain>& chains) {
  const auto n = static_cast<double>(chains.front().size());
  std::vector<double> means;
  Variances v;
  for (const Chain& chain : chains) {
    const Summary s = summarise(chain);
    means.push_back(s.mean), v.within += s.sd * s.sd / static_cast<double>(chains.size());
  }
  const double between = summarise(means).sd;
  // Too large as long as chains disagree, so that its ratio to what is inside falls to one as they mix.
  v.total = (n - 1.0) / n * v.within + between * between;
  return v;
}

/// Mean over chains of the autocovariance at a lag (divisor: the length).
double autocovariance(const std::vector<Chain>& chains, std::size_t lag) {
  double sum = 0.0;
  for (const Chain& chain : chains) {
    const double mean = summarise(chain).mean;
    for (std::size_t i = lag; i < chain.size(); ++i) sum += (chain[i] - mean) * (chain[i - lag] - mean);
  }
  return sum / static_cast<double>(chains.size() * chains.front().size());
}

/// Draws over the integrated autocorrelation time.
double effective_of(const std::vector<Chain>& chains) {
  const Variances v = variances_of(chains);
  const auto n = static_cast<double>(chains.front().size());
  const auto correlation = [&](std::size_t lag) {
    return 1.0 - (v.within - autocovariance(chains, lag) * n / (n - 1.0)) / v.total;
  };
  // The time is 1 + 2 (sum from lag 1 on). Pairs begin with lag 0, whose 1 is doubled too: hence the -1.
  double time = -1.0, least = 2.0;
  // By pairs, since a single odd lag of a healthy chain may be negative. Of a reversible chain pairs are
  // positive and fall.
  for (std::size_t lag = 0; lag + 1 < chains.front().size(); lag += 2) {
    const double pair = correlation(lag) + correlation(lag + 1);
    // From here on there is noise only, and its sum would not settle.
    if (pair <= 0.0) break;
    least = std::min(least, pair), time += 2.0 * least;
  }
  // Never more than there are: draws that alternate would claim it.
  return static_cast<double>(chains.size()) * n / std::max(1.0, time);
}

}  // namespace

Mixing mixing(const std::vector<Point>& draws, std::size_t n_walkers) {
  const std::size_t n_sweeps = draws.size() / n_walkers;
  Mixing worst{static_cast<double>(draws.size()), 1.0};
  for (std::size_t d = 0; d < draws.front().size(); ++d) {
    std::vector<Chain> walkers(n_walkers), parts(4);
    for (std::size_t sweep = 0; sweep < n_sweeps; ++sweep)
      for (std::size_t i = 0; i < n_walkers; ++i) {
        const double x = draws[sweep * n_walkers + i][d];
        walkers[i].push_back(x);
        parts[2 * (sweep < n_sweeps / 2 ? 0 : 1) + (i < n_walkers / 2 ? 0 : 1)].push_back(x);
      }
    const Variances v = variances_of(parts);
    worst.effective = std::min(worst.effective, effective_of(walkers));
    worst.r_hat = std::max(worst.r_hat, std::sqrt(v.total / v.within));
  }
  return worst;
}

namespace {

/// Where a walker might go, and what the way there adds to the logarithm of its chance.
struct Move {
  Point to;
  double log_factor = 0.0;
};

/// Uniform numbers of one move, by what each is for.
struct Uniforms {
  std::uint32_t seed, step, walker;
  double operator()(std::uint32_t purpose) const {
    return uniform(seed, Stream::calibration, step, walker, purpose);
  }
};

/// A walker of a half [from, from + size): the place of a number u in [0, 1).
std::size_t one_of(std::size_t from, std::size_t size, double u) {
  return from + static_cast<std::size_t>(u * static_cast<double>(size));
}

/// `others`: the half from which partners come, so that the two halves leave the density alone.
Move stretched(const std::vector<Point>& walkers, std::size_t i, std::size_t others, std::size_t n_others,
               const Uniforms& u) {
  constexpr double stretch = 2.0;  // Goodman & Weare's a
  const Point& partner = walkers[one_of(others, n_others, u(1))];
  // The density 1/sqrt(z) from 1/a to a, by its inverse: but for the volume, forth and back are as likely.
  const double root = 1.0 + (stretch - 1.0) * u(2), z = root * root / stretch;
  // A stretch by z makes the volume z^(d - 1) as large, which the chance of the move has to make good.
  Move move{partner, (static_cast<double>(partner.size()) - 1.0) * std::log(z)};
  for (std::size_t d = 0; d < partner.size(); ++d) move.to[d] += z * (walkers[i][d] - partner[d]);
  return move;
}

Move along_a_difference(const std::vector<Point>& walkers, std::size_t i, std::size_t others,
                        std::size_t n_others, const Uniforms& u) {
  constexpr double whole = 0.1, wobble = 0.05;  // share of whole steps; of the usual ones, in length
  const std::size_t a = one_of(others, n_others, u(1));
  std::size_t b = one_of(others, n_others - 1, u(2));
  if (b >= a) ++b;
  // As likely back as forth: no factor.
  Move move{walkers[i]};
  const double usual = 2.38 / std::sqrt(2.0 * static_cast<double>(move.to.size()));
  // Of one fixed length, steps along a finite set of differences would leave places unreached.
  const double gamma = u(3) < whole ? 1.0 : usual * (1.0 + wobble * (2.0 * u(4) - 1.0));
  for (std::size_t d = 0; d < move.to.size(); ++d) move.to[d] += gamma * (walkers[a][d] - walkers[b][d]);
  return move;
}

}  // namespace

std::vector<Point> sample(const LogDensity& density, std::vector<Point> walkers, int steps, int thin,
                          std::uint32_t seed) {
  constexpr double stretches = 0.2;  // share of the moves
  const std::size_t n = walkers.size(), half = n / 2;
  std::vector<double> log_p(n);
  for (std::size_t i = 0; i < n; ++i) log_p[i] = density(walkers[i]);
  std::vector<Point> draws;
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < n; ++i) {
      const Uniforms u{seed, static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(i)};
      // A partner that moves in the same half-sweep would break detailed balance.
      const std::size_t others = i < half ? half : 0, n_others = i < half ? n - half : half;
      Move move = u(0) < stretches ? stretched(walkers, i, others, n_others, u)
                                   : along_a_difference(walkers, i, others, n_others, u);
      const double p = density(move.to);
      if (std::log(u(5)) < move.log_factor + p - log_p[i]) walkers[i] = std::move(move.to), log_p[i] = p;
    }
    // The first half forgets where the walkers began.
    if (step >= steps / 2 && (step + 1) % thin == 0)
      draws.insert(draws.end(), walkers.begin(), walkers.end());
  }
  return draws;
}

}  // namespace phy::calibrate
