#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/model/features/shape.h"
#include "planner/model/features/shape/open_reach.h"
#include "planner/model/nouns/feature.h"
#include "planner/model/nouns/profile.h"

// How the shapes of the several kinds of feature are built; only shape/*.cpp include this.

namespace capstan::model::shape {

/// Chord tolerance of areas, mm.
inline constexpr double kAreaTolerance = 0.001;

/// Compounds of patterns of compounds.
inline constexpr int kNesting = 8;

using Shapes = std::vector<FeatureShape>;

/// The middle of the shape's area at that height of its frame, workpiece coordinates.
geometry::Vec3 middle(const FeatureShape& s, double z);

/// The bosses that a pocket, face or step lists; null: another kind of feature.
const RefList<Boss>* bosses_of(const Model& m, AnyRef feature);
/// The compounds and patterns that list a feature; the pockets, faces and steps that a boss stands in.
std::vector<AnyRef> holders(const Model& m, AnyRef feature);

/// The piece that a file speaks of, worked out when it is first asked for.
class Piece {
 public:
  explicit Piece(const Model& m) : m_(m) {}
  /// Whether what stands there would have its middle in the piece; anything does where no piece is known.
  [[nodiscard]] bool meets(const FeatureShape& s, bool top_too);
  /// Whether the piece holds its whole area.
  [[nodiscard]] bool holds(const FeatureShape& s);
  [[nodiscard]] bool has(geometry::Vec3 p);

 private:
  void find();
  const Model& m_;
  geometry::Box3 box_;
  bool stated_ = false, known_ = false;
};

/// The coordinates that a feature is stated in: those of the workpiece, or of the compound or pattern that
/// holds it.
struct Within {
  geometry::Placement frame;     ///< of these coordinates, in workpiece coordinates
  AnyRef container;              ///< unset: the workpiece
  int depth = 0;                 ///< of nesting
  bool by_the_standard = false;  ///< nothing further in is read as workpiece coordinates
  Piece* piece = nullptr;        ///< never null while shapes are built
};

/// Its kind and name, as messages call it.
std::string label(const Model& m, AnyRef feature);
/// Frame, name, depth: what every machining feature has. `kind` is left to the caller.
Result<FeatureShape> base(const Model& m, AnyRef feature, bool needs_depth);

/// The area of a closed profile in the feature's frame; fills width, length, corner radius and assumptions.
Result<geometry::Region> closed_area(const Model& m, Ref<ClosedProfile> profile, FeatureShape& into);
/// The line of an open profile in the feature's frame.
Result<std::vector<geometry::Vec2>> open_line(const Model& m, Ref<OpenProfile> profile);
/// The path of travel in the feature's frame.
Result<std::vector<geometry::Vec2>> travel_line(const Model& m, Ref<TravelPath> path, FeatureShape& into);
/// The bosses of a pocket or face as islands. Fails for one that is not in it, and for one that leans.
Status add_islands(const Model& m, const RefList<Boss>& bosses, FeatureShape& into);
/// The radius at the foot of a boss, where one is stated, mm.
Result<std::optional<double>> foot_of(const Model& m, AnyRef boss);

/// The box that spans a box in plan: workpiece coordinates in, coordinates of the frame out.
geometry::Box2 in_plan(const geometry::Box3& box, const geometry::Placement& frame);

/// Takes out of a feature's shapes the bosses that are features of their own, at each place that compounds
/// and patterns give them. Fails  SHP-BOSS where a boss of unknown contour may lie in the feature.
Status spare_bosses(const Model& m, AnyRef feature, const Within& in, Shapes& shapes);
/// Whether its walls are not upright; why it is not planned then.
bool leans(const Boss& boss);
tl::unexpected<Diagnostic> leaning(const Model& m, AnyRef boss);
/// An area in another frame; its loops turn round when seen from below.
geometry::Region moved(const geometry::Placement& frame, const geometry::Region& r);
/// Where a closed outline crosses itself, so that it bounds no single area; touching itself is no crossing.
std::optional<geometry::Vec2> crosses_itself(const geometry::Loop& loop);

/// The frame of a profile within its feature; a profile placed exactly where its feature is repeats it.
Result<geometry::Placement> profile_frame(const Model& m, const Profile& profile, FeatureShape& into);

/// A drawn area with its inside corners rounded by a stated radius. Fails where that would fill more than
/// corners: a passage that is narrower than twice the radius.
Result<geometry::Region> rounded_corners(const Model& m, AnyRef feature, const geometry::Region& drawn,
                                         double radius_mm);
/// The radii that a flat end of a slot states for its two corners, mm; 0: sharp, or not stated.
struct FlatCorners {
  double first = 0.0, second = 0.0;
  [[nodiscard]] bool same() const { return first - second < 1e-6 && second - first < 1e-6; }
};
Result<FlatCorners> corners_of(const Model& m, const FlatSlotEndType& end, AnyRef feature);

/// A noun that is a shape by itself, and what builds the shapes of it and of what is derived from it. Nouns
/// that refer to others (threads, edges, compounds, patterns) are chosen in `any`.
struct ShapeNoun {
  TypeId noun;
  Result<Shapes> (*build)(const Model& m, AnyRef self);
};
template <class Noun, Result<Shapes> (*build)(const Model&, AnyRef, const Noun&)>
ShapeNoun shape_noun() {
  return {Noun::kType, [](const Model& m, AnyRef self) { return build(m, self, *m.get<Noun>(self)); }};
}
/// Of all files of noun/: NAME.cpp gives its own by `std::vector<ShapeNoun> NAME_nouns()`, which the build
/// finds by the file's name (planner/model/CMakeLists.txt).
std::vector<std::vector<ShapeNoun>> shape_nouns();
Result<Shapes> thread(const Model& m, AnyRef self, const Thread& f, const Within& in);
Result<Shapes> transition(const Model& m, AnyRef self, const TransitionFeature& f, const Within& in);
Result<Shapes> compound(const Model& m, AnyRef self, const CompoundFeature& f, const Within& in);
Result<Shapes> replicate(const Model& m, AnyRef self, const ReplicateFeature& f, const Within& in);

/// Dispatch, with the nesting bounded: a file may hold a compound of itself. Workpiece coordinates.
Result<Shapes> any(const Model& m, AnyRef feature, const Within& in);
/// As above for a feature wherever its compounds and patterns put it: once for each that lists it.
Result<Shapes> standing(const Model& m, AnyRef feature, const Within& in);
/// The coordinates in which it is stated, in the first place where it is listed.
Result<Within> stated_in(const Model& m, AnyRef feature, const Within& in);
/// What a thread or an edge is on: where both are listed together, in the same coordinates.
Result<Shapes> referred(const Model& m, AnyRef feature, const Within& in);

tl::unexpected<Diagnostic> missing(const Model& m, AnyRef feature, const std::string& attribute);
/// As above, for a value that is there and cannot be read; `why` says what is wrong with it.
tl::unexpected<Diagnostic> missing(const Model& m, AnyRef feature, const std::string& attribute,
                                   Diagnostic why);
/// As `unsupported`: an outline that crosses itself.
tl::unexpected<Diagnostic> crossed(const Model& m, AnyRef feature, const std::string& what,
                                   geometry::Vec2 at);
tl::unexpected<Diagnostic> unsupported(const Model& m, AnyRef feature, const std::string& what);

}  // namespace capstan::model::shape
