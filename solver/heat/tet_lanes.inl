// SPDX-License-Identifier: MIT
// For field_kernels.inl, which includes it inside its namespace: the pass over tets. A lane is one
// tet of one source set.

template <int K>
struct TetLanes {
  static constexpr int kCount = 16;
  static constexpr int kTets = kCount / K;
  double u0[kCount];
  double du[3][kCount], dl[3][kCount];  ///< differences to corner 0, of u and of log u
  double gradient[9][kCount];           ///< of corners 1 to 3
  double measure[kCount];
  double flow[3][kCount];  ///< what X gives to corners 1 to 3; corner 0 takes the opposite of all
  unsigned careful;        ///< bits of lanes where the fast path does not hold
};

template <int K>
void load_tets(const TetPass& pass, Index first, TetLanes<K>& s) {
  prefetch_ahead(pass.corners + 4 * std::ptrdiff_t{first}, 4 * TetLanes<K>::kTets);
  prefetch_ahead(pass.gradients + 12 * std::ptrdiff_t{first}, 12 * TetLanes<K>::kTets);
  s.careful = 0;
  for (int i = 0; i < TetLanes<K>::kTets; ++i) {
    const Index* const corner = pass.corners + 4 * std::ptrdiff_t{first + i};
    const double* const gradient = pass.gradients + 12 * std::ptrdiff_t{first + i} + 3;
    constexpr unsigned kAll = (1U << K) - 1;
    bool mixed = false;
    for (int c = 0; c < 4; ++c) {
      mixed |= pass.level != nullptr &&
               std::memcmp(pass.level + corner[0] * pass.stride,
                           pass.level + corner[c] * pass.stride, K * sizeof(*pass.level)) != 0;
    }
    s.careful |= (mixed ? kAll : 0) << (i * K);
    for (int k = 0; k < K; ++k) {
      const int lane = i * K + k;
      s.u0[lane] = pass.u[corner[0] * pass.stride + k];
      s.measure[lane] = pass.measures[first + i];
      for (int c = 0; c < 3; ++c) s.du[c][lane] = pass.u[corner[c + 1] * pass.stride + k];
      for (int e = 0; e < 9; ++e) s.gradient[e][lane] = gradient[e];
      if (pass.log_u == nullptr) continue;
      const double l0 = pass.log_u[corner[0] * pass.stride + k];
      for (int c = 0; c < 3; ++c) s.dl[c][lane] = pass.log_u[corner[c + 1] * pass.stride + k] - l0;
    }
  }
}

struct Spatial {
  Register x, y, z;
};
inline Register dot(const Spatial& a, const Spatial& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Spatial cross(const Spatial& a, const Spatial& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Spatial gradient_of(const Spatial (&g)[3], const Register (&values)[3]) {
  return {values[0] * g[0].x + values[1] * g[1].x + values[2] * g[2].x,
          values[0] * g[0].y + values[1] * g[1].y + values[2] * g[2].y,
          values[0] * g[0].z + values[1] * g[1].z + values[2] * g[2].z};
}

/// The length of X. Corner k lies at cross(g of the next, g of the one after) / determinant from
/// corner 0, since the gradients are the inverse of the edges there.
inline Register tet_length(const Spatial (&g)[3], const Register (&dl)[3], double root_t,
                           Bits& careful) {
  const Spatial slope = gradient_of(g, dl);
  const Register square = dot(slope, slope);
  const Register inverse = inverse_root(square);
  const Spatial edge[3] = {cross(g[1], g[2]), cross(g[2], g[0]), cross(g[0], g[1])};
  const Register determinant = dot(g[0], edge[0]);
  const Register scale = inverse / determinant;
  Register high{}, low{};
  for (const Spatial& to : edge) {
    const Register place = dot(slope, to) * scale;
    high = place > high ? place : high;
    low = place < low ? place : low;
  }
  careful |=
      unsafe(square) | reinterpret_cast<Bits>((determinant == 0.0) | (determinant != determinant));
  return front_length(high - low, square * inverse, all_lanes(root_t), all_lanes(1 / root_t));
}

template <int K>
void compute_tets(const TetPass& pass, TetLanes<K>& s) {
  for (int j = 0; j < TetLanes<K>::kCount; j += kLanes) {
    const Register u0 = load(s.u0 + j);
    Register du[3], dl[3], largest{};
    Spatial g[3];
    for (int c = 0; c < 3; ++c) {
      du[c] = load(s.du[c] + j) - u0;
      dl[c] = load(s.dl[c] + j);
      const Register size = size_of(du[c]);
      largest = size > largest ? size : largest;
      g[c] = {load(s.gradient[3 * c] + j), load(s.gradient[3 * c + 1] + j),
              load(s.gradient[3 * c + 2] + j)};
    }
    const Register scale = to_one(largest);
    for (Register& difference : du) difference *= scale;
    const Spatial direction = gradient_of(g, du);
    const Register square = dot(direction, direction);
    const Register same = kSmallest + kEquallyWarm * size_of(u0);
    Bits careful =
        reinterpret_cast<Bits>((largest <= same) | (largest != largest)) | unsafe(square);
    Register factor = -load(s.measure + j) * inverse_root(square);
    if (pass.log_u != nullptr) {
      Bits no_length{};  // lanes whose logarithms or gradients say none
      factor *= tet_length(g, dl, pass.root_t, no_length);
      s.careful |= lane_mask(no_length) << j;
    }
    for (int c = 0; c < 3; ++c) store(factor * dot(direction, g[c]), s.flow[c] + j);
    s.careful |= lane_mask(careful) << j;
  }
}

/// What the careful way gives.
inline void careful_tet(const TetPass& pass, Index tet, int column, double* to, int stride) {
  const auto x = pass.careful(pass.context, tet, column);
  const double* const gradient = pass.gradients + 12 * std::ptrdiff_t{tet} + 3;
  for (int c = 0; c < 3; ++c) {
    to[c * stride] = pass.measures[tet] * (x[0] * gradient[3 * c] + x[1] * gradient[3 * c + 1] +
                                           x[2] * gradient[3 * c + 2]);
  }
}

/// flow: of corner c from flow + c * stride, K columns.
template <int K>
inline void scatter_tet(const TetPass& pass, Index tet, const double* flow, int stride) {
  const Index* const corner = pass.corners + 4 * std::ptrdiff_t{tet};
  double* b[4];
  for (int c = 0; c < 4; ++c) b[c] = pass.b + corner[c] * pass.stride;
  for (int k = 0; k < K; ++k) {
    const double f1 = flow[k], f2 = flow[stride + k], f3 = flow[2 * stride + k];
    b[0][k] -= f1 + f2 + f3;
    b[1][k] += f1;
    b[2][k] += f2;
    b[3][k] += f3;
  }
}

template <int K>
void run_tets(const TetPass& pass) {
  constexpr int kTets = TetLanes<K>::kTets, kCount = TetLanes<K>::kCount;
  TetLanes<K> lanes[2];
  Index t = pass.first;
  const Index end = t + (pass.end - t) / kTets * kTets;
  if (t < end) load_tets<K>(pass, t, lanes[0]);
  for (int turn = 0; t < end; t += kTets, turn = 1 - turn) {
    if (t + kTets < end) load_tets<K>(pass, t + kTets, lanes[1 - turn]);
    TetLanes<K>& s = lanes[turn];
    compute_tets<K>(pass, s);
    for (unsigned careful = s.careful; careful != 0; careful &= careful - 1) {
      const int j = std::countr_zero(careful);
      careful_tet(pass, t + j / K, j % K, s.flow[0] + j, kCount);
    }
    for (int i = 0; i < kTets; ++i) scatter_tet<K>(pass, t + i, s.flow[0] + i * K, kCount);
  }
  for (; t < pass.end; ++t) {
    double flow[3 * K];
    for (int k = 0; k < K; ++k) careful_tet(pass, t, k, flow + k, K);
    scatter_tet<K>(pass, t, flow, K);
  }
}
