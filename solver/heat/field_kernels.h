// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "solver/core/processor.h"
#include "solver/geometry/operator_mesh.h"

namespace geotherm {

/// What a pass over the faces reads and writes, for some columns of a block: row i of u, log_u,
/// level and b starts at i * stride.
struct FieldPass {
  const OperatorMesh* mesh;
  Index first_face, end_face;  ///< those to be walked
  const double* u;
  const double* log_u;         ///< null: X keeps length 1
  const std::uint16_t* level;  ///< null, or exponents of u: faces with several are done carefully
  double* b;
  std::ptrdiff_t stride;
  double root_t;                 ///< sqrt(t), for field_length(), where all faces have one
  const double* root_t_of_face;  ///< F, or null

  /// X of one face and column, for the lanes that the fast path cannot do: gradients that
  /// underflow, logarithms that do not exist, corners with different exponents.
  const void* context;
  std::array<double, 2> (*careful)(const void* context, Index face, int column);
};

/// The same for a pass over tets: cells of four corners in three dimensions (CellMesh).
struct TetPass {
  const Index* corners;     ///< four to a tet
  const double* gradients;  ///< of their hat functions: three numbers to a corner
  const double* measures;   ///< of each tet
  Index first, end;         ///< tets to be walked
  const double* u;
  const double* log_u;         ///< null: X keeps length 1
  const std::uint16_t* level;  ///< as in FieldPass
  double* b;
  std::ptrdiff_t stride;
  double root_t;
  const void* context;
  std::array<double, 3> (*careful)(const void* context, Index tet, int column);
};

/// Corners whose u differ by less than this share of it are equally warm, but for round-off: their
/// face has no direction. Symmetric meshes have such faces opposite their sources.
inline constexpr double kEquallyWarm = 1e-14;

/// Where sqrt(t) |grad log u| is above this share of what one front gives on this mesh, there is
/// one front: the rest is the scatter of the discretisation, some 5 %.
inline constexpr double kFront = 0.95;
/// Faces longer than this many diffusion lengths say nothing reliable about the slope.
inline constexpr double kResolved = 1.6;

/// Length of X on a cell that reaches so far along the gradient of log u, which has this size: the
/// slope sqrt(t) |grad log u|, relative to that of one front, at most 1. Over an extent e of the
/// mesh one front falls by 2 asinh(x), x = e / (2 sqrt(t)), where exp(-d / sqrt(t)) falls by 2 x;
/// 1 + x^2/6 - x^4/72 is x / asinh(x) to 2 % for x < 0.8.
/// T: a number, or a register of them. inverse_root_t: 1 / sqrt(t); divisions take longest here.
template <class T>
inline T front_length(T extent, T size, T root_t, T inverse_root_t) {
  const T zero{}, one = zero + 1.0;
  const T half = 0.5 * inverse_root_t * extent;
  const T q = half * half * (1.0 / 6);
  const T length = root_t * (1 / kFront) * size * (1.0 + q - 0.5 * q * q);
  return ((extent > kResolved * root_t) | (length > one)) ? one : length;
}

/// front_length() on a face, by its layout and the direction of the gradient.
template <class T>
inline T field_length(T base, T x, T height, T nx, T ny, T size, T root_t, T inverse_root_t) {
  const T a = base * nx;
  const T b = x * nx + height * ny;
  const T zero{};
  const T high = a > b ? a : b;
  const T low = a < b ? a : b;
  const T extent = (high > zero ? high : zero) - (low < zero ? low : zero);
  return front_length(extent, size, root_t, inverse_root_t);
}

/// out[i] = log(u[i]) to 1e-8; NaN where u <= 0.
void logarithms(const double* u, double* out, std::size_t count,
                InstructionSet set = best_instruction_set());

/// Bit k of masks[i]: |u| of row i, column k is below floors[k]; not where it is no number.
/// u: rows x columns, 16 columns at most.
void mark_small(const double* u, std::int64_t rows, int columns, const double* floors,
                std::uint16_t* masks, InstructionSet set = best_instruction_set());

/// Adds to b the integrated divergence of X = -grad u / |grad u| over the pass's faces, for a group
/// of 1, 2, 4, 8 or 16 columns.
void add_unit_divergence(const FieldPass& pass, int group,
                         InstructionSet set = best_instruction_set());

/// Adds to b the integrated divergence of X over the tets of the pass.
void add_tet_divergence(const TetPass& pass, int group,
                        InstructionSet set = best_instruction_set());

/// The functions of one instruction set that the functions above call.
struct FieldKernels {
  void (*add_unit_divergence[5])(const FieldPass& pass);  ///< by the binary logarithm of the group
  void (*add_tet_divergence[5])(const TetPass& pass);     ///< likewise
  void (*logarithms)(const double* u, double* out, std::size_t count);
  void (*mark_small)(const double* u, std::int64_t rows, int columns, const double* floors,
                     std::uint16_t* masks);
};

}  // namespace geotherm
