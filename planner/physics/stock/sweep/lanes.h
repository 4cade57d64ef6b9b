// Included once by each variant's source, inside its unnamed namespace, after kWidth is defined: eight floats
// side by side in vectors of kWidth, so that every variant does the same on the same lanes.

constexpr int kParts = kLanes / kWidth;
typedef float Native __attribute__((vector_size(4 * kWidth)));
typedef int NativeMask __attribute__((vector_size(4 * kWidth)));

#if defined(__AVX512VL__) && defined(__AVX512DQ__)
struct Mask {
  __mmask8 p;
};
#else
struct Mask {
  NativeMask p[kParts];
};
#endif

struct Float {
  Native p[kParts];
  Float() = default;
  Float(float v) {  // NOLINT(google-explicit-constructor): numbers and vectors mix in formulas
    for (int i = 0; i < kParts; ++i) p[i] = Native{} + v;
  }
  static Float at(const float* from) {
    Float out;
    __builtin_memcpy(out.p, from, sizeof(out.p));
    return out;
  }
  void put(float* to) const { __builtin_memcpy(to, p, sizeof(p)); }
  static Float count() {  // 0, 1, ... 7
    constexpr float kCount[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7};
    return at(kCount);
  }
};

#define CAPSTAN_LANES(result, type, expression)                \
  type result;                                                 \
  for (int i = 0; i < kParts; ++i) result.p[i] = (expression); \
  return result

inline Float operator+(Float a, Float b) { CAPSTAN_LANES(r, Float, a.p[i] + b.p[i]); }
inline Float operator-(Float a, Float b) { CAPSTAN_LANES(r, Float, a.p[i] - b.p[i]); }
inline Float operator*(Float a, Float b) { CAPSTAN_LANES(r, Float, a.p[i] * b.p[i]); }
inline Float operator/(Float a, Float b) { CAPSTAN_LANES(r, Float, a.p[i] / b.p[i]); }
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
inline Mask operator<(Float a, Float b) { return {_mm256_cmp_ps_mask(a.p[0], b.p[0], _CMP_LT_OQ)}; }
inline Mask operator<=(Float a, Float b) { return {_mm256_cmp_ps_mask(a.p[0], b.p[0], _CMP_LE_OQ)}; }
inline Mask operator&(Mask a, Mask b) { return {_kand_mask8(a.p, b.p)}; }
inline Mask operator|(Mask a, Mask b) { return {_kor_mask8(a.p, b.p)}; }
inline Mask operator~(Mask a) { return {_knot_mask8(a.p)}; }
inline Float select(Mask m, Float a, Float b) {
  CAPSTAN_LANES(r, Float, _mm256_mask_blend_ps(m.p, b.p[i], a.p[i]));
}
#else
inline Mask operator<(Float a, Float b) { CAPSTAN_LANES(r, Mask, a.p[i] < b.p[i]); }
inline Mask operator<=(Float a, Float b) { CAPSTAN_LANES(r, Mask, a.p[i] <= b.p[i]); }
inline Mask operator&(Mask a, Mask b) { CAPSTAN_LANES(r, Mask, a.p[i] & b.p[i]); }
inline Mask operator|(Mask a, Mask b) { CAPSTAN_LANES(r, Mask, a.p[i] | b.p[i]); }
inline Mask operator~(Mask a) { CAPSTAN_LANES(r, Mask, ~a.p[i]); }
inline Float select(Mask m, Float a, Float b) { CAPSTAN_LANES(r, Float, m.p[i] ? a.p[i] : b.p[i]); }
#endif

// The instructions for the larger and the smaller are `a > b ? a : b` to the bit, signs of zero included.
inline Native greater(Native a, Native b) {
#if defined(__AVX2__)
  return _mm256_max_ps(a, b);
#elif defined(__SSE2__)
  return _mm_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}
inline Native smaller(Native a, Native b) {
#if defined(__AVX2__)
  return _mm256_min_ps(a, b);
#elif defined(__SSE2__)
  return _mm_min_ps(a, b);
#else
  return a < b ? a : b;
#endif
}
inline Float greater(Float a, Float b) { CAPSTAN_LANES(r, Float, greater(a.p[i], b.p[i])); }
inline Float smaller(Float a, Float b) { CAPSTAN_LANES(r, Float, smaller(a.p[i], b.p[i])); }
inline Float magnitude(Float a) { return greater(a, 0.0F - a); }

inline Native root(Native v) {
#if defined(__AVX2__)
  return _mm256_sqrt_ps(v);
#elif defined(__SSE2__)
  return _mm_sqrt_ps(v);
#else
  for (int i = 0; i < kWidth; ++i) v[i] = __builtin_sqrtf(v[i]);
  return v;
#endif
}
inline Float root(Float a) { CAPSTAN_LANES(r, Float, root(a.p[i])); }

/// Bit k: lane k.
inline unsigned bits(Mask m) {
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
  return m.p;
#elif defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(m.p[0])));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m.p[0]))) |
         (static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m.p[1]))) << 4U);
#else
  unsigned out = 0;
  for (int k = 0; k < kLanes; ++k) out |= m.p[k / kWidth][k % kWidth] != 0 ? 1U << unsigned(k) : 0U;
  return out;
#endif
}
inline bool any(Mask m) { return bits(m) != 0; }

/// Cut off towards zero.
inline void whole_numbers(Float a, int* to) {
#if defined(__AVX2__)
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cvttps_epi32(a.p[0]));
#elif defined(__SSE2__)
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_cvttps_epi32(a.p[0]));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to + 4), _mm_cvttps_epi32(a.p[1]));
#else
  for (int i = 0; i < kLanes; ++i) to[i] = static_cast<int>(a.p[i / kWidth][i % kWidth]);
#endif
}

#undef CAPSTAN_LANES
