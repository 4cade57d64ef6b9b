#include "planner/engagement/planar/merged.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planner/engagement/planar/planar.h"

namespace capstan::engagement {
namespace {

using model::MoveKind;

bool slopes(const model::CutterPath& p, std::size_t i) {
  if (p.kind[i] == MoveKind::kDwell || p.z[i] == p.z[i - 1]) return false;
  const bool arc = p.kind[i] == MoveKind::kArcCw || p.kind[i] == MoveKind::kArcCcw;
  return arc || std::hypot(p.x[i] - p.x[i - 1], p.y[i] - p.y[i - 1]) > stock::kTouch;
}

/// The samples of one move.
struct Range {
  std::size_t begin = 0, end = 0;
  void turn_to(const Measurement& m, std::size_t move) {
    begin = end;
    while (begin < m.sections.size() && m.sections.move[begin] < move) ++begin;
    end = begin;
    while (end < m.sections.size() && m.sections.move[end] == move) ++end;
  }
};

bool cuts(const Measurement& m) { return !m.engagement.empty() && m.engagement.back().removed_mm3 > 0.0; }

void append(const Measurement& from, std::size_t i, Measurement& to) {
  const auto& e = from.engagement[i];
  if (!(e.removed_mm3 > 0.0) && !cuts(to)) return;  // nothing to close
  const auto& s = from.sections;
  auto& t = to.sections;
  t.move.push_back(s.move[i]);
  t.at_mm.push_back(s.at_mm[i]);
  t.ad_max_mm.push_back(s.ad_max_mm[i]);
  t.rd_max_mm.push_back(s.rd_max_mm[i]);
  t.x_max_ofs_mm.push_back(s.x_max_ofs_mm[i]);
  t.y_max_ofs_mm.push_back(s.y_max_ofs_mm[i]);
  t.csa_mm2.push_back(s.csa_mm2[i]);
  t.x_cg_ofs_mm.push_back(s.x_cg_ofs_mm[i]);
  t.y_cg_ofs_mm.push_back(s.y_cg_ofs_mm[i]);
  t.removed_mm3.push_back(s.removed_mm3[i]);
  to.engagement.push_back(e);
  to.removed_mm3 += e.removed_mm3;
  to.highest_contact_mm = std::max(to.highest_contact_mm, s.y_max_ofs_mm[i] + 0.5 * s.ad_max_mm[i]);
}

/// A sample without contact at the end of a move.
void close(std::size_t move, double at_mm, Measurement& to) {
  auto& t = to.sections;
  t.move.push_back(static_cast<std::uint32_t>(move));
  t.at_mm.push_back(at_mm);
  for (auto* column : {&t.ad_max_mm, &t.rd_max_mm, &t.x_max_ofs_mm, &t.y_max_ofs_mm, &t.csa_mm2,
                       &t.x_cg_ofs_mm, &t.y_cg_ofs_mm, &t.removed_mm3}) {
    column->push_back(0.0);
  }
  to.engagement.emplace_back();
}

}  // namespace

Measurement merged(const model::CutterPath& path, const Measurement& exact, const Measurement& cells) {
  Measurement out;
  out.rapid_removed_mm3 = std::max(exact.rapid_removed_mm3, cells.rapid_removed_mm3);
  Range of_exact, of_cells;
  for (std::size_t i = 1; i < path.size(); ++i) {
    of_exact.turn_to(exact, i);
    of_cells.turn_to(cells, i);
    const bool sloping = slopes(path, i);
    const Measurement& from = sloping ? cells : exact;
    const Range& r = sloping ? of_cells : of_exact;
    for (std::size_t k = r.begin; k < r.end; ++k) append(from, k, out);
    if (r.begin < r.end || !cuts(out)) continue;
    const double length = model::move_length(path, i);
    if (path.kind[i] != MoveKind::kRapid && length > 0.0) close(i, length, out);
  }
  return out;
}

}  // namespace capstan::engagement
