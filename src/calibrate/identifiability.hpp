// What a table of tests can and cannot determine, predicted before anything runs.
//
// Elastic parameters: the closed form of jointed rock (theory/goodman.hpp) stands in for the model, because
// the micro-parameters act on it one by one (E_c on E, k_s/k_n on nu, k_n on K_n, k_s on K_s). Its
// derivatives at the fitted curve and the scatter of the table give the expected intervals, sd^2 = (J^T W J +
// prior)^-1. Strengths have no closed form worth the name; there the rules of parameters.cpp say which tests
// feel which parameter.
#pragma once
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"
#include "calibrate/parameters.hpp"

namespace phy::calibrate {

/// One estimate per parameter, with intervals for the elastic ones (values NaN: it has none before the fit).
std::vector<Estimate> identifiability(const Evidence& evidence);

/// Sentences for the user: what the table holds, what is missing, what a further test would bring.
std::vector<std::string> advice(const Evidence& evidence);

}  // namespace phy::calibrate
