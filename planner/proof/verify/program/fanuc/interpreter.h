#pragma once

#include <set>
#include <string>
#include <string_view>

#include "planner/proof/verify/program/block_state.h"
#include "planner/proof/verify/program/fanuc/reader.h"
#include "planner/proof/verify/program/fanuc/words.h"

namespace capstan::verify::fanuc {

/// G54 to G59, G54.1 and Haas's G154, as codes times ten.
[[nodiscard]] constexpr bool is_offset(int g) {
  return g == 541 || g == 1540 || (g >= 540 && g <= 590 && g % 10 == 0);
}

/// The control's state, and what one block does to it.
class Interpreter : private BlockState {
 public:
  explicit Interpreter(const model::Machine& machine);
  void line(const Line& l, long number);
  [[nodiscard]] Program finish(long lines);

 private:
  /// What one block says, and which of its numbers have a decimal point.
  struct BlockWords : BlockSaid {
    bool point[26] = {};
    [[nodiscard]] bool code(int tenths) const;
    [[nodiscard]] bool m_code(int m) const;
    [[nodiscard]] bool axes() const { return is('X') || is('Y') || is('Z'); }
  };

  /// The codes that the machine has; `all` where its file lists none.
  struct ListedCodes {
    bool all = true;
    std::set<int> g;  ///< times ten
    std::set<int> m;
  };
  [[nodiscard]] static ListedCodes listed_codes(std::string_view text);

  /// What the machine's file says (options.h).
  struct Ways {
    bool haas = false, seconds = false, m29 = false, proves_out = false;
    int extended_offsets = 0;
    double peck_clearance_mm = 0.0, chip_break_mm = 0.0, tolerance_mm = 0.0, top_mm = 0.0;
    bool quadrants = false, helices = true;
    double largest_radius_mm = 0.0, last_decimal_mm = 0.0;
    std::size_t longest_block = 0;  ///< characters
    ListedCodes codes;
  };

  bool frame(const Line& l);
  bool gather(const Line& l, BlockWords& s);
  /// What a control refuses, or what one reads otherwise than another: block_rules.cpp.
  void word_rules(const BlockWords& s);
  void range_rules(const BlockWords& s);
  void code_rules(const BlockWords& s);
  void point_rules(const BlockWords& s);
  void known_codes(const BlockWords& s);
  void arc_rules(const Block& b);
  void set_words(const BlockWords& s);
  void state_code(int g, const BlockWords& s);
  void unit_code(bool inch, const BlockWords& s);
  void offset_code_of(int g, const BlockWords& s);
  void feed_code(int mode);
  void length_code(int g, const BlockWords& s);
  void path_code(int g, const BlockWords& s);
  void before_move(const BlockWords& s);
  void after_move(const BlockWords& s);
  void change_tool();
  void optional_stop();
  void motion(const BlockWords& s);
  void way_home(const BlockWords& s);
  void cycle(const BlockWords& s);
  void one_hole(double x, double y, double faster_back);
  bool peck_words(const BlockWords& s);
  void pecks(double x, double y);
  void tap(double x, double y, double faster_back);
  /// Seconds with a point, milliseconds without.
  [[nodiscard]] static double seconds_of_p(const BlockWords& s);

  Ways ways_;
  int motion_ = -1;  ///< modal motion code times ten
  int next_tool_ = -1;
  bool opened_ = false, closed_ = false, named_ = false, any_ = false;
  bool smooth_ = false, rigid_ = false, to_r_ = false;
  bool offset_away_ = false;  ///< G53 or G28 took the length offset away; G43 brings it back
  double accuracy_mm_ = 0.0;  ///< of G187, else the machine's
  double r_ = 0.0, z_ = 0.0, q_ = 0.0, p_s_ = 0.0, initial_ = 0.0;
  bool has_r_ = false, has_z_ = false;
  bool shrinks_ = false;  ///< pecks by Haas's I, J and K
  double i_ = 0.0, j_ = 0.0, k_ = 0.0;
};

}  // namespace capstan::verify::fanuc
