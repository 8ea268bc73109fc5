// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

// What is fed with arbitrary bytes, by libFuzzer (docs/testing.md) and by the replay of the corpus.
// Each returns what is wrong, for people, or nothing. Errors of the library are not wrong: a crash,
// a NaN and an error that is not one sentence are.
namespace geotherm::test {

using Bytes = std::span<const std::uint8_t>;

// The bytes of a file, through its reader.
std::string fuzz_obj(Bytes bytes);
/// As a mesh, and as points.
std::string fuzz_ply(Bytes bytes);
std::string fuzz_off(Bytes bytes);
std::string fuzz_stl(Bytes bytes);
std::string fuzz_vtk(Bytes bytes);
std::string fuzz_vtu(Bytes bytes);
std::string fuzz_vtp(Bytes bytes);
std::string fuzz_msh(Bytes bytes);
std::string fuzz_mesh(Bytes bytes);
std::string fuzz_meshb(Bytes bytes);
/// Of TetGen's pair: a .node file, a zero byte, an .ele file.
std::string fuzz_node(Bytes bytes);
std::string fuzz_gii(Bytes bytes);
std::string fuzz_fsurf(Bytes bytes);
/// As a mask of every format.
std::string fuzz_mask(Bytes bytes);
std::string fuzz_xyz(Bytes bytes);
std::string fuzz_pts(Bytes bytes);
std::string fuzz_pcd(Bytes bytes);
std::string fuzz_npy(Bytes bytes);
std::string fuzz_png(Bytes bytes);
std::string fuzz_nrrd(Bytes bytes);
std::string fuzz_vti(Bytes bytes);

/// What gzip packed.
std::string fuzz_gz(Bytes bytes);

// Scenes, through Assimp in its process.
std::string fuzz_glb(Bytes bytes);
std::string fuzz_dae(Bytes bytes);
std::string fuzz_threemf(Bytes bytes);

/// A script: parsed, applied to the state of a viewer and written again. Each line is read as a
/// source and as the value of an option, too.
std::string fuzz_command(Bytes bytes);

/// Options, a small mesh and sources (fuzz_mesh.h), solved by one method after the other.
std::string fuzz_solve(Bytes bytes);

/// What is wrong with the message of an error, or nothing: it is one line without control
/// characters and not long, but for so many bytes that it may quote.
std::string message_fault(const std::string& message, std::size_t quoted = 0);

}  // namespace geotherm::test
