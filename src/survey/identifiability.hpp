// What a table of tests can and cannot determine, predicted before anything runs.
//
// Elastic parameters: the closed form of jointed rock (theory/goodman.hpp) stands in for the model, because
// the micro-parameters act on it one by one (E_c on E, k_s/k_n on nu, k_n on K_n, k_s on K_s). Its
// derivatives at the fitted curve and the scatter of the table give the expected intervals, sd^2 = (J^T W J +
// prior)^-1. Strengths have no closed form of use; there the rules of parameters.cpp say which tests feel
// which parameter.
#pragma once
#include <vector>

#include "records/evidence.hpp"
#include "records/finding.hpp"
#include "records/parameters.hpp"

namespace phy::survey {

/// One estimate per parameter, with intervals for the elastic ones (values NaN: it has none before the fit).
std::vector<Estimate> identifiability(const Evidence& evidence);

/// What the table lacks or cannot have: scatter that is assumed, parts that nothing is fitted to, moduli that
/// no model of this kind has.
std::vector<Finding> limits_of_table(const Evidence& evidence);

}  // namespace phy::survey
