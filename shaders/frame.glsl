// SPDX-License-Identifier: MIT
// The frame's uniforms. Included by every shader of the scene.
#include "shared.h"

layout(std140, set = 0, binding = kFrameBinding) uniform FrameBlock { Frame frame; };
