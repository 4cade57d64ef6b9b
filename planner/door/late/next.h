#pragma once

#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// Which workingsteps are bound now.
struct Next {
  std::size_t count = 1;
  /// The first of them, counted from 1 in the order in which the workplan has them; those before are cut, as
  /// the plan has them. Nothing: the first of which something is open; where nothing is, the first of all.
  std::optional<std::size_t> from = std::nullopt;
};

/// The steps that are meant, of those that the plan executes (given::steps_in_order): no more than there are.
/// Fails  LATE-NEXT where there is no such step, or one before it was not bound.
[[nodiscard]] Result<pipeline::Window> window_of(const model::Plan& plan, const Next& next,
                                                 const std::vector<model::AnyRef>& steps);
/// Whether nothing is bound yet, and a feature has no operation.
[[nodiscard]] bool operations_open(const model::Plan& plan, const std::vector<model::AnyRef>& steps);
/// The operations of steps that are meant.
[[nodiscard]] std::set<model::AnyRef> operations_of(const model::Plan& plan, const pipeline::Window& window,
                                                    const std::vector<model::AnyRef>& steps);

/// Behind the name of a cutter that was another when it cut.
inline constexpr std::string_view kAsCut = " as cut";

/// The whole plan of which some steps were bound: the steps before as they were cut, these, and what
/// `brought` has of those after them. A cutter that was another when it cut keeps its sizes under a name of
/// its own, out of the magazine.
[[nodiscard]] model::Plan joined(const model::Plan& brought, const model::Plan& bound,
                                 const pipeline::Window& window);

}  // namespace capstan::late
