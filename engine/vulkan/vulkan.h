// SPDX-License-Identifier: MIT
#pragma once

// The loader is opened when an instance is made (loader.h), so that a machine without it still runs
// everything that draws nothing. Included by sources of this folder only: it is expensive.
#define VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL 0
#include <vulkan/vulkan_raii.hpp>
