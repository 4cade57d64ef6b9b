#include "planner/proof/verify/following/following.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/operation.h"
#include "planner/model/plan/resources/control_options.h"

// A path of the plan beside the text's blocks, one after the other. The reader of this room has made moves of
// the text; nothing of what writes programs is used, so that a fault there is a departure here.

namespace capstan::verify {

using geometry::Vec3;
using model::MoveKind;

namespace {

/// Waits are written to a thousandth of a second.
constexpr int kDwellDecimals = 3;
constexpr double kDwellSlack = 0.00051;
/// An arc's ends and its centre are rounded each on its own: the arc drawn may stand off by so many units.
constexpr double kArcUnits = 4.0;
/// But no more than this where the control's last decimal is finer.
constexpr double kArcMostMm = 0.002;
/// Arcs flatter than half a unit, and those of less than 20 units, have no shape left after rounding.
constexpr double kFlatUnits = 0.6, kShortUnits = 22.0;
constexpr double kPitchSlack = 1e-5;
constexpr double kPi = std::numbers::pi;

bool known(const Block& b) { return b.known_to[0] && b.known_to[1] && b.known_to[2]; }
bool known_from(const Block& b) { return b.known_from[0] && b.known_from[1] && b.known_from[2]; }

Move move_of(const Block& b) {
  Move m;
  m.kind = b.move;
  m.from = b.from;
  m.to = b.to;
  m.centre = b.centre;
  return m;
}

}  // namespace

const char* Following::name(MoveKind k) {
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

Following::Following(const ProgramCase& c, std::size_t marker, std::size_t step,
                     std::vector<const Block*> text, bool high, Findings& out)
    : c_(c),
      marker_(marker),
      step_(c.plan->steps[step]),
      path_(*step_.path),
      cutter_(model::find_cutter(*c.plan, step_.cutter_id)),
      text_(std::move(text)),
      high_(high),
      out_(out),
      decimals_(c.machine.control.decimals),
      unit_(std::pow(10.0, -decimals_)),
      arc_off_(unit_ < kArcMostMm ? std::min(kArcUnits * unit_, kArcMostMm) : kArcUnits * unit_),
      speed_slack_(0.51 * std::pow(10.0, -c.reader.speed_decimals)) {
  const auto& setups = c.plan->setups;
  security_ = step_.setup < setups.size() ? setups[step_.setup].security_z_mm : path_.z[0];
}

Vec3 Following::round(Vec3 v) const {
  return {rounded(v.x, decimals_), rounded(v.y, decimals_), rounded(v.z, decimals_)};
}
bool Following::same(double a, double b) const { return std::abs(a - b) <= 0.51 * unit_; }
bool Following::same(Vec3 a, Vec3 b) const { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }
std::string Following::text_of(Vec3 v) const {
  return "(" + trimmed(v.x, decimals_) + ", " + trimmed(v.y, decimals_) + ", " + trimmed(v.z, decimals_) +
         ")";
}
Move Following::planned(std::size_t i) const {
  Move m;
  m.kind = path_.kind[i];
  m.from = path_.point(i - 1);
  m.to = path_.point(i);
  m.centre = {path_.cx[i], path_.cy[i]};
  return m;
}
double Following::radius_of(std::size_t i) const { return norm(xy(path_.point(i)) - planned(i).centre); }
double Following::feed_of(std::size_t i) const {
  return step_.schedule ? step_.schedule->feed_mm_min[i] : step_.feed_mm_min;
}
double Following::feed_slack() const {
  return 0.51 * std::pow(10.0, -c_.machine.control.feed_decimals) + 1e-9;
}
double Following::speed_of(std::size_t i) const {
  return step_.schedule ? step_.schedule->spindle_rpm[i] : step_.spindle_rpm;
}

bool Following::say(long line, const std::string& what, long move, int property, const char* code) {
  const std::string& id = c_.program.markers[marker_].id;
  out_.error(
      property, code, {marker_ + 2, id, line},
      (move >= 0 ? "move " + std::to_string(move) + " of step '" + id + "' of the plan: " : "") + what);
  return false;
}

/// A straight move to where the tool is.
bool Following::still(const Block& b) const {
  return b.kind == Block::Kind::kMove && !b.in_machine && !b.synchronised && known_from(b) && known(b) &&
         (b.move == MoveKind::kRapid || b.move == MoveKind::kLine) && same(b.from, b.to);
}

/// The one wait for the spindle after each start, before anything moves.
bool Following::spin_up(const Block& b) const {
  const double wanted = rounded(c_.machine.spindle.spin_up_s, kDwellDecimals);
  return b.spindle_rpm != 0.0 && b.started_s == 0.0 && !b.moved_since && wanted > 0.0 &&
         std::abs(b.dwell_s - wanted) <= kDwellSlack;
}

void Following::run() {
  last_ = round(path_.point(0));
  travel_height_ = std::max(last_.z, rounded(security_, decimals_));
  for (const Block* b : text_) {
    if (b->kind != Block::Kind::kMove || b->in_machine) continue;
    if (known_from(*b)) travel_height_ = std::max(travel_height_, b->from.z);
    break;
  }
  if (!approach()) return;
  if (begins_pocket()) {
    if (pocket_cycle()) nothing_behind();
    return;
  }
  if (begins_face()) {
    if (face_cycle()) nothing_behind();
    return;
  }
  for (std::size_t i = 1; i < path_.size(); ++i) {
    if (!one(i)) return;
  }
  nothing_behind();
}

bool Following::approach() {
  const Block* last = nullptr;
  for (; at_ < text_.size(); ++at_) {
    const Block& b = *text_[at_];
    if (b.kind == Block::Kind::kDwell) {
      if (spin_up(b)) continue;
      return say(b.line, "a wait of " + plain(b.dwell_s) + " s that the plan does not have", -1);
    }
    if (still(b)) {
      last = &b;
      continue;
    }
    if (!b.in_machine && known_from(b) && same(b.from, last_) && begins_path(b)) return true;
    if (!approach_move(b)) return false;
    if (b.in_machine) {
      high_ = at_top(b, c_.machine);
    } else if (b.words[2]) {
      high_ = false;
    }
    last = &b;
  }
  if (last != nullptr && known(*last) && same(last->to, last_)) return true;
  return say(marker_line(), "the path's start " + text_of(last_) + " is not reached", 0);
}

/// At the path's start: whether this is the path's own first move, rather than the way up to come back to it.
bool Following::begins_path(const Block& b) const {
  if (b.move != MoveKind::kRapid || b.words[0] || b.words[1] || !same(b.to.z, travel_height_)) return true;
  for (std::size_t i = 1; i < path_.size(); ++i) {
    if (path_.kind[i] == MoveKind::kDwell || same(round(path_.point(i)), last_)) continue;
    return path_.kind[i] == MoveKind::kRapid && same(round(path_.point(i)), b.to);
  }
  return true;
}

/// To the top of the machine or up to the height of travel, across, and down to the start.
bool Following::approach_move(const Block& b) {
  const auto wrong = [&](const std::string& why) {
    return say(b.line,
               std::string("before the path's start ") + text_of(last_) + ": " + why +
                   " that the plan does not have",
               -1);
  };
  if (b.move != MoveKind::kRapid) return wrong("a feed move");
  if (b.in_machine) {
    if (!b.words[0] && !b.words[1] && at_top(b, c_.machine)) return true;
    return wrong("a move in machine coordinates other than to the top of Z");
  }
  const bool across = b.words[0] || b.words[1];
  // At the top of Z a move across needs no length of the tool.
  const bool at_any_length = across && !b.words[2] && high_ && b.length_offset < 0;
  if (!at_any_length && !state_agrees(-1, b)) return false;
  if (!across && known_from(b) && b.to.z > b.from.z && same(b.to.z, travel_height_)) return true;
  // Own speed first, so that the spindle is started where the tool is clear.
  if (std::abs(b.spindle_rpm - speed_of(path_.size() > 1 ? 1 : 0)) > speed_slack_)
    return say(b.line,
               "the tool comes with the spindle at " + plain(b.spindle_rpm) + " rpm; the plan says " +
                   plain(speed_of(path_.size() > 1 ? 1 : 0)),
               -1);
  if (across) {
    const bool level = b.known_from[2] && same(b.from.z, travel_height_);
    if (b.words[2] && !(b.known_from[2] && same(b.to.z, b.from.z)))
      return wrong("a rapid across and down at once");
    if (!high_ && !level)
      return wrong("a rapid across at " +
                   (b.known_from[2] ? "z = " + plain(b.from.z) : std::string("an unknown height")));
    const bool x = same(b.to.x, last_.x), y = same(b.to.y, last_.y);
    const bool part =
        (x && b.known_from[1] && same(b.to.y, b.from.y)) || (y && b.known_from[0] && same(b.to.x, b.from.x));
    if (!(x && y && b.known_to[0] && b.known_to[1]) && !part) return wrong("a rapid to " + text_of(b.to));
    return true;
  }
  if (!b.known_to[0] || !b.known_to[1] || !same(b.to, last_)) return wrong("a rapid to " + text_of(b.to));
  if (coolant_differs(b))
    return say(b.line, "the coolant is not the plan's when the tool comes to the path's start", -1, 29,
               "CHK-TEXT-STATE");
  return true;
}

const Block* Following::next(std::size_t i, Vec3 goal) {
  for (; at_ < text_.size(); ++at_) {
    const Block& b = *text_[at_];
    if (b.kind == Block::Kind::kDwell) {
      if (spin_up(b)) continue;
      say(b.line, "the text waits " + plain(b.dwell_s) + " s before " + text_of(goal) + "; the plan does not",
          static_cast<long>(i));
      return nullptr;
    }
    if (still(b)) continue;
    if (b.in_machine || !known(b) || !known_from(b)) {
      say(b.line,
          b.in_machine ? "a move in machine coordinates that the plan does not have"
                       : "the text moves where its position is not known",
          static_cast<long>(i));
      return nullptr;
    }
    ++at_;
    return &b;
  }
  say(marker_line(), "the text ends before " + text_of(goal), static_cast<long>(i));
  return nullptr;
}

bool Following::dwell(std::size_t i) {
  const double wanted = step_.schedule ? rounded(step_.schedule->dwell_s[i], kDwellDecimals) : 0.0;
  // A tap's cycle (G33.1) turns round at the bottom by itself.
  const bool tapping = path_.role[i - 1] == model::MoveRole::kTap;
  if (wanted <= 0.0 || tapping) return true;
  while (at_ < text_.size() &&
         (still(*text_[at_]) || (text_[at_]->kind == Block::Kind::kDwell && spin_up(*text_[at_]) &&
                                 at_ + 1 < text_.size() && text_[at_ + 1]->kind == Block::Kind::kDwell)))
    ++at_;
  if (at_ < text_.size() && text_[at_]->kind == Block::Kind::kDwell &&
      std::abs(text_[at_]->dwell_s - wanted) <= kDwellSlack) {
    ++at_;
    return true;
  }
  return say(at_ < text_.size() ? text_[at_]->line : marker_line(),
             "the plan waits " + plain(wanted) + " s; the text does not", static_cast<long>(i));
}

bool Following::one(std::size_t i) {
  if (i <= done_to_) return true;
  if (path_.kind[i] == MoveKind::kDwell) return dwell(i);
  if (const auto made = hole_way(i)) return *made;
  if (const auto made = peck_way(i)) return *made;
  const Vec3 goal = round(path_.point(i));
  const bool arcs = is_arc(path_.kind[i]);
  // A whole turn ends where it begins; so does an arc that is shorter than the last decimal.
  const bool full = arcs && same(goal, last_) && radius_of(i) > unit_ && sweep_of(planned(i)) > kPi;
  if (same(goal, last_) && !full) return true;
  const Vec3 begin = last_;
  last_ = goal;
  if (arcs) return arc(i, goal);
  if (path_.kind[i] == MoveKind::kRapid) return rapid(i, begin, goal);
  const Block* b = next(i, goal);
  if (b == nullptr || !kind_agrees(i, *b)) return false;
  if (!same(b->to, goal))
    return say(b->line, "the text goes to " + text_of(b->to) + "; the plan to " + text_of(goal),
               static_cast<long>(i));
  return numbers_agree(i, *b);
}

/// One axis after the other, each on its way.
bool Following::rapid(std::size_t i, Vec3 begin, Vec3 goal) {
  for (;;) {
    const Block* b = next(i, goal);
    if (b == nullptr || !kind_agrees(i, *b) || !numbers_agree(i, *b)) return false;
    if (same(b->to, goal)) return true;
    const auto stays_or_arrives = [&](double to, double from, double wanted) {
      return same(to, from) || same(to, wanted);
    };
    if (!stays_or_arrives(b->to.x, begin.x, goal.x) || !stays_or_arrives(b->to.y, begin.y, goal.y) ||
        !stays_or_arrives(b->to.z, begin.z, goal.z) || same(b->to, begin)) {
      return say(b->line, "the text goes to " + text_of(b->to) + "; the plan to " + text_of(goal),
                 static_cast<long>(i));
    }
    begin = b->to;
  }
}

/// Piece by piece along the plan's arc, never back, until its whole angle is behind.
bool Following::arc(std::size_t i, Vec3 goal) {
  const Move whole = planned(i);
  const double radius = norm(xy(whole.to) - whole.centre);
  // Centre and end are rounded: each end may lie as far along the arc as the arc may stand off.
  const double slack = 2.0 * arc_off_ / std::max(radius, unit_) + 1e-9;
  const double sweep = sweep_of(whole);
  double done = 0.0;
  for (;;) {
    const Block* b = next(i, goal);
    if (b == nullptr || !kind_agrees(i, *b) || !arc_piece(i, *b, whole, done) || !numbers_agree(i, *b))
      return false;
    // Within a helix of one block the path's arcs end where no number of the text is rounded.
    const bool there = same(b->to, goal) || (b->from_turns && norm(b->to - path_.point(i)) <= arc_off_);
    if (std::abs(done - sweep) <= slack && there) return true;
    if (done > sweep + slack)
      return say(b->line, "the text goes to " + text_of(b->to) + "; the plan's arc ends at " + text_of(goal),
                 static_cast<long>(i));
  }
}

bool Following::arc_piece(std::size_t i, const Block& b, const Move& whole, double& done) {
  const double radius = norm(xy(whole.to) - whole.centre);
  const double sweep = sweep_of(whole);
  const auto off = [&](geometry::Vec2 p) { return std::abs(norm(p - whole.centre) - radius); };
  double part;
  if (is_arc(b.move)) {
    const Move m = move_of(b);
    part = sweep_of(m);
    const Vec3 middle = point_of(m, 0.5);
    if (off(xy(middle)) > arc_off_)
      return say(b.line,
                 "the arc passes " + text_of(middle) + ", " + mm(off(xy(middle))) +
                     " from the plan's; its radius is " + mm(b.radius_end) + ", the plan's " + mm(radius),
                 static_cast<long>(i));
  } else {
    const geometry::Vec2 u = xy(b.from) - whole.centre, v = xy(b.to) - whole.centre;
    part = std::atan2(u.x * v.y - u.y * v.x, dot(u, v));
    if (whole.kind == MoveKind::kArcCw) part = -part;
    const double sagitta = radius * (1.0 - std::cos(0.5 * part));
    if (sagitta > kFlatUnits * unit_ && radius * std::abs(part) > kShortUnits * unit_)
      return say(
          b.line,
          "the text has a line to " + text_of(b.to) + " where the plan has an arc, " + mm(sagitta) + " high",
          static_cast<long>(i));
  }
  done += part;
  const double z = whole.from.z + (whole.to.z - whole.from.z) * std::min(1.0, done / sweep);
  const double steep = std::abs(whole.to.z - whole.from.z) / std::max(radius * sweep, unit_);
  const bool along = std::abs(b.to.z - z) <= (1.0 + kArcUnits * (1.0 + steep)) * unit_;
  if (off(xy(b.to)) <= arc_off_ && along && part > -arc_off_ / std::max(radius, unit_)) return true;
  return say(b.line, "the text goes to " + text_of(b.to) + ", which is not on the plan's arc there",
             static_cast<long>(i));
}

bool Following::kind_agrees(std::size_t i, const Block& b) {
  const MoveKind want = path_.kind[i];
  if (b.move == want || (is_arc(want) && b.move == MoveKind::kLine)) return true;
  return say(b.line,
             std::string("the text has ") + name(b.move) + " to " + text_of(b.to) + "; the plan has " +
                 name(want) + " to " + text_of(round(path_.point(i))),
             static_cast<long>(i));
}

bool Following::state_agrees(long i, const Block& b) {
  if (cutter_ == nullptr) return true;
  const int pocket = cutter_->pocket;
  if (b.tool != pocket)
    return say(b.line,
               "T" + std::to_string(b.tool) + " is loaded; the plan has T" + std::to_string(pocket) + ", '" +
                   cutter_->id + "'",
               i, 4, "CHK-TEXT-TOOL");
  if (b.length_offset != pocket)
    return say(b.line, "the length offset is not H" + std::to_string(pocket) + ", of the step's tool", i, 5,
               "CHK-TEXT-TOOL");
  if (b.radius_offset >= 0)
    return say(b.line, "radius compensation is on; the plan's path is of the tool's centre", i, 25,
               "CHK-TEXT-STATE");
  return true;
}

bool Following::tap_agrees(std::size_t i, const Block& b) {
  const bool planned = path_.role[i] == model::MoveRole::kTap;
  if (b.synchronised != planned)
    return say(b.line,
               planned ? "the text feeds without holding step with the spindle; the plan taps"
                       : "the text taps; the plan feeds",
               static_cast<long>(i), 22, "CHK-TEXT-TAP");
  if (!planned || b.to.z >= b.from.z) return true;
  const auto* step = c_.plan->model.get<model::MachiningWorkingstep>(step_.step);
  const auto* tapping = step == nullptr ? nullptr : c_.plan->model.get<model::Tapping>(step->its_operation);
  if (b.in_chuck && (tapping == nullptr || !tapping->compensation_chuck.value_or(false)))
    return say(b.line,
               "the text taps as with a compensating chuck; the operation states none (compensation_chuck)",
               static_cast<long>(i), 22, "CHK-TEXT-TAP");
  const double pitch = cutter_ != nullptr && cutter_->thread_pitch_mm > 0.0
                           ? cutter_->thread_pitch_mm
                           : feed_of(i) / std::max(std::abs(speed_of(i)), 1e-9);
  if (std::abs(b.pitch_mm - pitch) > kPitchSlack)
    return say(b.line, "the pitch is " + plain(b.pitch_mm) + " mm; the plan's is " + plain(pitch),
               static_cast<long>(i), 18, "CHK-TAP-FEED");
  return true;
}

bool Following::numbers_agree(std::size_t i, const Block& b) {
  const long move = static_cast<long>(i);
  if (!state_agrees(move, b)) return false;
  const bool feeds = b.move != MoveKind::kRapid;
  if (feeds && !tap_agrees(i, b)) return false;
  const double speed = speed_of(i);
  const bool back = b.synchronised && b.to.z > b.from.z;
  // A control may have stopped the spindle when the tap was out.
  tapped_ = tapped_ || b.synchronised;
  const bool drawn_away = tapped_ && !feeds && b.spindle_rpm == 0.0;
  // A machine may be set to bring taps out faster, by a whole factor.
  const double factor = back ? std::max(1.0, model::control_number(c_.machine, "tap_retract", 1.0)) : 1.0;
  const double turns = back ? std::abs(b.spindle_rpm) : b.spindle_rpm;
  const double wanted_rpm = back ? factor * std::abs(speed) : speed;
  if (!drawn_away && std::abs(turns - wanted_rpm) > factor * speed_slack_)
    return say(b.line, "the spindle turns at " + plain(turns) + " rpm; the plan says " + plain(wanted_rpm),
               move);
  if (coolant_differs(b) && !feeds)
    return say(b.line, "the coolant is not the plan's", move, 29, "CHK-TEXT-STATE");
  if (!feeds) return true;
  if (b.spindle_starts != starts_) {
    starts_ = b.spindle_starts;
    const double wanted = rounded(c_.machine.spindle.spin_up_s, kDwellDecimals);
    if (b.spindle_rpm != 0.0 && b.started_s < wanted - kDwellSlack)
      return say(b.line,
                 "the tool feeds " + plain(b.started_s) + " s after the spindle was started; it needs " +
                     plain(wanted) + " s to come up to speed",
                 move, 15, "CHK-SPIN-UP");
  }
  if (!b.synchronised && std::abs(b.feed_mm_min - feed_of(i)) > feed_slack())
    return say(b.line, "the feed is " + plain(b.feed_mm_min) + " mm/min; the plan says " + plain(feed_of(i)),
               move);
  return true;
}

bool Following::nothing_behind() {
  for (; at_ < text_.size(); ++at_) {
    const Block& b = *text_[at_];
    if (still(b)) continue;
    if (b.kind == Block::Kind::kDwell)
      return say(b.line, "a wait of " + plain(b.dwell_s) + " s follows that the plan does not have", -1);
    const bool retract =
        b.in_machine && b.move == MoveKind::kRapid && !b.words[0] && !b.words[1] && at_top(b, c_.machine);
    const bool last = marker_ + 1 == c_.program.markers.size();
    if (!retract && !(last && parks(b, c_.machine)))
      return say(b.line, "a move follows that the plan does not have", -1);
  }
  return true;
}

}  // namespace capstan::verify
