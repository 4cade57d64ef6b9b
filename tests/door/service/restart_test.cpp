// A program may be begun anew at each step that calls its tool: all that the control must know is said there.
// The reader of the control reads the text from that step on as a control that has just been switched on, and
// what the blocks do there is held against what they do in the whole program.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/proof/verify/program/readers.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

using verify::Block;
using verify::Program;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

/// What begins a file of the control, before its first comment: %, O0001, BEGIN PGM.
std::string frame_of(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& l : lines) {
    if (l.empty() || l.front() == '(' || l.find(';') != std::string::npos) break;
    out += l + "\n";
  }
  return out;
}

/// What a block does, where it goes by its own words, and the state in which it does so. Of a tool change the
/// tool: what held before it is the last tool's.
std::string said(const Block& b) {
  std::string out;
  const auto add = [&](const auto& v) { out += std::to_string(v) + " "; };
  add(static_cast<int>(b.kind));
  if (b.kind == Block::Kind::kToolChange) {
    add(b.tool);
    return out;
  }
  if (b.kind == Block::Kind::kStop || b.kind == Block::Kind::kEnd) return out;
  add(static_cast<int>(b.move));
  for (int i = 0; i < 3; ++i) {
    const double to[] = {b.to.x, b.to.y, b.to.z};
    if (b.words[i]) add(to[i]);
  }
  if (model::is_arc(b.move)) {
    add(b.centre.x);
    add(b.centre.y);
  }
  if (b.kind == Block::Kind::kMove && b.move != model::MoveKind::kRapid) add(b.feed_mm_min);
  add(b.spindle_rpm);
  add(b.tool);
  add(b.length_offset);
  add(b.radius_offset);
  add(b.work_offset);
  add(b.dwell_s);
  add(b.pitch_mm);
  add(static_cast<int>(b.synchronised));
  add(static_cast<int>(b.in_machine));
  add(static_cast<int>(b.mist));
  add(static_cast<int>(b.flood));
  add(static_cast<int>(b.through));
  add(b.tolerance_mm);
  add(static_cast<int>(b.exact_stop));
  return out;
}

/// Holds each step of the program that calls its tool, begun anew, against the whole. Gives how many there
/// are. `through`: codes of coolant through the spindle, with which the second step cuts then.
int expect_restarts(const std::string& control, const std::string& part, const std::string& through = {}) {
  Request request;
  EXPECT_TRUE(set(request, "control", control));
  Job job;
  const auto out = plan(request, {.name = testing::source_dir() + "/examples/" + part}, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error().what));
  if (!out) return 0;
  model::Plan made = out->plan;
  if (!through.empty()) {
    made.machine.control_options = model::ControlOptions{{{"through_coolant", through}}};
    made.steps[1].through = true;
  }
  const auto text = controls::write_program(made, job);
  EXPECT_TRUE(text) << control;
  if (!text) return 0;
  const verify::DialectReader& reader = *verify::reader_of(control);
  const Program whole = reader.program(*text, made.machine);
  const std::vector<std::string> lines = lines_of(*text);
  int found = 0;
  for (std::size_t k = 0; k < whole.markers.size(); ++k) {
    std::vector<const Block*> wanted;
    for (const Block& b : whole.blocks) {
      if (b.marker >= static_cast<int>(k)) wanted.push_back(&b);
    }
    const auto first_of_next = std::find_if(wanted.begin(), wanted.end(),
                                            [&](const Block* b) { return b->marker > static_cast<int>(k); });
    const bool calls = std::any_of(wanted.begin(), first_of_next,
                                   [](const Block* b) { return b->kind == Block::Kind::kToolChange; });
    if (!calls) continue;
    ++found;
    std::string rest = frame_of(lines);
    std::size_t number = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n'));
    for (std::size_t i = static_cast<std::size_t>(whole.markers[k].line) - 1; i < lines.size(); ++i) {
      // Heidenhain numbers each block; a control that begins at one has no gap there.
      const std::size_t digits = lines[i].find_first_not_of("0123456789");
      const bool numbered = control == "heidenhain" && digits > 0 && digits != std::string::npos;
      rest += (numbered ? std::to_string(number++) + lines[i].substr(digits) : lines[i]) + "\n";
    }
    const Program again = reader.program(rest, made.machine);
    for (const verify::ReaderFault& f : again.faults)
      ADD_FAILURE() << control << " step " << whole.markers[k].id << ": " << f.message;
    EXPECT_EQ(again.blocks.size(), wanted.size()) << control << " " << whole.markers[k].id;
    for (std::size_t i = 0; i < std::min(again.blocks.size(), wanted.size()); ++i) {
      const Block& b = again.blocks[i];
      EXPECT_EQ(said(b), said(*wanted[i])) << control << " step " << whole.markers[k].id << ": "
                                           << lines[static_cast<std::size_t>(wanted[i]->line) - 1];
      if (::testing::Test::HasFailure()) return found;
      // Nothing is cut from a place that the control cannot know.
      if (b.kind == Block::Kind::kMove && b.move != model::MoveKind::kRapid) {
        EXPECT_TRUE(b.known_from[0] && b.known_from[1] && b.known_from[2])
            << control << " step " << whole.markers[k].id;
      }
    }
  }
  return found;
}

TEST(Restart, AtEachStepThatCallsItsToolMakesTheSameMovesInTheSameState) {
  for (const controls::Dialect* control : controls::dialects()) {
    const std::string id(control->id);
    if (!control->conformance.rigid_tapping) continue;  // refuses the bracket's thread; its own case below
    EXPECT_GE(expect_restarts(id, "bracket.p21"), 7) << id;
  }
}

TEST(Restart, StatesCoolantThroughTheSpindleToo) {
  EXPECT_GE(expect_restarts("haas", "bracket.p21", "M88/M89"), 7);
  EXPECT_GE(expect_restarts("linuxcnc", "bracket.p21", "M188/M189"), 7);
}

TEST(Restart, OfTwoSetUpsToo) {
  for (const controls::Dialect* control : controls::dialects()) {
    const std::string id(control->id);
    EXPECT_GE(expect_restarts(id, "two_setups.p21"), 3) << id;
  }
}

}  // namespace
}  // namespace capstan::service
