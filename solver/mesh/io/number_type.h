// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "solver/mesh/io/byte_order.h"

namespace geotherm::io {

/// How a file stores a number. Whole numbers come first.
enum class NumberType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

inline bool is_whole(NumberType type) { return type < NumberType::kFloat32; }

/// Calls use(zero), where zero is 0 in the type, and returns what it returns.
template <class Use>
auto with_number_type(NumberType type, const Use& use) {
  switch (type) {
    case NumberType::kInt8:
      return use(std::int8_t{});
    case NumberType::kUint8:
      return use(std::uint8_t{});
    case NumberType::kInt16:
      return use(std::int16_t{});
    case NumberType::kUint16:
      return use(std::uint16_t{});
    case NumberType::kInt32:
      return use(std::int32_t{});
    case NumberType::kUint32:
      return use(std::uint32_t{});
    case NumberType::kInt64:
      return use(std::int64_t{});
    case NumberType::kUint64:
      return use(std::uint64_t{});
    case NumberType::kFloat32:
      return use(float{});
    case NumberType::kFloat64:
      break;
  }
  return use(double{});
}

/// Bytes of one number.
inline std::size_t size_of(NumberType type) {
  return with_number_type(type, [](auto zero) { return sizeof zero; });
}

/// Calls use(number) for each of `count` numbers. Precondition: the bytes hold them.
template <class Use>
void for_each_number(std::string_view bytes, std::size_t count, NumberType type, std::endian order,
                     const Use& use) {
  with_number_type(type, [&](auto zero) {
    using T = decltype(zero);
    for (std::size_t i = 0; i < count; ++i) use(load<T>(bytes.data() + i * sizeof(T), order));
  });
}

/// The numbers as doubles. Precondition: the same.
inline std::vector<double> decode_numbers(std::string_view bytes, std::size_t count,
                                          NumberType type, std::endian order) {
  std::vector<double> out;
  out.reserve(count);
  for_each_number(bytes, count, type, order,
                  [&out](auto number) { out.push_back(static_cast<double>(number)); });
  return out;
}

}  // namespace geotherm::io
