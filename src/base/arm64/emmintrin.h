// Stands in for the intrinsics of SSE2 on 64-bit ARM (CMakeLists.txt), for the one header of Boost that
// base/stats.cpp takes in for its order of sums. Each does to two numbers what its namesake does.
#pragma once
typedef double __m128d __attribute__((vector_size(16)));
inline __m128d _mm_load_pd(const double* two) { return __m128d{two[0], two[1]}; }
inline __m128d _mm_load1_pd(const double* one) { return __m128d{*one, *one}; }
inline __m128d _mm_add_pd(__m128d a, __m128d b) { return a + b; }
inline __m128d _mm_mul_pd(__m128d a, __m128d b) { return a * b; }
inline void _mm_store_pd(double* two, __m128d a) { two[0] = a[0], two[1] = a[1]; }
