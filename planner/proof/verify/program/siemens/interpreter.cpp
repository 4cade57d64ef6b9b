#include "planner/proof/verify/program/siemens/interpreter.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/reader_options.h"

// One block after another: what it says, the state it sets, its move, the modal cycle behind it, its stop.
// M0, M1, M2, M5, M9 and M30 act when the block's move has ended.

namespace capstan::verify::siemens {

bool Interpreter::BlockWords::code(int g_code) const {
  return std::find(g, g + g_count, g_code) != g + g_count;
}
bool Interpreter::BlockWords::m_code(int m_code) const {
  return std::find(m, m + m_count, m_code) != m + m_count;
}

Interpreter::Interpreter(const model::Machine& machine) {
  builders_codes(option(machine, "shop_codes"), option(machine, "through_coolant"));
  const std::string_view proves = option(machine, "prove_out");
  proves_out_ = proves == "m1" || proves == "skip_m0";
  longest_block_ = static_cast<std::size_t>(option_number(machine, "line_length"));
  const model::LinearAxis& z = machine.axes[2];
  top_mm_ = z.travel_max_mm > z.travel_min_mm ? z.travel_max_mm : 0.0;
}

bool Interpreter::take_code(const Item& item, BlockWords& s) {
  const double v = item.value.value_or(-1.0);
  if (!(v >= 0.0 && v < 10000.0) || v != std::floor(v)) {
    fault(33, "CHK-CODE", item.name + plain(v) + " is not a code");
    return false;
  }
  const bool g = item.name == "G";
  int& count = g ? s.g_count : s.m_count;
  const std::size_t most = g ? std::size(s.g) : std::size(s.m);
  if (static_cast<std::size_t>(count) >= most) {
    fault(33, "CHK-CODE",
          "the block has more than " + std::to_string(most) + " codes of " + item.name +
              " and was not followed: write some of them in a block of their own");
    return false;
  }
  (g ? s.g : s.m)[count++] = static_cast<int>(v);
  return true;
}

bool Interpreter::put_word(char letter, const Item& item, BlockWords& s) {
  if (!item.value) {
    fault(1, "CHK-NUMBER", item.name + " has a text where a number belongs");
    return false;
  }
  const int i = letter - 'A';
  if (i < 0 || i >= static_cast<int>(std::size(s.value))) {
    fault(33, "CHK-WORD", item.name + " is no address; a name of a variable has two letters at least", true);
    return false;
  }
  if (s.has[i]) fault(33, "CHK-WORD-TWICE", "the word " + item.name + " occurs twice in one block");
  s.has[i] = true;
  s.value[i] = *item.value;
  return true;
}

bool Interpreter::take_item(const Item& item, BlockWords& s) {
  if (item.call) {
    if (s.call != nullptr) fault(33, "CHK-WORD-TWICE", "two calls in one block");
    s.call = &item;
    return true;
  }
  if (item.name == "T" && item.text) {
    s.tool_name = item.text;
    return true;
  }
  if ((item.name == "G" || item.name == "M") && item.assigned) {
    fault(33, "CHK-UNVERIFIABLE", item.name + "= is not followed", true);
    return false;
  }
  if (item.name == "G" || item.name == "M") return take_code(item, s);
  if (item.name.size() == 1) return put_word(item.name.front(), item, s);
  if (item.name == "CR") return put_word('R', item, s);
  const auto number = [&](std::optional<double>& into) {
    if (!item.value) {
      fault(1, "CHK-NUMBER", item.name + "= has no number");
      return false;
    }
    if (into) fault(33, "CHK-WORD-TWICE", item.name + "= occurs twice in one block");
    into = item.value;
    return true;
  };
  if (item.name == "TURN") return number(s.turns);
  if (item.name == "ADIS") return number(s.adis);
  if (item.name == "ADISPOS") return number(s.adispos);
  if (item.name == "CTOL") return number(s.ctol);
  if (item.name == "SUPA" && !item.assigned) {
    s.supa = true;
    return true;
  }
  if (item.name == "MCALL" && !item.assigned) {
    s.modal_call = true;
    return true;
  }
  if (item.name == "SPOS" && item.value) {
    s.positions_spindle = true;
    return true;
  }
  fault(33, "CHK-UNVERIFIABLE",
        item.name + " is not followed: what it moves, shifts, sets or jumps to is not known", true);
  return false;
}

bool Interpreter::gather(const Line& l, BlockWords& s) {
  for (std::size_t i = 0; i < l.items.size(); ++i) {
    if (l.items[i].name == "R") {
      fault(33, "CHK-UNVERIFIABLE", "R parameters are not followed", true);
      return false;
    }
    if (l.items[i].name == "N" && i > 0) fault(33, "CHK-WORD", "N does not begin its block");
    if (!take_item(l.items[i], s)) return false;
  }
  return true;
}

/// Whole turns and the arc.
void Interpreter::turn(const Block& whole, int further) {
  Move m;
  m.kind = whole.move;
  m.from = whole.from;
  m.to = whole.to;
  m.centre = whole.centre;
  half_turns(whole, sweep_of(m) + 2.0 * std::numbers::pi * further);
}

void Interpreter::arc_block(const BlockWords& s) {
  const std::size_t before = out_.blocks.size();
  arc(s, motion_ == 2);
  if (out_.blocks.size() == before || !s.turns) return;
  if (s.turns < 0.0 || s.turns > 999.0 || *s.turns != std::floor(*s.turns))
    return fault(23, "CHK-ARC", "TURN=" + plain(*s.turns) + " is no number of turns from 0 to 999");
  if (*s.turns == 0.0) return;
  const Block whole = out_.blocks.back();
  out_.blocks.pop_back();
  turn(whole, static_cast<int>(*s.turns));
}

/// SUPA suppresses all frames and shifts, not the tool: with its length on Z says where the tip goes,
/// wherever that is. G53 leaves the base frames on, G153 shifts by the handwheel and from outside.
void Interpreter::to_machine_place(const BlockWords& s) {
  if (modal_)
    fault(26, "CHK-CYCLE",
          "a move in machine coordinates while a modal call is on would run the cycle there");
  if (motion_ > 1)
    return fault(33, "CHK-WORD", "a move in machine coordinates behind an arc; state G0 with it");
  if (!absolute_) return fault(33, "CHK-WORD", "SUPA in incremental mode (G91) is not followed; state G90");
  straight(s, motion_, true);
  if (!s.supa) {
    fault(10, "CHK-MACHINE-MOVE",
          std::string(s.code(153) ? "G153 leaves shifts by handwheel and external offsets on"
                                  : "G53 leaves base frames and shifts by handwheel on") +
              ", so where the axes go is not known; state SUPA");
    machine_z_.reset();
    out_.blocks.back().machine_z.reset();
    return;
  }
  if (!s.is('Z') || length_off_) return;
  fault(10, "CHK-MACHINE-MOVE",
        (length_ < 0 ? "whether a tool's length is on is machine data here, so that Z"
                     : "the tool's length is on, so Z") +
            plain(s.of('Z')) + " says where its tip goes and not the axis; state D0 in this block");
  machine_z_.reset();
  out_.blocks.back().machine_z.reset();
}

void Interpreter::motion(const BlockWords& s) {
  for (int i = 0; i < s.g_count; ++i) {
    if (s.g[i] >= 0 && s.g[i] <= 3) motion_ = s.g[i];
  }
  const bool centre = s.is('I') || s.is('J');
  if (!s.axes() && !(centre && motion_ >= 2)) return;
  if (!units_stated_) {
    fault(2, "CHK-UNITS", "a move before the unit of length was stated (G71, G710 or G70, G700)");
    units_stated_ = true;
  }
  if (s.in_machine()) return to_machine_place(s);
  if (motion_ >= 2) {
    arc_block(s);
  } else {
    straight(s, motion_, false);
  }
  if (modal_) run_cycle(*modal_);
}

void Interpreter::wait(const BlockWords& s) {
  if (s.is('S')) return fault(33, "CHK-UNVERIFIABLE", "G4 S, turns of the spindle, is not followed", true);
  if (!s.is('F') || s.of('F') < 0.0) return fault(33, "CHK-WORD", "G4 has no F, the seconds that it waits");
  dwell(s.of('F'));
}

void Interpreter::line(const Line& l, long number) {
  line_ = number;
  if (l.comment && read_comment(*l.comment, line_, out_)) {
    marker_ = static_cast<int>(out_.markers.size()) - 1;
    stated_ = 0;
  }
  if (l.percent && any_)
    fault(33, "CHK-SYNTAX", "a % within the program: it begins a file as it comes over a serial line");
  if (!l.fault.empty())
    fault(l.no_number ? 1 : 33,
          l.no_number      ? "CHK-NUMBER"
          : l.unverifiable ? "CHK-UNVERIFIABLE"
                           : "CHK-SYNTAX",
          l.fault, l.unverifiable);
  if (l.items.empty()) return;
  any_ = true;
  if (out_.ended) return fault(32, "CHK-END", "text goes on after the end of the program");
  BlockWords s;
  if (!gather(l, s)) return;
  const std::size_t words = s.is('N') ? 2 : 1;
  const bool only_stop = s.g_count == 0 && s.m_count == 1 && s.m[0] < 2 && l.items.size() == words;
  if (l.skipped && only_stop) return optional_stop();
  if (l.skipped)
    fault(33, "CHK-UNVERIFIABLE", "a block that may be skipped (/) is taken as not skipped", true);
  if (l.length > longest_block_)
    fault(33, "CHK-SYNTAX",
          "the block has " + std::to_string(l.length) + " characters; this machine's have " +
              std::to_string(longest_block_) + " at most: write it as several");
  code_rules(s);
  word_rules(s);
  if (s.modal_call || s.call != nullptr) {
    if (l.items.size() != words + (s.modal_call && s.call != nullptr ? 1 : 0))
      fault(26, "CHK-CYCLE", "a call needs a block of its own; its other words are not followed");
    if (s.call != nullptr) return call_block(*s.call, s.modal_call);
    modal_.reset();
    cycle_active_ = false;
    stated_ |= kStatedCycle;
    return;
  }
  state_codes(s);
  if (s.code(4)) {
    if (l.items.size() != words + 1)  // N, G4 and its time
      fault(33, "CHK-WORD", "G4 needs a block of its own; its other words are not followed");
    return wait(s);
  }
  before_move(s);
  motion(s);
  after_move(s);
}

Program Interpreter::finish(long lines) {
  out_.lines = lines;
  return std::move(out_);
}

Program read_program(std::string_view text, const model::Machine& machine) {
  if (text.size() > kProgramCap) return too_large_program();
  Interpreter control(machine);
  Line line;
  long number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    split_line(text.substr(0, end), line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    control.line(line, ++number);
  }
  return control.finish(number);
}

}  // namespace capstan::verify::siemens
