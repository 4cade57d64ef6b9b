#include "planner/app/show/node.h"

#include <algorithm>
#include <charconv>

#include "planner/app/show/values.h"
#include "planner/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/walk.h"

namespace capstan::app {

using model::AnyRef;
using model::Model;
using model::Storage;
using model::value_of;

namespace {

constexpr std::size_t kSegments = 256;  // of one path

tl::unexpected<Diagnostic> fault(std::string_view path, std::string message, std::string expected = {}) {
  return fail({.code = "INS-PATH",
               .message = std::move(message),
               .path = std::string(path),
               .expected = std::move(expected)});
}

/// "/a[0]" -> {"a", "[0]"}; the first of "#12/a" is "#12".
Result<std::vector<std::string>> segments_of(std::string_view path) {
  std::vector<std::string> out;
  std::size_t i = 0;
  while (i < path.size()) {
    if (path[i] == '[') {
      const auto end = path.find(']', i);
      if (end == std::string_view::npos) return fault(path, "a bracket is not closed", "']'");
      out.emplace_back(path.substr(i, end + 1 - i));
      i = end + 1;
    } else {
      if (path[i] == '/') ++i;
      const auto end = std::min(path.find_first_of("/[", i), path.size());
      if (end == i) {
        if (i == path.size()) break;  // a slash at the end
        return fault(path, "a segment has no name");
      }
      out.emplace_back(path.substr(i, end - i));
      i = end;
    }
    if (out.size() > kSegments) return fault(path, "the path has more than 256 segments");
  }
  return out;
}

std::optional<std::uint64_t> whole(std::string_view s) {
  std::uint64_t v = 0;
  const auto [end, ec] = std::from_chars(s.data(), s.data() + s.size(), v);
  if (ec != std::errc() || end != s.data() + s.size() || s.empty()) return std::nullopt;
  return v;
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

std::vector<AnyRef> unhandled(const Model& m) { return m.all(model::TypeId::kKeptInstance); }

Result<Node> root_of(const model::Plan& plan, std::string_view path, const std::string& name) {
  const Model& m = plan.model;
  if (name == "project") {
    if (!plan.project.set()) return fault(path, "the plan has no project");
    return object_node(plan.project);
  }
  if (name == "kept") return list_node(plan.kept);
  if (name == "unhandled") return list_node(unhandled(m));
  if (name.starts_with('#')) {
    const auto n = whole(std::string_view(name).substr(1));
    if (!n || *n == 0) return fault(path, "'" + name + "' is not an instance number", "#1, #2, ...");
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      for (const AnyRef at : m.all(static_cast<model::TypeId>(t))) {
        if (m.origin(at).instance == *n) return object_node(at);
      }
    }
    return fault(path, "there is no instance " + name);
  }
  if (const auto type = model::find_noun(name)) return list_node(m.all_below(*type));
  return fault(path, "there is no '" + name + "' at the top",
               "project, unhandled, kept, #<instance number>, or a kind of object such as ROUND_HOLE");
}

std::string names_of(model::TypeId type) {
  std::string out;
  for (const auto& a : model::noun_type(type).attributes) {
    if (!out.empty()) out += ", ";
    out += a.name;
  }
  return out.empty() ? "nothing: it has no attributes" : out;
}

Node item_of(const Node& list, std::size_t i) {
  if (list.is_list) return object_node(list.list[i]);
  Node out = list;
  out.item.push_back(i);
  return out;
}

/// Where a name leads from one node. `mapped`: nothing instead of a fault where the attribute is not there.
Result<std::optional<Node>> step_into(const Model& m, const Node& from, const std::string& name,
                                      std::string_view path, bool mapped) {
  const AnyRef at = object_of(m, from);
  if (!at.set()) {
    if (mapped) return std::nullopt;
    if (list_size(m, from))
      return fault(path, "'" + name + "' is asked of a list", "an index [0], or [*] for all of it");
    const std::string what = node_text(m, from);
    if (what == "absent")
      return fault(path, "'" + name + "' is asked of " + std::string(from.attribute->name) +
                             ", which is absent on " + label(m, from.object));
    return fault(path, "'" + name + "' is asked of a value (" + what + "), which has no attributes");
  }
  if (m.holds<model::KeptInstance>(at)) {
    if (mapped) return std::nullopt;
    return fault(path, label(m, at) + " is kept as it was read; its attributes have no names");
  }
  const model::Attribute* a = model::find_attribute(at.type, name);
  if (a == nullptr) {
    if (mapped) return std::nullopt;
    return fault(path, label(m, at) + " has no attribute '" + name + "'", names_of(at.type));
  }
  Node out = object_node(at);
  out.attribute = a;
  return out;
}

Result<std::vector<Node>> index_into(const Model& m, const Node& from, const std::string& bracket,
                                     std::string_view path, bool mapped) {
  const auto size = list_size(m, from);
  if (!size) {
    if (mapped) return std::vector<Node>{};
    return fault(path, "'" + bracket + "' is asked of what is no list: " + node_text(m, from));
  }
  const std::string inside = bracket.substr(1, bracket.size() - 2);
  if (inside == "*") {
    std::vector<Node> out;
    for (std::size_t i = 0; i < *size; ++i) out.push_back(item_of(from, i));
    return out;
  }
  const auto i = whole(inside);
  if (!i) return fault(path, "'" + bracket + "' is not an index", "[0], [1], ... or [*]");
  if (*i >= *size) {
    if (mapped) return std::vector<Node>{};
    return fault(path, "'" + bracket + "' is past the end of the list",
                 *size == 0 ? "nothing: the list is empty" : "[0] to [" + std::to_string(*size - 1) + "]");
  }
  return std::vector<Node>{item_of(from, static_cast<std::size_t>(*i))};
}

}  // namespace

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

Result<std::vector<Node>> nodes_at(const model::Plan& plan, std::string_view path) {
  const auto segments = segments_of(path);
  if (!segments) return tl::unexpected(segments.error());
  if (segments->empty()) return fault(path, "the path is empty", "/project, or #<instance number>");
  if (segments->front().starts_with('['))
    return fault(path, "a path does not begin with an index", "/project, or #<instance number>");
  const auto root = root_of(plan, path, segments->front());
  if (!root) return tl::unexpected(root.error());
  std::vector<Node> at = {*root};
  bool mapped = false;
  for (std::size_t i = 1; i < segments->size(); ++i) {
    const std::string& segment = (*segments)[i];
    std::vector<Node> next;
    std::optional<Diagnostic> why;
    for (const Node& n : at) {
      if (segment.starts_with('[')) {
        auto items = index_into(plan.model, n, segment, path, mapped);
        if (!items) return tl::unexpected(items.error());
        next.insert(next.end(), items->begin(), items->end());
      } else {
        auto to = step_into(plan.model, n, segment, path, mapped);
        if (!to) return tl::unexpected(to.error());
        if (*to) next.push_back(**to);
      }
    }
    if (next.empty() && !at.empty() && mapped) {
      // Nowhere at all: say what is wrong with the first.
      if (segment.starts_with('[')) {
        const auto none = index_into(plan.model, at.front(), segment, path, false);
        if (!none) return tl::unexpected(none.error());
      } else {
        const auto none = step_into(plan.model, at.front(), segment, path, false);
        if (!none) return tl::unexpected(none.error());
      }
    }
    mapped = mapped || segment == "[*]";
    at = std::move(next);
  }
  return at;
}

}  // namespace capstan::app
