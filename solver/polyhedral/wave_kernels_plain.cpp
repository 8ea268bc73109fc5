// SPDX-License-Identifier: MIT
// The kernels for one instruction set; CMake gives this file its compiler flags.
#define GEOTHERM_KERNEL_NAMESPACE kernels_plain
#include "solver/polyhedral/wave_kernels.inl"
