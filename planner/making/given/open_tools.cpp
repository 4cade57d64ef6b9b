#include "planner/making/given/open_tools.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "planner/ground/base/number.h"
#include "planner/making/given/magazine.h"
#include "planner/making/piece/surroundings.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/making/step/cut/preferences.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/cutter/stated.h"
#include "planner/model/plan/decision/by_planning.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/selection/least_cutter.h"
#include "tooling/selection/select.h"

namespace capstan::given {
namespace {

using draft::StepDraft;
using model::FeatureShape;

/// The tool requirement that the rules give for this operation on this feature: from the step of the same
/// name, else of the same kind.
std::optional<model::ToolRequirement> asked_by_rules(const Choice& choice, const StepDraft& step) {
  if (step.shapes.empty()) return std::nullopt;
  const auto all = piece::shapes_in_piece(choice.piece, step.feature);
  if (!all) return std::nullopt;
  const auto shapes = rules::from_the_top(*all);
  const rules::Context context = piece::context_of(choice.piece, choice.demands, step.feature, shapes);
  const std::string name =
      choice.piece.plan.model.at<model::MachiningOperation>(step.operation).its_id.value_or("");
  std::optional<model::ToolRequirement> same_kind;
  const auto proposals = rules::propose_members(choice.rules, shapes, context);
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    if (shapes[i].member != step.shapes.front().member) continue;
    for (const auto& chain : proposals[i].chains) {
      for (const auto& s : chain) {
        if (s.operation != step.operation.type) continue;
        if (s.name == name) return s.tool;
        if (!same_kind) same_kind = s.tool;
      }
    }
  }
  return same_kind;
}

/// True if a tool that meets `stated` can meet `asked`: the stated size lies within the range asked for.
bool agree(const model::ToolRequirement& asked, const model::ToolRequirement& stated) {
  const double d = stated.diameter_exact_mm > 0.0 ? stated.diameter_exact_mm : stated.diameter_max_mm;
  if (!(d > 0.0)) return true;
  constexpr double kSame = 1e-6;
  if (asked.diameter_exact_mm > 0.0)
    return std::abs(asked.diameter_exact_mm - d) <= asked.diameter_tolerance_mm + kSame;
  return d >= asked.diameter_min_mm - kSame &&
         (asked.diameter_max_mm <= 0.0 || d <= asked.diameter_max_mm + kSame);
}

/// Requirement of an open tool: the file's, else the rules' for such an operation on such a feature. It is
/// always deep enough for the feature.
Result<model::ToolRequirement> requirement_of(const model::Plan& plan, const Choice& choice,
                                              const StepDraft& step, Job& job) {
  const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
  const bool deep = !step.shapes.empty();
  const double reach =
      deep ? step.shapes.front().depth_mm + piece::raw_above(plan.stock.box, step.shapes.front().frame) : 0.0;
  if (tooling::is_requirement(plan.model, op->its_tool)) {
    // Nouns hold class and size only; what the rules ask for the same operation says more, where both agree.
    const auto asked = asked_by_rules(choice, step);
    const auto stated = tooling::requirement_from_nouns(plan.model, op->its_tool, job);
    if (asked && (!stated || agree(*asked, *stated))) return *asked;
  }
  if (plan.model.holds<model::MachiningTool>(op->its_tool)) {
    auto r = tooling::requirement_from_nouns(plan.model, op->its_tool, job);
    if (r) {
      // The feature's depth counts, not the length of the given tool.
      if (deep) {
        r->reach_mm = reach;
        r->depth_of_cut_mm = std::min(r->depth_of_cut_mm, reach);
        r->point_angle_rad = 0.0;
      }
      const bool fits_narrow = deep && step.shapes.front().corner_radius_mm > 0.0;
      if (fits_narrow && plan.model.holds<model::BottomAndSideMilling>(step.operation)) {
        r->diameter_max_mm = std::min(r->diameter_max_mm, 2.0 * step.shapes.front().corner_radius_mm);
        r->diameter_min_mm = std::min(r->diameter_min_mm, r->diameter_max_mm);
      }
    }
    return r;
  }
  if (const auto asked = asked_by_rules(choice, step)) return *asked;
  return fail({.code = "PIP-TOOL-OPEN",
               .message = "operation '" + op->its_id.value_or("") +
                          "' leaves its tool open, and nothing says what it must be",
               .file = plan.file_name,
               .instance = plan.model.origin(step.operation).instance,
               .expected = "a machining_tool with class and dimensions",
               .hint = "or re-open the operations"});
}

/// Shortens the stick-out of a tool without a described holder to the length that its feature and its flutes
/// need. The functional length counts from the gage line, holder included. Defaults, unsourced.
void stand_out(const geometry::Box3& raw, StepDraft& step) {
  constexpr double kFluteShare = 1.5;   // of the cutting edge's length
  constexpr double kSlenderness = 3.0;  // diameters
  constexpr double kSpare = 5.0;        // between holder and material, mm
  model::Cutter& c = step.cutter;
  if (c.stick_out_mm < c.functional_length_mm) return;  // the stick-out is stated
  double needed = std::max(kFluteShare * c.maximum_depth_of_cut_mm, kSlenderness * c.cutting_diameter_mm);
  for (const FeatureShape& s : step.shapes) {
    const double above = piece::raw_above(raw, s.frame);
    needed = std::max(needed, s.depth_mm + above + model::tip_length(c) + kSpare);
  }
  if (!(needed < c.stick_out_mm)) return;
  c.stick_out_mm = c.usable_length_mm = needed;
  c.sources.emplace_back("stick_out_mm",
                         "default: what feature and flutes need, no holder being described; unsourced");
}

/// A cutter that is loaded is where the tool table says, and as long.
void take_from_magazine(const std::vector<model::Cutter>& library, model::Cutter& cutter) {
  for (const auto& c : library) {
    if (c.pocket <= 0 || c.id != cutter.id) continue;
    cutter.pocket = c.pocket;
    take_length(c, cutter);
    return;
  }
}

/// Why a tool that is loaded shorter than was assumed cannot cut: its holder would take in its flutes.
std::optional<std::string> too_short_as_loaded(const model::Cutter& c, double assumed_mm) {
  if (!(c.stick_out_mm < assumed_mm) || c.stick_out_mm >= c.maximum_depth_of_cut_mm) return std::nullopt;
  return "the tool '" + c.id + "' (T" + std::to_string(c.pocket) + ") is " +
         trimmed(c.functional_length_mm, 4) + " mm long as it is loaded, so that " +
         trimmed(c.stick_out_mm, 4) + " mm of it stand out where " + trimmed(assumed_mm, 4) +
         " were assumed: less than its flutes of " + trimmed(c.maximum_depth_of_cut_mm, 4) +
         " mm, so that it does not reach; load it in a shorter holder whose stick-out is stated, or a longer "
         "tool";
}

/// Selects the cutter of one open operation; false if none fits.
bool select_one(model::Plan& plan, StepDraft& step, std::vector<std::string>& used,
                std::vector<model::NeededTool>& needed, const Choice& choice, Job& job) {
  const std::string name = plan.model.at<model::MachiningOperation>(step.operation).its_id.value_or("");
  const auto requirement = requirement_of(plan, choice, step, job);
  if (!requirement) {
    job.report(requirement.error());
    plan.unplanned.push_back({step.feature, requirement.error().message});
    return false;
  }
  tooling::Preferences wanted;
  if (!step.shapes.empty()) {
    model::ProposedStep as_proposed;
    as_proposed.operation = step.operation.type;
    if (const auto* drills = plan.model.get<model::DrillingTypeOperation>(step.operation))
      as_proposed.start_diameter_mm = drills->previous_diameter.value_or(0.0);
    wanted = step::preferences_of(choice.piece, choice.demands.batch, as_proposed, step.shapes.front());
    wanted.places = static_cast<int>(step.shapes.size());
  }
  wanted.used = used;
  std::vector<model::Cutter> kept;
  std::vector<model::Rejected> barred;
  const std::vector<model::Cutter>& usable =
      choice.edits == nullptr ? choice.usable
                              : model::allowed(*choice.edits, draft::edit_names(plan.model, step),
                                               choice.usable, requirement->classes, kept, barred);
  auto s = tooling::select(*requirement, usable, plan.material, plan.machine, wanted);
  // Nouns say less of a tool than the rules that planning chose it by: what they leave out may bar all.
  if (s.ranked.empty() && model::by_planning(plan.ledger.find(step.operation, "its_tool"))) {
    if (const auto asked = asked_by_rules(choice, step)) {
      auto by_rules = tooling::select(*asked, usable, plan.material, plan.machine, wanted);
      if (!by_rules.ranked.empty()) s = std::move(by_rules);
    }
  }
  s.rejected.insert(s.rejected.end(), barred.begin(), barred.end());
  if (!step.shapes.empty())
    step::weigh_by_cases(choice.cases, plan, step::of_step(plan.model, step), step.shapes.front(), s);
  if (s.ranked.empty()) {
    if (auto lacks = tooling::needed_cutter(*requirement, plan.material, plan.machine, wanted))
      needed.push_back({step.feature, draft::name_of(plan.model, step), std::move(lacks->cutter),
                        model::words_of(*requirement)});
    plan.unplanned.push_back(
        {step.feature,
         "operation '" + name + "': no cutter fits; " + s.would_fit + " would" +
             (barred.empty() ? std::string()
                             : "; ruled out is '" + barred.front().what + "', by " + barred.front().why)});
    job.report({.code = "PIP-NO-TOOL",
                .severity = Severity::kError,
                .message = "operation '" + name + "' finds no cutter",
                .file = plan.file_name,
                .instance = plan.model.origin(step.operation).instance,
                .expected = s.would_fit,
                .hint = "load or add one, or re-open the operations"});
    return false;
  }
  step.candidates = draft::CandidatePool().list(s.ranked);
  step.cutter = s.ranked.front().cutter;
  step.rejected_tools = s.rejected;
  tooling::use(used, step.cutter.id);
  const auto tool = tooling::tool_noun(plan.model, step.cutter);
  plan.model.get<model::MachiningOperation>(step.operation)->its_tool = tool;
  plan.ledger.bind(step.operation, "its_tool", model::Binder::kToolSelection, s.ranked.front().why,
                   {{step.step, "its_operation"}}, s.rejected);
  return true;
}

std::string words(const model::Cutter& c) {
  return std::string(model::to_text(c.cutter_class)) + " " + trimmed(c.cutting_diameter_mm, 4) + " mm, " +
         std::to_string(c.teeth) + " teeth, " + trimmed(c.functional_length_mm, 4) + " mm long";
}

/// True if two given tools with one name are the same tool. Stick-outs may differ; stand_out_alike takes the
/// longest.
bool same_given(const model::Cutter& a, const model::Cutter& b) {
  model::Cutter other = b;
  other.stick_out_mm = a.stick_out_mm;
  other.usable_length_mm = a.usable_length_mm;
  other.sources = a.sources;
  return a == other;
}
/// The same of a given one and one that planning chose or may choose, of which nouns hold less: what the file
/// states of it is as it is there. A measured length is the magazine's to say, and one that planning recorded
/// is that of the tool as it was put together; else two lengths are two tools, for the table has one line.
bool same_chosen(const model::Cutter& a, const model::Cutter& b, bool recorded) {
  constexpr double kSame = 1e-6;        // mm, rad: what units round
  constexpr double kSameLength = 0.01;  // mm; lengths are preset to a hundredth
  const auto near = [](double x, double y) { return std::abs(x - y) <= kSame; };
  const auto agree = [&](double x, double y) { return x == 0.0 || y == 0.0 || near(x, y); };
  const auto stated = [&](const char* field, double x, double y) {
    return near(x, y) || !model::is_stated(b, field);
  };
  const bool length = recorded || a.loaded || !model::is_stated(b, "functional_length_mm") ||
                      std::abs(a.functional_length_mm - b.functional_length_mm) <= kSameLength;
  return length && a.cutter_class == b.cutter_class && a.teeth == b.teeth && a.hand == b.hand &&
         near(a.cutting_diameter_mm, b.cutting_diameter_mm) && near(a.corner_radius_mm, b.corner_radius_mm) &&
         agree(a.thread_pitch_mm, b.thread_pitch_mm) && agree(a.thread_size_mm, b.thread_size_mm) &&
         agree(a.point_angle_rad, b.point_angle_rad) && agree(a.taper_angle_rad, b.taper_angle_rad) &&
         stated("tip_diameter_mm", a.tip_diameter_mm, b.tip_diameter_mm) &&
         stated("cutting_width_mm", a.cutting_width_mm, b.cutting_width_mm) &&
         stated("maximum_depth_of_cut_mm", a.maximum_depth_of_cut_mm, b.maximum_depth_of_cut_mm) &&
         (a.substrate == b.substrate || !model::is_stated(b, "substrate"));
}

/// Files name tools as they like, or not at all: different ones of one name get a name each. A name of the
/// library is the library's, whether planning has chosen that tool or may still take it: pocket, length and
/// table line go by the name. Which one keeps a name does not depend on the order of the steps: what planning
/// chose or the library has, then the smaller.
void tell_apart(const std::vector<StepDraft>& steps, const std::vector<model::Cutter>& library,
                const std::vector<StepDraft*>& given, const std::set<const StepDraft*>& recorded, Job& job) {
  std::map<std::string, std::vector<const model::Cutter*>> named;
  std::set<std::string> taken, known;
  // A head that is set to a size is named with it where a plan sets it to several (choose.cpp): its size says
  // nothing against it.
  const auto only_set = [&](const model::Cutter& c) {
    return c.adjustable_to_mm > 0.0 && std::none_of(given.begin(), given.end(), [&](const StepDraft* s) {
             return s->cutter.id == c.id && !(s->cutter.adjustable_to_mm > 0.0);
           });
  };
  for (const model::Cutter& c : library) {
    taken.insert(c.id);
    if (!only_set(c) && known.insert(c.id).second) named[c.id] = {&c};
  }
  for (const StepDraft& s : steps) {
    if (s.cutter.id.empty()) continue;
    taken.insert(s.cutter.id);
    if (std::find(given.begin(), given.end(), &s) != given.end()) continue;
    if (known.insert(s.cutter.id).second) named[s.cutter.id] = {&s.cutter};
  }
  const auto find = [&](const StepDraft& s) {
    const auto& all = named[s.cutter.id];
    const auto first = all.begin() + (known.contains(s.cutter.id) ? 1 : 0);
    if (first != all.begin() && same_chosen(*all.front(), s.cutter, recorded.contains(&s)))
      return std::size_t{0};
    return static_cast<std::size_t>(
        std::find_if(first, all.end(), [&](const auto* o) { return same_given(*o, s.cutter); }) -
        all.begin());
  };
  std::vector<const StepDraft*> sorted(given.begin(), given.end());
  const auto size = [](const StepDraft* s) {
    const model::Cutter& c = s->cutter;
    return std::tuple(c.cutting_diameter_mm, c.functional_length_mm, c.maximum_depth_of_cut_mm,
                      c.corner_radius_mm, c.point_angle_rad, c.thread_pitch_mm, c.taper_angle_rad, c.teeth,
                      c.cutter_class);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const StepDraft* a, const StepDraft* b) { return size(a) < size(b); });
  for (const StepDraft* s : sorted) {
    if (find(*s) == named[s->cutter.id].size()) named[s->cutter.id].push_back(&s->cutter);
  }
  std::map<std::string, std::vector<std::string>> names;
  for (const auto& [name, all] : named) {
    auto& own = names[name] = {name};
    for (int n = 2; own.size() < all.size(); ++n) {
      const std::string other = name + "~" + std::to_string(n);
      if (taken.insert(other).second) own.push_back(other);
    }
    if (!known.contains(name)) continue;
    for (std::size_t i = 1; i < own.size(); ++i) {
      job.note("PIP-TOOL-NAME", "the file's tool '" + name + "' (" + words(*all[i]) +
                                    ") is another than the one of that name that planning has (" +
                                    words(*all.front()) + "): it is '" + own[i] + "' in the plan");
    }
  }
  // A name may mean several of these cutters: all get names of their own before one is renamed.
  std::vector<std::string> own;
  for (const StepDraft* s : given) own.push_back(names[s->cutter.id][find(*s)]);
  for (std::size_t i = 0; i < given.size(); ++i) given[i]->cutter.id = std::move(own[i]);
}

/// Takes the cutter that the plan recorded if planning chose it before: nouns hold fewer values. If the nouns
/// were edited since, or somebody else chose the tool, the nouns count.
bool take_recorded(const model::Plan& plan, const Choice& choice, const StepDraft& step,
                   model::Cutter& cutter) {
  const auto* d = plan.ledger.find(step.operation, "its_tool");
  const bool by_edit = d != nullptr && plan.ledger.reason(d->reason).id == model::kByEdit;
  if (!model::by_planning(d) && !by_edit) return false;
  const auto named = [&](const model::Cutter& c) { return c.id == cutter.id; };
  const auto it = std::find_if(choice.recorded.begin(), choice.recorded.end(), named);
  constexpr double kSame = 1e-6;  // mm
  if (it == choice.recorded.end() || it->cutter_class != cutter.cutter_class || it->teeth != cutter.teeth ||
      std::abs(it->cutting_diameter_mm - cutter.cutting_diameter_mm) > kSame) {
    return false;
  }
  model::Cutter known = *it;
  // Start values and sources are the library's; a file does not hold them.
  const auto item = std::find_if(choice.library.begin(), choice.library.end(), named);
  const model::Cutter& from = item != choice.library.end() ? *item : cutter;
  if (known.presets.empty()) known.presets = from.presets;
  if (known.sources.empty()) known.sources = from.sources;
  known.adjustable_to_mm = std::max(known.adjustable_to_mm, from.adjustable_to_mm);
  cutter = std::move(known);
  return true;
}

/// The cutter of a step as the file gives it. Where the file does not state what it is made of, it is read
/// once more with what tells of it, for its start values follow from that.
Result<model::Cutter> given_cutter(const model::Plan& plan, const StepDraft& step, const Choice& choice,
                                   Job& job) {
  const auto tool = plan.model.at<model::MachiningOperation>(step.operation).its_tool;
  auto cutter = tooling::cutter_from_nouns(plan.model, tool, job, choice.library);
  if (!cutter || !tooling::material_is_assumed(*cutter)) return cutter;
  const auto hints = hints_of(plan, step, *cutter, choice.library, choice.materials);
  Job silent;  // what is to be said of it was said above
  return tooling::cutter_from_nouns(plan.model, tool, silent, choice.library, &hints);
}

}  // namespace

void select_open_tools(model::Plan& plan, std::vector<StepDraft>& steps, std::vector<std::string>& used,
                       std::vector<model::NeededTool>& needed, const Choice& choice, Job& job) {
  std::vector<StepDraft*> given;
  std::set<const StepDraft*> recorded;
  for (StepDraft& step : steps) {
    if (step.proposed || !step.operation.set()) continue;
    const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
    if (step.open_tool) {
      select_one(plan, step, used, needed, choice, job);
      continue;
    }
    auto cutter = given_cutter(plan, step, choice, job);
    if (cutter) {
      step.cutter = *std::move(cutter);
      (void)tooling::give_holder(step.cutter, choice.holders);
      if (take_recorded(plan, choice, step, step.cutter)) recorded.insert(&step);
      given.push_back(&step);
      tooling::use(used, step.cutter.id);
      continue;
    }
    job.report(cutter.error());
    plan.unplanned.push_back({step.feature, "step '" + draft::name_of(plan.model, step) + "', operation '" +
                                                op->its_id.value_or("") + "': " + cutter.error().message});
  }
  tell_apart(steps, choice.library, given, recorded, job);
  for (StepDraft* step : given) {
    if (!recorded.contains(step)) stand_out(plan.stock.box, *step);
    const double assumed = step->cutter.stick_out_mm;
    take_from_magazine(choice.library, step->cutter);
    if (auto why = too_short_as_loaded(step->cutter, assumed)) {
      plan.unplanned.push_back({step->feature, "step '" + draft::name_of(plan.model, *step) + "': " + *why});
    }
  }
}

void stand_out_alike(std::vector<StepDraft>& steps) {
  struct Out {
    double stick_out_mm = 0.0, usable_length_mm = 0.0, functional_length_mm = 0.0;
  };
  std::map<std::string, Out> most;
  for (const StepDraft& s : steps) {
    if (s.cutter.id.empty()) continue;
    Out& m = most[s.cutter.id];
    m.stick_out_mm = std::max(m.stick_out_mm, s.cutter.stick_out_mm);
    m.usable_length_mm = std::max(m.usable_length_mm, s.cutter.usable_length_mm);
    m.functional_length_mm = std::max(m.functional_length_mm, s.cutter.functional_length_mm);
  }
  const auto take = [&](model::Cutter& c) {
    const auto it = most.find(c.id);
    if (it == most.end()) return;
    c.stick_out_mm = std::max(c.stick_out_mm, it->second.stick_out_mm);
    c.usable_length_mm = std::max(c.usable_length_mm, it->second.usable_length_mm);
    c.functional_length_mm = std::max(c.functional_length_mm, it->second.functional_length_mm);
  };
  // A step's cutter is taken from its candidates once more; what steps share is changed once for all.
  std::map<const model::Candidate*, draft::Candidates::Shared> changed;
  const auto longer = [&](const draft::Candidates::Shared& c) -> draft::Candidates::Shared {
    const auto [it, is_new] = changed.try_emplace(c.get(), nullptr);
    if (is_new && most.contains(c->cutter.id)) {
      model::Candidate out = *c;
      take(out.cutter);
      if (!(out == *c)) it->second = std::make_shared<const model::Candidate>(std::move(out));
    }
    return it->second;
  };
  std::vector<draft::Candidates> before;  // keeps what `changed` knows by its place
  for (StepDraft& s : steps) {
    take(s.cutter);
    before.push_back(s.candidates);
    s.candidates.replace(longer);
  }
}

}  // namespace capstan::given
