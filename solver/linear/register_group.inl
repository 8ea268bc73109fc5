// SPDX-License-Identifier: MIT
// For the .inl files of kernels, which include it inside their namespace.

#include "solver/core/register.inl"

/// The upper half of a double: its sign, all of its exponent, and the first 20 bits of its
/// mantissa.
struct UpperHalf {
  std::uint32_t bits = 0;
};

/// Rounds to the nearest number that the storage holds.
inline void narrow(double x, double& to) { to = x; }
inline void narrow(double x, float& to) { to = static_cast<float>(x); }
inline void narrow(double x, UpperHalf& to) {
  constexpr std::uint64_t kHalf = 1ULL << 31;
  to.bits = static_cast<std::uint32_t>((std::bit_cast<std::uint64_t>(x) + kHalf) >> 32);
}

inline void widen(const float* from, Register& to) {
  typedef float Narrow __attribute__((vector_size(4 * kLanes)));
  Narrow narrow;
  __builtin_memcpy(&narrow, from, sizeof narrow);
#if defined(__AVX512F__) && !defined(__clang__)
  constexpr int kCurrentRounding = 4;  // as _mm512_cvtps_pd() has it; vectors convert by halves
  to = __builtin_ia32_cvtps2pd512_mask(narrow, Register{}, -1, kCurrentRounding);
#else
  to = __builtin_convertvector(narrow, Register);
#endif
}

inline void widen(const UpperHalf* from, Register& to) {
  typedef std::uint32_t Half __attribute__((vector_size(4 * kLanes)));
  typedef std::uint64_t Whole __attribute__((vector_size(8 * kLanes)));
  Half half;
  __builtin_memcpy(&half, from, sizeof half);
#if defined(__AVX512F__) && !defined(__clang__)
  typedef int Signed __attribute__((vector_size(4 * kLanes)));
  typedef long long SignedWhole __attribute__((vector_size(8 * kLanes)));
  const Whole whole = reinterpret_cast<Whole>(__builtin_ia32_pmovzxdq512_mask(
      reinterpret_cast<Signed>(half), SignedWhole{}, -1));  // as above
#else
  const Whole whole = __builtin_convertvector(half, Whole);
#endif
  to = reinterpret_cast<Register>(whole << 32);
}

inline void gather_lanes(const double* from, const Index* place, Register& to) {
#if defined(__AVX512F__)
  to = Register{from[place[0]], from[place[1]], from[place[2]], from[place[3]],
                from[place[4]], from[place[5]], from[place[6]], from[place[7]]};
#elif defined(__AVX2__)
  to = Register{from[place[0]], from[place[1]], from[place[2]], from[place[3]]};
#else
  to = Register{from[place[0]], from[place[1]]};
#endif
}

/// Lane k of the result: the sum of the lanes of r[k].
inline Register sums_of(const Register* r) {
#if defined(__AVX512F__)
  Register pairs[4], fours[2];
  for (int k = 0; k < 4; ++k) {
    pairs[k] = __builtin_shufflevector(r[2 * k], r[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14) +
               __builtin_shufflevector(r[2 * k], r[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 2; ++k) {
    fours[k] = __builtin_shufflevector(pairs[2 * k], pairs[2 * k + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
               __builtin_shufflevector(pairs[2 * k], pairs[2 * k + 1], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  return __builtin_shufflevector(fours[0], fours[1], 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(fours[0], fours[1], 4, 5, 6, 7, 12, 13, 14, 15);
#elif defined(__AVX2__)
  const Register low = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6) +
                       __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
  const Register high = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6) +
                        __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
  return __builtin_shufflevector(low, high, 0, 1, 4, 5) +
         __builtin_shufflevector(low, high, 2, 3, 6, 7);
#else
  return __builtin_shufflevector(r[0], r[1], 0, 2) + __builtin_shufflevector(r[0], r[1], 1, 3);
#endif
}

/// K doubles in registers of the instruction set's width.
template <int K>
class Group {
  static constexpr int kWidth = K < kLanes ? K : kLanes;
  static constexpr int kCount = K / kWidth;
  typedef double Lane __attribute__((vector_size(8 * kWidth)));
  typedef double Loose __attribute__((vector_size(8 * kWidth), aligned(8), may_alias));

 public:
  static Group load(const double* from) {
    Group out;
    for (int i = 0; i < kCount; ++i) out.lane_[i] = reinterpret_cast<const Loose*>(from)[i];
    return out;
  }
  /// Loads numbers of a narrower type and widens them to double.
  template <class T>
  static Group load(const T* from) {
    static_assert(kWidth == kLanes);
    Group out;
    for (int i = 0; i < kCount; ++i) widen(from + i * kWidth, out.lane_[i]);
    return out;
  }
  /// from[place[k]] in lane k.
  static Group gather(const double* from, const Index* place) {
    Group out;
    for (int i = 0; i < kCount; ++i) gather_lanes(from, place + i * kWidth, out.lane_[i]);
    return out;
  }
  /// Lane k of the result: the sum of the lanes of group k. For as many groups as there are lanes.
  static Group sums(const Group (&groups)[K]) {
    Group out;
    Lane one[K];
    for (int k = 0; k < K; ++k) {
      one[k] = groups[k].lane_[0];
      for (int i = 1; i < kCount; ++i) one[k] += groups[k].lane_[i];
    }
    for (int i = 0; i < kCount; ++i) out.lane_[i] = sums_of(one + i * kWidth);
    return out;
  }
  /// Lanes from `count` on become 0.
  void keep_first(Index count) {
    for (int k = 0; k < K; ++k) lane_[k / kWidth][k % kWidth] = k < count ? (*this)[k] : 0.0;
  }
  static Group zero() {
    Group out;
    for (int i = 0; i < kCount; ++i) out.lane_[i] = Lane{};
    return out;
  }
  void store(double* to) const {
    for (int i = 0; i < kCount; ++i) reinterpret_cast<Loose*>(to)[i] = lane_[i];
  }
  /// A group with this number in every lane.
  static Group all(double value) {
    Group out;
    for (int i = 0; i < kCount; ++i) out.lane_[i] = Lane{} + value;
    return out;
  }
  double operator[](int k) const { return lane_[k / kWidth][k % kWidth]; }
  void add(const Group& a, const Group& b) {
    for (int i = 0; i < kCount; ++i) lane_[i] += a.lane_[i] * b.lane_[i];
  }
  double sum() const {
    double out = 0;
    for (int i = 0; i < kCount; ++i) {
      for (int j = 0; j < kWidth; ++j) out += lane_[i][j];
    }
    return out;
  }
  void add(double factor, const Group& other) {
    for (int i = 0; i < kCount; ++i) lane_[i] += factor * other.lane_[i];
  }
  void subtract(double factor, const Group& other) {
    for (int i = 0; i < kCount; ++i) lane_[i] -= factor * other.lane_[i];
  }
  void subtract(const Group& other) {
    for (int i = 0; i < kCount; ++i) lane_[i] -= other.lane_[i];
  }
  void scale(double factor) {
    for (int i = 0; i < kCount; ++i) lane_[i] *= factor;
  }

 private:
  Lane lane_[kCount];
};
