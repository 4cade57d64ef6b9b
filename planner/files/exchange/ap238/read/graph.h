#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/exchange/express/dictionary.h"
#include "planner/files/p21/file.h"

namespace capstan::exchange::ap238 {

using express::EntityId;

/// An instance of a file, by its index.
using Node = std::uint32_t;
inline constexpr Node kNoNode = 0xFFFFFFFF;

/// A file seen as typed instances that know who refers to them.
class Graph {
 public:
  /// Cost   linear in the file; eight bytes for each reference.
  Graph(const p21::File& file, const express::Dictionary& schema);

  [[nodiscard]] const p21::File& file() const { return file_; }
  [[nodiscard]] const express::Dictionary& schema() const { return schema_; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(entity_.size()); }
  [[nodiscard]] p21::Instance instance(Node n) const { return file_.instance(n); }
  [[nodiscard]] Node find(std::uint64_t id) const;

  /// Of a simple instance; kNoEntity for a complex one and for a keyword outside the schema.
  [[nodiscard]] EntityId entity(Node n) const { return entity_[n]; }
  [[nodiscard]] bool is(Node n, EntityId e) const;
  [[nodiscard]] bool is(Node n, std::string_view entity) const { return is(n, schema_.find(entity)); }
  [[nodiscard]] bool is_all(Node n, std::span<const EntityId> es) const;

  /// The attribute's value by name, "owner.name" if several supertypes have it; omitted if there is none.
  [[nodiscard]] p21::Value get(Node n, std::string_view attribute) const;
  /// The instance that the attribute refers to; kNoNode if it is no reference, or a dangling one.
  [[nodiscard]] Node referred(Node n, std::string_view attribute) const;
  /// The attribute's text; empty if it has none.
  [[nodiscard]] std::string text(Node n, std::string_view attribute) const;
  /// Instances that refer to this one, each once, in file order.
  [[nodiscard]] std::span<const Node> users(Node n) const;
  /// Whether the value refers to the instance, directly or in lists and typed parameters.
  [[nodiscard]] bool refers(const p21::Value& v, Node to) const;
  /// Every reference in the value, in order; dangling ones left out.
  void references(const p21::Value& v, std::vector<Node>& out) const;

 private:
  template <class Visit>
  void for_each_reference(const p21::Value& v, const Visit& visit) const;

  const p21::File& file_;
  const express::Dictionary& schema_;
  std::vector<EntityId> entity_;
  std::vector<std::uint32_t> first_;  ///< of users_, by instance; one more at the end
  std::vector<Node> users_;
};

}  // namespace capstan::exchange::ap238
