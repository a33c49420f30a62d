// Numbers that are one lane wide or many: the laws and the force loop are written once, over the number type
// R.
//
//   R = double, float       one specimen: the reference, easy to step through in a debugger
//   R = Pack<double, W>     W specimens of one packing side by side in a SIMD register, or W contacts of one
//   R = Pack<float, W>      the same in single precision
//
// A comparison gives a mask (bool, or a vector of all-ones/all-zeros integers); select(mask, a, b) replaces
// branches, so that every lane does the same operations and a lane's bits never depend on its neighbours.
// Arithmetic is that of the vector types of GCC and Clang; what depends on masks goes through intrinsics, one
// short table per register size: left to the vector types, g++ 12 takes logic on masks apart lane by lane,
// hundreds of scalar instructions wherever a bond breaks. Rejected: a SIMD library (the ten functions below
// are all that is used).
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

// The force loop is compiled once per instruction set. Each build lives in an inline namespace of its own, or
// the linker would keep one copy of equally named templates, perhaps one that this processor cannot run.
#ifndef PHY_ISA
#define PHY_ISA portable
#endif
// The body of the loop over contacts must be one piece of straight code: what is called for every contact is
// inlined whatever its size, and what happens to few contacts is kept out of it (g++ 12 otherwise spills half
// the registers).
#define PHY_HOT __attribute__((always_inline))
#define PHY_RARE __attribute__((noinline))

namespace phy {
inline namespace PHY_ISA {

template <class T>
using MaskInt = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

/// What a register of `bytes` bytes full of T can do beyond arithmetic. This one serves any machine; masks
/// are integers of the size of T, all ones or all zeros.
template <class T, std::size_t bytes>
struct Register {
  typedef T Lanes __attribute__((vector_size(bytes)));
  typedef MaskInt<T> Bits __attribute__((vector_size(bytes)));
  static constexpr int width = static_cast<int>(bytes / sizeof(T));
  static Bits less(Lanes a, Lanes b) { return a < b; }
  static Bits less_or_equal(Lanes a, Lanes b) { return a <= b; }
  static Lanes select(Bits m, Lanes a, Lanes b) { return (Lanes)((m & (Bits)a) | (~m & (Bits)b)); }
  static bool test(Bits m, int lane) { return m[lane] != 0; }
  static bool any(Bits m) {
    MaskInt<T> all = 0;
    for (int i = 0; i < width; ++i) all |= m[i];
    return all != 0;
  }
  static Lanes sqrt(Lanes a) {
    for (int i = 0; i < width; ++i) a[i] = std::sqrt(a[i]);
    return a;
  }
};

#if defined(__SSE2__)
#define PHY_REGISTER_16(T, V, suffix)                                                                 \
  template <>                                                                                         \
  struct Register<T, 16> {                                                                            \
    typedef T Lanes __attribute__((vector_size(16)));                                                 \
    typedef MaskInt<T> Bits __attribute__((vector_size(16)));                                         \
    static Bits less(Lanes a, Lanes b) { return (Bits)_mm_cmplt_##suffix((V)a, (V)b); }               \
    static Bits less_or_equal(Lanes a, Lanes b) { return (Bits)_mm_cmple_##suffix((V)a, (V)b); }      \
    static Lanes select(Bits m, Lanes a, Lanes b) { return (Lanes)((m & (Bits)a) | (~m & (Bits)b)); } \
    static bool test(Bits m, int lane) { return m[lane] != 0; }                                       \
    static bool any(Bits m) { return _mm_movemask_##suffix((V)m) != 0; }                              \
    static Lanes sqrt(Lanes a) { return (Lanes)_mm_sqrt_##suffix((V)a); }                             \
  };
PHY_REGISTER_16(float, __m128, ps)
PHY_REGISTER_16(double, __m128d, pd)
#endif
#if defined(__AVX__)
#define PHY_REGISTER_32(T, V, suffix)                                                                \
  template <>                                                                                        \
  struct Register<T, 32> {                                                                           \
    typedef T Lanes __attribute__((vector_size(32)));                                                \
    typedef MaskInt<T> Bits __attribute__((vector_size(32)));                                        \
    static Bits less(Lanes a, Lanes b) { return (Bits)_mm256_cmp_##suffix((V)a, (V)b, _CMP_LT_OS); } \
    static Bits less_or_equal(Lanes a, Lanes b) {                                                    \
      return (Bits)_mm256_cmp_##suffix((V)a, (V)b, _CMP_LE_OS);                                      \
    }                                                                                                \
    static Lanes select(Bits m, Lanes a, Lanes b) {                                                  \
      return (Lanes)_mm256_blendv_##suffix((V)b, (V)a, (V)m);                                        \
    }                                                                                                \
    static bool test(Bits m, int lane) { return m[lane] != 0; }                                      \
    static bool any(Bits m) { return _mm256_movemask_##suffix((V)m) != 0; }                          \
    static Lanes sqrt(Lanes a) { return (Lanes)_mm256_sqrt_##suffix((V)a); }                         \
  };
PHY_REGISTER_32(float, __m256, ps)
PHY_REGISTER_32(double, __m256d, pd)
#endif
#if defined(__AVX512F__)
// A mask is a register of its own here, one bit per lane.
#define PHY_REGISTER_64(T, V, M, suffix)                                                              \
  template <>                                                                                         \
  struct Register<T, 64> {                                                                            \
    typedef T Lanes __attribute__((vector_size(64)));                                                 \
    using Bits = M;                                                                                   \
    static Bits less(Lanes a, Lanes b) { return _mm512_cmp_##suffix##_mask((V)a, (V)b, _CMP_LT_OS); } \
    static Bits less_or_equal(Lanes a, Lanes b) {                                                     \
      return _mm512_cmp_##suffix##_mask((V)a, (V)b, _CMP_LE_OS);                                      \
    }                                                                                                 \
    static Lanes select(Bits m, Lanes a, Lanes b) {                                                   \
      return (Lanes)_mm512_mask_blend_##suffix(m, (V)b, (V)a);                                        \
    }                                                                                                 \
    static bool test(Bits m, int lane) { return (m >> lane & 1) != 0; }                               \
    static bool any(Bits m) { return m != 0; }                                                        \
    static Lanes sqrt(Lanes a) { return (Lanes)_mm512_sqrt_##suffix((V)a); }                          \
  };
PHY_REGISTER_64(float, __m512, __mmask16, ps)
PHY_REGISTER_64(double, __m512d, __mmask8, pd)
#endif

template <class T, int W>
struct Mask {
  using Reg = Register<T, sizeof(T) * W>;
  using Bits = typename Reg::Bits;
  Bits bits;
  friend Mask operator&(Mask a, Mask b) { return {static_cast<Bits>(a.bits & b.bits)}; }
  friend Mask operator|(Mask a, Mask b) { return {static_cast<Bits>(a.bits | b.bits)}; }
  friend Mask operator!(Mask a) { return {static_cast<Bits>(~a.bits)}; }
  bool operator[](int lane) const { return Reg::test(bits, lane); }
};

template <class T, int W>
struct Pack {
  using Reg = Register<T, sizeof(T) * W>;
  using Lanes = typename Reg::Lanes;
  using Scalar = T;
  static constexpr int width = W;
  Lanes v;

  Pack() = default;
  Pack(T scalar) : v(scalar - Lanes{}) {}  // NOLINT: a scalar is the same in every lane
  static Pack of(Lanes lanes) {
    Pack p;
    p.v = lanes;
    return p;
  }
  T operator[](int lane) const { return v[lane]; }

  friend Pack operator+(Pack a, Pack b) { return of(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return of(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return of(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) { return of(a.v / b.v); }
  friend Pack operator-(Pack a) { return of(-a.v); }
  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  friend Mask<T, W> operator<(Pack a, Pack b) { return {Reg::less(a.v, b.v)}; }
  friend Mask<T, W> operator>(Pack a, Pack b) { return {Reg::less(b.v, a.v)}; }
  friend Mask<T, W> operator>=(Pack a, Pack b) { return {Reg::less_or_equal(b.v, a.v)}; }
};

template <class T, int W>
Pack<T, W> select(Mask<T, W> m, Pack<T, W> a, Pack<T, W> b) {
  return Pack<T, W>::of(Mask<T, W>::Reg::select(m.bits, a.v, b.v));
}

template <class T, int W>
Pack<T, W> sqrt(Pack<T, W> a) {
  return Pack<T, W>::of(Pack<T, W>::Reg::sqrt(a.v));
}

template <class T, int W>
Pack<T, W> abs(Pack<T, W> a) {
  typedef MaskInt<T> Bits __attribute__((vector_size(sizeof(T) * W)));
  const Bits sign = (Bits)(-(Pack<T, W>((T)0)).v);
  return Pack<T, W>::of((typename Pack<T, W>::Lanes)((Bits)a.v & ~sign));
}

template <class T, int W>
bool any(Mask<T, W> m) {
  return Mask<T, W>::Reg::any(m.bits);
}

// The same vocabulary for one lane.
inline double select(bool m, double a, double b) { return m ? a : b; }
inline float select(bool m, float a, float b) { return m ? a : b; }
inline double sqrt(double a) { return std::sqrt(a); }
inline float sqrt(float a) { return std::sqrt(a); }
inline double abs(double a) { return std::fabs(a); }
inline float abs(float a) { return std::fabs(a); }
inline bool any(bool m) { return m; }

/// What the laws need to know about a number type.
template <class R>
struct NumberTraits {
  using Scalar = typename R::Scalar;
  using MaskType = Mask<Scalar, R::width>;
  static constexpr int width = R::width;
  static Scalar get(const R& r, int lane) { return r.v[lane]; }
  static void set(R& r, int lane, Scalar value) { r.v[lane] = value; }
  static bool test(const MaskType& m, int lane) { return m[lane]; }
};
template <class T>
struct OneLane {
  using Scalar = T;
  using MaskType = bool;
  static constexpr int width = 1;
  static T get(const T& r, int) { return r; }
  static void set(T& r, int, T value) { r = value; }
  static bool test(bool m, int) { return m; }
};
template <>
struct NumberTraits<double> : OneLane<double> {};
template <>
struct NumberTraits<float> : OneLane<float> {};
template <class R>
using MaskOf = typename NumberTraits<R>::MaskType;
template <class R>
using ScalarOf = typename NumberTraits<R>::Scalar;

template <class R>
R max0(R a) {
  return select(a > R(0), a, R(0));
}
template <class R>
R min(R a, R b) {
  return select(a < b, a, b);
}
template <class R>
R max(R a, R b) {
  return select(a > b, a, b);
}
/// a limited to [-limit, limit], limit >= 0.
template <class R>
R clip(R a, R limit) {
  return max(min(a, limit), -limit);
}
/// -1, 0 or +1.
template <class R>
R sign(R a) {
  return select(a > R(0), R(1), select(a < R(0), R(-1), R(0)));
}

}  // namespace PHY_ISA
}  // namespace phy
