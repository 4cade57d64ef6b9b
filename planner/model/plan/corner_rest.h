#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// Rest material that a plan leaves in the inside corners of a feature, because no mill that there is makes
/// them as they are stated. It stands in the plan's provenance, which every form of a plan keeps: the check
/// reads it there, and a later binding keeps it.
struct CornerRest {
  std::string feature;     ///< name of its shape: its_id, with "[n]" for members
  double stated_mm = 0.0;  ///< radius that the file states, or that may stay where it states none; 0: sharp
  double radius_mm = 0.0;  ///< radius that stays
  std::string why;
};

/// Those of a plan, in the order of its provenance.
[[nodiscard]] std::vector<CornerRest> corner_rests(const Plan& plan);
/// That of one shape; nothing where its corners are made as they are stated.
[[nodiscard]] std::optional<CornerRest> corner_rest_of(const Plan& plan, std::string_view feature);
/// The row of provenance that says it.
[[nodiscard]] Provenance provenance_of(const CornerRest& r);
/// What a row of provenance says, if it is such a one.
[[nodiscard]] std::optional<CornerRest> corner_rest(const Provenance& p);

}  // namespace capstan::model
