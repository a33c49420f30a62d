// The C library's elementary functions for the whole program and all that is linked into it. The linker takes
// what it meets first, and this is before the C library. <cmath>, which declares them in another way on each
// system, is not to be included here.
#include "base/exact_functions.hpp"

namespace exact = phy::exact;

extern "C" {

double exp(double x) { return exact::exp(x); }
double exp2(double x) { return exact::exp2(x); }
double expm1(double x) { return exact::expm1(x); }
double log(double x) { return exact::log(x); }
double log2(double x) { return exact::log2(x); }
double log10(double x) { return exact::log10(x); }
double log1p(double x) { return exact::log1p(x); }
double pow(double x, double y) { return exact::pow(x, y); }
double tanh(double x) { return exact::tanh(x); }
double sin(double x) { return exact::sin(x); }
double cos(double x) { return exact::cos(x); }
double tan(double x) { return exact::tan(x); }
double asin(double x) { return exact::asin(x); }
double acos(double x) { return exact::acos(x); }
double atan(double x) { return exact::atan(x); }
double atan2(double y, double x) { return exact::atan2(y, x); }
double hypot(double x, double y) { return exact::hypot(x, y); }
double erfc(double x) { return exact::erfc(x); }

// What g++ makes of sin and cos of one angle.
void sincos(double x, double* sine, double* cosine) {
  *sine = exact::sin(x);
  *cosine = exact::cos(x);
}

// std::abs and std::log of complex numbers.
double cabs(__complex__ double z) { return exact::hypot(__real__ z, __imag__ z); }
__complex__ double clog(__complex__ double z) {
  __complex__ double log;
  __real__ log = exact::log(cabs(z));
  __imag__ log = exact::atan2(__imag__ z, __real__ z);
  return log;
}

}  // extern "C"
