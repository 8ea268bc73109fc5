// SPDX-License-Identifier: MIT
#include "engine/scene/line_set.h"

#include <gtest/gtest.h>

#include <limits>

namespace geotherm::test {
namespace {

using engine::finite_runs;
using engine::line_pieces;
using engine::LinePiece;
using glm::vec3;

constexpr vec3 kA(0, 0, 0), kB(1, 0, 0), kC(1, 1, 0), kD(0, 1, 0);

void expect_piece(const LinePiece& piece, const vec3& before, const vec3& from, const vec3& to,
                  const vec3& after) {
  EXPECT_EQ(piece.before, before);
  EXPECT_EQ(piece.from, from);
  EXPECT_EQ(piece.to, to);
  EXPECT_EQ(piece.after, after);
}

TEST(LinePieces, KnowTheirNeighbours) {
  const auto pieces = line_pieces(std::vector{kA, kB, kC});
  ASSERT_EQ(pieces.size(), 2U);
  expect_piece(pieces[0], kA, kA, kB, kC);
  expect_piece(pieces[1], kA, kB, kC, kC);
}

TEST(LinePieces, OfALoopJoinWhereItCloses) {
  const auto pieces = line_pieces(std::vector{kA, kB, kC, kD, kA});
  ASSERT_EQ(pieces.size(), 4U);
  expect_piece(pieces.front(), kD, kA, kB, kC);
  expect_piece(pieces.back(), kC, kD, kA, kB);
}

TEST(LinePieces, ThereAndBackAreNoLoop) {
  const auto pieces = line_pieces(std::vector{kA, kB, kA});
  ASSERT_EQ(pieces.size(), 2U);
  expect_piece(pieces.front(), kA, kA, kB, kA);
  expect_piece(pieces.back(), kA, kB, kA, kA);
}

TEST(LinePieces, LeaveOutRepeatedPoints) {
  EXPECT_EQ(line_pieces(std::vector{kA, kA, kB, kB + vec3(0, 1e-7F, 0), kC}).size(), 2U);
  EXPECT_TRUE(line_pieces(std::vector{kA, kA}).empty());
  EXPECT_TRUE(line_pieces(std::vector{kA}).empty());
  EXPECT_TRUE(line_pieces({}).empty());
}

TEST(FiniteRuns, AreCutAtPointsThatAreNone) {
  const vec3 none(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  const vec3 far(0, std::numeric_limits<float>::infinity(), 0);
  const auto runs = finite_runs(std::vector{none, kA, kB, far, far, kC, none});
  EXPECT_EQ(runs, (std::vector{std::vector{kA, kB}, std::vector{kC}}));
  EXPECT_TRUE(finite_runs(std::vector{none}).empty());
  EXPECT_TRUE(finite_runs({}).empty());
}

}  // namespace
}  // namespace geotherm::test
