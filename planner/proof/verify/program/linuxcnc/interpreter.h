#pragma once

#include <string>

#include "planner/proof/verify/program/block_state.h"
#include "planner/proof/verify/program/linuxcnc/reader.h"
#include "planner/proof/verify/program/linuxcnc/words.h"

namespace capstan::verify::linuxcnc {

/// What a control that speaks RS274/NGC does otherwise than LinuxCNC.
struct Ways {
  bool mach3 = false;
  double unit_of_p_s = 1.0;   ///< of P, the time of G4 and of cycles
  double tolerance_mm = 0.0;  ///< of G64, which has no word for it at Mach3
  std::size_t longest_line = kLineCap;
};

/// The interpreter's state, and what one line does to it.
class Interpreter : private BlockState {
 public:
  Interpreter(std::string_view shop_codes, std::string_view through_coolant) {
    builders_codes(shop_codes, through_coolant);
  }
  /// Mach3's, by what the machine's file says (mach3.cpp).
  explicit Interpreter(const model::Machine& machine);
  [[nodiscard]] std::string name() const { return ways_.mach3 ? "Mach3" : "LinuxCNC"; }
  [[nodiscard]] std::size_t longest_line() const { return ways_.longest_line; }
  void line(const Line& l, long number);
  [[nodiscard]] Program finish(long lines);

 private:
  bool gather(const Line& l, BlockSaid& s);
  /// What LinuxCNC refuses in a block, or reads otherwise than this reader does: block_rules.cpp.
  void block_rules(const Line& l, const BlockSaid& s);
  void word_rules(const BlockSaid& s);
  void code_rules(const BlockSaid& s);
  /// What Mach3 has not, or does by a setting: mach3.cpp.
  void mach3_rules(const Line& l, const BlockSaid& s);
  void percent(const Line& l);
  /// A comment that LinuxCNC carries out (Line::command).
  void command(const std::string& name);
  void state_codes(const BlockSaid& s);
  void state_code(int g, const BlockSaid& s);
  void length_code(int g, const BlockSaid& s);
  void machine_codes(const BlockSaid& s);
  void motion(const BlockSaid& s, bool machine_coordinates);
  void tap(const BlockSaid& s);
  void cycle(const BlockSaid& s);
  void one_hole(int mode, double x, double y, double z, double r, double q, double p, double clear);

  Ways ways_;
  bool arcs_stated_ = false;  ///< G90.1 or G91.1
  int motion_ = -1;           ///< modal motion code times ten
  int next_tool_ = -1;
  bool any_line_ = false, percent_ = false, percent_end_ = false;
  bool return_to_r_ = false;
  bool cycle_known_ = false;
  double cycle_r_ = 0.0, cycle_z_ = 0.0, cycle_q_ = 0.0, cycle_p_ = 0.0, cycle_clear_ = 0.0;
  bool has_q_ = false;
};

}  // namespace capstan::verify::linuxcnc
