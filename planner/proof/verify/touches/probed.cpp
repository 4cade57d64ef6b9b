#include "planner/proof/verify/touches/probed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/proof/verify/touches/measured.h"
#include "planner/proof/verify/touches/way.h"

namespace capstan::verify {
namespace {

using geometry::Vec3;
using model::MoveKind;

constexpr std::string_view kCall = "CHK-PROBE-CALL";

std::set<int> probes_of(const Program& program, const model::Plan* plan,
                        const std::vector<model::Cutter>& cutters) {
  std::set<int> out;
  for (const model::Cutter& c : plan != nullptr ? plan->cutters : cutters) {
    if (c.cutter_class == model::CutterClass::kTouchProbe && c.pocket > 0) out.insert(c.pocket);
  }
  for (const HeaderTool& t : program.tools) {
    if (plan == nullptr && cutters.empty() && t.kind == "touch_probe") out.insert(t.tool);
  }
  return out;
}

/// A touch of the plan that may stand at a place of the program.
struct Wanted {
  model::AnyRef touch;
  TouchWay way;
};

/// One way of the probe as the program has it: the places of the ball's lowest point.
struct Made {
  Vec3 start, end;
  double touch_feed = 0.0, way_feed = 0.0;
  char axis = 'Z';
};

std::string at_text(const Vec3& v) {
  return "X" + trimmed(v.x, 4) + " Y" + trimmed(v.y, 4) + " Z" + trimmed(v.z, 4);
}

class Probing {
 public:
  Probing(const ProgramCase& c, const Probed& p, const ToolTable& table, std::set<model::AnyRef>& done,
          Findings& out)
      : c_(c),
        p_(p),
        plan_(*c.plan),
        table_(table),
        done_(done),
        out_(out),
        slack_(0.51 * std::pow(10.0, -c.machine.control.decimals)),
        feed_slack_(0.51 * std::pow(10.0, -c.machine.control.feed_decimals)),
        at_(between_steps(c, p.blocks.front().line)) {}

  void run() {
    if (!stands()) return;
    called();
    if (p_.blocks.size() < 2 || !up(p_.blocks[1]))
      return say(31, p_.blocks.front(),
                 "the probe does not go to the top of Z behind its call: " +
                     std::string(c_.reader.words.to_top) + plain(top_of(c_.machine)));
    std::size_t i = 1;
    while (i < p_.blocks.size()) {
      if (up(p_.blocks[i])) {
        ++i;
        continue;
      }
      const auto made = touch(i);
      if (!made) return;
      held(*made, p_.blocks[i]);
      i += kMoves;
    }
    if (!at_top(p_.blocks.back(), c_.machine))
      say(31, p_.blocks.back(), "the probe is left below the top of Z; retract it behind its last touch");
  }

 private:
  static constexpr std::size_t kMoves = 4;  ///< of a touch: over, down, along, back

  void say(int property, const Block& b, const std::string& what) {
    Findings::Where where = at_.where;
    where.move = b.line;
    out_.error(property, std::string(kCall), where, what);
  }

  bool stands() {
    const Block& b = p_.blocks.front();
    std::vector<model::AnyRef> due;
    setup_ = at_.then != nullptr ? at_.then->setup : plan_.steps.back().setup;
    for (const auto& [before, touches] : touches_before(plan_)) {
      if (stands_right(at_, before, setup_)) due = touches;
    }
    if (due.empty()) {
      say(33, b, "T" + std::to_string(b.tool) + " touches where the plan measures nothing; take it out");
      return false;
    }
    for (const model::AnyRef t : due) {
      if (const auto way = way_of(plan_, t, setup_)) wanted_.push_back({t, *way});
    }
    if (calls_no_tool(c_, at_))
      say(4, b,
          "T" + std::to_string(b.tool) +
              " touches before a step that calls no tool: it would cut with the probe; measure by hand");
    return true;
  }

  void called() {
    const Block& b = p_.blocks.front();
    const Block& last = p_.before;
    if (!at_top(last, c_.machine) || b.spindle_rpm != 0.0 || b.flood || b.mist || b.through)
      say(31, b, "the probe is called before the tool is at the top of Z with spindle and coolant off");
    const model::Cutter* probe = c_.cutter(b.tool);
    if (probe == nullptr || !model::offset_fault(*probe).empty() ||
        !(model::length_offset_mm(*probe) > 0.0) ||
        (probe->table_line && probe->table_line->against_reference))
      say(6, b,
          "T" + std::to_string(b.tool) +
              " touches, and how low it goes is not known, for its length is not measured; measure it");
    const auto rows =
        std::count_if(table_.entries.begin(), table_.entries.end(),
                      [&](const ToolTableEntry& e) { return e.tool == b.tool && e.has_length; });
    if (c_.has_table && rows != 1)
      say(6, b,
          "T" + std::to_string(b.tool) + " touches, and stands " + std::to_string(rows) +
              " times with a length in the tool table; it must stand there once");
  }

  /// To the top of Z.
  [[nodiscard]] bool up(const Block& b) const {
    return b.kind == Block::Kind::kMove && b.in_machine && b.move == MoveKind::kRapid && !b.probes &&
           !b.words[0] && !b.words[1] && b.words[2] && at_top(b, c_.machine);
  }

  /// What must hold in each of its moves.
  [[nodiscard]] std::string state_fault(const Block& b) const {
    if (b.kind != Block::Kind::kMove || b.in_machine) return "is no move of a touch";
    if (b.spindle_rpm != 0.0 || b.flood || b.mist || b.through) return "has spindle or coolant on";
    if (b.work_offset != offset_code(plan_.setups[setup_].work_offset))
      return "is not in " + plan_.setups[setup_].work_offset + ", the work offset of the set-up";
    if (b.length_offset != b.tool) return "is without the length of T" + std::to_string(b.tool);
    if (b.radius_offset >= 0 || b.cycle_active) return "has a radius or a cycle active";
    // Grbl follows the exact path, and has no word that says otherwise.
    if (b.tolerance_mm != 0.0 && c_.machine.control.dialect != "grbl")
      return "may round its corners: state exact stop";
    return {};
  }

  /// The touch that begins with block `i`; nothing, and a finding, for any other moves.
  std::optional<Made> touch(std::size_t i) {
    const auto wrong = [&](const Block& b, const std::string& what) {
      say(31, b,
          "the probe " + what +
              "; a touch goes over its start at the top of Z, straight down, along one axis, " +
              "back to its start and up");
      return std::nullopt;
    };
    if (i + kMoves > p_.blocks.size()) return wrong(p_.blocks.back(), "makes a part of a touch only");
    const Block &over = p_.blocks[i], &down = p_.blocks[i + 1], &reach = p_.blocks[i + 2],
                &back = p_.blocks[i + 3];
    for (const Block* b : {&over, &down, &reach, &back}) {
      if (const std::string fault = state_fault(*b); !fault.empty()) return wrong(*b, "makes what " + fault);
    }
    if (!at_top(p_.blocks[i - 1], c_.machine) || over.probes || over.move != MoveKind::kRapid ||
        over.words[2] || !over.words[0] || !over.words[1])
      return wrong(over, "does not begin with a rapid across at the top of Z");
    if (down.probes || down.move != MoveKind::kLine || !down.words[2] || down.words[0] || down.words[1])
      return wrong(down, "does not go straight down at a feed");
    Made m;
    m.start = down.to;
    m.end = reach.to;
    m.touch_feed = reach.feed_mm_min;
    m.way_feed = std::max(down.feed_mm_min, back.feed_mm_min);
    int axes = 0;
    for (int a = 0; a < 3; ++a) {
      if (!reach.words[a]) continue;
      ++axes;
      m.axis = static_cast<char>('X' + a);
    }
    if (!reach.probes || axes != 1)
      return wrong(reach, "does not touch along one axis by a move that ends at the touch");
    bool same = !back.probes && back.move == MoveKind::kLine;
    for (int a = 0; a < 3; ++a) {
      const char axis = static_cast<char>('X' + a);
      same = same && back.words[a] == (axis == m.axis);
      if (axis == m.axis) same = same && along(back.to, axis) == along(m.start, axis);
    }
    if (!same) return wrong(back, "does not go back to its start");
    const Block* after = i + kMoves < p_.blocks.size() ? &p_.blocks[i + kMoves] : nullptr;
    if (after == nullptr || !up(*after)) return wrong(back, "is not taken to the top of Z behind the touch");
    return m;
  }

  void held(const Made& m, const Block& over) {
    const double beyond = model::control_number(plan_.machine, "probe_overtravel_mm", 0.0);
    const double feed = model::control_number(plan_.machine, "probe_feed_mm_min", 0.0);
    const double way_feed = model::control_number(plan_.machine, "probe_way_mm_min", 0.0);
    const auto near = [](double a, double b, double slack) { return std::abs(a - b) <= slack; };
    const auto of_plan = [&](const Wanted& w) {
      const Vec3 s = w.way.start;
      return !done_.contains(w.touch) && w.way.axis == m.axis && near(s.x, m.start.x, slack_) &&
             near(s.y, m.start.y, slack_) && near(s.z - w.way.ball, m.start.z, slack_);
    };
    const auto w = std::find_if(wanted_.begin(), wanted_.end(), of_plan);
    if (w == wanted_.end())
      return say(33, over,
                 "the probe touches along " + std::string(1, m.axis) + " from " + at_text(m.start) +
                     " (of its lowest place), which is no touch of the plan here, or one a second time");
    done_.insert(w->touch);
    const double up = along(w->way.wall, m.axis) > along(w->way.start, m.axis) ? 1.0 : -1.0;
    const double met = along(w->way.wall, m.axis) - (m.axis == 'Z' ? 0.0 : up * w->way.ball);
    const double wanted = met + up * beyond;
    if (!(beyond > 0.0) || !near(along(m.end, m.axis), wanted, slack_))
      say(33, over,
          "the touch ends at " + std::string(1, m.axis) + trimmed(along(m.end, m.axis), 4) +
              " at the latest; by probe_overtravel_mm " + trimmed(beyond, 4) + " it is " +
              trimmed(wanted, 4));
    if (!(feed > 0.0) || !near(m.touch_feed, feed, feed_slack_) || !near(m.way_feed, way_feed, feed_slack_))
      say(18, over,
          "the probe touches at " + trimmed(m.touch_feed, 3) + " and goes there at " +
              trimmed(m.way_feed, 3) + " mm/min; the machine's file states " + trimmed(feed, 3) +
              " (probe_feed_mm_min) and " + trimmed(way_feed, 3) + " (probe_way_mm_min)");
    TouchWay read = w->way;
    const Vec3 ball{0.0, 0.0, read.ball};
    read.start = m.start + ball;
    read.wall = m.end + ball;
    const std::string what = in_the_way(plan_, read, setup_);
    if (what.empty()) return;
    Findings::Where where = at_.where;
    where.move = over.line;
    out_.error(what == "the piece" ? 9 : 31, "CHK-PROBE-WAY", where,
               "the probe goes down to " + at_text(m.start) + ", which is not proven clear of " + what +
                   "; measure by hand at the stop");
  }

  const ProgramCase& c_;
  const Probed& p_;
  const model::Plan& plan_;
  const ToolTable& table_;
  std::set<model::AnyRef>& done_;  ///< touches that were made
  Findings& out_;
  const double slack_, feed_slack_;
  const StandsBetween at_;
  std::size_t setup_ = 0;
  std::vector<Wanted> wanted_;
};

}  // namespace

std::vector<Probed> take_probed(Program& program, const model::Plan* plan,
                                const std::vector<model::Cutter>& cutters) {
  std::vector<Probed> out;
  const std::set<int> probes = probes_of(program, plan, cutters);
  if (probes.empty()) return out;
  std::vector<Block>& all = program.blocks;
  std::vector<Block> kept;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    bool touches = false;
    if (all[i].kind == Block::Kind::kToolChange && probes.contains(all[i].tool)) {
      while (end < all.size() && all[end].marker == all[i].marker &&
             (all[end].kind == Block::Kind::kMove || all[end].kind == Block::Kind::kDwell)) {
        touches = touches || all[end].probes;
        ++end;
      }
    }
    if (!touches) {
      kept.push_back(all[i++]);
      continue;
    }
    Probed p;
    if (i > 0) p.before = all[i - 1];
    p.blocks.assign(all.begin() + static_cast<std::ptrdiff_t>(i),
                    all.begin() + static_cast<std::ptrdiff_t>(end));
    out.push_back(std::move(p));
    i = end;
  }
  if (!out.empty()) all = std::move(kept);
  return out;
}

void check_probed(const ProgramCase& c, const std::vector<Probed>& probed, const ToolTable& table,
                  Findings& findings) {
  std::set<model::AnyRef> done;
  for (const Block& b : c.program.blocks) {
    if (b.probes)
      findings.error(
          33, std::string(kCall), c.where(b),
          "a move that ends where a probe touches, with no probe called for it in its step; take it "
          "out, or call the probe that the plan touches with");
  }
  for (const Probed& p : probed) {
    if (c.plan != nullptr && !c.plan->steps.empty()) {
      Probing(c, p, table, done, findings).run();
      continue;
    }
    findings.unproved(Severity::kWarning, 31, "CHK-PROBE-WAY", c.where(p.blocks.front()),
                      "T" + std::to_string(p.blocks.front().tool) +
                          " touches the piece: whether its way is clear is not known without the plan");
  }
}

}  // namespace capstan::verify
