// SPDX-License-Identifier: MIT
// For the .inl files of kernels, which include it inside their namespace.

#if defined(__AVX512F__)
constexpr int kLanes = 8;  ///< doubles a register holds
#elif defined(__AVX2__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif

typedef double Register __attribute__((vector_size(8 * kLanes)));

inline void widen(const float* from, Register& to) {
  typedef float Narrow __attribute__((vector_size(4 * kLanes)));
  Narrow narrow;
  __builtin_memcpy(&narrow, from, sizeof narrow);
  to = __builtin_convertvector(narrow, Register);
}

inline void widen(const UpperHalf* from, Register& to) {
  typedef std::uint32_t Half __attribute__((vector_size(4 * kLanes)));
  typedef std::uint64_t Whole __attribute__((vector_size(8 * kLanes)));
  Half half;
  __builtin_memcpy(&half, from, sizeof half);
  to = reinterpret_cast<Register>(__builtin_convertvector(half, Whole) << 32);
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
  /// Of narrower numbers, widened.
  template <class T>
  static Group load(const T* from) {
    static_assert(kWidth == kLanes);
    Group out;
    for (int i = 0; i < kCount; ++i) widen(from + i * kWidth, out.lane_[i]);
    return out;
  }
  static Group zero() {
    Group out;
    for (int i = 0; i < kCount; ++i) out.lane_[i] = Lane{};
    return out;
  }
  void store(double* to) const {
    for (int i = 0; i < kCount; ++i) reinterpret_cast<Loose*>(to)[i] = lane_[i];
  }
  /// The same number in every lane.
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
