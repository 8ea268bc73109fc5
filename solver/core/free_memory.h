// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace geotherm {

/// Bytes that this process can still take: the least of what the machine has available, what each
/// control group around the process (versions 1 and 2, /sys/fs/cgroup) leaves of its limit, and
/// what RLIMIT_AS leaves. File caches that can be dropped count as free. Empty where the system
/// says none of these. `root`: where /proc and /sys are looked for. Cost: some small files.
std::optional<std::int64_t> free_memory(const std::filesystem::path& root = "/");

/// Bytes of address space that RLIMIT_AS leaves; empty where it sets no limit.
std::optional<std::int64_t> free_address_space(const std::filesystem::path& root = "/");

}  // namespace geotherm
