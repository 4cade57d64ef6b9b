#pragma once

#include <string>

#include "planner/proof/verify/program/block_state.h"
#include "planner/proof/verify/program/grbl/reader.h"
#include "planner/proof/verify/program/grbl/words.h"

namespace capstan::verify::grbl {

/// Grbl's state, and what one line does to it.
class Interpreter : private BlockState {
 public:
  explicit Interpreter(const model::Machine& machine);
  void line(const Line& l, long number);
  [[nodiscard]] Program finish(long lines);

 private:
  bool gather(const Line& l, BlockSaid& s);
  void restate();
  // block_rules.cpp: what Grbl refuses in a block, or reads otherwise than this reader does.
  void block_rules(const BlockSaid& s);
  void code_rules(const BlockSaid& s);
  void word_rules(const BlockSaid& s);
  void state_codes(const BlockSaid& s);
  void state_code(int g);
  void length_code(const BlockSaid& s);
  void machine_codes(const BlockSaid& s);
  void change_tool();
  void motion(const BlockSaid& s, bool machine_coordinates);
  void flow(const BlockSaid& s);

  bool by_m6_ = true, touches_off_ = true, has_mist_ = false;
  int motion_ = 0;  ///< modal motion code times ten; -1: G80. A reset leaves G0
  int next_tool_ = -1;
  bool anywhere_ = false;  ///< a tool was changed, and did not go to a place of the machine since
};

}  // namespace capstan::verify::grbl
