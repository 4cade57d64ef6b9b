#include <algorithm>
#include <map>

#include "planner/files/exchange/ap238/read/auxiliary.h"
#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/files/exchange/common/file_sections.h"
#include "planner/files/exchange/common/text.h"
#include "planner/model/nouns/all.h"

// Keeps instances that the mapping does not explain verbatim, still connected: to application objects, to
// instances of an object's mapping, and to other kept ones.

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::TypeId;

AnyRef Reader::kept_at(Node n) {
  if (kept_[n].set()) return kept_[n];
  const AnyRef at = plan_.model.add_object(TypeId::kKeptInstance);
  const auto i = g_.instance(n);
  plan_.model.set_origin(at, {i.id(), i.line()});
  kept_[n] = at;
  kept_pending_.push_back(n);
  return at;
}

AnyRef Reader::auxiliary(Node n) {
  const auto it = auxiliary_.find(n);
  if (it != auxiliary_.end()) return it->second;
  const Role& role = owner_[n];
  const AnyRef at = plan_.model.add(
      auxiliary_instance(role.owner, {std::string(map_.prefix_text(role.prefix)), role.ordinal}));
  const auto i = g_.instance(n);
  plan_.model.set_origin(at, {i.id(), i.line()});
  auxiliary_.emplace(n, at);
  return at;
}

// The target of a reference in kept text; nothing if the file has no such instance.
AnyRef Reader::connected(std::uint64_t id) {
  const Node to = g_.find(id);
  if (to == kNoNode) return {};
  if (const auto noun = nouns_.find(to); noun != nouns_.end()) return noun->second;
  // Geometry that was read in the model's own units is written back the same.
  for (std::uint32_t s = 0; s < scales_.size(); ++s) {
    if (!scales_[s].identity()) continue;
    if (const AnyRef g = geometry_met(to, s); g.set()) return g;
  }
  if (owner_[to].set()) return auxiliary(to);
  return kept_at(to);
}

void Reader::fill_kept() {
  while (!kept_pending_.empty()) {
    const Node n = kept_pending_.front();
    kept_pending_.pop_front();
    auto kept = keep(g_.instance(n), [&](std::uint64_t id) { return connected(id); });
    kept.schema = model::KeptSchema::kAp238;
    plan_.model.at<model::KeptInstance>(kept_[n]) = std::move(kept);
  }
}

void Reader::keep_the_rest() {
  fill_kept();
  std::vector<bool> explained(g_.size(), false);
  for (const Node n : units_.used()) explained[n] = true;
  for (const char* entity :
       {"APPLICATION_CONTEXT", "APPLICATION_CONTEXT_ELEMENT", "APPLICATION_PROTOCOL_DEFINITION"}) {
    const EntityId e = g_.schema().find(entity);  // every file has them; written anew
    for (Node n = 0; n < g_.size(); ++n) explained[n] = explained[n] || g_.is(n, e);
  }
  // Shapes that an attribute leads to are explained; verbatim is how the model has them.
  for (const char* entity : {"REPRESENTATION", "REPRESENTATION_ITEM"}) {
    const EntityId e = g_.schema().find(entity);
    for (Node n = 0; n < g_.size(); ++n) explained[n] = explained[n] || (kept_[n].set() && g_.is(n, e));
  }
  // Geometry that nothing refers to is in the units of the file.
  for (Node n = 0; n < g_.size(); ++n) {
    if (used(n) || explained[n] || kept_[n].set() || !g_.users(n).empty()) continue;
    if (const auto type = geometry_type(n)) plan_.kept.push_back(geometry_at(n, *type, default_scale_));
  }
  drain();
  std::vector<Node> rest;
  std::map<std::string, std::pair<std::size_t, Node>> kinds;
  for (Node n = 0; n < g_.size(); ++n) {
    if (used(n) || explained[n] || kept_[n].set()) continue;
    rest.push_back(n);
    kept_at(n);
  }
  fill_kept();
  for (Node n = 0; n < g_.size(); ++n) {
    if (!kept_[n].set() || explained[n]) continue;
    auto& kind =
        kinds.emplace(plan_.model.at<model::KeptInstance>(kept_[n]).keyword, std::pair(std::size_t{0}, n))
            .first->second;
    ++kind.first;
    kind.second = std::min(kind.second, n);
  }
  // Roots first: what no other kept instance refers to; then, for circles, whatever is left.
  std::vector<bool> reached(g_.size(), false);
  const auto reach = [&](Node root) {
    plan_.kept.push_back(kept_[root]);
    std::vector<Node> pending = {root};
    while (!pending.empty()) {
      const Node n = pending.back();
      pending.pop_back();
      if (reached[n]) continue;
      reached[n] = true;
      const auto i = g_.instance(n);
      for (std::size_t k = 0; k < i.part_count(); ++k) g_.references(i.part(k).parameters, pending);
    }
  };
  for (const Node n : rest) {
    const auto users = g_.users(n);
    if (std::none_of(users.begin(), users.end(), [&](Node u) { return u != n && kept_[u].set(); })) reach(n);
  }
  for (const Node n : rest) {
    if (!reached[n]) reach(n);
  }
  keep_sections(
      g_.file(), model::KeptSchema::kAp238, [&](std::uint64_t id) { return connected(id); }, plan_,
      reporter_);
  fill_kept();
  for (const auto& [keyword, kind] : kinds) {
    about(kind.second, {.code = "EXC-KEPT",
                        .severity = Severity::kNote,
                        .message = keyword + " is kept as it is and not acted on" +
                                   (kind.first == 1 ? "" : " (" + std::to_string(kind.first) + " of them)")});
  }
}

}  // namespace capstan::exchange::ap238
