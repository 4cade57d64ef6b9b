#pragma once

#include <map>
#include <string>
#include <string_view>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// The reason, in the ledger, of faces of a CAD part that no feature makes: nothing is planned for them, and
/// a plan that holds some is not complete.
inline constexpr std::string_view kNotRecognised = "recognise.none";

/// Records why a feature, or a region that stands for faces, is not planned.
void set_not_recognised(Plan& plan, AnyRef feature, std::string why);
/// Those of a plan, each with the reason.
[[nodiscard]] std::map<AnyRef, std::string> not_recognised(const Plan& plan);

}  // namespace capstan::model
