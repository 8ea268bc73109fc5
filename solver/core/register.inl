// SPDX-License-Identifier: MIT
// For the .inl files of kernels, which include it inside their namespace: a register of the
// instruction set they are compiled for, and what it takes to choose lane by lane.

#if defined(__AVX512F__)
constexpr int kLanes = 8;  ///< doubles a register holds
#elif defined(__AVX2__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif

typedef double Register __attribute__((vector_size(8 * kLanes)));
/// A register that is loaded from or stored to any address.
typedef double LooseRegister __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));
/// The bits of a register; of a comparison, all or none.
typedef std::uint64_t Bits __attribute__((vector_size(8 * kLanes)));
typedef long long SignedBits __attribute__((vector_size(8 * kLanes)));

inline Register load(const double* from) { return *reinterpret_cast<const LooseRegister*>(from); }
inline void store(Register value, double* to) { *reinterpret_cast<LooseRegister*>(to) = value; }
inline Register all_lanes(double value) { return Register{} + value; }

/// The result of a comparison as bits: bit j is set where it holds in lane j.
inline unsigned lane_mask(Bits bits) {
#if defined(__AVX512DQ__) && !defined(__clang__)
  return static_cast<unsigned char>(
      __builtin_ia32_cvtq2mask512(reinterpret_cast<SignedBits>(bits)));
#elif defined(__AVX2__) && !defined(__AVX512F__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(reinterpret_cast<Register>(bits)));
#elif defined(__SSE2__) && !defined(__AVX512F__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd(reinterpret_cast<Register>(bits)));
#else
  unsigned mask = 0;
  for (int j = 0; j < kLanes; ++j) mask |= static_cast<unsigned>(bits[j] >> 63) << j;
  return mask;
#endif
}
