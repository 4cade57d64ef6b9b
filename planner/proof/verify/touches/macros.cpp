#include "planner/proof/verify/touches/macros.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/proof/verify/sweep/apart.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/touches/measured.h"
#include "planner/proof/verify/volumes/nouns.h"

namespace capstan::verify {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double kAlong = 0.999999;  ///< cosine

/// Where the ball's centre begins, and where its surface meets the wall: the set-up's frame, mm.
struct Way {
  Vec3 start, wall;
  char axis = 'Z';
  double ball = 0.0, stem = 0.0;
};

double along(const Vec3& v, char axis) { return axis == 'X' ? v.x : axis == 'Y' ? v.y : v.z; }

std::optional<Way> way_of(const model::Plan& plan, model::AnyRef touch, std::size_t setup) {
  const model::Model& m = plan.model;
  const auto& p = m.at<model::WorkpieceProbing>(touch);
  const auto start = volumes::frame_of(m, p.start_position);
  const auto direction = volumes::unit_of(m, p.direction);
  const auto* expected = m.get<model::TolerancedLengthMeasure>(p.expected_value);
  const auto* probe = m.get<model::TouchProbe>(p.its_probe);
  if (!start || !direction || expected == nullptr || !expected->theoretical_size || probe == nullptr ||
      !probe->ball_radius)
    return std::nullopt;
  const geometry::Placement piece = workpiece_in(plan, setup);
  Way w;
  w.ball = *probe->ball_radius;
  w.stem = std::max(w.ball, probe->stylus_diameter.value_or(0.0) / 2.0);
  w.start = piece.to_parent(start->origin);
  w.wall = piece.to_parent(start->origin + (*expected->theoretical_size + w.ball) * *direction);
  const Vec3 d = w.wall - w.start;
  for (const char axis : {'X', 'Y', 'Z'}) {
    if (std::abs(along(d, axis)) > kAlong * norm(d)) {
      w.axis = axis;
      return w;
    }
  }
  return std::nullopt;
}

std::string_view stripped(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

/// Without the number of the block.
std::string_view numberless(std::string_view line) {
  line = stripped(line);
  if (line.size() < 2 || line[0] != 'N' || line[1] < '0' || line[1] > '9') return line;
  return stripped(line.substr(std::min(line.find_first_not_of("0123456789", 1), line.size())));
}

std::vector<std::string_view> blocks_of(std::string_view macro) {
  std::vector<std::string_view> out;
  while (!macro.empty()) {
    const std::size_t bar = std::min(macro.find('|'), macro.size());
    if (const auto one = stripped(macro.substr(0, bar)); !one.empty()) out.push_back(one);
    macro.remove_prefix(std::min(bar + 1, macro.size()));
  }
  return out;
}

/// What stands in a place of the macro.
struct Place {
  std::string_view text;
  double number = 0.0;
  bool is_number = false;
};

class Reading {
 public:
  Reading(const model::Plan& plan, model::AnyRef touch, const Way& w)
      : way_(w),
        slack_(0.51 * std::pow(10.0, -plan.machine.control.decimals)),
        points_(plan.machine.control.dialect == "fanuc" || plan.machine.control.dialect == "haas") {
    const auto& p = plan.model.at<model::WorkpieceProbing>(touch);
    id_ = p.its_id.value_or("");
    const auto* probe = plan.model.get<model::TouchProbe>(p.its_probe);
    const auto* usage = probe == nullptr ? nullptr : plan.model.get<model::ToolUsage>(probe->its_usage);
    if (usage != nullptr) tool_ = usage->its_position.value_or("");
  }

  [[nodiscard]] bool says(std::string_view line, std::string_view block) const {
    while (!block.empty()) {
      if (block.front() != '{') {
        if (line.empty() || line.front() != block.front()) return false;
        line.remove_prefix(1);
        block.remove_prefix(1);
        continue;
      }
      const std::size_t end = block.find('}');
      if (end == std::string_view::npos || !place(block.substr(1, end - 1), line)) return false;
      block.remove_prefix(end + 1);
    }
    return line.empty();
  }

 private:
  [[nodiscard]] bool place(std::string_view name, std::string_view& line) const {
    if (name == "feature") return word(line, id_);
    if (name == "probe") return !tool_.empty() && word(line, tool_);
    if (name == "axis") return word(line, std::string(1, way_.axis));
    if (name == "nominal") return number(line, along(way_.wall, way_.axis));
    if (name == "x") return number(line, way_.start.x);
    if (name == "y") return number(line, way_.start.y);
    return name == "z" && number(line, way_.start.z);
  }

  /// Letters and digits as they are, else _.
  static bool word(std::string_view& line, const std::string& text) {
    if (line.size() < text.size()) return false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      const bool kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
      if (line[i] != (kept ? c : '_')) return false;
    }
    line.remove_prefix(text.size());
    return true;
  }

  [[nodiscard]] bool number(std::string_view& line, double wanted) const {
    const std::size_t end = std::min(line.find_first_not_of("+-.0123456789"), line.size());
    std::string digits(line.substr(0, end));
    if (digits.starts_with('+')) digits.erase(0, 1);
    const bool point = digits.find('.') != std::string::npos;
    if (digits.ends_with('.')) digits += '0';
    const auto value = parse_double(digits);
    line.remove_prefix(end);
    if (points_ && value && *value != 0.0 && !point) return false;
    return value && std::abs(*value - wanted) <= slack_;
  }

  const Way way_;
  double slack_;
  bool points_;  ///< a length without its point counts thousandths on one machine, millimetres on another
  std::string id_, tool_;
};

/// What is in the way of it; empty: nothing is.
std::string in_the_way(const model::Plan& plan, const Way& w, std::size_t setup) {
  const double head = model::control_number(plan.machine, "probe_radius_mm", 0.0);
  const double stylus = model::control_number(plan.machine, "probe_stylus_mm", 0.0);
  if (!(head > 0.0) || !(stylus > 0.0)) return "the probe, whose sizes the machine's file does not state";
  const model::Workholding& holding = plan.setups[setup].holding;
  if (holding.solids.empty()) return "what holds the piece, which nobody has said";
  if (plan.stock.box.empty()) return "the raw piece, which is not known";
  const geometry::Box3 raw = placed(plan.stock.box, workpiece_in(plan, setup));
  const std::vector<Vec2> sides{
      {raw.lo.x, raw.lo.y}, {raw.hi.x, raw.lo.y}, {raw.hi.x, raw.hi.y}, {raw.lo.x, raw.hi.y}};
  const std::vector<Vec2> begin{xy(w.start)}, way{xy(w.start), xy(w.wall)};
  const double low = std::min(w.start.z, w.wall.z), gap = holding.clearance_mm;
  const bool under_start = w.start.z - w.ball < raw.hi.z + gap, under_head = low + stylus < raw.hi.z + gap;
  if ((under_start && apart(begin, sides) < w.stem + gap) || (under_head && apart(way, sides) < head + gap))
    return "the piece";
  for (const model::FixtureSolid& s : holding.solids) {
    if (s.outline.empty()) continue;
    const double off = apart(way, s.outline);
    if ((low - w.ball < s.top_mm + gap && off < w.stem + gap) ||
        (low + stylus < s.top_mm + gap && off < head + gap))
      return s.id;
  }
  return {};
}

}  // namespace

WithoutMacros without_macros(std::string_view text, const model::Plan& plan) {
  WithoutMacros out{std::string(text), {}};
  const auto blocks = blocks_of(model::control_option(plan.machine, "probe_macro"));
  if (blocks.empty() || plan.steps.empty()) return out;
  struct Wanted {
    MacroTouch touch;
    Reading reading;
    bool done = false;
  };
  std::vector<Wanted> wanted;
  for (const auto& [before, touches] : touches_before(plan)) {
    const auto step = std::find_if(plan.steps.begin(), plan.steps.end(),
                                   [&, b = before](const model::StepResult& s) { return s.step == b; });
    const std::size_t setup = step == plan.steps.end() ? plan.steps.back().setup : step->setup;
    for (const model::AnyRef t : touches) {
      if (const auto way = way_of(plan, t, setup))
        wanted.push_back({{t, before, setup, 0, 0, 0}, Reading(plan, t, *way), false});
    }
  }
  struct Row {
    std::size_t begin, end;
  };
  std::vector<Row> rows;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    rows.push_back({at, end});
    at = end + 1;
  }
  for (std::size_t i = 0; i + blocks.size() <= rows.size(); ++i) {
    for (Wanted& w : wanted) {
      bool all = !w.done;
      for (std::size_t k = 0; all && k < blocks.size(); ++k) {
        const Row r = rows[i + k];
        all = w.reading.says(numberless(text.substr(r.begin, r.end - r.begin)), blocks[k]);
      }
      if (!all) continue;
      w.done = true;
      w.touch.first = static_cast<long>(i) + 1;
      w.touch.last = static_cast<long>(i + blocks.size());
      out.touches.push_back(w.touch);
      for (std::size_t k = 0; k < blocks.size(); ++k)
        std::fill(out.text.begin() + static_cast<long>(rows[i + k].begin),
                  out.text.begin() + static_cast<long>(rows[i + k].end), ' ');
      i += blocks.size() - 1;
      break;
    }
  }
  for (MacroTouch& t : out.touches) {
    auto row = static_cast<std::size_t>(t.last);
    const auto empty = [&] {
      const std::string_view left(out.text);
      return stripped(left.substr(rows[row].begin, rows[row].end - rows[row].begin)).empty();
    };
    while (row < rows.size() && empty()) ++row;
    t.behind = static_cast<long>(row) + 1;
  }
  return out;
}

void check_macros(const ProgramCase& c, const std::vector<MacroTouch>& touches, Findings& findings) {
  const model::Plan& plan = *c.plan;
  const auto step_at = [&](std::size_t marker) -> const model::StepResult* {
    const long i = marker < c.step_of_marker.size() ? c.step_of_marker[marker] : -1;
    return i < 0 ? nullptr : &plan.steps[static_cast<std::size_t>(i)];
  };
  const auto pocket = [&](const model::StepResult& s) {
    const auto* cutter = model::find_cutter(plan, s.cutter_id);
    return cutter != nullptr ? cutter->pocket : 0;
  };
  for (const MacroTouch& t : touches) {
    std::size_t next = 0;
    while (next < c.program.markers.size() && c.program.markers[next].line < t.first) ++next;
    Block at;
    at.marker = static_cast<int>(next) - 1;
    at.line = t.first;
    const Findings::Where where = c.where(at);
    const std::string name =
        "the macro of '" + plan.model.at<model::WorkpieceProbing>(t.touch).its_id.value_or("") + "' ";
    const model::StepResult* behind = next == 0 ? nullptr : step_at(next - 1);
    const model::StepResult* then = next < c.program.markers.size() ? step_at(next) : nullptr;
    if (behind == nullptr || (then == nullptr) != (next == c.program.markers.size()) ||
        (then == nullptr ? model::AnyRef{} : model::AnyRef(then->step)) != t.before ||
        behind->setup != t.setup) {
      findings.error(33, "CHK-PROBE-CALL", where,
                     name +
                         "does not stand where the plan measures, behind a step of "
                         "its set-up; take it there");
      continue;
    }
    if (then != nullptr && pocket(*then) == pocket(*behind))
      findings.error(4, "CHK-PROBE-CALL", where,
                     name + "stands before a step that calls no tool: whether T" +
                         std::to_string(pocket(*then)) +
                         " is in the spindle again is not known; measure by hand");
    const Block *before = nullptr, *after = nullptr;
    for (const Block& b : c.program.blocks) {
      if (b.line < t.first) before = &b;
      if (b.line > t.last && after == nullptr) after = &b;
    }
    const bool away =
        before != nullptr && at_top(*before, c.machine) &&
        (after == nullptr || (after->spindle_rpm == 0.0 && !after->flood && !after->mist && !after->through));
    const bool back = after != nullptr && after->line == t.behind && after->kind == Block::Kind::kMove &&
                      after->in_machine && after->move == model::MoveKind::kRapid && !after->words[0] &&
                      !after->words[1] && at_top(*after, c.machine);
    if (!away || !back)
      findings.error(
          31, "CHK-PROBE-CALL", where,
          name + (away ? "is not followed by a way to the top of Z: where it ends is not known"
                       : "begins before the tool is at the top of Z with spindle and coolant off"));
    const auto way = way_of(plan, t.touch, t.setup);
    const std::string what = in_the_way(plan, *way, t.setup);
    if (!what.empty())
      findings.error(what == "the piece" ? 9 : 31, "CHK-PROBE-WAY", where,
                     name + "goes down at X" + trimmed(way->start.x, 3) + " Y" + trimmed(way->start.y, 3) +
                         " to Z" + trimmed(way->start.z, 3) + ", which is not proven clear of " + what +
                         "; measure by hand at the stop");
  }
}

}  // namespace capstan::verify
