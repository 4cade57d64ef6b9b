#include "planner/making/given/magazine.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "planner/ground/base/number.h"
#include "planner/making/draft/draft.h"
#include "planner/making/step/path/job_of.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/model/plan/cutter/measured_length.h"
#include "planner/model/plan/cutter/sized_name.h"
#include "planner/model/plan/cutter/table_offsets.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/library/nouns/tool_material.h"
#include "tooling/library/words/comment_words.h"

// Compares the tools of the plan with those loaded in the magazine.

namespace capstan::given {
namespace {

using model::AnyRef;
using model::Cutter;

constexpr double kSameAngle = 0.01;  // rad, about half a degree

/// A name says nothing: every size that both know has to agree, and what a thread is has to be known.
bool same_tool(const Cutter& a, const Cutter& b) {
  const auto near = [](double x, double y, double by) { return std::abs(x - y) <= by; };
  const auto near_if_known = [&](double x, double y, double by) {
    return x == 0.0 || y == 0.0 || near(x, y, by);
  };
  return a.cutter_class == b.cutter_class && a.hand == b.hand &&
         near(a.cutting_diameter_mm, b.cutting_diameter_mm, model::kSameDiameterMm) &&
         near(a.corner_radius_mm, b.corner_radius_mm, model::kSameDiameterMm) &&
         near(a.thread_pitch_mm, b.thread_pitch_mm, 1e-6) &&
         near_if_known(a.point_angle_rad, b.point_angle_rad, kSameAngle) &&
         near_if_known(a.tip_diameter_mm, b.tip_diameter_mm, model::kSameDiameterMm);
}

/// Whether a loaded tool states a field: its library does; of a line of a tool table, its comment.
bool states(const Cutter& loaded, std::string_view field) {
  const std::string* source = tooling::source_of(loaded, field);
  if (loaded.table_line)
    return source != nullptr && (source->starts_with("stated") || source->ends_with(tooling::kOfComment));
  return source == nullptr || source->starts_with("stated");
}

/// True if the loaded tool can replace the planned one. A value of a library counts only if the library
/// states it and it is no default; of a line of a tool table the values in its comment count.
bool does_as_much(const Cutter& loaded, const Cutter& planned) {
  constexpr double kRoom = 0.01;  // mm and 1/min: rounding of what is written
  const auto says = [&](std::string_view field) { return states(loaded, field); };
  const auto less = [&](std::string_view field, double has, double wants) {
    return says(field) && has > 0.0 && wants > 0.0 && has < wants - kRoom;
  };
  const auto more = [&](std::string_view field, double has, double wants) {
    return says(field) && has > 0.0 && wants > 0.0 && has > wants + kRoom;
  };
  // A plan that assumes HSS, the slower one, is no plan against carbide.
  const std::string* assumed = tooling::source_of(planned, "substrate");
  const bool slower_assumed =
      assumed != nullptr && assumed->starts_with("default") && planned.substrate == model::Substrate::kHss;
  if (says("substrate") && loaded.substrate != planned.substrate && !slower_assumed) return false;
  if (says("teeth") && loaded.teeth > 0 && planned.teeth > 0 && loaded.teeth != planned.teeth) return false;
  if (loaded.table_line) return true;  // its lengths are taken as they are measured
  if (says("centre_cutting") && planned.centre_cutting && !loaded.centre_cutting) return false;
  const bool slower =
      loaded.maximum_speed_rpm > 0.0 && says("maximum_speed_rpm") &&
      (planned.maximum_speed_rpm == 0.0 || loaded.maximum_speed_rpm < planned.maximum_speed_rpm);
  const bool worn = loaded.life_min > 0.0 && loaded.life_used_min >= loaded.life_min;
  return !slower && !worn &&
         !less("maximum_depth_of_cut_mm", loaded.maximum_depth_of_cut_mm, planned.maximum_depth_of_cut_mm) &&
         !less("usable_length_mm", loaded.usable_length_mm, planned.usable_length_mm) &&
         !less("maximum_ramp_angle_rad", loaded.maximum_ramp_angle_rad, planned.maximum_ramp_angle_rad) &&
         !less("neck_diameter_mm", loaded.neck_diameter_mm, planned.neck_diameter_mm) &&
         !more("neck_length_mm", loaded.neck_length_mm, planned.neck_length_mm) &&
         !more("stick_out_mm", loaded.stick_out_mm, planned.stick_out_mm) &&
         !more("shank_diameter_mm", loaded.shank_diameter_mm, planned.shank_diameter_mm);
}

/// Whether a tool is the planned one as it may measure after wear or a regrind: by all but its diameter,
/// which is near.
bool as_worn(const Cutter& c, const Cutter& planned) {
  constexpr double kWorn = 0.05;        // of the diameter: what regrinding takes. Default, unsourced.
  constexpr double kMeasuredMm = 0.05;  // larger by runout. Default, unsourced.
  const double less = planned.cutting_diameter_mm - c.cutting_diameter_mm;
  Cutter as_planned = c;
  as_planned.cutting_diameter_mm = planned.cutting_diameter_mm;
  return less <= kWorn * planned.cutting_diameter_mm && less >= -kMeasuredMm &&
         same_tool(as_planned, planned);
}

/// The planned tool as it is loaded under its number, smaller by wear or a regrind, if one is: a mill whose
/// path the measured diameter offsets. Holes have the size of their drill, so that another one is another
/// tool.
const Cutter* worn(const std::vector<Cutter>& library, const Cutter& planned) {
  const bool mill = model::has(planned.cutter_class, model::CutterTrait::kEndMill) ||
                    planned.cutter_class == model::CutterClass::kFacemill;
  if (planned.pocket <= 0 || !mill) return nullptr;
  for (const Cutter& c : library) {
    const std::string* source = tooling::source_of(c, "cutting_diameter_mm");
    const bool measured = c.table_line || (source != nullptr && *source == kLessWear);
    if (!c.loaded || !measured || c.pocket != planned.pocket) continue;
    if (as_worn(c, planned) && does_as_much(c, planned) && model::offset_fault(c).empty()) return &c;
  }
  return nullptr;
}

/// What the plan took a tool to be whose file does not say it: its speeds are for that.
void take_assumed(const std::vector<model::AssumedToolMaterial>& assumed, Cutter& c) {
  if (!tooling::material_is_assumed(c)) return;
  for (const model::AssumedToolMaterial& a : assumed) {
    if (a.tool == c.id) c.substrate = a.substrate;
  }
}

/// What the loaded tool states is no assumption any more.
void state_material(const Cutter& loaded, Cutter& c) {
  for (auto& [field, source] : c.sources) {
    if (field == "substrate") source = "stated: of the loaded tool T" + std::to_string(loaded.pocket);
  }
}

/// Whether the path of an operation is its file's, for the planned diameter.
bool fixed_by_its_path(const model::Plan& plan, AnyRef operation) {
  draft::StepDraft step;
  step.operation = operation;
  return step::has_given_path(plan, step);
}

/// The plan's operations that a workingstep executes. A feature may list more: those of steps that were left
/// out, whose tools nobody calls. Where there is no workingstep yet, all.
std::vector<AnyRef> executed_operations(const model::Plan& plan) {
  const std::vector<AnyRef> roots = {plan.project};
  const std::vector<AnyRef> all = model::reachable(plan.model, roots);
  std::set<AnyRef> executed;
  for (const AnyRef r : all) {
    if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(r);
        ws != nullptr && ws->its_operation.set())
      executed.insert(ws->its_operation);
  }
  std::vector<AnyRef> out;
  for (const AnyRef r : all) {
    const bool operation = plan.model.get<model::MachiningOperation>(r) != nullptr;
    if (operation && (executed.empty() || executed.contains(r))) out.push_back(r);
  }
  return out;
}

/// How a planned tool is missing: not there, or of another size by the wear that is told of it.
std::string missing_as(const std::vector<Cutter>& library, const Cutter& planned) {
  for (const Cutter& c : library) {
    const std::string* source = tooling::source_of(c, "cutting_diameter_mm");
    if (!c.loaded || c.pocket != planned.pocket || c.cutter_class != planned.cutter_class) continue;
    if (source != nullptr && *source == kLessWear)
      return "is worn to " + trimmed(c.cutting_diameter_mm, 3) + " mm as T" + std::to_string(c.pocket);
  }
  return "is not in the magazine";
}

}  // namespace

const Cutter* loaded_like(const std::vector<Cutter>& library, const Cutter& wanted) {
  const Cutter* found = nullptr;
  for (const Cutter& c : library) {
    if (!c.loaded || c.pocket <= 0 || !same_tool(c, wanted) || !does_as_much(c, wanted)) continue;
    // One that is measured first; of these the wanted one itself by name, then by number; then the lowest
    // number.
    const auto rank = [&](const Cutter& x) {
      return std::tuple(!model::offset_fault(x).empty(), x.id != wanted.id, x.pocket != wanted.pocket,
                        x.pocket);
    };
    if (found == nullptr || rank(c) < rank(*found)) found = &c;
  }
  return found;
}

std::vector<const Cutter*> sisters_of(const std::vector<Cutter>& library, const Cutter& wanted) {
  std::vector<const Cutter*> out;
  for (const Cutter& c : library) {
    if (c.loaded && c.pocket > 0 && c.pocket != wanted.pocket && same_tool(c, wanted) &&
        does_as_much(c, wanted) && model::offset_fault(c).empty())
      out.push_back(&c);
  }
  std::sort(out.begin(), out.end(), [](const Cutter* a, const Cutter* b) { return a->pocket < b->pocket; });
  return out;
}

std::optional<std::string> out_of_use(const std::vector<OutOfUse>& tools, const Cutter& planned) {
  const OutOfUse* found = nullptr;
  for (const OutOfUse& o : tools) {
    const bool same_number = o.tool.pocket == planned.pocket;
    // Wear that is told of it changes its size, and not which tool it is.
    const bool is = same_tool(o.tool, planned) || (same_number && as_worn(o.tool, planned));
    if (is && (found == nullptr || same_number)) found = &o;
  }
  if (found == nullptr) return std::nullopt;
  return "is T" + std::to_string(found->tool.pocket) + ", which " + found->why;
}

const Cutter* stating_material(const std::vector<Cutter>& library, const Cutter& wanted) {
  const Cutter* found = nullptr;
  bool differ = false;
  for (const Cutter& c : library) {
    if (c.pocket <= 0 || !same_tool(c, wanted) || !states(c, "substrate")) continue;
    if (c.id == wanted.id) return &c;
    if (found != nullptr) differ = differ || found->substrate != c.substrate;
    if (found == nullptr) found = &c;
  }
  return differ ? nullptr : found;
}

std::optional<std::string> missing_tool(const model::Plan& plan, AnyRef operation,
                                        const std::vector<Cutter>& library) {
  const auto* op = plan.model.get<model::MachiningOperation>(operation);
  if (op == nullptr || !plan.model.holds<model::MachiningTool>(op->its_tool) ||
      tooling::is_requirement(plan.model, op->its_tool) || plan.ledger.is_open(operation, "its_tool"))
    return std::nullopt;
  Job silent;  // what is to be said of the tool is said when it is used
  auto wanted = tooling::cutter_from_nouns(plan.model, op->its_tool, silent, plan.cutters);
  if (wanted) take_assumed(model::assumed_tool_materials(plan), *wanted);
  if (!wanted || loaded_like(library, *wanted) != nullptr) return std::nullopt;
  return wanted->id;
}

void give_tool(model::Plan& plan, AnyRef operation, const Cutter& tool, model::Reason why,
               std::vector<model::Rejected> instead_of) {
  if (model::find_cutter(plan, tool.id) == nullptr) plan.cutters.push_back(tool);
  const auto noun = tooling::tool_noun(plan.model, tool);
  plan.model.get<model::MachiningOperation>(operation)->its_tool = noun;
  const model::Decision* d = plan.ledger.find(operation, "its_tool");
  std::vector<model::DecisionKey> needs = d == nullptr ? std::vector<model::DecisionKey>{} : d->depends_on;
  plan.ledger.bind(operation, "its_tool", model::Binder::kToolSelection, std::move(why), std::move(needs),
                   std::move(instead_of));
}

void take_length(const Cutter& loaded, Cutter& into) {
  if (loaded.table_line) return model::take_table_line(into, *loaded.table_line);
  if (!(loaded.functional_length_mm > 0.0)) return;
  if (loaded.functional_length_mm == into.functional_length_mm) return;
  model::take_measured_length(into, loaded.functional_length_mm, "derived: as long as the loaded tool");
}

Result<Matched> match_loaded(const model::Plan& plan, std::vector<Cutter>& library, Job& job,
                             const std::set<AnyRef>* of, const std::vector<OutOfUse>& gone) {
  const auto assumed = model::assumed_tool_materials(plan);
  Matched out;
  std::vector<Cutter> merged;
  std::set<std::string> seen;
  const std::vector<AnyRef> all =
      of != nullptr ? std::vector<AnyRef>(of->begin(), of->end()) : executed_operations(plan);
  for (const AnyRef r : all) {
    const auto* op = plan.model.get<model::MachiningOperation>(r);
    if (op == nullptr || !plan.model.holds<model::MachiningTool>(op->its_tool)) continue;
    if (tooling::is_requirement(plan.model, op->its_tool)) continue;
    auto wanted = tooling::cutter_from_nouns(plan.model, op->its_tool, job, plan.cutters);
    if (!wanted) return tl::unexpected(wanted.error());
    take_assumed(assumed, *wanted);
    const Cutter* there = loaded_like(library, *wanted);
    const bool has_worn = there == nullptr && (there = worn(library, *wanted)) != nullptr;
    // The table knows pocket and sizes; class, flutes and tool material are the plan's.
    const auto as_loaded = [&] {
      Cutter c = *wanted;
      c.pocket = there->pocket;
      c.loaded = true;
      if (has_worn) {
        c.cutting_diameter_mm = there->cutting_diameter_mm;
        c.id = model::name_with_size(wanted->id, c.cutting_diameter_mm);
      }
      if (there->substrate == c.substrate && states(*there, "substrate")) state_material(*there, c);
      take_length(*there, c);
      return c;
    };
    if (there == nullptr || has_worn) {
      const bool follows = has_worn && !fixed_by_its_path(plan, r);
      const std::string what =
          (there == nullptr ? " " + out_of_use(gone, *wanted).value_or(missing_as(library, *wanted))
                            : " measures " + trimmed(there->cutting_diameter_mm, 3) + " mm as T" +
                                  std::to_string(there->pocket)) +
          (follows ? "; its path is made anew" : "; re-opened");
      out.why.push_back("operation '" + op->its_id.value_or("") + "': tool '" + wanted->id + "' (" +
                        std::string(model::to_text(wanted->cutter_class)) + " " +
                        trimmed(wanted->cutting_diameter_mm, 3) + " mm)" + what);
      if (follows) {
        out.worn.push_back({r, as_loaded(), out.why.back()});
      } else {
        out.open.push_back({r, "its_tool"});
      }
    }
    if (there == nullptr || !seen.insert(wanted->id).second) continue;
    const auto same_pocket = [&](const Cutter& m) { return m.pocket == there->pocket; };
    if (std::any_of(merged.begin(), merged.end(), same_pocket)) continue;  // the same tool under another name
    Cutter c = as_loaded();
    if (std::string fault = model::offset_fault(c); !fault.empty()) {
      return fail({.code = "LATE-TOOL",
                   .message = "the tool '" + c.id + "' of operation '" + op->its_id.value_or("") +
                              "' has no length that can be used: " + fault,
                   .file = plan.file_name,
                   .path = c.id,
                   .hint = "measure it and enter its length; where offsets count from a reference tool, "
                           "say length_offsets: reference under the machine's control"});
    }
    merged.push_back(std::move(c));
  }
  // Loaded cutters that the plan did not name stay as the table describes them; a name counts once: what has
  // that of a tool of the plan gets one of its own.
  std::set<std::string> names;
  for (const Cutter& m : merged) names.insert(m.id);
  for (const Cutter& c : library) {
    bool taken = false;
    for (const Cutter& m : merged) taken = taken || (c.pocket > 0 && m.pocket == c.pocket);
    if (taken) continue;
    if (const std::string fault = model::offset_fault(c); c.loaded && !fault.empty()) {
      const bool named = c.id == "T" + std::to_string(c.pocket);  // by the text itself
      job.note("LATE-TOOL", (named ? "not used: " : "'" + c.id + "' is not used: ") + fault);
      continue;
    }
    merged.push_back(c);
    for (int n = 2; !names.insert(merged.back().id).second; ++n)
      merged.back().id = c.id + "~" + std::to_string(n);
  }
  library = std::move(merged);
  return out;
}

}  // namespace capstan::given
