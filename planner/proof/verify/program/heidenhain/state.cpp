#include <algorithm>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/heidenhain/interpreter.h"

// Tools, and what a step has without stating it.

namespace capstan::verify::heidenhain {

/// At a marker: what the language itself fixes, and the length, which goes with the tool. A control that
/// starts within a program reads all before it first.
void Interpreter::restate() {
  stated_ = kStatedPlane | kStatedDistance | kStatedFeedMode | kStatedCycle;
  if (units_stated_) stated_ |= kStatedUnits;
  if (tool_ > 0) stated_ |= kStatedLength;
}

/// TOOL CALL 5 Z S3000 changes the tool; TOOL CALL Z S3000 and TOOL CALL S3000 state a speed.
void Interpreter::tool_call(const std::vector<std::string>& w) {
  std::optional<double> speed, tool;
  bool axis = false;
  for (std::size_t i = 2; i < w.size(); ++i) {
    const std::string& word = w[i];
    if (i == 2) {
      tool = number_behind(word, "");
      if (tool) continue;
    }
    if (word == "Z") {
      once(axis, "the tool axis Z");
      axis = true;
    } else if (const auto s = number_behind(word, "S")) {
      once(speed.has_value(), "S");
      speed = s;
    } else {
      return fault(33, "CHK-UNVERIFIABLE",
                   "the word " + word.substr(0, 20) +
                       " of TOOL CALL is not followed: a number, Z and S are (no name, feed, oversize)",
                   true);
    }
  }
  if (!tool && !speed) return fault(4, "CHK-TOOL", "TOOL CALL names neither a tool nor a speed");
  if (speed) {
    constexpr double kMostSpeed = 99999.999;  // TNC 640 ISO programming, 19.3
    if (*speed < 0.0 || *speed > kMostSpeed)
      fault(33, "CHK-WORD", "S" + plain(*speed) + " is not from 0 to " + plain(kMostSpeed) + " 1/min");
    speed_ = *speed;
    stated_ |= kStatedSpeed;
  }
  if (!tool) return;
  constexpr double kMostTool = 32767.0;  // TNC 640 ISO programming, 5.2
  if (*tool < 0.0 || *tool > kMostTool || *tool != std::floor(*tool))
    return fault(4, "CHK-TOOL",
                 "TOOL CALL " + plain(*tool) + ": tools have whole numbers from 0 to " + plain(kMostTool));
  if (!axis) return fault(33, "CHK-SYNTAX", "TOOL CALL with a tool has no tool axis (Z)");
  change_tool(static_cast<int>(*tool));
}

void Interpreter::change_tool(int tool) {
  Block b = block();
  b.kind = Block::Kind::kToolChange;
  if (tool_ != tool) known_[2] = false;  // nobody knows where this one's tip is
  b.tool = tool_ = tool;
  out_.blocks.push_back(b);
  length_ = tool_ > 0 ? tool_ : -1;
  if (tool_ > 0) stated_ |= kStatedLength;
  spindle_ = 0;
}

/// Makes a tool ready, or, with a length, defines one: in programs without a tool table.
void Interpreter::tool_definition(const std::vector<std::string>& w) {
  if (w.size() == 3 && number_behind(w[2], "")) return;
  unfollowed("TOOL DEF with a length, radius or name");
}

void Interpreter::stop() {
  Block b = block();
  b.kind = Block::Kind::kStop;
  out_.stops.push_back(b);
  out_.blocks.push_back(b);
}

}  // namespace capstan::verify::heidenhain
