#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "planner/door/pipeline/stages.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/given/placed_setups.h"
#include "planner/making/probing/add_probings.h"
#include "planner/making/sequence/order.h"

// The order of proposed steps, and the workplan that says it.

namespace capstan::pipeline {
namespace {

using draft::SetupDraft;
using draft::StepDraft;
using model::Model;

constexpr std::size_t kMostWishes = 20000;  // each is held against those before it

std::string named(const Model& m, AnyRef feature) {
  const auto* f = m.get<model::ManufacturingFeature>(feature);
  return "'" + (f == nullptr ? std::string() : f->its_id.value_or("")) + "'";
}

/// Datum features first: between all shapes of the one and of the other.
std::vector<sequence::Wish> wishes_of(const Model& m, const piece::Demands& demands,
                                      const std::map<AnyRef, std::set<std::size_t>>& shapes_of) {
  std::vector<sequence::Wish> out;
  for (const model::Tie& tie : demands.ties) {
    const auto first = shapes_of.find(tie.first);
    const auto second = shapes_of.find(tie.second);
    if (tie.letter.empty() || first == shapes_of.end() || second == shapes_of.end()) continue;
    const std::string text = "datum " + tie.letter + " (" + named(m, tie.first) + ") first, before " +
                             named(m, tie.second) + ": " + tie.text;
    for (const std::size_t a : first->second) {
      for (const std::size_t b : second->second) {
        if (out.size() < kMostWishes) out.push_back({a, b, text});
      }
    }
  }
  return out;
}

/// Features that a tolerance ties together and that are not made in one set-up: said, for the tolerance then
/// holds only as well as the clamping repeats.
void warn_of_parted(const Model& m, const std::vector<StepDraft>& steps, const piece::Demands& demands,
                    Job& job) {
  std::map<AnyRef, std::set<std::size_t>> setups;
  for (const StepDraft& s : steps) {
    if (s.feature.set()) setups[s.feature].insert(s.setup);
    for (const auto& shape : s.shapes) setups[shape.feature].insert(s.setup);
  }
  std::set<std::string> said;
  for (const model::Tie& tie : demands.ties) {
    const auto a = setups.find(tie.first);
    const auto b = setups.find(tie.second);
    if (a == setups.end() || b == setups.end()) continue;
    std::set<std::size_t> both = a->second;
    both.insert(b->second.begin(), b->second.end());
    if (both.size() < 2) continue;
    const std::string datum = tie.letter.empty() ? "" : " (datum " + tie.letter + ")";
    const std::string text = named(m, tie.second) + " and " + named(m, tie.first) + datum +
                             " are not cut in one set-up, for no direction reaches both; '" + tie.text +
                             "' between them holds only as well as the part is located again";
    if (said.insert(text).second) job.warn("PIP-TIED", text);
  }
}

/// Whether `to` comes after `from` already.
bool follows(const std::vector<std::set<std::size_t>>& next, std::size_t from, std::size_t to) {
  std::set<std::size_t> seen;
  std::vector<std::size_t> pending{from};
  while (!pending.empty()) {
    const std::size_t at = pending.back();
    pending.pop_back();
    if (at == to) return true;
    if (!seen.insert(at).second) continue;
    pending.insert(pending.end(), next[at].begin(), next[at].end());
  }
  return false;
}

/// Members of one feature that are cut from the same side, all marked before all are drilled, and so on: a
/// wider hole is milled before the narrower one in it is reamed. Where a chain or the order of coaxial holes
/// wants it otherwise, that counts.
void add_craft(const std::vector<StepDraft>& drafts, const std::vector<std::size_t>& steps,
               const std::vector<sequence::Item>& items,
               std::vector<std::pair<std::size_t, std::size_t>>& given) {
  constexpr std::size_t kMost = 64;  // steps of one feature; each pair is looked at
  std::map<AnyRef, std::vector<std::size_t>> by_feature;
  for (std::size_t i = 0; i < items.size(); ++i) by_feature[drafts[steps[i]].feature].push_back(i);
  std::vector<std::set<std::size_t>> next(items.size());
  for (const auto& [a, b] : given) next[a].insert(b);
  for (const auto& [feature, own] : by_feature) {
    if (own.size() > kMost) continue;
    for (const std::size_t a : own) {
      for (const std::size_t b : own) {
        if (items[a].feature == items[b].feature && items[a].in_chain < items[b].in_chain) next[a].insert(b);
      }
    }
    for (const std::size_t a : own) {
      for (const std::size_t b : own) {
        const StepDraft& sa = drafts[steps[a]];
        const StepDraft& sb = drafts[steps[b]];
        const int ra = model::craft_rank(items[a].operation), rb = model::craft_rank(items[b].operation);
        if (items[a].feature == items[b].feature || ra == 0 || rb <= ra) continue;
        if (norm(sa.shapes.front().frame.z - sb.shapes.front().frame.z) > sequence::kSameDirection) continue;
        if (next[a].contains(b) || follows(next, b, a)) continue;
        next[a].insert(b);
        given.emplace_back(a, b);
      }
    }
  }
}

/// Whether an edit wants step `a` before step `b`.
bool wants(const model::Edit& e, const Model& m, const StepDraft& a, const StepDraft& b) {
  if (e.kind != model::EditKind::kOrder) return false;
  const auto first = draft::edit_names(m, a), second = draft::edit_names(m, b);
  const auto means = [](const std::string& pattern, const model::StepNames& s) {
    return model::names(pattern, s);
  };
  return means(e.where, first) && means(e.before, second) && !means(e.before, first) &&
         !means(e.where, second);
}

/// The operator's orders, between items.
void add_edits(const Model& m, const std::vector<model::Edit>& edits, const std::vector<StepDraft>& drafts,
               const std::vector<std::size_t>& steps,
               std::vector<std::pair<std::size_t, std::size_t>>& given) {
  for (const model::Edit& e : edits) {
    if (e.kind != model::EditKind::kOrder) continue;
    for (std::size_t a = 0; a < steps.size(); ++a) {
      for (std::size_t b = 0; b < steps.size(); ++b) {
        if (a != b && wants(e, m, drafts[steps[a]], drafts[steps[b]])) given.emplace_back(a, b);
      }
    }
  }
}

/// Steps of a file keep the file's order and come first; what rules proposed follows, ordered.
Result<sequence::Order> order_of(const Model& m, const Drafts& drafts, const piece::Demands& demands,
                                 const std::vector<std::size_t>& proposed,
                                 const std::vector<model::Edit>& edits, Job& job) {
  std::vector<model::FeatureShape> shapes;
  std::vector<sequence::Item> items;
  std::map<std::size_t, std::size_t> item_of;  // step -> item
  std::map<AnyRef, int> chain;
  std::map<AnyRef, std::set<std::size_t>> shapes_of;
  sequence::Options options;
  for (const std::size_t i : proposed) {
    const StepDraft& s = drafts.steps[i];
    sequence::Item item;
    // One shape represents a whole pattern: its members are made one after the other.
    item.feature = shapes.size();
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      if (shapes[k].feature == s.shapes.front().feature && shapes[k].member == s.shapes.front().member)
        item.feature = k;
    }
    if (item.feature == shapes.size()) shapes.push_back(s.shapes.front());
    shapes_of[s.feature].insert(item.feature);
    shapes_of[s.shapes.front().feature].insert(item.feature);
    item.in_chain = chain[s.feature]++;
    item.name = s.proposal.name;
    item.cutter_id = s.cutter.id;
    item.operation = s.operation.type;
    item_of[i] = items.size();
    items.push_back(std::move(item));
  }
  for (const std::size_t i : proposed) {
    for (const std::size_t before : drafts.steps[i].after) {
      if (item_of.contains(before)) options.given.emplace_back(item_of[before], item_of[i]);
    }
  }
  add_edits(m, edits, drafts.steps, proposed, options.given);
  add_craft(drafts.steps, proposed, items, options.given);
  options.wishes = wishes_of(m, demands, shapes_of);
  for (const SetupDraft& s : drafts.setups)
    options.directions.push_back(s.workpiece.direction_to_local({0.0, 0.0, 1.0}));
  return sequence::order(shapes, items, options, job);
}

Ref<model::Workplan> plan_of(Model& m, const std::string& id, Ref<model::Setup> setup) {
  model::Workplan p;
  p.its_id = id;
  p.its_setup = setup;
  p.its_elements.given = true;
  return m.add(p);
}

/// The main workplan: what it held before (unless operations were re-opened), then the new steps by set-up.
void rebuild_workplan(model::Plan& plan, const Drafts& drafts, bool keep) {
  Model& m = plan.model;
  auto* project = m.get<model::Project>(plan.project);
  if (project == nullptr) {
    model::Project p;
    p.its_id = "project";
    p.its_workpieces.given = true;
    for (const AnyRef piece : m.all(model::TypeId::kWorkpiece))
      p.its_workpieces.push_back(Ref<model::Workpiece>(piece));
    plan.project = m.add(p);
    project = m.get<model::Project>(plan.project);
  }
  const auto* old = m.get<model::Workplan>(project->main_workplan);
  const std::string id = old != nullptr ? old->its_id.value_or("main workplan") : "main workplan";
  const bool one_setup = drafts.setups.size() == 1;
  Ref<model::Workplan> main;
  if (keep && old != nullptr) {
    main = project->main_workplan;
  } else {
    main = plan_of(m, id, one_setup ? drafts.setups.front().setup : Ref<model::Setup>{});
    m.get<model::Project>(plan.project)->main_workplan = main;
  }
  Ref<model::Workplan> into = main;
  std::size_t last = drafts.setups.size();
  const bool nest = !one_setup || (keep && old != nullptr && !m.at<model::Workplan>(main).its_setup.set());
  for (const StepDraft& s : drafts.steps) {
    if (!s.proposed) continue;
    if (nest && s.setup != last) {
      into = plan_of(m, "set-up " + std::to_string(s.setup + 1), drafts.setups[s.setup].setup);
      m.at<model::Workplan>(main).its_elements.push_back(into);
      last = s.setup;
    }
    m.at<model::Workplan>(into).its_elements.push_back(s.step);
    if (const auto* setup = m.get<model::Setup>(drafts.setups[s.setup].setup)) {
      const auto plane = setup->its_secplane;
      if (auto* ws = m.get<model::Workingstep>(s.step)) ws->its_secplane = plane;
    }
  }
}

std::string words(const sequence::Order& order) {
  std::string out = std::to_string(order.precedences.size()) + " precedences kept, " +
                    std::to_string(order.tool_changes) + " tool changes";
  std::size_t said = 0;
  std::set<std::string> texts;
  for (const bool datums : {true, false}) {
    for (const auto& p : order.precedences) {
      if (p.cause == sequence::Cause::kChain || p.text.empty()) continue;
      if ((p.cause == sequence::Cause::kDatum) != datums || !texts.insert(p.text).second) continue;
      out += "; " + p.text;
      if (++said == 12) return out;
    }
  }
  return out;
}

/// Set-ups without a step are not clamped.
void drop_empty_setups(Drafts& drafts) {
  std::vector<std::size_t> renumbered(drafts.setups.size(), 0);
  std::vector<SetupDraft> used;
  for (std::size_t i = 0; i < drafts.setups.size(); ++i) {
    const bool has =
        std::any_of(drafts.steps.begin(), drafts.steps.end(), [i](const auto& s) { return s.setup == i; });
    if (!has && drafts.setups.size() > 1) continue;
    renumbered[i] = used.size();
    used.push_back(drafts.setups[i]);
  }
  if (used.empty()) return;
  for (StepDraft& s : drafts.steps) s.setup = renumbered[s.setup];
  drafts.setups = std::move(used);
}

}  // namespace

Result<Drafted> order_steps(model::Plan plan, Drafts drafts, const Required& required, const Asked& asked,
                            Job& job) {
  const piece::Demands& demands = required.demands;
  Learned learned;
  given::tell_leaning_setups(plan, drafts.setups, drafts.steps, job);
  drop_empty_setups(drafts);
  std::vector<StepDraft>& steps = drafts.steps;
  std::vector<std::size_t> given;
  std::vector<std::size_t> proposed;
  for (std::size_t i = 0; i < steps.size(); ++i) (steps[i].proposed ? proposed : given).push_back(i);
  if (proposed.empty()) {
    warn_of_parted(plan.model, steps, demands, job);
    return Drafted{std::move(plan), std::move(drafts), std::move(learned)};
  }
  const auto order = order_of(plan.model, drafts, demands, proposed, asked.inputs.edits, job);
  if (!order) return tl::unexpected(order.error());
  if (!order->cannot.empty()) {
    std::string wanted;
    for (const model::Edit& e : asked.inputs.edits) {
      if (e.kind == model::EditKind::kOrder) wanted += "; wanted is " + model::words_of(e);
    }
    return fail("PIP-ORDER", "the steps have no order that keeps every rule: " + order->cannot + wanted);
  }
  std::vector<StepDraft> sorted;
  for (const std::size_t i : given) sorted.push_back(std::move(steps[i]));
  for (const auto& setup : order->setups) {
    for (const std::size_t item : setup.steps) sorted.push_back(std::move(steps[proposed[item]]));
  }
  auto added = probing::add_probings(std::move(plan), std::move(sorted), required.shapes, demands, job);
  plan = std::move(added.plan);
  steps = std::move(added.steps);
  learned.again = !added.given_up.empty();
  learned.given_up = std::move(added.given_up);
  for (const auto& d : order->dropped)
    job.note("PIP-ORDER", "order not kept: " + d.text +
                              "; it contradicts an order that must hold, or needs a further set-up");
  warn_of_parted(plan.model, steps, demands, job);
  rebuild_workplan(plan, drafts, !given.empty());
  const auto* project = plan.model.get<model::Project>(plan.project);
  plan.ledger.bind(project->main_workplan, "its_elements", model::Binder::kRule,
                   {"sequence.order", words(*order),
                    "precedences by geometry and chain; few tool changes (planner/making/sequence)"});
  return Drafted{std::move(plan), std::move(drafts), std::move(learned)};
}

}  // namespace capstan::pipeline
