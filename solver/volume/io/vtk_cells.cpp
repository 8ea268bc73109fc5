// SPDX-License-Identifier: MIT
#include "solver/volume/io/vtk_cells.h"

#include <string>

#include "solver/mesh/io/input_file.h"

namespace geotherm::io {
namespace {

constexpr std::int64_t kVtkTet = 10;

std::string vtk_cell_name(std::int64_t type) {
  switch (type) {
    case 1:
      return "points";
    case 3:
      return "edges";
    case 5:
      return "triangles";
    case 7:
      return "polygons";
    case 8:
    case 9:
      return "quads";
    case 11:
    case 12:
      return "hexahedra";
    case 13:
      return "prisms";
    case 14:
      return "pyramids";
    case 24:
      return "tetrahedra with 10 corners";
    default:
      return "cells of VTK's type " + std::to_string(type);
  }
}

[[noreturn]] void fail_in_cell(std::size_t cell, std::size_t count, const std::string& cause) {
  throw ReadFailure{"cell " + std::to_string(cell) + " of " + std::to_string(count) +
                    " (counted from 0) " + cause};
}

}  // namespace

std::size_t size_of(VtkType type) {
  switch (type) {
    case VtkType::kInt8:
    case VtkType::kUint8:
      return 1;
    case VtkType::kInt16:
    case VtkType::kUint16:
      return 2;
    case VtkType::kInt32:
    case VtkType::kUint32:
    case VtkType::kFloat32:
      return 4;
    case VtkType::kInt64:
    case VtkType::kUint64:
    case VtkType::kFloat64:
      break;
  }
  return 8;
}

void add_vtk_tets(const VtkCells& cells, std::int64_t first, RawTets& raw) {
  const std::size_t count = cells.types.size();
  const auto corners = static_cast<std::int64_t>(cells.connectivity.size());
  const auto vertices = static_cast<std::int64_t>(raw.positions.size()) - first;
  if (cells.offsets.size() != count + 1) {
    throw ReadFailure{"there are the types of " + std::to_string(count) + " cells, but " +
                      std::to_string(cells.offsets.size()) + " offsets"};
  }
  for (std::size_t c = 0; c < count; ++c) {
    const std::int64_t begin = cells.offsets[c], end = cells.offsets[c + 1];
    if (begin < 0 || end < begin || end > corners) {
      fail_in_cell(c, count,
                   "has the corners " + std::to_string(begin) + " to " + std::to_string(end) +
                       " of " + std::to_string(corners));
    }
    if (cells.types[c] != kVtkTet) {
      ++raw.others[vtk_cell_name(cells.types[c])];
      continue;
    }
    if (end - begin != 4) {
      fail_in_cell(
          c, count,
          "is a tetrahedron with " + std::to_string(end - begin) + " corners instead of 4");
    }
    Tet tet;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int64_t corner = cells.connectivity[static_cast<std::size_t>(begin) + k];
      if (corner < 0 || corner >= vertices) {
        fail_in_cell(c, count,
                     "uses vertex " + std::to_string(corner) + ", but there are " +
                         std::to_string(vertices) + " vertices");
      }
      tet[k] = static_cast<Index>(first + corner);
    }
    raw.tets.push_back(tet);
  }
}

}  // namespace geotherm::io
