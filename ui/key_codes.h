// SPDX-License-Identifier: MIT
#pragma once

// Where keys stand in ImGuiIO::KeysDown: the numbers of the window system (GLFW). Letters and
// digits are their capital ASCII characters.
namespace geotherm::ui {

inline constexpr int kKeySpace = 32;
inline constexpr int kKeyEscape = 256;
inline constexpr int kKeyEnter = 257;
inline constexpr int kKeyTab = 258;
inline constexpr int kKeyBackspace = 259;
inline constexpr int kKeyInsert = 260;
inline constexpr int kKeyDelete = 261;
inline constexpr int kKeyRight = 262;
inline constexpr int kKeyLeft = 263;
inline constexpr int kKeyDown = 264;
inline constexpr int kKeyUp = 265;
inline constexpr int kKeyPageUp = 266;
inline constexpr int kKeyPageDown = 267;
inline constexpr int kKeyHome = 268;
inline constexpr int kKeyEnd = 269;
inline constexpr int kKeyF1 = 290;  ///< the others follow
inline constexpr int kKeyPadEnter = 335;

}  // namespace geotherm::ui
