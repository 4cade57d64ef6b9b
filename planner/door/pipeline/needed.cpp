#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/checked.h"
#include "planner/door/pipeline/trial.h"
#include "planner/model/plan/corner_rest.h"
#include "planner/model/plan/needed_tool.h"
#include "tooling/library/formats/own/own_list.h"

// Which tools a shop has to buy or load so that all of a part is planned. That a cutter has the size and the
// reach that a step asks for does not say that it stands the cut: a slender one bends. So the part is planned
// once more with the tools as they are named, and checked where plans are; those of features that fail then,
// or keep rest material in their corners, are named no more. A second proof is that of the tools that are
// left.

namespace capstan::pipeline {
namespace {

using model::NeededKind;
using model::NeededTool;

constexpr int kMostProofs = 2;  // each is a planning; default, unsourced

/// The tools as one reads them who adds the entries of the plan to his list.
Result<std::vector<model::Cutter>> as_read(const std::vector<NeededKind>& kinds) {
  std::string list = "capstan_tools: 1\nunit: mm\nsource: \"needed tools of a plan\"\ntools:\n";
  for (const NeededKind& k : kinds) list += "  - " + model::list_entry(k.cutter) + "\n";
  Job unsaid;
  return tooling::read_own_list(list, "needed tools", unsaid);
}

bool is_planned(const model::Plan& plan, model::AnyRef feature) {
  return std::none_of(plan.unplanned.begin(), plan.unplanned.end(),
                      [&](const model::Unplanned& u) { return u.feature == feature; });
}

bool keeps_rest(const NeededTool& tool, const model::Plan& with) {
  return model::corner_rest_of(with, tool.feature_name).has_value();
}

/// Whether the tool makes its feature: one that leaves rest material in its corners does not make it as it is
/// stated.
bool helps(const NeededTool& tool, const model::Plan& with) {
  return is_planned(with, tool.feature) && !keeps_rest(tool, with);
}

/// `unproved`: why they are not proved; empty: they are, or `to` is of no proof.
void tell(model::Plan& made, const std::vector<NeededKind>& kinds, const std::string& to,
          const std::string& unproved, Job& job) {
  std::string all;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    made.provenance.push_back(model::provenance_of(kinds[i], i + 1));
    all += (all.empty() ? "" : "; ") + model::text_of(kinds[i]);
  }
  if (all.empty()) return;
  job.report({.code = "PIP-TOOLS-NEEDED",
              .severity = Severity::kWarning,
              .message = to + all + (unproved.empty() ? "" : " (not proved: " + unproved + ")"),
              .file = made.file_name,
              .hint = "the plan holds them as entries for a list of tools (--tools): capstan explain"});
}

}  // namespace

Result<model::Plan> name_needed(model::Plan made, std::vector<NeededTool> needed, const Inputs& inputs,
                                const Policy& policy, const Planner& planner, Job& job) {
  auto kinds = model::needed_kinds(made, needed);
  if (policy.bind != Bind::kAll || policy.window || policy.only_loaded_cutters || job.deadline() ||
      is_edited(inputs)) {
    tell(made, kinds, "to plan all of this part you need at least: ", "", job);
    return made;
  }
  bool all = false, dropped = false, rests = false;
  std::string unproved;
  for (int proofs = 0; !kinds.empty(); ++proofs) {
    if (proofs == kMostProofs) {
      unproved = "each planning with what was named showed tools that do not help";
      break;
    }
    const auto cutters = as_read(kinds);
    if (!cutters) {
      unproved = "they cannot be read back as a list: " + cutters.error().message;
      break;
    }
    Inputs richer = inputs;
    richer.library.insert(richer.library.end(), cutters->begin(), cutters->end());
    Job trial;
    begin_trial(trial, job);
    const auto with = planner(richer, trial);
    if (job.stop_requested()) return tl::unexpected(stopped_planning(made));
    if (!with) {
      unproved = "planning with them fails: " + with.error().message;
      break;
    }
    all = with->unplanned.empty();
    const std::size_t before = needed.size();
    rests = rests || std::any_of(needed.begin(), needed.end(),
                                 [&](const NeededTool& n) { return keeps_rest(n, *with); });
    std::erase_if(needed, [&](const NeededTool& n) { return !helps(n, *with); });
    if (needed.size() == before) break;
    all = false;
    dropped = true;
    kinds = model::needed_kinds(made, needed);
  }
  const std::string what = (all && !rests) || (!unproved.empty() && !dropped) ? "all" : "more";
  tell(made, kinds, "to plan " + what + " of this part you need" + (unproved.empty() ? ": " : " at least: "),
       unproved, job);
  return made;
}

}  // namespace capstan::pipeline
