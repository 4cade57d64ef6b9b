#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/proof/verify/program/program.h"

namespace capstan::verify {

/// What one block says, gathered before it is carried out in its control's order.
struct BlockSaid {
  double value[26] = {};
  bool has[26] = {};
  int g[32] = {};  ///< codes times ten
  int g_count = 0;
  int m[16] = {};
  int m_count = 0;
  [[nodiscard]] bool is(char c) const { return has[c - 'A']; }
  [[nodiscard]] double of(char c) const { return value[c - 'A']; }
};

/// What a reader gives for a text above kProgramCap: the one finding that it was not read.
[[nodiscard]] Program too_large_program();

/// The state of a control that the readers of RS-274 dialects share, and the moves that blocks make of it:
/// straight ones, arcs in the XY plane, dwells. What codes and words mean is each reader's own.
class BlockState {
 protected:
  void fault(int property, std::string code, std::string message, bool undecided = false);
  /// Starts the spindle: 1 as M3, -1 as M4.
  void start(int way);
  /// G17, G18 or G19.
  void plane(int code);
  void target(const BlockSaid& s, Block& b, bool machine_coordinates);
  /// `mode`: 0 rapid, 1 feed.
  void straight(const BlockSaid& s, int mode, bool machine_coordinates);
  /// At feed to the words of axes, or to where the probe touches before: where that is nobody knows.
  void toward(const BlockSaid& s);
  /// By R, or by I and J; both ways of giving an arc mean the same to all these controls.
  void arc(const BlockSaid& s, bool clockwise);
  /// A helix of one block: `whole` turns by `total`, rad, about its centre, up or down in step. It becomes
  /// half turns; what is left at the end as less than kLeastOfHalfTurn belongs to the last one.
  void half_turns(const Block& whole, double total);
  void put(Block b);
  /// A move of a canned cycle.
  void to(geometry::Vec3 p, model::MoveKind kind, bool synchronised = false);
  /// The moves of a pocket cycle (pocket/pocket_moves.cpp), or a fault.
  void mill(Pocket p);
  /// The moves of a face cycle (pocket/face_moves.cpp), or a fault.
  void mill(FacedArea f);
  /// The diameter of the tool that is called, by the program's header, mm; 0: it does not say it.
  [[nodiscard]] double called_diameter_mm() const;
  void dwell(double seconds);
  [[nodiscard]] Block block() const;
  /// Notes what the machine's file says of M codes of its builder: `shop_codes` ("M51 M52") move and switch
  /// nothing that the check follows, `through_coolant` ("M88/M89") switches the coolant through the spindle
  /// on and off. What is no M with a whole number is no code, and stays unknown.
  void builders_codes(std::string_view shop_codes, std::string_view through_coolant);
  /// Whether M `code` is one of these; it is carried out then. A code with a meaning of the control's own is
  /// none, whatever the file lists: each reader asks only for those behind all that it knows.
  [[nodiscard]] bool builders(int code);
  /// M7, M8 or M9, one of which may be what the machine's file names for coolant through the spindle.
  void coolant(int code);
  [[nodiscard]] double units() const { return inch_ ? 25.4 : 1.0; }
  [[nodiscard]] double speed() const;

  std::vector<int> shop_codes_;
  int through_on_ = -1, through_off_ = -1;  ///< M codes; -1: not stated
  bool through_ = false;
  Program out_;
  long line_ = 0;
  int marker_ = -1;
  geometry::Vec3 at_;
  bool known_[3] = {false, false, false};
  bool inch_ = false, units_stated_ = false, moved_ = false;
  bool absolute_ = true, absolute_arcs_ = false, plane_xy_ = true;
  int feed_mode_ = 94;
  double feed_ = 0.0, speed_ = 0.0;
  int spindle_ = 0;  ///< 1 M3, -1 M4
  bool cycle_active_ = false;
  int tool_ = 0, length_ = -1, radius_ = -1, offset_ = 0;
  std::optional<double> machine_z_;
  int starts_ = 0;
  double started_s_ = 0.0;
  bool moved_since_ = false;
  std::size_t cycle_blocks_ = 0;
  int turned_ = 0;  ///< half turns of helices
  bool mist_ = false, flood_ = false, left_ = false;
  double tolerance_ = kNoTolerance, naive_ = kNoTolerance;
  bool exact_stop_ = false;
  unsigned stated_ = 0;
};

}  // namespace capstan::verify
