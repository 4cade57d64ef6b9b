#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "planner/files/exchange/brep/brep.h"
#include "planner/ground/vocabulary/noun_kind.h"

namespace capstan::recognise {

using exchange::Direction3;
using exchange::Point3;
using model::TypeId;

/// Lengths below this are one: planes that lie so close are the same plane, axes the same axis. Far below
/// what is machined, far above what CAD systems and STEP files round to (their usual uncertainty is 1e-5 to
/// 1e-3 mm).
inline constexpr double kSameLengthMm = 1e-3;
/// Directions closer than this are the same.
inline constexpr double kSameAngleRad = 1e-4;

/// A size of a feature: a length, an angle, or a number of islands.
struct Parameter {
  std::string name;  ///< a word of ISO 14649: "depth", "width", "length", "diameter", "slope", …
  double value = 0;  ///< mm; rad where `is_angle`; one of "islands" is one
  friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// Whether a size is in rad.
[[nodiscard]] bool is_angle(const Parameter& p);

/// What else the same faces could be machined as.
struct Alternative {
  TypeId type = TypeId::kNone;
  Direction3 access;   ///< from the material to the tool
  std::string reason;  ///< a sentence
};

/// A group of faces that one manufacturing feature makes.
struct Feature {
  /// ISO 14649's word: kClosedPocket, kOpenPocket, kSlot, kStep, kPlanarFace, kRoundHole, kCounterboreHole,
  /// kCountersunkHole, kChamfer, kEdgeRound, kGeneralOutsideProfile, kRegionSurfaceList.
  TypeId type = TypeId::kNone;
  /// The profile of its boundary, or of what is swept: kRectangularClosedProfile, kNgonClosedProfile,
  /// kCircularClosedProfile, kGeneralClosedProfile, kSquareUProfile, kVeeProfile, kOpenProfile, or kNone.
  TypeId profile = TypeId::kNone;
  int walls = 0;                     ///< plane walls beside the floor
  bool through = false;              ///< no floor: it leaves the raw piece on the other side
  bool rim = false;                  ///< chamfer, edge round: all along an outline, made from above
  int open_sides = 0;                ///< sides of the raw piece that it opens to, beside those along `access`
  Direction3 access;                 ///< from the material to the tool
  std::vector<std::uint32_t> faces;  ///< into Brep::faces, ascending
  std::vector<Parameter> parameters;
  std::vector<Alternative> alternatives;
  std::string reason;  ///< why it was taken for this, a sentence
};

/// Faces of the raw piece, or faces that no rule explains.
struct Rest {
  std::vector<std::uint32_t> faces;
  std::string reason;
};

/// A rectangular raw piece that just holds the part.
struct RawBox {
  std::array<Direction3, 3> axis;  ///< right-handed
  std::array<double, 3> lo{};      ///< mm along each axis, from the origin of the part
  std::array<double, 3> hi{};
};

/// Each face of the body stands once: in a feature, on the raw piece, or unrecognised with a reason.
struct Recognition {
  RawBox raw;
  std::vector<Feature> features;      ///< by their lowest face
  std::vector<std::uint32_t> on_raw;  ///< faces that lie on the sides of the raw piece, ascending
  std::vector<Rest> unrecognised;     ///< by their lowest face
};

/// Recognises the machining features of one body by the adjacency of its faces.
///
/// Edges that are concave tie faces of one feature together; edges where two features meet, or a feature
/// meets the raw piece, are convex. Fillets carry the tie. Faces that one plane or cylinder was split into
/// are taken together first, so that neither their number, nor their order, nor the frame matters.
///
/// Frame   that of the Brep; `RawBox` has its own axes in it.
/// Units   mm, rad.
/// Cost    linear in faces and edges, but for groups that are incomplete, which are compared in pairs.
/// Source  derived; the words are ISO 14649-10's.
[[nodiscard]] Recognition recognise(const exchange::Brep& brep, std::size_t body = 0);

/// `#id` of each face in its file, or its number among the faces, from 1, where it has none: "#12 #15".
[[nodiscard]] std::string faces_in_words(const exchange::Brep& brep, const std::vector<std::uint32_t>& faces);

}  // namespace capstan::recognise
