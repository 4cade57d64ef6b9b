#include "planner/files/exchange/ap238/read/graph.h"

#include <string>

namespace capstan::exchange::ap238 {

using p21::Kind;
using p21::Value;

// Not recursive beyond the parser's limit of depth.
template <class Visit>
void Graph::for_each_reference(const Value& v, const Visit& visit) const {
  if (v.is(Kind::kReference)) {
    if (const Node n = find(v.reference()); n != kNoNode) visit(n);
  } else if (v.is(Kind::kList) || v.is(Kind::kTyped)) {
    for (std::size_t i = 0; i < v.size(); ++i) for_each_reference(v[i], visit);
  }
}

Graph::Graph(const p21::File& file, const express::Dictionary& schema) : file_(file), schema_(schema) {
  const auto n = static_cast<std::uint32_t>(file.size());
  entity_.reserve(n);
  first_.assign(n + 1, 0);
  const auto each = [&](const auto& visit) {
    std::vector<Node> last(n, kNoNode);  // each user once, however often it refers
    for (Node at = 0; at < n; ++at) {
      const p21::Instance i = file.instance(at);
      for (std::size_t k = 0; k < i.part_count(); ++k) {
        for_each_reference(i.part(k).parameters, [&](Node to) {
          if (last[to] == at) return;
          last[to] = at;
          visit(at, to);
        });
      }
    }
  };
  // Most instances are of the keyword of the one before.
  std::string_view keyword;
  EntityId entity = express::kNoEntity;
  for (Node at = 0; at < n; ++at) {
    const p21::Instance i = file.instance(at);
    if (!i.is_complex() && i.keyword() != keyword) {
      keyword = i.keyword();
      entity = schema.find(keyword);
    }
    entity_.push_back(i.is_complex() ? express::kNoEntity : entity);
  }
  each([&](Node, Node to) { ++first_[to + 1]; });
  for (std::uint32_t i = 0; i < n; ++i) first_[i + 1] += first_[i];
  users_.resize(first_[n]);
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  each([&](Node from, Node to) { users_[next[to]++] = from; });
}

Node Graph::find(std::uint64_t id) const {
  const auto i = file_.find(id);
  return i ? static_cast<Node>(i->index()) : kNoNode;
}

bool Graph::is(Node n, EntityId e) const {
  if (entity_[n] != express::kNoEntity) return schema_.is_a(entity_[n], e);
  const p21::Instance i = file_.instance(n);
  if (!i.is_complex()) return false;
  for (std::size_t k = 0; k < i.part_count(); ++k) {
    const EntityId part = schema_.find(i.part(k).keyword);
    if (part != express::kNoEntity && schema_.is_a(part, e)) return true;
  }
  return false;
}

bool Graph::is_all(Node n, std::span<const EntityId> es) const {
  for (const EntityId e : es) {
    if (!is(n, e)) return false;
  }
  return true;
}

Value Graph::get(Node n, std::string_view attribute) const {
  const auto dot = attribute.find('.');
  const std::string_view bare = dot == std::string_view::npos ? attribute : attribute.substr(dot + 1);
  const EntityId owner =
      dot == std::string_view::npos ? express::kNoEntity : schema_.find(attribute.substr(0, dot));
  const auto parameter = [](const Value& list, std::size_t i) {
    return list.is(Kind::kList) && i < list.size() ? list[i] : Value{};
  };
  const p21::Instance i = file_.instance(n);
  if (entity_[n] != express::kNoEntity) {
    const auto slots = schema_.slots(entity_[n]);
    for (std::size_t k = 0; k < slots.size(); ++k) {
      if (slots[k].attribute->name != bare) continue;
      if (owner != express::kNoEntity && slots[k].attribute->owner != owner) continue;
      return parameter(i.parameters(), k);
    }
    return {};
  }
  if (!i.is_complex()) return {};
  Value omitted;
  for (std::size_t p = 0; p < i.part_count(); ++p) {
    const EntityId part = schema_.find(i.part(p).keyword);
    if (part == express::kNoEntity || (owner != express::kNoEntity && part != owner)) continue;
    const auto own = schema_.own(part);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (own[k].name != bare) continue;
      const Value v = parameter(i.part(p).parameters, k);
      if (!v.is(Kind::kOmitted)) return v;
      omitted = v;
    }
  }
  return omitted;
}

Node Graph::referred(Node n, std::string_view attribute) const {
  const Value v = get(n, attribute);
  return v.is(Kind::kReference) ? find(v.reference()) : kNoNode;
}

std::string Graph::text(Node n, std::string_view attribute) const {
  const Value v = get(n, attribute);
  return v.is(Kind::kString) ? v.as_text() : std::string();
}

std::span<const Node> Graph::users(Node n) const {
  return std::span(users_).subspan(first_[n], first_[n + 1] - first_[n]);
}

bool Graph::refers(const Value& v, Node to) const {
  bool found = false;
  for_each_reference(v, [&](Node n) { found = found || n == to; });
  return found;
}

void Graph::references(const Value& v, std::vector<Node>& out) const {
  for_each_reference(v, [&](Node n) { out.push_back(n); });
}

}  // namespace capstan::exchange::ap238
