#include "planner/door/app/show/node.h"

#include <algorithm>

#include "planner/door/app/show/condition.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::app {

using model::AnyRef;
using model::Model;
using model::Storage;
using model::value_of;
using service::label;
using service::value_text;
using service::with_unit;

namespace {

tl::unexpected<Diagnostic> fault(const Query& q, const QueryStep& at, const std::string& message,
                                 std::string expected = {}) {
  return query_fault(q.text, at.position, message, std::move(expected));
}

Node object_node(AnyRef at) {
  Node n;
  n.object = at;
  return n;
}
Node list_node(std::vector<AnyRef> items) {
  Node n;
  n.is_list = true;
  n.list = std::move(items);
  return n;
}

/// A node of objects that a search found; an attribute is then read from each of them.
Node objects_node(std::vector<AnyRef> items) {
  Node n = list_node(std::move(items));
  n.spread = true;
  return n;
}

/// All objects of a kind that the roots reach, without the roots; of the whole plan if there are no roots.
std::vector<AnyRef> below(const model::Plan& plan, std::vector<AnyRef> roots, model::TypeId type) {
  const bool whole_plan = roots.empty();
  if (whole_plan) {
    if (plan.project.set()) roots.push_back(plan.project);
    for (const AnyRef f : plan.model.all_below(model::TypeId::kManufacturingFeature)) roots.push_back(f);
    roots.insert(roots.end(), plan.kept.begin(), plan.kept.end());
  }
  std::vector<AnyRef> out;
  for (const AnyRef at : model::reachable(plan.model, roots)) {
    const bool root = !whole_plan && std::find(roots.begin(), roots.end(), at) != roots.end();
    if (!root && model::is_a(at.type, type)) out.push_back(at);
  }
  return out;
}

std::vector<AnyRef> unhandled(const Model& m) { return m.all(model::TypeId::kKeptInstance); }

Result<Node> root_of(const model::Plan& plan, const Query& q) {
  const Model& m = plan.model;
  const QueryStep& root = q.steps.front();
  if (root.kind == QueryStep::Kind::kBelow) return objects_node(below(plan, {}, root.type));
  if (root.name == "project") {
    if (!plan.project.set()) return fault(q, root, "the plan has no project");
    return object_node(plan.project);
  }
  if (root.name == "kept") return list_node(plan.kept);
  if (root.name == "unhandled") return list_node(unhandled(m));
  if (root.type != model::TypeId::kNone) return list_node(m.all_below(root.type));
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    for (const AnyRef at : m.all(static_cast<model::TypeId>(t))) {
      if (m.origin(at).instance == root.index) return object_node(at);
    }
  }
  return fault(q, root, "there is no instance " + root.name);
}

std::string names_of(model::TypeId type) {
  std::string out;
  for (const auto& a : model::noun_type(type).attributes) {
    if (!out.empty()) out += ", ";
    out += a.name;
  }
  return out.empty() ? "nothing: it has no attributes" : out;
}

/// Where a name leads from one node. `mapped`: nothing instead of a fault where the attribute is not there.
Result<std::optional<Node>> step_into(const Model& m, const Node& from, const Query& q, const QueryStep& step,
                                      bool mapped) {
  const std::string& name = step.name;
  const AnyRef at = object_of(m, from);
  if (!at.set()) {
    if (mapped) return std::nullopt;
    if (list_size(m, from))
      return fault(q, step, "'" + name + "' is an attribute, and this is a list",
                   "an index [0], or [*] for all of it");
    const std::string what = node_text(m, from);
    if (what == "absent")
      return fault(q, step,
                   "'" + name + "' is an attribute of " + std::string(from.attribute->name) +
                       ", which is absent on " + label(m, from.object));
    return fault(q, step,
                 "'" + name + "' is an attribute, and this is a value (" + what + "), which has none");
  }
  if (m.holds<model::KeptInstance>(at)) {
    if (mapped) return std::nullopt;
    return fault(q, step, label(m, at) + " is kept as it was read; its attributes have no names");
  }
  const model::Attribute* a = model::find_attribute(at.type, name);
  if (a == nullptr) {
    if (mapped) return std::nullopt;
    return fault(q, step, label(m, at) + " has no attribute '" + name + "'", names_of(at.type));
  }
  Node out = object_node(at);
  out.attribute = a;
  return out;
}

Result<std::vector<Node>> index_into(const Model& m, const Node& from, const Query& q, const QueryStep& step,
                                     bool mapped) {
  const auto size = list_size(m, from);
  if (!size) {
    if (mapped) return std::vector<Node>{};
    return fault(q, step, "'" + step.name + "' needs a list; this is none: " + node_text(m, from));
  }
  if (step.kind == QueryStep::Kind::kAll) {
    std::vector<Node> out;
    for (std::size_t i = 0; i < *size; ++i) out.push_back(item_of(from, i));
    return out;
  }
  if (step.index >= *size) {
    if (mapped) return std::vector<Node>{};
    return fault(q, step, "'" + step.name + "' is past the end of the list",
                 *size == 0 ? "nothing: the list is empty" : "[0] to [" + std::to_string(*size - 1) + "]");
  }
  return std::vector<Node>{item_of(from, step.index)};
}

/// The objects that a node is: itself, or the items of its list.
std::vector<AnyRef> objects_in(const Model& m, const Node& node) {
  if (node.is_list) return node.list;
  if (const AnyRef at = object_of(m, node); at.set()) return {at};
  std::vector<AnyRef> out;
  for (std::size_t i = 0; i < list_size(m, node).value_or(0); ++i) {
    const Node item = item_of(node, i);
    if (const AnyRef at = object_of(m, item); at.set()) out.push_back(at);
    for (std::size_t k = 0; k < list_size(m, item).value_or(0); ++k) {
      if (const AnyRef at = object_of(m, item_of(item, k)); at.set()) out.push_back(at);
    }
  }
  return out;
}

Result<Node> filtered(const Model& m, const Node& from, const Query& q, const QueryStep& step, bool mapped) {
  const auto all = objects_in(m, from);
  if (all.empty() && !mapped && !from.is_list && !list_size(m, from))
    return fault(q, step, "a condition needs an object or a list; this is neither: " + node_text(m, from));
  auto passing = objects_where(m, all, q, step.condition);
  if (!passing) return tl::unexpected(passing.error());
  return objects_node(*std::move(passing));
}

/// One step from one node.
Result<std::vector<Node>> follow(const model::Plan& plan, const Node& from, const Query& q,
                                 const QueryStep& step, bool mapped) {
  const Model& m = plan.model;
  switch (step.kind) {
    case QueryStep::Kind::kBelow: {
      const auto roots = objects_in(m, from);
      if (roots.empty()) return std::vector<Node>{};
      return std::vector<Node>{objects_node(below(plan, roots, step.type))};
    }
    case QueryStep::Kind::kFilter: {
      auto node = filtered(m, from, q, step, mapped);
      if (!node) return tl::unexpected(node.error());
      return std::vector<Node>{*std::move(node)};
    }
    case QueryStep::Kind::kIndex:
    case QueryStep::Kind::kAll:
      return index_into(m, from, q, step, mapped);
    default:
      break;
  }
  std::vector<Node> out;
  const auto one = [&](const Node& node, bool lenient) -> Status {
    auto to = step_into(m, node, q, step, lenient);
    if (!to) return tl::unexpected(to.error());
    if (*to) out.push_back(**to);
    return {};
  };
  if (!from.spread) {
    if (auto ok = one(from, mapped); !ok) return tl::unexpected(ok.error());
    return out;
  }
  for (const AnyRef at : from.list) {
    if (auto ok = one(object_node(at), true); !ok) return tl::unexpected(ok.error());
  }
  // Nowhere at all: say what is wrong with the first.
  if (out.empty() && !from.list.empty()) {
    if (auto ok = one(object_node(from.list.front()), false); !ok) return tl::unexpected(ok.error());
  }
  return out;
}

}  // namespace

Node item_of(const Node& list, std::size_t i) {
  if (list.is_list) return object_node(list.list[i]);
  Node out = list;
  out.item.push_back(i);
  return out;
}

std::optional<std::size_t> list_size(const Model& m, const Node& node) {
  if (node.is_list) return node.list.size();
  if (node.attribute == nullptr) return std::nullopt;
  const auto& a = *node.attribute;
  const void* o = m.object(node.object);
  const std::size_t depth = node.item.size();
  const bool table = a.storage == Storage::kRefTable || a.storage == Storage::kRealTable;
  if (depth >= (table ? 2U : 1U)) return std::nullopt;
  if (table && depth == 1) {
    const std::size_t row = node.item[0];
    return a.storage == Storage::kRefTable ? value_of<model::RefTable>(a, o).items[row].size()
                                           : value_of<model::RealTable>(a, o).items[row].size();
  }
  switch (a.storage) {
    case Storage::kRefList:
      return value_of<model::AnyRefList>(a, o).items.size();
    case Storage::kSelectList:
      return value_of<model::SelectList>(a, o).items.size();
    case Storage::kRealList:
      return value_of<model::RealList>(a, o).items.size();
    case Storage::kIntegerList:
      return value_of<model::IntegerList>(a, o).items.size();
    case Storage::kTextList:
      return value_of<model::TextList>(a, o).items.size();
    case Storage::kRefTable:
      return value_of<model::RefTable>(a, o).items.size();
    case Storage::kRealTable:
      return value_of<model::RealTable>(a, o).items.size();
    default:
      return std::nullopt;
  }
}

AnyRef object_of(const Model& m, const Node& node) {
  if (node.is_list) return {};
  if (node.attribute == nullptr) return node.object;
  const auto& a = *node.attribute;
  const void* o = m.object(node.object);
  const std::size_t depth = node.item.size();
  if (a.storage == Storage::kRef) return value_of<AnyRef>(a, o);
  if (a.storage == Storage::kSelect) return value_of<model::SelectValue>(a, o).ref;
  if (a.storage == Storage::kRefList && depth == 1)
    return value_of<model::AnyRefList>(a, o).items[node.item[0]];
  if (a.storage == Storage::kSelectList && depth == 1)
    return value_of<model::SelectList>(a, o).items[node.item[0]].ref;
  if (a.storage == Storage::kRefTable && depth == 2)
    return value_of<model::RefTable>(a, o).items[node.item[0]][node.item[1]];
  return {};
}

std::string node_text(const Model& m, const Node& node) {
  if (node.is_list) {
    std::string out = "(";
    for (std::size_t i = 0; i < node.list.size(); ++i) out += (i != 0 ? ", " : "") + label(m, node.list[i]);
    return out + ")";
  }
  const AnyRef at = object_of(m, node);
  if (at.set()) return label(m, at);
  const auto& a = *node.attribute;
  const void* o = m.object(node.object);
  if (node.item.empty()) return value_text(m, a, o);
  const std::size_t i = node.item[0];
  switch (a.storage) {
    case Storage::kRealList:
      return with_unit(value_of<model::RealList>(a, o).items[i], a.unit);
    case Storage::kIntegerList:
      return std::to_string(value_of<model::IntegerList>(a, o).items[i]);
    case Storage::kTextList:
      return "'" + value_of<model::TextList>(a, o).items[i] + "'";
    case Storage::kSelectList: {
      const auto& v = value_of<model::SelectList>(a, o).items[i];
      return v.real ? shortest(*v.real) : v.text;
    }
    case Storage::kRealTable: {
      const auto& row = value_of<model::RealTable>(a, o).items[i];
      if (node.item.size() == 2) return with_unit(row[node.item[1]], a.unit);
      std::string out = "(";
      for (std::size_t k = 0; k < row.size(); ++k) out += (k != 0 ? ", " : "") + shortest(row[k]);
      return out + ")";
    }
    case Storage::kRefTable: {
      std::string out = "(";
      const auto& row = value_of<model::RefTable>(a, o).items[i];
      for (std::size_t k = 0; k < row.size(); ++k) out += (k != 0 ? ", " : "") + label(m, row[k]);
      return out + ")";
    }
    default:
      return "absent";
  }
}

Result<std::vector<Node>> nodes_at(const model::Plan& plan, const Query& q) {
  const auto root = root_of(plan, q);
  if (!root) return tl::unexpected(root.error());
  std::vector<Node> at = {*root};
  bool mapped = false;
  for (std::size_t i = 1; i < q.steps.size(); ++i) {
    const QueryStep& step = q.steps[i];
    std::vector<Node> next;
    for (const Node& n : at) {
      auto to = follow(plan, n, q, step, mapped);
      if (!to) return tl::unexpected(to.error());
      next.insert(next.end(), to->begin(), to->end());
    }
    if (next.empty() && !at.empty() && mapped && step.kind != QueryStep::Kind::kBelow) {
      const auto none = follow(plan, at.front(), q, step, false);
      if (!none) return tl::unexpected(none.error());
    }
    mapped = mapped || step.kind == QueryStep::Kind::kAll || next.size() > 1 ||
             std::any_of(next.begin(), next.end(), [](const Node& n) { return n.spread; });
    at = std::move(next);
  }
  std::vector<Node> out;
  for (Node& n : at) {
    if (!n.spread) {
      out.push_back(std::move(n));
      continue;
    }
    for (const AnyRef item : n.list) out.push_back(object_node(item));
  }
  return out;
}

Result<std::vector<Node>> nodes_at(const model::Plan& plan, std::string_view path) {
  const auto q = parse_query(path);
  if (!q) return tl::unexpected(q.error());
  return nodes_at(plan, *q);
}

}  // namespace capstan::app
