#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "planner/ground/vocabulary/shape_kind.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/proof/verify/volumes/nouns.h"
#include "planner/proof/verify/volumes/solid.h"

namespace capstan::verify::volumes {

/// What a feature takes away, by the check's own reading of the file's text.
struct Reading {
  std::vector<Solid> solids;  ///< workpiece coordinates; one for each element and member
  std::string unread;         ///< why it was not read; empty: it was
  bool nothing = false;       ///< it has no volume of its own: surfaces, and features that are paths

  /// What is said of a place of the workpiece: removed by one of the solids, else not said by one, else it
  /// stays.
  [[nodiscard]] PointState at(geometry::Vec3 p) const;
};

/// What readings need of a file, worked out once.
struct Source {
  const model::Model& m;
  geometry::Box3 raw;                                      ///< the raw piece, workpiece coordinates
  std::map<model::AnyRef, std::vector<model::AnyRef>> in;  ///< compounds, patterns (and, of bosses, others)
  std::vector<Solid> bosses;                               ///< all that stand, wherever they are put
};
[[nodiscard]] Source source_of(const model::Model& m, const geometry::Box3& raw);

/// A feature wherever its compounds and patterns put it, with the bosses in it left standing.
[[nodiscard]] Reading read(const Source& source, model::AnyRef feature);

/// Places at both sides of all surfaces of a solid, twice a tolerance away, and within it; workpiece
/// coordinates.
[[nodiscard]] std::vector<geometry::Vec3> places_of(const Solid& s, double tolerance_mm);

/// Features that are parts of others: elements of compounds, bases of patterns, bosses that others list.
[[nodiscard]] std::set<model::AnyRef> parts_of_others(const model::Model& m);

// What follows is shared by the files of this folder only.

/// A simple feature in the coordinates that it is stated in.
[[nodiscard]] Reading simple(const Source& source, model::AnyRef feature);
/// A noun that the own reading makes a solid of, and of what is derived from it: what kind of removal it is,
/// and what reads it, its frame and depth read already. A copy on purpose: what the planner's list forgets
/// must be found.
struct ReadingRow {
  model::TypeId noun;
  model::ShapeKind kind;
  Reading (*read)(const Source& source, model::AnyRef feature, Solid solid);
};
/// Of all files of noun/: NAME.cpp gives its own by `std::vector<ReadingRow> NAME_readings()`, which the
/// build finds by the file's name (planner/proof/verify/CMakeLists.txt).
[[nodiscard]] std::vector<std::vector<ReadingRow>> readings();
/// The row of the noun nearest above the feature's own; null: this reading does not know it.
[[nodiscard]] const ReadingRow* reading_of(model::AnyRef feature);
/// A feature in the coordinates of the workpiece, whatever lists it; and wherever its holders put it.
[[nodiscard]] Reading placed_in(const Source& source, model::AnyRef feature);
[[nodiscard]] Reading wherever(const Source& source, model::AnyRef feature);
/// A broken edge of what it is on, and a thread in it: in the same place.
[[nodiscard]] Reading on_others(const Source& source, model::AnyRef feature, Reading others);

[[nodiscard]] inline Reading unread(std::string why) { return {{}, std::move(why), false}; }

/// An open line in the plane of a feature: of an open profile, or of a path of travel.
[[nodiscard]] Course line_of(const model::Model& m, model::AnyRef profile_or_path);

}  // namespace capstan::verify::volumes
