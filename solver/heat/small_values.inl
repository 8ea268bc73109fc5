// SPDX-License-Identifier: MIT
// For field_kernels.inl, which includes it inside its namespace: which values of a row are small.

/// `columns`: as a rule a number that the compiler knows.
inline void mark_by_number(const double* u, std::int64_t rows, int columns, const double* floors,
                           std::uint16_t* masks) {
  for (std::int64_t row = 0; row < rows; ++row, u += columns) {
    unsigned small = 0;
    for (int k = 0; k < columns; ++k) small |= unsigned{std::abs(u[k]) < floors[k]} << k;
    masks[row] = static_cast<std::uint16_t>(small);
  }
}

/// Rows of K columns, whole registers.
template <int K>
void mark_by_register(const double* u, std::int64_t rows, const double* floors,
                      std::uint16_t* masks) {
  Register floor[K / kLanes];
  for (int i = 0; i < K / kLanes; ++i) floor[i] = load(floors + i * kLanes);
  for (std::int64_t row = 0; row < rows; ++row, u += K) {
    unsigned small = 0;
    for (int i = 0; i < K / kLanes; ++i) {
      const Register size = size_of(load(u + i * kLanes));
      small |= lane_mask(reinterpret_cast<Bits>(size < floor[i])) << (i * kLanes);
    }
    masks[row] = static_cast<std::uint16_t>(small);
  }
}

void mark_small(const double* u, std::int64_t rows, int columns, const double* floors,
                std::uint16_t* masks) {
  if (columns == 16) return mark_by_register<16>(u, rows, floors, masks);
  if (columns == 8) return mark_by_register<8>(u, rows, floors, masks);
  if (columns == 1) return mark_by_number(u, rows, 1, floors, masks);
  mark_by_number(u, rows, columns, floors, masks);
}
