#include <cmath>

#include "planner/base/number.h"
#include "planner/verify/program/program_checks.h"

namespace capstan::verify {

using geometry::Vec3;
using model::MoveKind;

namespace {

/// Steps through the text's moves of one step and the plan's path together.
class Comparison {
 public:
  Comparison(const ProgramCase& c, std::size_t marker, std::size_t step, std::vector<const Block*> text,
             Findings& out)
      : c_(c),
        marker_(marker),
        plan_step_(c.plan->steps[step]),
        text_(std::move(text)),
        out_(out),
        decimals_(c.machine.control.decimals),
        unit_(std::pow(10.0, -decimals_)) {}

  void run() {
    const model::CutterPath& p = *plan_step_.path;
    last_ = round(p.point(0));
    while (at_ < text_.size() && !(same(text_[at_]->to, last_) && known(*text_[at_]))) ++at_;
    if (at_ == text_.size()) {
      say(marker_line(), "the path's start " + text_of(last_) + " is not reached", 0);
      return;
    }
    ++at_;
    for (std::size_t i = 1; i < p.size(); ++i) {
      if (!one(p, i)) return;
    }
    // What follows may only go up and away.
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_]->move == MoveKind::kRapid) continue;
      say(text_[at_]->line, "a feed move follows that the plan does not have", -1);
      return;
    }
  }

 private:
  [[nodiscard]] static bool known(const Block& b) { return b.known_to[0] && b.known_to[1] && b.known_to[2]; }
  [[nodiscard]] long marker_line() const { return c_.program.markers[marker_].line; }
  [[nodiscard]] Vec3 round(Vec3 v) const {
    return {rounded(v.x, decimals_), rounded(v.y, decimals_), rounded(v.z, decimals_)};
  }
  [[nodiscard]] bool same(Vec3 a, Vec3 b) const {
    const double e = 0.51 * unit_;
    return std::abs(a.x - b.x) <= e && std::abs(a.y - b.y) <= e && std::abs(a.z - b.z) <= e;
  }
  [[nodiscard]] std::string text_of(Vec3 v) const {
    return "(" + trimmed(v.x, decimals_) + ", " + trimmed(v.y, decimals_) + ", " + trimmed(v.z, decimals_) +
           ")";
  }
  void say(long line, const std::string& what, long move) {
    out_.error(33, "CHK-TEXT", {marker_ + 2, c_.program.markers[marker_].id, line},
               (move >= 0 ? "move " + std::to_string(move) + " of step '" + c_.program.markers[marker_].id +
                                "' of the plan: "
                          : "") +
                   what);
  }

  [[nodiscard]] double feed_of(std::size_t i) const {
    return plan_step_.schedule ? plan_step_.schedule->feed_mm_min[i] : plan_step_.feed_mm_min;
  }
  [[nodiscard]] double speed_of(std::size_t i) const {
    return plan_step_.schedule ? plan_step_.schedule->spindle_rpm[i] : plan_step_.spindle_rpm;
  }

  bool one(const model::CutterPath& p, std::size_t i) {
    if (p.kind[i] == MoveKind::kDwell) return true;
    const Vec3 goal = round(p.point(i));
    const bool arc = p.kind[i] == MoveKind::kArcCw || p.kind[i] == MoveKind::kArcCcw;
    const bool full = arc && same(goal, last_) && std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]) > unit_;
    if (same(goal, last_) && !full) return true;
    const Vec3 begin = last_;
    last_ = goal;
    double length = 0.0;
    for (int pieces = 0; pieces < 10000; ++pieces) {
      if (at_ >= text_.size()) {
        say(marker_line(), "the text ends before " + text_of(goal), static_cast<long>(i));
        return false;
      }
      const Block& b = *text_[at_++];
      // A rapid to where the tool is already says nothing.
      if (b.move == MoveKind::kRapid && same(b.from, b.to) && same(b.to, begin)) continue;
      if (!kind_agrees(p, i, b)) return false;
      length += norm(b.to - b.from);
      if (same(b.to, goal) && (!full || length > 0.0)) return numbers_agree(p, i, b);
      if (!between(p, i, begin, goal, b)) return false;
    }
    return false;
  }

  bool kind_agrees(const model::CutterPath& p, std::size_t i, const Block& b) {
    const MoveKind want = p.kind[i];
    const bool arc = want == MoveKind::kArcCw || want == MoveKind::kArcCcw;
    if (b.move == want || (arc && b.move == MoveKind::kLine)) return true;
    say(b.line,
        std::string("the text has ") + name(b.move) + " to " + text_of(b.to) + "; the plan has " +
            name(want) + " to " + text_of(round(p.point(i))),
        static_cast<long>(i));
    return false;
  }
  static const char* name(MoveKind k) {
    switch (k) {
      case MoveKind::kRapid:
        return "a rapid";
      case MoveKind::kLine:
        return "a line";
      case MoveKind::kArcCw:
        return "a clockwise arc";
      case MoveKind::kArcCcw:
        return "a counter-clockwise arc";
      default:
        return "a dwell";
    }
  }

  /// A piece that ends on the way: arcs may be written in pieces, rapids axis by axis.
  bool between(const model::CutterPath& p, std::size_t i, Vec3 begin, Vec3 goal, const Block& b) {
    const MoveKind k = p.kind[i];
    if (k == MoveKind::kArcCw || k == MoveKind::kArcCcw) {
      const double r = std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]);
      const double at = std::hypot(b.to.x - p.cx[i], b.to.y - p.cy[i]);
      if (std::abs(r - at) <= 4.0 * unit_) return true;
      say(b.line, "the arc passes " + text_of(b.to) + ", " + mm(std::abs(r - at)) + " from the plan's",
          static_cast<long>(i));
      return false;
    }
    const auto within = [&](double v, double x, double y) {
      return v >= std::min(x, y) - unit_ && v <= std::max(x, y) + unit_;
    };
    if (k == MoveKind::kRapid && within(b.to.x, begin.x, goal.x) && within(b.to.y, begin.y, goal.y) &&
        within(b.to.z, begin.z, goal.z)) {
      return true;
    }
    say(b.line, "the text goes to " + text_of(b.to) + "; the plan to " + text_of(goal), static_cast<long>(i));
    return false;
  }

  bool numbers_agree(const model::CutterPath& p, std::size_t i, const Block& b) {
    if (b.move == MoveKind::kArcCw || b.move == MoveKind::kArcCcw) {
      const double off = std::hypot(b.centre.x - p.cx[i], b.centre.y - p.cy[i]);
      // A centre may slide along the bisector of a short chord; the arc's own middle must stay.
      const double r = std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]);
      if (off > 10.0 * unit_ && std::abs(r - b.radius_end) > 0.01 * r + 10.0 * unit_) {
        say(b.line, "the arc's radius is " + mm(b.radius_end) + "; the plan's " + mm(r),
            static_cast<long>(i));
        return false;
      }
    }
    if (b.move == MoveKind::kRapid) return true;
    const double speed = speed_of(i);
    if (!b.synchronised && std::abs(b.spindle_rpm - speed) > 0.5 + 1e-6) {
      say(b.line, "the spindle turns at " + plain(b.spindle_rpm) + " rpm; the plan says " + plain(speed),
          static_cast<long>(i));
      return false;
    }
    const double feed_unit = std::pow(10.0, -c_.machine.control.feed_decimals);
    if (!b.synchronised && std::abs(b.feed_mm_min - feed_of(i)) > 0.51 * feed_unit + 1e-9) {
      say(b.line, "the feed is " + plain(b.feed_mm_min) + " mm/min; the plan says " + plain(feed_of(i)),
          static_cast<long>(i));
      return false;
    }
    return true;
  }

  const ProgramCase& c_;
  std::size_t marker_;
  const model::StepResult& plan_step_;
  std::vector<const Block*> text_;
  Findings& out_;
  int decimals_;
  double unit_;
  std::size_t at_ = 0;
  Vec3 last_;
};

}  // namespace

namespace {

/// Corners may be rounded by no more than the step allows.
void check_tolerance(const model::StepResult& step, const std::vector<const Block*>& text,
                     const Findings::Where& at, Findings& findings) {
  constexpr double kRounding = 1e-6;
  if (!(step.contour_tolerance_mm > 0.0)) return;
  for (const Block* b : text) {
    if (b->move == MoveKind::kRapid || b->tolerance_mm <= step.contour_tolerance_mm + kRounding) continue;
    const std::string stated =
        b->tolerance_mm >= kNoTolerance ? "no path tolerance" : "a path tolerance of " + mm(b->tolerance_mm);
    findings.error(33, "CHK-TEXT-TOLERANCE", {at.order, at.step, b->line},
                   "the text cuts with " + stated + "; the step allows " + mm(step.contour_tolerance_mm));
    return;
  }
}

}  // namespace

void compare(const ProgramCase& c, Findings& findings) {
  if (c.plan == nullptr) return;
  std::vector<std::vector<const Block*>> text(c.program.markers.size());
  for (const Block& b : c.program.blocks) {
    if (b.kind == Block::Kind::kMove && b.marker >= 0 && !b.in_machine)
      text[static_cast<std::size_t>(b.marker)].push_back(&b);
  }
  std::vector<bool> written(c.plan->steps.size(), false);
  long last = -1;
  for (std::size_t m = 0; m < text.size(); ++m) {
    const long step = c.step_of_marker[m];
    const Findings::Where at{m + 2, c.program.markers[m].id, c.program.markers[m].line};
    if (step < 0) {
      findings.error(33, "CHK-TEXT-STEP", at,
                     "the step \"" + c.program.markers[m].id + "\" is not in the plan");
      continue;
    }
    if (step < last)
      findings.error(33, "CHK-TEXT-ORDER", at, "the step comes later in the text than in the plan");
    last = std::max(last, step);
    const auto i = static_cast<std::size_t>(step);
    written[i] = true;
    check_tolerance(c.plan->steps[i], text[m], at, findings);
    if (c.plan->steps[i].path && c.plan->steps[i].path->size() > 0)
      Comparison(c, m, i, std::move(text[m]), findings).run();
  }
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i] || !c.plan->steps[i].path || c.plan->steps[i].path->size() < 2) continue;
    const std::string id = model::step_id(*c.plan, c.plan->steps[i]);
    findings.error(33, "CHK-TEXT-MISSING", {text.size() + 2, id, -1},
                   "the step is in the plan, but not in the text");
  }
}

std::vector<StepMoves> moves_of(const ProgramCase& c) {
  std::vector<StepMoves> out;
  for (const Block& b : c.program.blocks) {
    if (b.kind == Block::Kind::kToolChange || b.kind == Block::Kind::kEnd || b.in_machine) continue;
    const model::Cutter* cutter = c.cutter(b.tool);
    const long marker_step = b.marker >= 0 ? c.step_of_marker[static_cast<std::size_t>(b.marker)] : -1;
    const Findings::Where at = c.where(b);
    if (out.empty() || out.back().order + 1 != at.order || out.back().cutter != cutter) {
      StepMoves s;
      s.order = at.order - 1;
      s.id = at.step;
      s.cutter = cutter;
      if (c.plan != nullptr && marker_step >= 0) {
        s.planned = &c.plan->steps[static_cast<std::size_t>(marker_step)];
        s.setup = s.planned->setup;
      }
      out.push_back(std::move(s));
    }
    Move m;
    m.kind = b.move;
    m.synchronised = b.synchronised;
    m.from = b.from;
    m.to = b.to;
    if (!b.known_from[2]) m.from.z = kUnknownHeightMm;
    if (!b.known_to[2]) m.to.z = kUnknownHeightMm;
    // From an unknown place nothing is swept but the height itself.
    if (!b.known_from[0]) m.from.x = m.to.x;
    if (!b.known_from[1]) m.from.y = m.to.y;
    m.centre = b.centre;
    m.feed_mm_min = b.feed_mm_min;
    m.spindle_rpm = b.spindle_rpm;
    m.dwell_s = b.dwell_s;
    m.where = b.line;
    out.back().moves.push_back(m);
  }
  return out;
}

}  // namespace capstan::verify
