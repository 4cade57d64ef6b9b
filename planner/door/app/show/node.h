#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/door/app/show/query.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::app {

/// A place in a plan that a path leads to: an object, an attribute of one, or an item of a list in one.
struct Node {
  model::AnyRef object;                         ///< the object, or the owner of `attribute`
  const model::Attribute* attribute = nullptr;  ///< null: the object itself
  std::vector<std::size_t> item;                ///< indices into a list or table attribute
  std::vector<model::AnyRef> list;              ///< with `is_list`: objects that no attribute holds
  bool is_list = false;
  bool spread =
      false;  ///< the list is the result of a search or a condition: attributes are read from each item
};

/// Every place that the path (see query.h) leads to, in order; several where it maps with `[*]`, a condition
/// or a search. Where it leads through objects of several kinds, those without the attribute are passed over.
/// Fails  INS-PATH, naming the character, and what there is at that place.
[[nodiscard]] Result<std::vector<Node>> nodes_at(const model::Plan& plan, const Query& query);
[[nodiscard]] Result<std::vector<Node>> nodes_at(const model::Plan& plan, std::string_view path);

/// How many items a list has; nothing for what is no list.
[[nodiscard]] std::optional<std::size_t> list_size(const model::Model& m, const Node& node);
/// The i-th item of a list. Needs i below its size.
[[nodiscard]] Node item_of(const Node& list, std::size_t i);
/// The object that the node is or refers to; unset when it is a value, a list, or absent.
[[nodiscard]] model::AnyRef object_of(const model::Model& m, const Node& node);
/// The value in one line.
[[nodiscard]] std::string node_text(const model::Model& m, const Node& node);

}  // namespace capstan::app
