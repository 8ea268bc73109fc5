// SPDX-License-Identifier: MIT
#include "solver/mesh/io/vtk_cells.h"

#include <string>
#include <utility>

#include "solver/mesh/io/input_file.h"

namespace geotherm::io {
namespace {

constexpr std::int64_t kVtkTriangle = 5, kVtkPixel = 8, kVtkQuad = 9, kVtkTet = 10;

std::string vtk_cell_name(std::int64_t type) {
  switch (type) {
    case 1:
    case 2:
      return "points";
    case 3:
    case 4:
      return "edges";
    case kVtkTriangle:
      return "triangles";
    case kVtkStrip:
      return "triangle strips";
    case kVtkPolygon:
      return "polygons";
    case kVtkPixel:
    case kVtkQuad:
      return "quads";
    case 11:
    case 12:
      return "hexahedra";
    case 13:
      return "prisms";
    case 14:
      return "pyramids";
    case 22:
      return "triangles with 6 corners";
    case 23:
      return "quads with 8 corners";
    case 28:
      return "quads with 9 corners";
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

void add_vtk_cells(const VtkCells& cells, std::int64_t first, RawElements& raw) {
  const std::size_t count = cells.types.size();
  const auto numbers = static_cast<std::int64_t>(cells.connectivity.size());
  const auto vertices = static_cast<std::int64_t>(raw.positions.size()) - first;
  if (cells.offsets.size() != count + 1) {
    throw ReadFailure{"there are the types of " + std::to_string(count) + " cells, but " +
                      std::to_string(cells.offsets.size()) + " offsets"};
  }
  FanBuilder fan(raw.faces);
  std::vector<Index> corners;
  for (std::size_t c = 0; c < count; ++c) {
    const std::int64_t begin = cells.offsets[c], end = cells.offsets[c + 1], type = cells.types[c];
    if (begin < 0 || end < begin || end > numbers) {
      fail_in_cell(c, count,
                   "has the corners " + std::to_string(begin) + " to " + std::to_string(end) +
                       " of " + std::to_string(numbers));
    }
    if (type != kVtkTet) ++raw.others[vtk_cell_name(type)];
    if (type != kVtkTet && (type < kVtkTriangle || type > kVtkQuad)) continue;
    const std::int64_t needed = type == kVtkTriangle                       ? 3
                                : type == kVtkStrip || type == kVtkPolygon ? end - begin
                                                                           : 4;
    if (end - begin != needed) {
      const char* const name = type == kVtkTet        ? "tetrahedron"
                               : type == kVtkTriangle ? "triangle"
                                                      : "quad";
      fail_in_cell(c, count,
                   std::string("is a ") + name + " with " + std::to_string(end - begin) +
                       " corners instead of " + std::to_string(needed));
    }
    corners.clear();
    for (std::int64_t k = begin; k < end; ++k) {
      const std::int64_t corner = cells.connectivity[static_cast<std::size_t>(k)];
      if (corner < 0 || corner >= vertices) {
        fail_in_cell(c, count,
                     "uses vertex " + std::to_string(corner) + ", but there are " +
                         std::to_string(vertices) + " vertices");
      }
      corners.push_back(static_cast<Index>(first + corner));
    }
    if (type == kVtkTet) {
      raw.tets.push_back({corners[0], corners[1], corners[2], corners[3]});
    } else if (type == kVtkStrip) {
      add_strip(corners, raw.faces);
    } else {
      if (type == kVtkPixel) std::swap(corners[2], corners[3]);  // by rows, not around
      for (const Index corner : corners) fan.add(corner);
      fan.end(raw.polygons);
    }
  }
  note_left_out(fan.left_out(), raw.notes);
}

}  // namespace geotherm::io
