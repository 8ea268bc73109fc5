// SPDX-License-Identifier: MIT
#include "solver/mesh/io/file_bytes.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "solver/core/free_memory.h"
#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/parallel.h"
#include "solver/mesh/io/read_failure.h"

namespace geotherm::io {
namespace {

LargeBuffer room_for(std::size_t bytes) {
  const auto free = free_memory();
  if (free && static_cast<std::int64_t>(bytes) > *free) throw std::bad_alloc();
  return LargeBuffer(bytes);
}

}  // namespace

FileBytes::FileBytes(const InputFile& file) : buffer_(room_for(file.size() + kPadding)) {
  constexpr std::size_t kPiece = std::size_t{4} << 20;
  char* const bytes = reinterpret_cast<char*>(buffer_.data());
  const std::size_t size = file.size();
  std::memset(bytes + size, 0, kPadding);
  for_each_parallel((size + kPiece - 1) / kPiece, [&](std::size_t i) {
    const std::size_t place = i * kPiece;
    file.read(bytes + place, std::min(kPiece, size - place), place);
  });
}

Result<FileBytes> FileBytes::read(const std::string& path) {
  const auto file = InputFile::open(path);
  if (!file) return file.error();
  try {
    FileBytes read(*file);
    if (auto same = file->check_unchanged(); !same) return same.error();
    return read;
  } catch (const ReadFailure& failure) {
    return Error{ErrorCode::kBadFile, printable(path) + ": " + failure.message, failure.hint};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, printable(path) + ": not enough memory to read it"};
  }
}

}  // namespace geotherm::io
