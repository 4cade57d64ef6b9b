#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace capstan::testing::sweep {

/// How a catalogue would make a part of a feature: one tool over one volume or one length.
enum class Work : std::uint8_t {
  kRough,    ///< an end mill takes a volume
  kFace,     ///< a face mill runs over a length at full feed
  kFinish,   ///< an end mill runs along walls or over a floor, one pass, at a finishing engagement
  kDrill,    ///< a drill goes down a length
  kReam,     ///< a reamer goes down a length
  kTap,      ///< a tap goes down a length and back
  kChamfer,  ///< a chamfer mill runs along an edge
  kBall,     ///< a ball mill runs along a surface
};

struct CatalogueWork {
  Work work;
  double diameter_mm;
  double amount;          ///< mm3 for kRough, mm of way for all others
  double depth_mm = 0.0;  ///< of kRough: how deep the volume is
};

/// A part with one feature, in a block of its own, and how a catalogue would make it.
struct Feature {
  std::string name;
  std::string text;           ///< ISO 14649, or an ASCII STL
  double allowance_mm = 0.0;  ///< an STL's raw piece is that much larger all round; 0: the file's block
  double wall_zone_mm = 0.0;  ///< the narrowest zone of the feature's sizes across; 0: none is drawn
  std::vector<CatalogueWork> catalogue;
};

/// Twelve kinds of feature: holes, pockets, step, slot, face, contour, freeform.
[[nodiscard]] const std::vector<Feature>& features();

}  // namespace capstan::testing::sweep
