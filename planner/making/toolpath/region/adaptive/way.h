#pragma once

#include <optional>
#include <vector>

#include "planner/making/toolpath/region/area/inside.h"

namespace capstan::toolpath {

/// Places from one to the other, both included, on straight lines within a region: the shortest way that
/// bends near its inner corners. Nothing: there is none, or the region has more corners than are worth a
/// search. The region must outlive this.
class Ways {
 public:
  explicit Ways(const geometry::Region& free);
  [[nodiscard]] std::optional<std::vector<geometry::Vec2>> between(geometry::Vec2 a, geometry::Vec2 b);

 private:
  void find_corners();
  Inside free_;
  const geometry::Region& region_;
  bool searched_ = false;
  std::vector<geometry::Vec2> corners_;
};

}  // namespace capstan::toolpath
