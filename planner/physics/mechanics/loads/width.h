#pragma once

/// How wide mills are put into a cut, over their diameter.
namespace capstan::mechanics {

/// Widest face that one pass covers.
/// Source: Mitsubishi Materials, course on selecting tool diameter and setting position (mmc-carbide.com):
/// for one pass a cutter of 1.2 to 1.3 times the face's width; the middle of it.
inline constexpr double kFaceWidthRatio = 0.8;
/// Widest cut of a rough pass that is not a slot. Default, unsourced.
inline constexpr double kRoughWidthRatio = 0.65;

}  // namespace capstan::mechanics
