// SPDX-License-Identifier: MIT
// For field_kernels.inl, which includes it inside its namespace: which values of a row are small.

/// Rows of K columns.
template <int K>
void mark_rows(const double* u, std::int64_t rows, const double* floors, std::uint16_t* masks) {
  if constexpr (K % kLanes == 0) {
    Register floor[K / kLanes];
    for (int i = 0; i < K / kLanes; ++i) floor[i] = load(floors + i * kLanes);
    for (std::int64_t row = 0; row < rows; ++row) {
      unsigned small = 0;
      for (int i = 0; i < K / kLanes; ++i) {
        const Register size = size_of(load(u + row * K + i * kLanes));
        small |= lane_mask(reinterpret_cast<Bits>(size < floor[i])) << (i * kLanes);
      }
      masks[row] = static_cast<std::uint16_t>(small);
    }
  } else {
    for (std::int64_t row = 0; row < rows; ++row) {
      unsigned small = 0;
      for (int k = 0; k < K; ++k) small |= unsigned{std::abs(u[row * K + k]) < floors[k]} << k;
      masks[row] = static_cast<std::uint16_t>(small);
    }
  }
}

void mark_small(const double* u, std::int64_t rows, int columns, const double* floors,
                std::uint16_t* masks) {
  switch (columns) {
    case 1:
      return mark_rows<1>(u, rows, floors, masks);
    case 2:
      return mark_rows<2>(u, rows, floors, masks);
    case 4:
      return mark_rows<4>(u, rows, floors, masks);
    case 8:
      return mark_rows<8>(u, rows, floors, masks);
    case 16:
      return mark_rows<16>(u, rows, floors, masks);
    default:
      break;
  }
  for (std::int64_t row = 0; row < rows; ++row) {
    unsigned small = 0;
    for (int k = 0; k < columns; ++k) {
      small |= unsigned{std::abs(u[row * columns + k]) < floors[k]} << k;
    }
    masks[row] = static_cast<std::uint16_t>(small);
  }
}
