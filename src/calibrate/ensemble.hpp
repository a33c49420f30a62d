// Draws from a probability density known up to a factor, by an ensemble of walkers that take their steps from
// each other: there is nothing to tune, and long thin densities, such as those of parameters that trade off
// against each other, trouble it no more than round ones. Four of five moves go along the difference of two
// others (ter Braak 2006, Statistics and Computing 16:239-249: mostly 2.38/sqrt(2 d) of it, one in ten the
// whole, from one valley to another), one is a stretch towards another (Goodman & Weare 2010, Comm. App.
// Math. Comp. Sci. 5:65-80). Draws of stretches alone were worth half as many independent ones in searches of
// six parameters. The numbers are counter-based: the same density and seed give the same draws.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "records/calibration.hpp"

namespace phy::calibrate {

using Point = std::vector<double>;
using LogDensity = std::function<double(const Point&)>;  ///< -infinity where nothing is possible

/// Moves `walkers` (more than twice as many as dimensions, at least four and one of them possible) by `steps`
/// sweeps and returns the states after every `thin`-th sweep of the second half.
std::vector<Point> sample(const LogDensity& density, std::vector<Point> walkers, int steps, int thin,
                          std::uint32_t seed);

/// How well draws of `n_walkers` walkers have mixed; the worst dimension. Effective sample size: each walker
/// a chain, autocorrelation of all chains together, summed over pairs while these are positive and fall
/// (Geyer 1992, as in Vehtari et al. 2021). R-hat: of four parts, halves of the walkers in halves of the
/// sweeps, each as long as many sweeps; a walker alone is too short to tell, and a partner of others.
Mixing mixing(const std::vector<Point>& draws, std::size_t n_walkers);

}  // namespace phy::calibrate
