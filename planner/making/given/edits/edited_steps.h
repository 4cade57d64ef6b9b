#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"

// The workingsteps of a plan as edits are about them, and what of them edits may be about.

namespace capstan::given {

inline constexpr const char* kToolAttribute = "its_tool";
inline constexpr const char* kDepthAttribute = "axial_cutting_depth";

/// The workingsteps that have an operation, as drafts - step, feature, operation -, in the order in which
/// they are executed, but for the first `cut` that the plan executes, whatever these are: they are cut.
[[nodiscard]] std::vector<draft::StepDraft> edited_steps(const model::Plan& plan, std::size_t cut = 0);

/// The depth of its levels, mm, of an operation that mills in levels; null: another one.
[[nodiscard]] model::Real* depth_of(model::Model& m, model::AnyRef operation);
[[nodiscard]] const model::Real* depth_of(const model::Model& m, model::AnyRef operation);
/// "contour_parallel", kConstantEngagementWord; empty: none.
[[nodiscard]] std::string_view strategy_word(const model::Model& m, model::AnyRef operation);
[[nodiscard]] model::AnyRef technology_of(const model::Model& m, model::AnyRef operation);
/// The cutter of a step, as its nouns or the plan say; nothing: it is open.
[[nodiscard]] std::optional<model::Cutter> cutter_of(const model::Plan& plan, model::AnyRef operation,
                                                     const std::vector<model::Cutter>& library);

/// "step 'SLOT area_rough'".
[[nodiscard]] std::string called(const model::Model& m, const draft::StepDraft& s);
/// EDIT-CONFLICT: two edits that cannot both hold.
[[nodiscard]] Diagnostic conflict(const model::Plan& plan, const std::string& what);

}  // namespace capstan::given
