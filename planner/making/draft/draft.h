#pragma once

#include <compare>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/geometry/placement.h"
#include "planner/making/draft/candidates.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/edit/restrictions.h"
#include "planner/model/plan/proposal.h"
#include "planner/model/plan/resources/workholding.h"

namespace capstan::draft {

using model::AnyRef;
using model::Ref;

/// One clamping while it is planned.
struct SetupDraft {
  Ref<model::Setup> setup;
  geometry::Placement workpiece;  ///< the workpiece's frame in the set-up's
  double security_z_mm = 0.0;
  geometry::Box3 stock;  ///< of the raw piece, set-up frame
  model::Workholding holding = {};
};

/// The subject of one chain of steps: a simple feature, or one member of a pattern or compound.
struct Member {
  AnyRef feature;  ///< as the workingsteps name it
  AnyRef part;     ///< the noun that the member's shape came from
  int number = 0;
  friend auto operator<=>(const Member&, const Member&) = default;
};

/// A measurement that a chain wants before one of its steps.
struct ProbingDraft {
  std::vector<model::ProposedStep> chain;  ///< whole
  std::size_t at = 0;                      ///< of the measuring step in it
  std::optional<model::Candidate> probe;   ///< unset: by hand
};

/// One workingstep while it is planned.
struct StepDraft {
  Ref<model::Executable> step;
  AnyRef feature;    ///< unset for a rapid movement
  AnyRef operation;  ///< unset for a rapid movement
  std::size_t setup = 0;
  std::vector<model::FeatureShape> shapes;  ///< workpiece coordinates; more than one for patterns
  std::string no_shape;                     ///< why `shapes` is empty
  model::Cutter cutter;
  bool proposed = false;           ///< made by rules in this run
  Member member = {};              ///< when proposed: what its chain is for,
  std::string chain = {};          ///< which chain that is (key_of),
  std::size_t in_chain = 0;        ///< and its place in it
  model::ProposedStep proposal;    ///< when proposed
  double start_in_chain_mm = 0.0;  ///< of its proposal, before the drill ahead of it was known
  Candidates candidates;           ///< when the cutter was selected in this run, best first
  std::vector<model::Rejected> rejected_tools;
  bool open_technology = false;  ///< feed or speed to be chosen
  bool keep_speed = false;       ///< of an open technology: the stated speed stays, the feed is chosen for it
  bool keep_feed = false;        ///< the other way round
  bool open_tool = false;
  /// Of a try at its path: passes of constant engagement, or rings; unset: as its strategy says.
  std::optional<bool> constant_engagement = {};
  /// Of a try at its path: rings from the wall inwards, or outwards; unset: as its strategy says.
  std::optional<bool> inwards = {};
  std::vector<std::size_t> after;            ///< indices of the steps that must come before; chain order
  std::string unreadable = {};               ///< what its file states wrongly of it or its feature: not made
  model::EditLimits limits = {};             ///< of the operator, on its feed and speed
  std::optional<ProbingDraft> probing = {};  ///< measured right before this step, if it can be
};

/// The name of a chain among those of a member: its row and which of the row's alternatives it is.
[[nodiscard]] std::string key_of(const std::vector<model::ProposedStep>& chain);

/// The name that messages call a step by.
[[nodiscard]] std::string name_of(const model::Model& m, const StepDraft& step);

/// What patterns of edits may call it by. Refers to the model's and the step's texts.
[[nodiscard]] model::StepNames edit_names(const model::Model& m, const StepDraft& step);
/// The name of a feature; empty: it has none.
[[nodiscard]] std::string_view feature_name(const model::Model& m, AnyRef feature);

/// The cutters that steps and the measurements before them use, each once.
[[nodiscard]] std::vector<std::string> cutters_of(const std::vector<StepDraft>& steps);

/// Whether a step finishes walls and level floors of a surface by an end mill.
[[nodiscard]] bool cuts_levels(const model::Model& m, const StepDraft& step);

}  // namespace capstan::draft
