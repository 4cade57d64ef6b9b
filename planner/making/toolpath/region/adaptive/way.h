#pragma once

#include <optional>
#include <vector>

#include "planner/making/toolpath/region/area/inside.h"

namespace capstan::toolpath {

/// Places from one to the other, both included, on straight lines within a region: the shortest way that
/// bends at its inner corners. The region is coarsened first, so that a way keeps a little away from its
/// boundary. Nothing: there is none, or the region has more corners than are worth a search.
class Ways {
 public:
  explicit Ways(const geometry::Region& free);
  [[nodiscard]] std::optional<std::vector<geometry::Vec2>> between(geometry::Vec2 a, geometry::Vec2 b) const;

 private:
  Inside free_;
  std::vector<geometry::Vec2> corners_;
};

}  // namespace capstan::toolpath
