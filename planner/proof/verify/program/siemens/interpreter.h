#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/proof/verify/program/block_state.h"
#include "planner/proof/verify/program/siemens/reader.h"
#include "planner/proof/verify/program/siemens/words.h"

namespace capstan::verify::siemens {

/// A cycle with its parameters; those left out are nothing.
struct CycleCall {
  int number = 0;  ///< 81 of CYCLE81
  std::vector<std::optional<double>> params;
  [[nodiscard]] std::optional<double> at(std::size_t i) const {
    return i < params.size() ? params[i] : std::nullopt;
  }
  [[nodiscard]] double of(std::size_t i) const { return at(i).value_or(0.0); }
};

/// The control's state, and what one block does to it.
class Interpreter : private BlockState {
 public:
  explicit Interpreter(const model::Machine& machine);
  void line(const Line& l, long number);
  [[nodiscard]] Program finish(long lines);

 private:
  /// What one block says. R is CR=; codes of G are whole here.
  struct BlockWords : BlockSaid {
    std::optional<double> turns, adis, adispos, ctol;
    bool supa = false, modal_call = false, positions_spindle = false;
    std::optional<std::string> tool_name;
    const Item* call = nullptr;
    [[nodiscard]] bool code(int g_code) const;
    [[nodiscard]] bool m_code(int m_code) const;
    [[nodiscard]] bool axes() const { return is('X') || is('Y') || is('Z'); }
    [[nodiscard]] bool in_machine() const { return supa || code(53) || code(153); }
  };

  /// The heights of a cycle, mm.
  struct Planes {
    double back = 0.0, start = 0.0, reference = 0.0, bottom = 0.0;
  };

  bool gather(const Line& l, BlockWords& s);
  bool take_item(const Item& item, BlockWords& s);
  bool take_code(const Item& item, BlockWords& s);
  bool put_word(char letter, const Item& item, BlockWords& s);
  // What the control refuses: block_rules.cpp.
  void code_rules(const BlockWords& s);
  void word_rules(const BlockWords& s);
  // State: state_codes.cpp.
  void state_codes(const BlockWords& s);
  void state_code(int g, const BlockWords& s);
  void unit(bool inch);
  void work_offset(int code);
  void path_mode(int g, const BlockWords& s);
  void select_tool(const BlockWords& s);
  void edge(double d);
  void change_tool();
  void before_move(const BlockWords& s);
  void after_move(const BlockWords& s);
  void optional_stop();
  void motion(const BlockWords& s);
  void to_machine_place(const BlockWords& s);
  void arc_block(const BlockWords& s);
  void turn(const Block& whole, int further);
  void wait(const BlockWords& s);
  // Cycles: cycles.cpp.
  void call_block(const Item& call, bool modal);
  void pattern(const Item& call, bool modal);
  void pocket(const Item& call, bool modal);  // pockets.cpp
  void face(const Item& call, bool modal);    // faces.cpp
  std::optional<CycleCall> parameters(const Item& call);
  void tolerance_cycle(const CycleCall& c);
  void run_cycle(const CycleCall& c);
  std::optional<Planes> planes(const CycleCall& c);
  void to_height(double z, model::MoveKind kind) { to({at_.x, at_.y, z}, kind); }
  void pause(double dtb);
  void peck(const CycleCall& c, const Planes& p);
  void tap(const CycleCall& c, const Planes& p);
  void tap_in_chuck(const CycleCall& c, const Planes& p);
  void ream(const CycleCall& c, const Planes& p);
  void bore(const CycleCall& c, const Planes& p);

  bool proves_out_ = false;
  std::size_t longest_block_ = 0;  ///< characters
  double top_mm_ = 0.0;
  int motion_ = 1;  ///< of group 1: G1 after a reset
  double next_tool_ = -1.0;
  double contour_tolerance_ = kNoTolerance;  ///< CTOL=
  bool by_contour_tolerance_ = false;        ///< CYCLE832 or G642 is on, which round by CTOL
  std::optional<CycleCall> modal_;
  bool any_ = false;
  bool length_off_ = false;      ///< D0 was stated since; a reset and M6 leave it to machine data
  bool feed_unit_known_ = true;  ///< G70 and G71 leave F in the unit of the control's basic system
};

}  // namespace capstan::verify::siemens
