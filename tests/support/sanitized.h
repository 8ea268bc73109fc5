// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::test {

/// True in a build with a sanitizer. A race or a wrong access shows there in little work as in
/// much, and work takes ten times as long: what is held for all sizes is held in the other builds.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace geotherm::test
