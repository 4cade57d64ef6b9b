#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/files/exchange/brep/brep.h"
#include "planner/model/plan/plan.h"

namespace capstan::from_cad {

/// A feature of the plan, and the faces of the part that it makes.
struct MadeOf {
  model::AnyRef feature;
  std::vector<std::uint32_t> faces;  ///< into Brep::faces, ascending
};

/// What became of the tolerances and textures that a CAD file states.
struct Attached {
  std::size_t stated = 0;         ///< sizes with a tolerance, geometric tolerances, textures
  std::size_t attached = 0;       ///< of these: on the features of all their faces, or on the whole part
  std::vector<std::string> lost;  ///< the others, each with `#id` and why, and which faces are without it
};

/// Makes nouns of what a CAD file asks of its shape (Brep::pmi) and ties them to the features of a plan.
///
/// Sizes      the tolerance goes to the size of a feature's noun that has the stated nominal value:
///            diameters, radii, widths and lengths of profiles. Where several have it, to the one that the
///            normals or the axes of the faces allow; to none where these allow several. Depths are planes in
///            ISO 14649, which have none.
/// Zones      geometric tolerances, with datums, of the features that make the faces.
/// Textures   of the machined surfaces that the faces are, bottom or side.
/// Left out   what names faces that no feature makes; it is in `lost`, also where the other faces got it.
/// Source     ISO 14649-10 (sizes, textures), ISO 10303-238 (tolerances, datums).
[[nodiscard]] Attached attach_requirements(const exchange::Brep& brep, const std::vector<MadeOf>& made,
                                           model::Ref<model::Workpiece> piece, model::Plan& plan);

}  // namespace capstan::from_cad
