#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/late/next.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

// A plan of which the first workingsteps are bound, and a program of some of these.

/// Whether the k-th result is that of the k-th of the steps that the plan executes, whole.
[[nodiscard]] bool has_result(const model::Plan& plan, std::size_t k,
                              const std::vector<model::AnyRef>& steps);
/// Whether a workingstep leaves anything open that binding closes: its operation, tool, path, feed or speed.
[[nodiscard]] bool is_open(const model::Plan& plan, model::AnyRef step);

/// Refuses to go on behind steps that somebody edited in the plan since they were bound: they were cut as the
/// plan had them then, or the plan is not the one that is cut. model::fresh_edits says what.
/// Fails  LATE-EDITED, with the first such step and the attribute.
[[nodiscard]] Status cut_as_bound(const model::Plan& plan, const Next& next, const pipeline::Window& window,
                                  const std::vector<model::AnyRef>& steps);

/// The workingsteps that are left open behind the bound ones, in the order of the workplan. Empty where all
/// are bound, where none is, and where one of the others has nothing open: that is missing, not to come.
[[nodiscard]] std::vector<model::AnyRef> unbound_steps(const model::Plan& plan);

/// That a check says nothing of these: a finding that nothing is proven there (Finding::unproved).
[[nodiscard]] model::Finding not_bound(const model::Plan& plan, const std::vector<model::AnyRef>& steps);

/// The workingsteps of a plan that a program has, as a plan, and how many were cut before them.
struct PartOfPlan {
  model::Plan plan;
  std::size_t before = 0;
};
/// By the ids of the program's steps in its order. Nothing where they are not steps of the plan one after the
/// other.
[[nodiscard]] std::optional<PartOfPlan> part_of(const model::Plan& plan, const std::vector<std::string>& ids);

/// That a check takes what comes before the program's steps as cut: a note.
[[nodiscard]] model::Finding taken_as_cut(const PartOfPlan& part);

}  // namespace capstan::late
