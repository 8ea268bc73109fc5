// SPDX-License-Identifier: MIT
// For field_kernels.inl, which includes it inside its namespace: X of faces and its divergence, a
// lane of the registers each.

/// Squares outside this range and smaller differences go the careful way: what has underflowed has
/// no direction left.
constexpr double kSafeLow = 1e-280;
constexpr double kSafeHigh = 1e280;
constexpr double kSmallest = 1e-300;

/// 1 / sqrt(x) to a few units of the last digit, for 1e-290 < x < 1e290, in a quarter of the time
/// that a square root and a division take: a guess from halving the exponent (3.5 % off, Lomont
/// 2003), and two steps y (1 - e)^(-1/2), e = 1 - x y^2, by the binomial series to e^2 and to e^3.
inline Register inverse_root(Register x) {
  constexpr std::uint64_t kGuess = 0x5fe6eb50c7b537a9;
  Register y = reinterpret_cast<Register>(kGuess - (reinterpret_cast<Bits>(x) >> 1));
  Register e = 1.0 - x * (y * y);
  y += y * e * (0.5 + 0.375 * e);
  e = 1.0 - x * (y * y);
  return y + y * e * (0.5 + e * (0.375 + 0.3125 * e));
}

/// The power of two that brings x, positive and not denormal, to between 1 and 2.
inline Register to_one(Register x) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000, kOfInverse = 0x7fe0000000000000;
  return reinterpret_cast<Register>(kOfInverse - (reinterpret_cast<Bits>(x) & kExponent));
}

inline Register size_of(Register x) {
  constexpr std::uint64_t kAllButSign = 0x7fffffffffffffff;
  return reinterpret_cast<Register>(reinterpret_cast<Bits>(x) & kAllButSign);
}

inline Bits unsafe(Register square) {
  return reinterpret_cast<Bits>((square <= kSafeLow) | (square >= kSafeHigh) | (square != square));
}

/// Faces as their lanes see them.
struct Shape {
  Register base, x, height, inverse_area, root_t, inverse_root_t;
};

/// What X gives to corners 1 and 2; corner 0 takes the opposite of both.
struct Given {
  Register d1, d2;
  Bits careful;  ///< lanes where the fast path does not hold
};

/// The divergence from the differences of u to corner 0, for X of length 1.
inline Given unit_divergence(const Shape& s, Register u0, Register du1, Register du2) {
  // Relative to the larger difference: squares of u itself underflow half way to the floor.
  const Register size1 = size_of(du1), size2 = size_of(du2);
  const Register largest = size1 > size2 ? size1 : size2;
  const Register scale = to_one(largest);
  du1 *= scale;
  // The gradient times base and height: only its direction counts.
  const Register gx = du1 * s.height;
  const Register gy = du2 * scale * s.base - s.x * du1;
  const Register square = gx * gx + gy * gy;
  const Register half = -0.5 * inverse_root(square);
  const Register fx = gx * half;
  const Register fy = gy * half;
  const Register same = kSmallest + kEquallyWarm * size_of(u0);
  return {s.height * fx - s.x * fy, s.base * fy,
          reinterpret_cast<Bits>((largest <= same) | (largest != largest)) | unsafe(square)};
}

/// Shortens X, from the differences of log u.
inline void shorten(const Shape& s, Register dl1, Register dl2, Given& given) {
  const Register gx = dl1 * s.height;
  const Register gy = dl2 * s.base - s.x * dl1;
  const Register square = gx * gx + gy * gy;
  const Register inverse = inverse_root(square);
  const Register size = square * inverse * s.inverse_area;
  const Register length = field_length(s.base, s.x, s.height, gx * inverse, gy * inverse, size,
                                       s.root_t, s.inverse_root_t);
  given.d1 *= length;
  given.d2 *= length;
  given.careful |= unsafe(square);
}
