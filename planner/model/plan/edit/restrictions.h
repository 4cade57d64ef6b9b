#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/nouns/forward.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/decision/decision.h"
#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/proposal.h"

// What edits leave to choose from: limits and what is ruled out.

namespace capstan::model {

/// The names of a step that a pattern may mean: its feature's, its own, its persistent id. Empty: it has
/// none.
struct StepNames {
  std::string_view feature, step, id = {};
};
[[nodiscard]] bool names(std::string_view pattern, const StepNames& step);

/// The reason, in the ledger and among rejected alternatives, of what an edit decided.
inline constexpr std::string_view kByEdit = "edit";
[[nodiscard]] Reason reason_of(const Edit& e);

/// The edit that keeps a cutter from a step, and the number that it breaks; null: none does.
struct Barred {
  const Edit* edit = nullptr;
  std::string why;  ///< "edit 1 of --limit ...: tool.diameter 10 mm, at most 8 mm"
};
[[nodiscard]] std::optional<Barred> barred(const std::vector<Edit>& edits, const StepNames& step,
                                           const Cutter& cutter);
/// Those of `all` that no edit keeps from a step; `why` gets the reasons against the others of the wanted
/// classes, at most kMostBarred. Gives `all` itself where no edit is about tools, else `kept`.
inline constexpr std::size_t kMostBarred = 12;
[[nodiscard]] const std::vector<Cutter>& allowed(const std::vector<Edit>& edits, const StepNames& step,
                                                 const std::vector<Cutter>& all,
                                                 const std::vector<CutterClass>& classes,
                                                 std::vector<Cutter>& kept, std::vector<Rejected>& why);
/// The same of the kind of operation, and of a strategy by its keyword: "contour_parallel".
[[nodiscard]] std::optional<Barred> barred_operation(const std::vector<Edit>& edits, const StepNames& step,
                                                     TypeId operation);
[[nodiscard]] std::optional<Barred> barred_strategy(const std::vector<Edit>& edits, const StepNames& step,
                                                    std::string_view strategy);
[[nodiscard]] std::string_view word_of(StrategyKind kind);
/// The word of passes of constant engagement, which no noun names.
inline constexpr std::string_view kConstantEngagementWord = "constant_engagement";

/// Bounds on the numbers of one step, by edits; unset: none.
struct EditLimits {
  std::optional<double> feed_mm_min, speed_rpm;
  std::string feed_by, speed_by;  ///< who says so, for reasons
  [[nodiscard]] bool any() const { return feed_mm_min || speed_rpm; }
  /// "edit 1 of x.edits.yaml: limit feed<=2000; ...".
  [[nodiscard]] std::string words() const;
};
[[nodiscard]] EditLimits limits_of(const std::vector<Edit>& edits, const StepNames& step);

}  // namespace capstan::model
