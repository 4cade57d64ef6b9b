#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/model/features/shape.h"
#include "planner/proof/verify/volumes/reading.h"

namespace capstan::verify {

/// How the planner reads one feature.
struct PlannersReading {
  model::AnyRef feature;
  std::vector<model::FeatureShape> shapes;
};
/// Of all features that the planner can read, or of some of them.
[[nodiscard]] std::vector<PlannersReading> planners_readings(const model::Model& m,
                                                             const std::set<model::AnyRef>* of = nullptr);

}  // namespace capstan::verify

namespace capstan::verify::volumes {

/// Two readings that differ by less are one, mm: the planner's areas stray by 0.001 from the arcs they stand
/// for, its mills are taken as 0.005 narrower where they would leave nothing of a passage, and the ends of
/// two curves may be 0.01 apart (model/features). Twice that is looked at on either side of a surface.
inline constexpr double kAgreeMm = 0.01;

/// A place of the workpiece at which the planner's shapes and the own reading differ.
struct Disagreement {
  geometry::Vec3 at;
  bool removed = false;  ///< by the own reading; the planner's says the opposite
  std::string own;       ///< the solid that is nearest, in words
  std::string theirs;    ///< the shape that is nearest
  std::string what;      ///< of sizes that are no volume: what differs, in place of all above
};

/// The first place at which a feature's shapes, as the planner reads them, and its own reading differ by more
/// than `kAgreeMm` in every direction; looked for at both sides of the own surfaces, on grids through both,
/// and only within `raw` (empty: everywhere).
[[nodiscard]] std::optional<Disagreement> disagreement(const Reading& own,
                                                       const std::vector<model::FeatureShape>& planner,
                                                       const geometry::Box3& raw);

/// Whether a shape of the planner's takes a place of the workpiece away, as the checks use it: from its top
/// down to `floor_at`; what heights do not hold (slots under a narrower mouth, holes that widen) by its
/// section.
[[nodiscard]] bool removes(const model::FeatureShape& shape, geometry::Vec3 p);

}  // namespace capstan::verify::volumes
