#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/proof/verify/program/block_state.h"
#include "planner/proof/verify/program/heidenhain/reader.h"
#include "planner/proof/verify/program/heidenhain/words.h"

namespace capstan::verify::heidenhain {

/// A cycle that is defined, with its Q parameters.
struct CycleDefinition {
  int number = 0;
  std::map<int, double> q;
  [[nodiscard]] bool has(int parameter) const { return q.contains(parameter); }
  [[nodiscard]] double of(int parameter) const {
    const auto at = q.find(parameter);
    return at == q.end() ? 0.0 : at->second;
  }
};

/// The control's state, and what one block does to it.
class Interpreter : private BlockState {
 public:
  explicit Interpreter(const model::Machine& machine);
  /// `number`: that of the text's line in which the block begins.
  void block_line(const Line& l, long number);
  [[nodiscard]] Program finish(long lines);

 private:
  /// What one block of movement says.
  struct Said {
    BlockSaid axes;  ///< absolute, mm; I, J: the circle's centre from the start; R: the radius of CR
    bool rapid = false, in_machine = false, incremental = false, radius = false;
    std::optional<double> feed, angle;
    std::optional<bool> clockwise;
    std::vector<int> m;
    [[nodiscard]] bool any_axis() const { return axes.is('X') || axes.is('Y') || axes.is('Z'); }
    [[nodiscard]] bool has_m(int code) const;
  };
  /// The heights of a cycle, mm.
  struct Heights {
    double start = 0.0, bottom = 0.0, back = 0.0;
  };

  void unfollowed(const std::string& what);
  void block_number(const Line& l);
  void comments(const Line& l);
  void dispatch(const Line& l);
  void begin_program(const std::vector<std::string>& w);
  void end_program(const std::vector<std::string>& w);
  void misc(const std::vector<std::string>& w);
  void move(const std::vector<std::string>& w);
  bool take(const std::string& word, std::string_view kind, Said& s);
  bool take_axis(const std::string& word, Said& s);
  bool take_radius(const std::string& word, Said& s);
  bool take_arc(const std::string& word, std::string_view kind, Said& s, bool& followed);
  /// `before`: it stood in this block already.
  void once(bool before, const std::string& what);
  void pole(const std::vector<std::string>& w);
  void arc_block(std::string_view kind, Said& s);
  void helix(const Said& s);
  void one_of_a_kind(const std::vector<int>& m);
  void before_move(const std::vector<int>& m);
  /// `stop_block`: the block is a STOP.
  void after_move(const std::vector<int>& m, bool stop_block = false);
  void optional_stop();
  // state.cpp
  void tool_call(const std::vector<std::string>& w);
  void tool_definition(const std::vector<std::string>& w);
  void change_tool(int tool);
  void restate();
  void stop();
  // cycles.cpp
  void cycle_definition(const std::vector<std::string>& w);
  void old_cycle(const std::string& number, const std::vector<std::string>& w);
  void q_cycle(int number, const std::vector<std::string>& w);
  void preset(const CycleDefinition& c);
  void call_cycle();
  std::optional<Heights> heights(const CycleDefinition& c);
  bool complete(const CycleDefinition& c);
  bool pecks_alike(const CycleDefinition& c);
  void to_height(double z, model::MoveKind kind) { to({at_.x, at_.y, z}, kind); }
  void drill(const CycleDefinition& c, const Heights& h);
  void ream(const CycleDefinition& c, const Heights& h);
  void peck(const CycleDefinition& c, const Heights& h);
  void bore(const CycleDefinition& c, const Heights& h);
  void out_of(const CycleDefinition& c, const Heights& h);
  void tap(const CycleDefinition& c, const Heights& h);
  void pocket(const CycleDefinition& c, const Heights& h);  // pockets.cpp
  void table_angle(std::string_view comment);

  bool proves_out_ = false;
  std::string pecking_;            ///< which parameters cycle 205 has
  std::size_t longest_block_ = 0;  ///< characters
  std::string name_;               ///< of BEGIN PGM
  bool begun_ = false, closed_ = false;
  std::optional<long> last_number_;
  std::optional<geometry::Vec2> pole_;  ///< CC
  std::optional<CycleDefinition> cycle_;
  int tolerance_part_ = 0;  ///< lines of cycle 32 so far
  bool waits_for_dwell_ = false;
  std::map<int, double> table_angles_;  ///< degrees, by tool: what a comment says of its ANGLE
};

}  // namespace capstan::verify::heidenhain
