#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

/// Follows the text of one step beside the plan's path: the way to its start, its moves, and that nothing but
/// a retract comes behind. The first departure becomes the step's finding.
///
/// What the text may write otherwise than the path: coordinates, feeds and speeds rounded to the control's
/// decimals; arcs in pieces, and lines for pieces that are flat after rounding; rapids one axis after the
/// other; the wait for the spindle after each start and reversal. A straight move to where the tool is says
/// nothing.
class Following {
 public:
  /// `text`  moves and dwells behind the marker; `high` whether the tool is at the top of Z when it begins.
  Following(const ProgramCase& c, std::size_t marker, std::size_t step, std::vector<const Block*> text,
            bool high, Findings& out);
  void run();

 private:
  bool approach();
  bool approach_move(const Block& b);
  bool begins_path(const Block& b) const;
  bool one(std::size_t i);
  bool dwell(std::size_t i);
  bool arc(std::size_t i, geometry::Vec3 goal);
  bool rapid(std::size_t i, geometry::Vec3 begin, geometry::Vec3 goal);
  bool begins_pocket();
  bool pocket_cycle();
  bool begins_face();
  bool face_cycle();
  std::optional<bool> hole_way(std::size_t i);
  std::optional<bool> peck_way(std::size_t i);
  [[nodiscard]] bool is_cleared(std::size_t i) const;
  bool fed_through_air(std::size_t i, std::size_t end, const Block& b, geometry::Vec3 goal);
  void split(const Block& b, geometry::Vec3 at);
  bool rapid_agrees(std::size_t i, const Block& b);
  [[nodiscard]] static const char* name(model::MoveKind k);
  bool arc_piece(std::size_t i, const Block& b, const Move& whole, double& done);
  bool nothing_behind();
  /// The next block that does something; null when there is none, or it waits when it should not.
  const Block* next(std::size_t i, geometry::Vec3 goal);
  bool spin_up(const Block& b) const;
  bool kind_agrees(std::size_t i, const Block& b);
  bool state_agrees(long i, const Block& b);
  bool numbers_agree(std::size_t i, const Block& b);
  bool tap_agrees(std::size_t i, const Block& b);

  [[nodiscard]] bool coolant_differs(const Block& b) const {
    return b.flood != step_.flood || b.mist != step_.mist || b.through != step_.through;
  }
  [[nodiscard]] bool still(const Block& b) const;
  [[nodiscard]] long marker_line() const { return c_.program.markers[marker_].line; }
  [[nodiscard]] geometry::Vec3 round(geometry::Vec3 v) const;
  [[nodiscard]] bool same(double a, double b) const;
  [[nodiscard]] bool same(geometry::Vec3 a, geometry::Vec3 b) const;
  [[nodiscard]] std::string text_of(geometry::Vec3 v) const;
  /// The plan's move, as it is before rounding.
  [[nodiscard]] Move planned(std::size_t i) const;
  [[nodiscard]] double radius_of(std::size_t i) const;
  [[nodiscard]] double feed_of(std::size_t i) const;
  /// What rounding a feed as programs write it leaves, mm/min.
  [[nodiscard]] double feed_slack() const;
  [[nodiscard]] double speed_of(std::size_t i) const;
  bool say(long line, const std::string& what, long move, int property = 33, const char* code = "CHK-TEXT");

  const ProgramCase& c_;
  std::size_t marker_;
  const model::StepResult& step_;
  const model::CutterPath& path_;
  const model::Cutter* cutter_;
  std::vector<const Block*> text_;
  std::deque<Block> rest_;  ///< of blocks that the path makes in two moves
  bool high_;
  Findings& out_;
  int decimals_;
  double unit_;
  double arc_off_;      ///< how far an arc may stand off the plan's, mm
  double speed_slack_;  ///< of the written speed, 1/min
  bool tapped_ = false;
  std::size_t done_to_ = 0;  ///< moves of the path up to this one are followed
  double security_;
  double travel_height_ = 0.0;
  std::size_t at_ = 0;
  int starts_ = 0;  ///< of the spindle, that were waited for
  geometry::Vec3 last_;
};

}  // namespace capstan::verify
