#include "planner/making/propose/propose.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/piece/mesh/surface_form.h"
#include "planner/making/piece/mesh/thin_places.h"
#include "planner/making/piece/raw_piece_limits.h"
#include "planner/making/piece/surroundings.h"
#include "planner/making/piece/twins.h"
#include "planner/making/propose/by_cases.h"
#include "planner/making/propose/coaxial_steps.h"
#include "planner/making/propose/corners.h"
#include "planner/making/propose/missing_tools.h"
#include "planner/making/propose/operation_nouns.h"
#include "planner/making/propose/shared_tools.h"
#include "planner/making/propose/sides.h"
#include "planner/making/step/cut/drilled_hole.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/resources/changed_by_hand.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/selection/select.h"
#include "tooling/selection/selections.h"

namespace capstan::propose {
namespace {

using draft::Member;
using draft::ProbingDraft;
using draft::SetupDraft;
using draft::StepDraft;
using model::AnyRef;
using model::FeatureShape;
using model::Model;
using model::Ref;
using model::TypeId;

/// Features the file wants made, in the order of the file.
std::vector<AnyRef> wanted(const Model& m, const std::vector<StepDraft>& steps) {
  const std::set<AnyRef> parts = model::parts_of_others(m);
  std::set<AnyRef> done;
  for (const StepDraft& s : steps) done.insert(s.feature);
  // A compound whose elements have their own steps is made by these.
  const auto by_elements = [&](AnyRef r) {
    const auto* c = m.get<model::CompoundFeature>(r);
    return c != nullptr && !c->elements.empty() &&
           std::all_of(c->elements.items.begin(), c->elements.items.end(),
                       [&](AnyRef e) { return done.contains(e); });
  };
  std::vector<AnyRef> out;
  for (const AnyRef r : m.all_below(TypeId::kManufacturingFeature)) {
    if (parts.contains(r) || done.contains(r) || by_elements(r) || m.holds<model::ToolpathFeature>(r))
      continue;
    out.push_back(r);
  }
  std::stable_sort(out.begin(), out.end(),
                   [&](AnyRef a, AnyRef b) { return m.origin(a).instance < m.origin(b).instance; });
  // A cone may be the mouth of another feature's hole, which is to be known before it.
  std::stable_partition(out.begin(), out.end(), [&](AnyRef r) {
    const auto* hole = m.get<model::RoundHole>(r);
    return hole == nullptr || !hole->change_in_diameter.set();
  });
  return out;
}

void unplanned(model::Plan& plan, AnyRef feature, const FeatureShape& s, const std::string& reason,
               Job& job) {
  plan.unplanned.push_back({feature, reason});
  job.report({.code = "PIP-UNPLANNED",
              .severity = Severity::kWarning,
              .message = "feature '" + s.name + "' (" +
                         std::string(model::noun_type(s.feature.type).keyword) +
                         ") is not planned: " + reason,
              .file = plan.file_name,
              .line = plan.model.origin(s.feature).line,
              .instance = plan.model.origin(s.feature).instance});
}

constexpr double kNarrowMm = 8.0;       ///< passages left to a ball; default, unsourced
constexpr double kSameHeightMm = 1e-3;  ///< the rounding of coordinates in a mesh; default, unsourced

class Proposer {
 public:
  Proposer(model::Plan& plan, const Sources& sources, Proposed& out, Job& job)
      : plan_(plan),
        sources_(sources),
        selections_(sources.choice.usable, plan.material, plan.machine),
        choice_(sources.choice),
        out_(out),
        job_(job) {
    choice_.selections = &selections_;
  }

  void feature(AnyRef f, const std::vector<FeatureShape>& shapes) {
    if (left_out(f, shapes.front())) return;
    rules::Context context = piece::context_of(choice_.piece, sources_.demands, f, shapes);
    const std::optional<Core> core = core_of(shapes);
    if (core) context.core_diameter_mm = core->diameter_mm;
    judge_tolerances(shapes.front());
    piece::ThinPlaces thin;
    for (const auto& s : shapes) {
      for (const std::string& a : s.assumptions) {
        if (said_.insert({f, a}).second) job_.warn("PIP-ASSUMED", "feature '" + s.name + "': " + a);
      }
      for (const std::string& r : s.remarks) {
        if (said_.insert({f, r}).second) job_.note("PIP-ASSUMED", "feature '" + s.name + "': " + r);
      }
      if (s.kind == model::ShapeKind::kFreeform && plan_.target_mesh) {
        context.surface_radius_mm = piece::surface_radius(*plan_.target_mesh);
        const piece::SurfaceForm form = piece::surface_form(*plan_.target_mesh, plan_.stock.box);
        context.surface_walls = form.walls;
        context.surface_curved = form.curved;
        context.surface_corner_mm = form.corner_mm;
        context.surface_sharp_mm = piece::sharp_corner_of(form);
        thin = piece::thin_places(*plan_.target_mesh, plan_.stock.box);
        if (thin.wall) context.surface_wall_ratio = thin.wall->ratio();
        if (thin.floor) context.surface_floor_ratio = thin.floor->ratio();
        if (form.walls)
          context.surface_height_mm = geometry::bounds(*plan_.target_mesh).hi.z - plan_.stock.box.lo.z;
        // Of what is curved, too, a ball finishes the places that no mill enters, or only a narrow one.
        if (form.walls)
          context.surface_passage_mm = piece::passage_between(*plan_.target_mesh, form, plan_.stock.box);
        if (form.curved && context.surface_passage_mm < kNarrowMm) context.surface_passage_mm = 0.0;
      }
    }
    std::vector<FeatureShape> in_material = shapes;
    for (FeatureShape& s : in_material) s.corner_radius_mm = piece::corner_in_material(choice_.piece, s);
    auto proposals = rules::propose_members(sources_.rules, in_material, context);
    for (model::Proposal& p : proposals) {
      if (!p.cannot.empty()) p.cannot += words_of(thin);
    }
    const auto order = rules::member_order(shapes);
    const auto within = rules::made_within(shapes);
    std::vector<std::vector<std::size_t>> made(shapes.size());  // indices of steps by shape
    std::vector<std::size_t> representative(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      representative[i] = i;
      for (std::size_t j = 0; j < i; ++j) {
        if (representative[j] == j && piece::alike(shapes[i], shapes[j])) {
          representative[i] = j;
          break;
        }
      }
      // Like members are made in one step each of their chain, one after the other.
      if (representative[i] != i) {
        for (const std::size_t s : made[representative[i]]) out_.drafts.steps[s].shapes.push_back(shapes[i]);
        if (auto rest = model::corner_rest_of(plan_, shapes[representative[i]].name)) {
          rest->feature = shapes[i].name;
          plan_.provenance.push_back(model::provenance_of(*rest));
        }
        continue;
      }
      if (within[i] != i) {
        job_.note("PIP-WITHIN", "feature '" + shapes[i].name + "': no step of its own, '" +
                                    shapes[within[i]].name + "' removes all of it");
        continue;
      }
      made[i] = shape(f, shapes[i], proposals[i], context);
      if (core && !made[i].empty()) out_.drafts.steps[made[i].front()].after.push_back(core->last_step);
    }
    // Part of a feature cannot be made, so the rest of the feature is not made either.
    if (const auto why = failed_.find(f); why != failed_.end()) {
      const bool some = std::any_of(made.begin(), made.end(), [](const auto& m) { return !m.empty(); });
      for (const std::string& reason : why->second) out_.left_out.emplace_back(f, reason);
      // An omitted face makes all features below it deeper; the proposals assumed that it is cut.
      const bool face = shapes.front().kind == model::ShapeKind::kFace;
      out_.again = out_.again || some || face;
    }
    for (const auto& [first, second] : order) {
      if (representative[first] != first || representative[second] != second) continue;
      if (made[first].empty() || made[second].empty()) continue;
      members_in_order(out_.drafts.steps, made[first], made[second]);
    }
  }

 private:
  /// The thin places of a surface, for the reason why it is not planned.
  static std::string words_of(const piece::ThinPlaces& thin) {
    std::string out;
    const auto tell = [&](const char* what, const std::optional<piece::ThinPlace>& t, const char* extent) {
      if (!t) return;
      out += std::string("; its thinnest ") + what + " is " + trimmed(t->thickness_mm, 2) + " mm thick and " +
             trimmed(t->extent_mm, 2) + " mm " + extent + " at (" + trimmed(t->at.x, 2) + ", " +
             trimmed(t->at.y, 2) + ", " + trimmed(t->at.z, 2) + ")";
    };
    tell("wall", thin.wall, "high");
    tell("floor", thin.floor, "wide");
    return out;
  }
  /// Whether an earlier try left this feature out; said again in this one.
  bool left_out(AnyRef f, const FeatureShape& first) {
    const draft::LeftOut* out = choice_.bans.left_out(f);
    if (out == nullptr) return false;
    const auto* named = plan_.model.get<model::ManufacturingFeature>(f);
    FeatureShape whole = first;
    if (named != nullptr && named->its_id) whole.name = *named->its_id;
    for (const std::string& why : out->reasons) unplanned(plan_, f, whole, why, job_);
    if (!out->reasons.empty()) return true;
    std::string names;
    for (const AnyRef on : out->rests_on) {
      const auto* other = plan_.model.get<model::ManufacturingFeature>(on);
      names += (names.empty() ? "'" : ", '") + (other == nullptr ? "" : other->its_id.value_or("")) + "'";
    }
    unplanned(plan_, f, whole,
              "it rests on " + names + ", which " + (out->rests_on.size() > 1 ? "are" : "is") +
                  " not planned" + (out->why_rests.empty() ? "" : ": ") + out->why_rests,
              job_);
    return true;
  }

  /// Why this member cannot be made; with its name where the feature has others.
  void fail_member(AnyRef f, const FeatureShape& s, const std::string& reason) {
    const auto* named = plan_.model.get<model::ManufacturingFeature>(f);
    const bool whole = named == nullptr || named->its_id.value_or("") == s.name;
    const std::string text = whole ? reason : "'" + s.name + "': " + reason;
    failed_[f].push_back(text);
    unplanned(plan_, f, s, text, job_);
  }

  /// A narrower hole of another feature that an earlier step makes right through where these holes are.
  struct Core {
    double diameter_mm = 0.0;
    std::size_t last_step = 0;
  };

  /// Whether `hole` runs on the axis of `s`, from above its bottom to below it, from whichever side it is
  /// cut.
  static bool runs_through(const FeatureShape& hole, const FeatureShape& s) {
    if (hole.kind != model::ShapeKind::kHole ||
        hole.bottom_diameter_mm < hole.diameter.nominal_mm - model::kCoaxialMm)
      return false;
    if (hole.diameter.nominal_mm > s.diameter.nominal_mm - model::kCoaxialMm) return false;
    const auto rel = compose(inverse(s.frame), hole.frame);
    if (std::abs(std::abs(rel.z.z) - 1.0) > kSameAxis ||
        std::hypot(rel.origin.x, rel.origin.y) > model::kCoaxialMm)
      return false;
    const double a = rel.origin.z, b = rel.origin.z - hole.depth_mm * rel.z.z;
    return std::min(a, b) < -s.depth_mm - model::kCoaxialMm && std::max(a, b) > -model::kCoaxialMm;
  }

  [[nodiscard]] std::optional<Core> core_of(const std::vector<FeatureShape>& shapes) const {
    std::optional<Core> out;
    for (const FeatureShape& s : shapes) {
      if (s.kind != model::ShapeKind::kHole || s.through) return std::nullopt;
      std::optional<Core> here;
      for (std::size_t i = 0; i < out_.drafts.steps.size(); ++i) {
        const StepDraft& step = out_.drafts.steps[i];
        if (step.feature == s.feature || step.setup > setup_up(out_.drafts.setups, s.frame.z)) continue;
        for (const FeatureShape& hole : step.shapes) {
          if (!runs_through(hole, s)) continue;
          if (!here || hole.diameter.nominal_mm >= here->diameter_mm)
            here = Core{hole.diameter.nominal_mm, i};
        }
      }
      if (!here || (out && out->diameter_mm != here->diameter_mm)) return std::nullopt;
      out = Core{here->diameter_mm, std::max(here->last_step, out ? out->last_step : 0)};
    }
    return out;
  }

  /// A tolerance wider than its size is more likely a slip of the pen than meant.
  void judge_tolerances(const FeatureShape& s) {
    for (const auto& [what, t] : {std::pair("diameter", s.diameter), std::pair("width", s.width)}) {
      if (!t.given || !(t.nominal_mm > 0.0) || t.upper_mm - t.lower_mm < t.nominal_mm) continue;
      job_.warn("MDL-TOLERANCE", "feature '" + s.name + "': the tolerance of its " + what + ", " +
                                     trimmed(t.lower_mm, 4) + " to " + trimmed(t.upper_mm, 4) +
                                     " mm, is as wide as the size of " + trimmed(t.nominal_mm, 4) +
                                     " mm or wider; look at its unit and value");
    }
  }
  /// Why the tolerance leaves no size to make; empty if it does.
  static std::string swallowed(const FeatureShape& s) {
    for (const auto& [what, t] : {std::pair("diameter", s.diameter), std::pair("width", s.width)}) {
      if (!t.given || !(t.nominal_mm > 0.0) || t.nominal_mm + t.lower_mm > 0.0) continue;
      return "the tolerance swallows the size: a " + std::string(what) + " of " + trimmed(t.nominal_mm, 4) +
             " mm with a lower limit " + trimmed(-t.lower_mm, 4) + " mm below it";
    }
    return {};
  }

  [[nodiscard]] double widest_mm() const {
    double out = 0.0;
    for (const model::Cutter& c : choice_.usable) out = std::max(out, c.cutting_diameter_mm);
    return out;
  }

  /// Where only the operator's edits leave no chain: which these are, and what to do; empty: they do not.
  std::string ruled_out_by_edits(const model::Proposal& p, const FeatureShape& s, const Member& member,
                                 const rules::Context& context) const {
    if (choice_.edits == nullptr) return {};
    Choice free = choice_;
    free.edits = nullptr;
    Job silent;
    const InCorners without = choose_in_corners(free, sources_.rules, context, p, s, member,
                                                out_.drafts.steps, out_.drafts.used, silent);
    if (without.chosen.chain == nullptr) return {};
    std::string words;
    std::size_t n = 0;
    for (const model::Edit& e : *choice_.edits) {
      const bool chooses = e.kind == model::EditKind::kForbid || model::is_tool_limit(e);
      const auto feature = draft::feature_name(plan_.model, member.feature);
      const bool meant = std::any_of(p.chains.begin(), p.chains.end(), [&](const auto& chain) {
        return std::any_of(chain.begin(), chain.end(), [&](const model::ProposedStep& step) {
          return model::names(e.where, model::StepNames{feature, step.name});
        });
      });
      if (!chooses || !meant) continue;
      words += (words.empty() ? "" : "; ") + model::words_of(e);
      ++n;
    }
    if (n == 0) return {};
    return words + (n == 1 ? " leaves" : " leave") + " no way to make it that works; take " +
           (n == 1 ? "it" : "one of them") + " back, or rule out less";
  }

  std::vector<std::size_t> shape(AnyRef f, const FeatureShape& given, const model::Proposal& proposed,
                                 const rules::Context& context) {
    std::string why = swallowed(given);
    if (why.empty()) why = piece::crosses_a_wall(choice_.piece, given);
    if (why.empty()) why = piece::beyond_travel(choice_.piece, given, widest_mm());
    if (why.empty()) why = piece::not_in_piece(choice_.piece, given);
    if (why.empty()) why = piece::lies_within_another(choice_.piece.shapes, given);
    if (why.empty() && given.kind == model::ShapeKind::kFreeform && plan_.target_mesh &&
        !context.surface_walls && context.stock_above_mm < kSameHeightMm)
      why =
          "the raw piece is the surface already, and nothing of it is to be cut; say what it is cut from "
          "(--stock block:+2)";
    if (!why.empty() || !proposed.cannot.empty()) {
      fail_member(f, given, why.empty() ? proposed.cannot : why);
      return {};
    }
    const model::Proposal p =
        by_cases(choice_, piece::without_drills_at_edges(choice_.piece, given, proposed), f, given);
    if (p.chains.empty() && !proposed.chains.empty()) {
      fail_member(f, given, p.rejected.back().why);
      return {};
    }
    for (const model::Rejected& r : p.rejected) {
      if (r.what == "breaking edges" && said_.insert({f, "edges: " + r.why}).second)
        job_.note("PIP-EDGE", "feature '" + given.name + "': its edges are not broken: " + r.why +
                                  "; deburr them, or state a chamfer");
    }
    const FeatureShape s = reachable_side(choice_.piece, sources_.demands, out_.drafts.setups, f, given);
    const Member member{f, s.feature, s.member};
    InCorners found = choose_in_corners(choice_, sources_.rules, context, p, s, member, out_.drafts.steps,
                                        out_.drafts.used, job_);
    if ((found.chosen.chain == nullptr || found.rest) && room_made_for(p))
      found = choose_in_corners(choice_, sources_.rules, context, p, s, member, out_.drafts.steps,
                                out_.drafts.used, job_);
    const Chosen& chosen = found.chosen;
    const std::vector<model::Rejected>& rejected = found.rejected;
    if (chosen.chain == nullptr) {
      if (const std::string edits = ruled_out_by_edits(p, s, member, context); !edits.empty()) {
        fail_member(f, given, edits);
        return {};
      }
    }
    if (chosen.chain == nullptr || found.rest) {
      for (model::NeededTool& n : needed_tools(choice_, p, s, member, out_.drafts.used)) {
        if (found.drawn_square.empty()) out_.drafts.needed.push_back(std::move(n));
      }
    }
    if (chosen.chain == nullptr) {
      if (const std::string full =
              full_magazine(choice_, sources_.rules, context, p, s, member, out_.drafts.used);
          !full.empty()) {
        out_.full = true;
        fail_member(f, given, full);
        return {};
      }
      const bool tried = std::any_of(p.chains.begin(), p.chains.end(), [&](const auto& chain) {
        return choice_.bans.chain_banned(member, draft::key_of(chain)) != nullptr;
      });
      std::string reason = tried ? "no way to make it works" : "no cutter in the library fits";
      if (!found.drawn_square.empty())
        reason = found.drawn_square + ", and a mill leaves them round; " + reason;
      for (const auto& r : rejected) {
        if (reason.find("; " + r.why) == std::string::npos) reason += "; " + r.why;  // chains share reasons
      }
      fail_member(f, given, reason);
      return {};
    }
    if (found.rest) plan_.provenance.push_back(model::provenance_of(*found.rest));
    std::vector<std::size_t> made;
    std::vector<std::optional<std::size_t>> made_of;  // by step of the chain
    std::optional<ProbingDraft> probing;
    const std::size_t setup = setup_for(plan_, out_.drafts.setups, s, job_);
    for (std::size_t i = 0; i < chosen.chain->size(); ++i) {
      StepDraft step;
      step.feature = f;
      step.setup = setup;
      step.shapes = {s};
      step.proposed = true;
      step.member = member;
      step.chain = chosen.key;
      step.in_chain = i;
      step.open_technology = true;
      step.proposal = as_opened(*chosen.chain, i, chosen.tools);
      step.proposal.feature = f;
      if (step.proposal.operation == TypeId::kWorkpieceProbing) {
        probing = probing_at(*chosen.chain, i, chosen.tools[i]);
        made_of.push_back(made.empty() ? std::nullopt : std::optional(made.back()));
        continue;
      }
      step.candidates = pool_.list(chosen.tools[i].ranked);
      step.rejected_tools = chosen.tools[i].rejected;
      step.cutter = step.candidates.front().cutter;
      step.start_in_chain_mm = (*chosen.chain)[i].start_diameter_mm;
      if (const auto depth = step::depth_with_its_cutter(step)) step.proposal.depth_mm = *depth;
      for (std::size_t k = 1; k < step.candidates.size() && k < 4; ++k) {
        step.rejected_tools.push_back(
            {step.candidates[k].cutter.id, "fits, ranked lower: " + step.candidates[k].why.text});
      }
      const auto ws =
          add_nouns(plan_, step.proposal, step.candidates.front(), s, rejected, step.rejected_tools, job_);
      step.step = ws;
      step.operation = plan_.model.at<model::MachiningWorkingstep>(ws).its_operation;
      for (const std::size_t before : step.proposal.after) {
        if (before < made_of.size() && made_of[before]) step.after.push_back(*made_of[before]);
      }
      step.probing = std::exchange(probing, std::nullopt);
      made_of.push_back(out_.drafts.steps.size());
      tooling::use(out_.drafts.used, step.cutter.id);
      made.push_back(out_.drafts.steps.size());
      out_.drafts.steps.push_back(std::move(step));
    }
    return made;
  }

  /// Shares tools where the magazine may be too small for a chain; whether that made room.
  bool room_made_for(const model::Proposal& p) {
    const std::size_t before = out_.drafts.used.size();
    std::size_t longest = 0;
    for (const auto& chain : p.chains) longest = std::max(longest, chain.size());
    const int pockets = plan_.machine.magazine_pockets;
    if (model::changed_by_hand(plan_.machine) || before + longest <= static_cast<std::size_t>(pockets))
      return false;
    out_.drafts.used = share_tools(plan_, out_.drafts.steps,
                                   {magazine_known(choice_.usable), choice_.batch, choice_.thrift});
    return out_.drafts.used.size() < before;
  }

  ProbingDraft probing_at(const std::vector<model::ProposedStep>& chain, std::size_t i,
                          const model::Selection& tools) {
    ProbingDraft out{chain, i, {}};
    if (plan_.machine.abilities.probe && !tools.ranked.empty()) {
      out.probe = tools.ranked.front();
      tooling::use(out_.drafts.used, out.probe->cutter.id);
    }
    return out;
  }

  model::Plan& plan_;
  const Sources& sources_;
  tooling::Selections selections_;
  Choice choice_;
  Proposed& out_;
  Job& job_;
  draft::CandidatePool pool_;
  std::set<std::pair<AnyRef, std::string>> said_;
  std::map<AnyRef, std::vector<std::string>> failed_;  ///< why members cannot be made, by feature
};

}  // namespace

Proposed propose_missing(model::Plan& plan, Drafts given, const Sources& sources, Job& job) {
  Proposed out;
  out.drafts = std::move(given);
  const std::vector<AnyRef> features = wanted(plan.model, out.drafts.steps);
  if (sources.reopened) {
    warn_of_lost_threads(plan, job);
    for (const AnyRef f : features)
      plan.model.get<model::ManufacturingFeature>(f)->its_operations.items.clear();
  }
  Proposer proposer(plan, sources, out, job);
  std::size_t done = 0;
  for (const AnyRef f : features) {
    job.progress("propose", static_cast<double>(done++) / static_cast<double>(features.size()));
    poll();
    FeatureShape nameless;
    nameless.feature = f;
    nameless.name = plan.model.get<model::ManufacturingFeature>(f)->its_id.value_or("");
    // An unreadable feature might be a boss: it is not cut at all.
    if (const auto wrong = sources.unreadable.find(f); wrong != sources.unreadable.end()) {
      unplanned(plan, f, nameless, wrong->second, job);
      if (sources.choice.bans.left_out(f) == nullptr) out.left_out.emplace_back(f, wrong->second);
      continue;
    }
    const auto shapes = piece::shapes_in_piece(sources.choice.piece, f);
    if (!shapes) {
      unplanned(plan, f, nameless, shapes.error().message, job);
      continue;
    }
    if (!shapes->empty()) proposer.feature(f, rules::from_the_top(*shapes));
  }
  return out;
}

}  // namespace capstan::propose
