// How long a test will take, guessed before it runs: for the order of the queue and for the expected time.
// Decides no result. `r`: the recipe of one test.
#pragma once
#include "records/recipe.hpp"

namespace phy::study {

/// Grains of the specimen, near enough; of a Brazilian test those of the disc.
double expected_grains(const Recipe& r);

/// Memory that a run with so many specimens takes before its results are written [bytes]: an upper estimate.
double expected_memory(const Recipe& r, std::size_t n_specimens);

/// Expected cost of a test [cycles times grains], a guess.
double expected_cost(const Recipe& r);
/// The same of a test whose peak is expected at a strain, in the measure of the test.
double expected_cost(const Recipe& r, double peak_strain);

/// The same of a direct elastic solution, as if it took cycles.
double expected_direct_cost(const Recipe& r);

/// Strain at which a specimen is expected to peak, in the measure of its test, from Goodman's modulus and
/// Jaeger's strength with rules of thumb for the macro values. Within a factor of two for the usual rocks;
/// decides no result.
double expected_peak_strain(const Recipe& r);

/// Seconds of CPU per unit of cost on this processor when nothing has been measured.
double usual_seconds_per_cost(Precision precision);

}  // namespace phy::study
