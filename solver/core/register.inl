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
/// The same at any address.
typedef double LooseRegister __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));
/// The bits of a register; of a comparison, all or none.
typedef std::uint64_t Bits __attribute__((vector_size(8 * kLanes)));

inline Register load(const double* from) { return *reinterpret_cast<const LooseRegister*>(from); }
inline void store(Register value, double* to) { *reinterpret_cast<LooseRegister*>(to) = value; }
inline Register all_lanes(double value) { return Register{} + value; }

inline bool any(Bits bits) {
  std::uint64_t all = 0;
  for (int j = 0; j < kLanes; ++j) all |= bits[j];
  return all != 0;
}
