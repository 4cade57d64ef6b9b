#include <algorithm>

#include "planner/proof/verify/following/following.h"

// Holes that the text makes by a canned cycle: of these the ways through air and between pecks are the
// control's, which says how it makes them. Each is held against what the plan means by its own.

namespace capstan::verify {

using geometry::Vec3;
using model::MoveKind;
using model::MoveRole;

/// Straight down to where the tool is fed into the hole, or straight up out of it: a canned cycle makes such
/// a way in pieces of its own. By rapid where the plan goes through air at feed to R, and above R on the way
/// out. Handled only where the text is a cycle's; `done_to_` is then the last move of the way.
std::optional<bool> Following::hole_way(std::size_t i) {
  // A modal call follows a move to where the tool already is.
  std::size_t first = at_;
  while (first < text_.size() && still(*text_[first])) ++first;
  if (first >= text_.size() || !text_[first]->from_cycle) return std::nullopt;
  const auto straight = [&](std::size_t k, Vec3 from) {
    return path_.kind[k] != MoveKind::kDwell && !is_arc(path_.kind[k]) && same(path_.x[k], from.x) &&
           same(path_.y[k], from.y);
  };
  const auto in_air = [&](std::size_t k) {
    return path_.kind[k] == MoveKind::kRapid || path_.role[k] == model::MoveRole::kApproach;
  };
  const bool up = path_.z[i] > last_.z;
  const bool fed = path_.kind[i] == MoveKind::kLine;
  if (up ? path_.role[i] != model::MoveRole::kRetract : !in_air(i)) return std::nullopt;
  Vec3 goal = last_;
  std::size_t end = i;
  for (; end < path_.size() && straight(end, last_); ++end) {
    const Vec3 to = round(path_.point(end));
    if (up ? to.z <= goal.z : !in_air(end) || to.z >= goal.z) break;
    goal = to;
  }
  if (end == i) return std::nullopt;
  std::size_t begun = i - 1;
  while (begun > 1 && !in_air(begun)) --begun;
  const double r = round(path_.point(begun)).z;
  while (!same(last_, goal)) {
    const Block* b = next(i, goal);
    if (b == nullptr) return false;
    if (!up && fed_through_air(i, end, *b, goal)) break;
    const double sign = up ? 1.0 : -1.0;
    const bool on_way = same(b->to.x, goal.x) && same(b->to.y, goal.y) && sign * (b->to.z - last_.z) > 0.0 &&
                        (sign * (goal.z - b->to.z) > 0.0 || same(b->to.z, goal.z));
    const bool above = last_.z > r || same(last_.z, r);
    const bool kind =
        b->move == MoveKind::kRapid ? !up || !fed || above : up && fed && b->move == MoveKind::kLine;
    if (!on_way || !kind)
      return say(b->line,
                 std::string("the text has ") + name(b->move) + " to " + text_of(b->to) + "; the plan has " +
                     name(path_.kind[i]) + " on its way to " + text_of(goal),
                 static_cast<long>(i));
    if (!numbers_agree(b->move == MoveKind::kRapid ? end - 1 : i, *b)) return false;
    last_ = b->to;
  }
  done_to_ = end - 1;
  return true;
}

/// Whether the path comes back down into a hole that it clears, at the place of move `i` and behind it.
bool Following::is_cleared(std::size_t i) const {
  for (std::size_t k = i; k < path_.size() && path_.x[k] == path_.x[i - 1] && path_.y[k] == path_.y[i - 1];
       ++k) {
    if (path_.kind[k] == MoveKind::kLine && path_.role[k] == MoveRole::kLink && path_.z[k] < path_.z[k - 1])
      return true;
  }
  return false;
}

/// A cycle that clears the hole between pecks is fed from where it comes back to, above where the path begins
/// to be fed: no faster through the air than the path goes there, and behind it as the path. Whether `b` is
/// such a feed; what of it is below `goal` stays to be followed.
bool Following::fed_through_air(std::size_t i, std::size_t end, const Block& b, Vec3 goal) {
  const bool down = b.move == MoveKind::kLine && same(b.to.x, goal.x) && same(b.to.y, goal.y) &&
                    b.to.z < goal.z && !same(b.to.z, goal.z);
  if (!b.from_cycle || b.synchronised || !down || !is_cleared(end)) return false;
  for (std::size_t k = i; k < end; ++k) {
    if (path_.kind[k] == MoveKind::kLine && round(path_.point(k)).z < last_.z &&
        b.feed_mm_min > feed_of(k) + feed_slack())
      return false;
  }
  split(b, goal);
  last_ = goal;
  return true;
}

/// The rest of the block, from there on, is the text's next one.
void Following::split(const Block& b, Vec3 at) {
  rest_.push_back(b);
  rest_.back().from = at;
  text_[--at_] = &rest_.back();
}

/// Between two pecks of a cycle: up a little to break the chip, by rapid or at a feed that is no faster than
/// the plan's, as far as the plan; or back down into the cleared hole, by rapid to where the control is fed
/// again, which is above all that is drilled there, and behind it at the feed of the next peck.
std::optional<bool> Following::peck_way(std::size_t i) {
  std::size_t first = at_;
  while (first < text_.size() && still(*text_[first])) ++first;
  if (first >= text_.size() || !text_[first]->from_cycle) return std::nullopt;
  const Vec3 goal = round(path_.point(i));
  if (path_.kind[i] != MoveKind::kLine || path_.role[i] != MoveRole::kLink || !same(goal.x, last_.x) ||
      !same(goal.y, last_.y) || same(goal.z, last_.z))
    return std::nullopt;
  const Block* b = next(i, goal);
  if (b == nullptr) return false;
  const bool up = goal.z > last_.z;
  const bool straight = same(b->to.x, goal.x) && same(b->to.y, goal.y) && !b->synchronised;
  const auto wrong = [&] {
    return say(b->line,
               std::string("the text has ") + name(b->move) + " to " + text_of(b->to) +
                   " between pecks; the plan goes to " + text_of(goal),
               static_cast<long>(i));
  };
  if (b->move == MoveKind::kLine && b->feed_mm_min > feed_of(i) + feed_slack()) return wrong();
  if (up) {
    if (!straight || !same(b->to, goal) || (b->move != MoveKind::kRapid && b->move != MoveKind::kLine))
      return wrong();
  } else {
    // The last bottom: as low as the path has been since it came to this place.
    double bottom = last_.z;
    for (std::size_t k = i; k-- > 0 && same(path_.x[k], goal.x) && same(path_.y[k], goal.y);)
      bottom = std::min(bottom, round(path_.point(k)).z);
    const bool above = b->to.z > bottom && !same(b->to.z, bottom) && b->to.z < last_.z;
    if (!straight || b->move != MoveKind::kRapid || !above) return wrong();
    if (b->to.z > goal.z && !same(b->to.z, goal.z)) {
      // Fed from higher up than the plan: the rest of the way through the cleared hole is slower.
      last_ = b->to;
      if (!rapid_agrees(i, *b)) return false;
      const Block* fed = next(i, goal);
      if (fed == nullptr) return false;
      if (!fed_through_air(i, i, *fed, goal) || fed->feed_mm_min > feed_of(i) + feed_slack()) return wrong();
      return true;
    }
  }
  if (!rapid_agrees(i, *b)) return false;
  last_ = up ? goal : b->to;
  return true;
}

/// State and speed as the plan has them; of the feed `peck_way` has judged.
bool Following::rapid_agrees(std::size_t i, const Block& b) {
  Block as_rapid = b;
  as_rapid.move = MoveKind::kRapid;
  return numbers_agree(i, as_rapid);
}

}  // namespace capstan::verify
