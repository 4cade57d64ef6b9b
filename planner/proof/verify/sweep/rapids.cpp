#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/proof/verify/sweep/step_checks.h"

// Rapids. They are judged on the set-up's cells, as the box between their ends. On a piece so large that
// these cells are coarse for the cutter, what stands between two centres is not seen: there a rapid is looked
// at once more, closer, and what cannot be told is not called free.

namespace capstan::verify {

using geometry::Vec2;

namespace {

constexpr double kSame = 1e-9;

bool straight_down_or_up(const Move& m) { return norm(xy(m.to) - xy(m.from)) < kSame; }

/// Whether axes that do not arrive together leave the straight line.
bool along_one_axis(const Move& m) {
  const geometry::Vec3 d = m.to - m.from;
  return static_cast<int>(std::abs(d.x) > kSame) + static_cast<int>(std::abs(d.y) > kSame) +
             static_cast<int>(std::abs(d.z) > kSame) <=
         1;
}

}  // namespace

void StepChecks::rapid(const Move& m) {
  helix_turned_ = 0.0;
  descent_ = {};
  body(m);
  ring_up(m);
  Vec2 where;
  const double dip = rapid_collision(grid_, m, *outline_, kRapidClearanceMm, where);
  if (dip > 0.0) {
    const bool falls = m.to.z < m.from.z - 1e-9 && norm(xy(m.to) - xy(m.from)) < 1e-9;
    const double into = std::max(0.0, dip - kRapidClearanceMm);
    out_.error(falls ? 10 : 9, falls ? "CHK-RAPID-DOWN" : "CHK-RAPID", at(m),
               (falls ? "a rapid goes down to z = " + plain(m.to.z)
                      : "a rapid at z = " + plain(std::min(m.from.z, m.to.z)) +
                            ", axes taken as not arriving together,") +
                   (into > 0.0 ? " runs " + mm(into) + " into material at " : " touches material at ") +
                   here(where) + " (cells of " + mm(grid_.cell()) + ")",
               dip);
  } else {
    closer(m);
  }
  if (m.spindle_rpm == 0.0 && hole_tool() && cutter_.cutter_class != model::CutterClass::kBoringTool &&
      in_hole(m) && m.to.z > m.from.z) {
    out_.error(15, "CHK-SPINDLE-STOPPED", at(m),
               "the tool is withdrawn from z = " + plain(m.from.z) + " with the spindle stopped",
               m.to.z - m.from.z);
  }
}

void StepChecks::follow(const Move& m) {
  const bool stays = !is_arc(m.kind) && straight_down_or_up(m);
  if (!stays) lowest_here_ = m.to.z;
  lowest_here_ = std::min({lowest_here_, m.to.z, stays ? m.from.z : m.to.z});
}

// Cells no wider than an eighth of the cutter show what it meets (sweep.cpp).
void StepChecks::closer(const Move& m) {
  const double low = std::min(m.from.z, m.to.z), close_mm = 2.0 * radius_ / kCellsPerCutter;
  const bool back = straight_down_or_up(m) && (m.to.z >= m.from.z || m.to.z >= lowest_here_);
  if (grid_.cell() <= close_mm || back || low >= grid_.top() + kRapidClearanceMm) return;
  std::optional<Touch> met;
  if (along_one_axis(m)) met = earlier_.meets(grid_, m, *outline_, close_mm, rapid_looks_);
  if (met && !met->at) return;
  const bool falls = m.to.z < m.from.z;
  if (met && met->sure) {
    out_.error(falls ? 10 : 9, falls ? "CHK-RAPID-DOWN" : "CHK-RAPID", at(m),
               "a rapid to z = " + plain(m.to.z) + " touches material at " + here(*met->at) +
                   " (looked at closer than by cells of " + mm(grid_.cell()) + ")",
               grid_.top() - low);
    return;
  }
  out_.unproved(Severity::kWarning, 9, "CHK-RAPID-UNDECIDED", at(m),
                "whether a rapid at z = " + plain(low) + " is free cannot be told: cells of " +
                    mm(grid_.cell()) + " are coarse for a cutter of " + mm(2.0 * radius_) +
                    ": state the raw piece as small as it is, or let rapids run above it");
}

}  // namespace capstan::verify
