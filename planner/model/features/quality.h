#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

namespace capstan::model {

/// What a part asks of a feature beyond its sizes: surface texture and geometric tolerances, in mm (zones as
/// stated: the diameter of a round zone, the width of any other). Unset: not asked.
struct Quality {
  std::optional<double> ra_um;
  std::optional<double> form_mm;         ///< tightest of flatness, straightness, roundness, cylindricity
  std::optional<double> orientation_mm;  ///< parallelism, perpendicularity, angularity
  std::optional<double> location_mm;     ///< position, concentricity, coaxiality, symmetry
  std::optional<double> runout_mm;
  std::optional<double> profile_mm;  ///< of a line or a surface
  std::vector<std::string> datums;   ///< letters that it refers to, primary first
  std::vector<std::string> texts;    ///< each as a person would read it: "position 0.05 | A | B"
};

/// The tolerances and textures whose faces, dimensions or shape elements belong to this feature.
[[nodiscard]] Quality quality_of(const Model& model, Ref<ManufacturingFeature> feature);

}  // namespace capstan::model
