#pragma once

#include "planner/model/plan/cutter_path.h"

namespace capstan::model {

/// Whether all columns have as many entries as the first.
template <class First, class... Others>
[[nodiscard]] bool of_one_length(const First& first, const Others&... others) {
  return ((others.size() == first.size()) && ...);
}
[[nodiscard]] inline bool columns_agree(const CutterPath& p) {
  return of_one_length(p.x, p.y, p.z, p.cx, p.cy, p.kind, p.role);
}
[[nodiscard]] inline bool columns_agree(const SectionSeries& s) {
  return of_one_length(s.move, s.at_mm, s.ad_max_mm, s.rd_max_mm, s.x_max_ofs_mm, s.y_max_ofs_mm, s.csa_mm2,
                       s.x_cg_ofs_mm, s.y_cg_ofs_mm, s.removed_mm3);
}

}  // namespace capstan::model
