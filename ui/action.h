// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

/// What a key or an entry of a menu asks for.
enum class Action {
  kOpenModel,
  kOpenSession,
  kOpenSequence,
  kSaveSession,
  kSavePicture,
  kSaveDistances,
  kSaveFigures,
  kSaveMesh,
  kSaveLog,
  kQuit,
  kUndo,
  kRedo,
  kWireframe,
  kFlat,
  kSmooth,
  kSources,
  kHeatGradient,
  kGradientError,
  kContours,
  kExactError,
  kRegions,
  kEikonalError,
  kLostGradients,
  kTriangleQuality,
  kNonDelaunay,
  kRotate,
  kFrame,
  kMoreSources,
  kFewerSources,
  kShuffleSources,
  kClearSources,
  kBoundarySource,
  kViewTool,
  kSourceTool,
  kBrush,
  kPathTool,
  kPickTool,
  kSculpt,
  kRemovePointed,  ///< the source that the pointer is at, or that was clicked
  kKeep,
  kFlip,
  kSwap,
  kForget,
  kShowDifference,
  kCompare,
  kLeftPanel,
  kRightPanel,
  kLogPanel,
  kTheme,
  kPlay,
  kNextFrame,
  kPreviousFrame,
  kLoop,
  kKeys,
  kAbout,
  kStop,  ///< another tool than that of sources, the picked point or the work, in this order
};

struct Frame;

/// Sends its command, opens its dialog or turns its switch. What is not possible now does nothing.
void perform(Frame& frame, Action action);

/// Opens a section of the right side bar, and brings it into sight.
void show_figures(Frame& frame, const char* section);

/// Whether it would do anything now.
bool is_possible(const Frame& frame, Action action);

/// Whether what it turns on is on.
bool is_on(const Frame& frame, Action action);

}  // namespace geotherm::ui
