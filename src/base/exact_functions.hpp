// Elementary functions with the same bits on every machine, for everything that is no test of rock: fits,
// searches, statistics. C libraries differ in last bits (glibc itself by whether the processor multiplies and
// adds at once), and a search that meets another last bit may take another way. libm.cpp puts these in place
// of the C library's for the whole program, so that no call can be forgotten.
//
// Arguments and first terms of the series are sums of two doubles (Dekker 1971), the rest is double: errors
// stay below 0.6 units in the last place, of log below 1 (exact_functions.test.cpp). Tests of rock keep
// exact_math.hpp, which their recorded numbers were made with.
#pragma once

namespace phy::exact {

double exp(double x);
double exp2(double x);
double expm1(double x);
double log(double x);
double log2(double x);
double log10(double x);
double log1p(double x);
double pow(double x, double y);
double tanh(double x);
/// Arguments of millions of turns lose digits, the same ones everywhere.
double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double hypot(double x, double y);
double erfc(double x);

}  // namespace phy::exact
