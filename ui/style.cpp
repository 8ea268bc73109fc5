// SPDX-License-Identifier: MIT
#include "ui/layout.h"

#include <algorithm>
#include <cmath>

namespace geotherm::ui {
namespace {

ImVec4 rgb(unsigned hex) {
  const auto part = [hex](unsigned shift) {
    return static_cast<float>((hex >> shift) & 255U) / 255.0F;
  };
  return {part(16), part(8), part(0), 1};
}

// Text on panel: 11:1 and more; dim text on panel: 5:1 and more, in both themes (WCAG 2.1, AA).
const Palette kDark = {
    .window = rgb(0x16191d),
    .panel = rgb(0x1f2328),
    .header = rgb(0x2a2f37),
    .frame = rgb(0x15181c),
    .border = rgb(0x3a424d),
    .button = rgb(0x353c47),
    .text = rgb(0xe4e8ed),
    .dim = rgb(0x9aa5b2),
    .accent = rgb(0x52b8ad),
    .selected = rgb(0x27514e),
    .good = rgb(0x7cc58a),
    .warning = rgb(0xe5b454),
    .error = rgb(0xf4807a),
    .series = {rgb(0x52b8ad), rgb(0xe3bcdb), rgb(0x8fa3d9)},
};
const Palette kLight = {
    .window = rgb(0xe9ecef),
    .panel = rgb(0xf7f8fa),
    .header = rgb(0xe3e7ec),
    .frame = rgb(0xffffff),
    .border = rgb(0xbcc4ce),
    .button = rgb(0xdde2e8),
    .text = rgb(0x1b2026),
    .dim = rgb(0x56606c),
    .accent = rgb(0x0b7a75),
    .selected = rgb(0xc3e4e1),
    .good = rgb(0x1c7a3a),
    .warning = rgb(0x8a5700),
    .error = rgb(0xb3261e),
    .series = {rgb(0x0b7a75), rgb(0xb873a8), rgb(0x5266a8)},
};

ImVec4 mixed(const ImVec4& a, const ImVec4& b, float share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z),
          a.w + share * (b.w - a.w)};
}

void set_colours(ImGuiStyle& style, const Palette& p) {
  // Whatever has no line below keeps to this: one accent, no blue of ImGui's own.
  for (ImVec4& colour : style.Colors) colour = p.header;
  const auto set = [&style](ImGuiCol which, const ImVec4& colour) { style.Colors[which] = colour; };
  // Pointed at and pressed: towards the text's colour.
  const auto raised = [&p](const ImVec4& colour, float share) {
    return mixed(colour, p.text, share);
  };
  const ImVec4 none(0, 0, 0, 0);
  set(ImGuiCol_Text, p.text);
  set(ImGuiCol_TextDisabled, p.dim);
  set(ImGuiCol_WindowBg, p.panel);
  set(ImGuiCol_ChildBg, none);
  set(ImGuiCol_PopupBg, p.panel);
  set(ImGuiCol_Border, p.border);
  set(ImGuiCol_BorderShadow, none);
  set(ImGuiCol_FrameBg, p.frame);
  set(ImGuiCol_FrameBgHovered, raised(p.frame, 0.06F));
  set(ImGuiCol_FrameBgActive, raised(p.frame, 0.09F));
  set(ImGuiCol_MenuBarBg, p.window);
  set(ImGuiCol_ScrollbarBg, none);
  set(ImGuiCol_ScrollbarGrab, p.button);
  set(ImGuiCol_ScrollbarGrabHovered, raised(p.button, 0.15F));
  set(ImGuiCol_ScrollbarGrabActive, raised(p.button, 0.25F));
  set(ImGuiCol_CheckMark, p.accent);
  set(ImGuiCol_SliderGrab, p.accent);
  set(ImGuiCol_SliderGrabActive, raised(p.accent, 0.2F));
  set(ImGuiCol_Button, p.button);
  set(ImGuiCol_ButtonHovered, raised(p.button, 0.1F));
  set(ImGuiCol_ButtonActive, raised(p.button, 0.2F));
  set(ImGuiCol_Header, p.selected);
  set(ImGuiCol_HeaderHovered, mixed(p.header, p.selected, 0.6F));
  set(ImGuiCol_HeaderActive, p.selected);
  set(ImGuiCol_Separator, p.border);
  set(ImGuiCol_TableRowBg, none);
  set(ImGuiCol_TableRowBgAlt, faded(p.header, 0.5F));
  set(ImGuiCol_TextSelectedBg, faded(p.accent, 0.4F));
  set(ImGuiCol_NavHighlight, p.accent);
  set(ImGuiCol_ModalWindowDimBg, ImVec4(0, 0, 0, 0.45F));
}

}  // namespace

const Palette& palette(Theme theme) { return theme == Theme::kDark ? kDark : kLight; }

ImVec4 faded(ImVec4 colour, float alpha) {
  colour.w *= alpha;
  return colour;
}

void set_style(Theme theme, float scale) {
  ImGuiStyle style;
  style.WindowPadding = {10, 8};
  style.FramePadding = {7, 3};
  style.ItemSpacing = {6, 5};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {5, 2};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 11;
  style.WindowRounding = 0;
  style.ChildRounding = 4;
  style.FrameRounding = 4;
  style.PopupRounding = 4;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 4;
  style.DisabledAlpha = 0.5F;
  style.ScaleAllSizes(scale);
  style.WindowMinSize = {1, 1};  // ImGui wants no less
  // Borders are lines: one pixel, two where pixels are small.
  style.WindowBorderSize = 0;
  style.PopupBorderSize = style.FrameBorderSize = std::max(1.0F, std::floor(scale));
  style.ChildBorderSize = style.FrameBorderSize;
  set_colours(style, palette(theme));
  ImGui::GetStyle() = style;
}

void load_fonts(std::span<const std::byte> font, float scale) {
  // Latin-1, Latin Extended-A, Greek, punctuation, super- and subscripts, arrows, mathematics,
  // blocks and shapes. ImGui reads the list when it makes its image, hence static.
  static constexpr ImWchar kRanges[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x2010, 0x2044, 0x2070,
                                        0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0x2580, 0x25ff,
                                        0x2713, 0x2717, 0x26a0, 0x26a0, 0};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  // The default keeps a power of two; a wide image is what HiDPI letters need.
  atlas.TexDesiredWidth = scale > 1.5F ? 2048 : 1024;
  if (font.empty()) {
    atlas.AddFontDefault();
    atlas.AddFontDefault();
  } else {
    for (const float letters : {kLetters, kBigLetters}) {
      ImFontConfig config;
      config.FontDataOwnedByAtlas = false;
      config.OversampleH = scale > 1.5F ? 1 : 2;
      config.PixelSnapH = scale > 1.5F;
      // ImGui promises not to write to bytes that it does not own.
      void* bytes = const_cast<std::byte*>(font.data());  // NOLINT
      atlas.AddFontFromMemoryTTF(bytes, static_cast<int>(font.size()), std::round(letters * scale),
                                 &config, kRanges);
    }
  }
  atlas.Build();
}

ImFont* big_font() {
  const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  return atlas.Fonts.empty() ? nullptr : atlas.Fonts.back();
}

}  // namespace geotherm::ui
