// SPDX-License-Identifier: MIT
#include "app/drawing/packed_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "app/picture/picture_data.h"

namespace geotherm::app {

void PackedArrays::add(const std::string& name, std::span<const std::uint32_t> numbers,
                       std::size_t parts, const Json& more) {
  std::vector<std::uint32_t> folded(numbers.size());
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint32_t d = numbers[i] - (i < parts ? 0 : numbers[i - parts]);
    folded[i] = d << 1U ^ (d >> 31U != 0 ? ~0U : 0U);
    most = std::max(most, folded[i]);
  }
  const auto width = std::max(1U, (static_cast<std::uint32_t>(std::bit_width(most)) + 7) / 8);
  Json entry = {{"name", name}, {"count", numbers.size()}, {"parts", parts}, {"bytes", width}};
  entry.update(more);
  index_.push_back(std::move(entry));
  for (std::uint32_t shift = 0; shift < 8 * width; shift += 8) {
    for (const std::uint32_t x : folded) bytes_ += static_cast<char>(x >> shift & 255U);
  }
}

void PackedArrays::add_floats(const std::string& name, std::span<const float> floats,
                              std::size_t parts, int bits) {
  float low = std::numeric_limits<float>::max(), high = -low;
  for (const float x : floats) {
    if (x == kNoPictureValue) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  const double steps = std::ldexp(1.0, bits) - 2;
  const double scale = high > low ? steps / (double{high} - low) : 0;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(floats.size());
  for (const float x : floats) {
    const bool none = x == kNoPictureValue;
    numbers.push_back(
        none ? 0 : static_cast<std::uint32_t>(std::lround((double{x} - low) * scale)) + 1);
  }
  add(name, numbers, parts,
      {{"low", low > high ? 0.0F : low}, {"step", scale > 0 ? 1 / scale : 0}});
}

Result<std::string> PackedArrays::deflated() const {
  uLongf size = compressBound(bytes_.size());
  std::string out(size, '\0');
  constexpr int kLevel = 6;
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes_.data()), bytes_.size(), kLevel) != Z_OK) {
    return Error{ErrorCode::kOutOfMemory, "not enough memory to compress the page"};
  }
  out.resize(size);
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

}  // namespace geotherm::app
