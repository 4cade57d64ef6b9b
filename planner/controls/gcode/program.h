#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/controls/gcode/moves/arcs.h"
#include "planner/controls/gcode/moves/helices.h"
#include "planner/controls/gcode/words.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::controls::gcode {

/// The text of a program as it grows, and what the control knows at its end: position, feed.
/// Units  mm, mm/min, 1/min, s. Positions are those of the work offset, rounded as they are written.
class Program {
 public:
  Program(const model::Control& control, const Words& words) : control_(control), words_(words) {}

  /// A block, or some with line ends between; with its number where each block has one.
  void line(std::string_view text);
  /// The number N of the step at hand, before what is written next.
  void number_step(std::size_t n);
  /// A comment, in as many lines as its text needs.
  void comment(std::string_view text);
  /// A comment of one line, however long: what the check reads. The caller keeps it short (marker_text).
  void marker(std::string_view text);
  void blank();

  /// A cycle had a feed of its own: the next one is written.
  void forget_feed() { feed_.clear(); }
  /// Forgets position and feed, so that the next words are all written.
  void forget();
  [[nodiscard]] geometry::Vec3 round(geometry::Vec3 p) const;
  [[nodiscard]] std::string number(double v) const;
  [[nodiscard]] std::string feed(double v) const;

  /// `G0` or `G1 ... F`, with the words that change; nothing when none does.
  void rapid(geometry::Vec3 to);
  void cut(geometry::Vec3 to, double feed_mm_min);
  /// Stands in the block of the next move of Z, which is then written whole.
  void with_next_height(std::string words) { with_height_ = std::move(words); }
  /// Stands in the block of the next move, whatever moves; `words` begin with a blank.
  void with_next_move(std::string words) { with_move_ = std::move(words); }
  /// In a block of their own what still waits for a move.
  void write_waiting();
  /// Words are always written, changed or not.
  void rapid_xy(geometry::Vec3 to);
  void rapid_z(double z);
  void arc(geometry::Vec3 to, double i, double j, bool clockwise, double feed_mm_min);
  /// A helix in one block, with its turns beyond the first.
  void helix(const Helix& h, bool clockwise, double feed_mm_min);
  [[nodiscard]] ArcForm arc_form() const;
  /// A word by word line whose motion ends at `to`; `restate`: only to half a unit, so that the next move
  /// across says both X and Y.
  void moved(std::string_view text, geometry::Vec3 to, bool restate = false);

  /// The tool stands there, though nothing is written.
  void stands_at(geometry::Vec3 to) { arrive(to); }
  /// The last known position; nothing after `forget` or a move in machine coordinates.
  [[nodiscard]] std::optional<geometry::Vec3> at() const;
  void lost_z() { z_.reset(); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  [[nodiscard]] std::string coordinate(double v) const;
  [[nodiscard]] std::string changed(geometry::Vec3 to) const;
  /// A line with its number, where each has one (BlockNumbers::kLines).
  void numbered_line(std::string_view text);
  /// `from`, decimals and feed are filled in.
  void turn(ArcBlock arc, double feed_mm_min);
  [[nodiscard]] std::string arc_text(const ArcBlock& arc) const;
  void arrive(geometry::Vec3 to);
  /// What waits for the next move, once.
  [[nodiscard]] std::string waiting();
  [[nodiscard]] std::string feed_word(double feed_mm_min);

  const model::Control& control_;
  const Words& words_;
  std::string text_;
  std::optional<double> x_, y_, z_;
  std::string feed_, with_height_, with_move_, step_number_;
  long block_ = 0;
  bool goes_on_ = false;     ///< the next line belongs to the block before it
  bool restate_xy_ = false;  ///< the last block's end is rounded otherwise than a place is
};

}  // namespace capstan::controls::gcode
