#pragma once

#include <string>

#include "planner/proof/verify/program/linuxcnc/reader.h"
#include "planner/proof/verify/program/linuxcnc/words.h"

namespace capstan::verify::linuxcnc {

/// The interpreter's state, and what one line does to it.
class Interpreter {
 public:
  void line(const Line& l, long number);
  [[nodiscard]] Program finish(long lines);

 private:
  /// What one line says, gathered before it is carried out in RS274's order.
  struct Said {
    double value[26] = {};
    bool has[26] = {};
    int g[32] = {};  ///< codes times ten
    int g_count = 0;
    int m[16] = {};
    int m_count = 0;
    [[nodiscard]] bool is(char c) const { return has[c - 'A']; }
    [[nodiscard]] double of(char c) const { return value[c - 'A']; }
  };

  bool gather(const Line& l, Said& s);
  /// What LinuxCNC refuses in a block, or reads otherwise than this reader does: block_rules.cpp.
  void block_rules(const Line& l, const Said& s);
  void word_rules(const Said& s);
  void code_rules(const Said& s);
  void percent(const Line& l);
  void start(int way);
  /// A comment that LinuxCNC carries out (Line::command).
  void command(const std::string& name);
  void fault(int property, std::string code, std::string message, bool undecided = false);
  void state_codes(const Said& s);
  void state_code(int g, const Said& s);
  void length_code(int g, const Said& s);
  void machine_codes(const Said& s);
  void motion(const Said& s, bool machine_coordinates);
  void target(const Said& s, Block& b, bool machine_coordinates);
  void straight(const Said& s, int mode, bool machine_coordinates);
  void arc(const Said& s, bool clockwise);
  void tap(const Said& s);
  void cycle(const Said& s);
  void one_hole(int mode, double x, double y, double z, double r, double q, double p, double clear);
  void put(Block b);
  void to(geometry::Vec3 p, model::MoveKind kind, bool synchronised = false);
  void dwell(double seconds);
  [[nodiscard]] Block block() const;
  [[nodiscard]] double units() const { return inch_ ? 25.4 : 1.0; }
  [[nodiscard]] double speed() const;

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
  int motion_ = -1;  ///< modal motion code times ten
  int tool_ = 0, next_tool_ = -1, length_ = -1, radius_ = -1, offset_ = 0;
  std::optional<double> machine_z_;
  int starts_ = 0;
  double started_s_ = 0.0;
  bool moved_since_ = false;
  bool any_line_ = false, percent_ = false, percent_end_ = false;
  std::size_t cycle_blocks_ = 0;
  bool mist_ = false, flood_ = false, left_ = false;
  bool return_to_r_ = false;
  bool cycle_known_ = false;
  double cycle_r_ = 0.0, cycle_z_ = 0.0, cycle_q_ = 0.0, cycle_p_ = 0.0, cycle_clear_ = 0.0;
  bool has_q_ = false;
  double tolerance_ = kNoTolerance, naive_ = kNoTolerance;
  bool exact_stop_ = false;
  unsigned stated_ = 0;
};

}  // namespace capstan::verify::linuxcnc
