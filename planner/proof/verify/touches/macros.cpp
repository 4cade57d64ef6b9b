#include "planner/proof/verify/touches/macros.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/proof/verify/touches/measured.h"
#include "planner/proof/verify/touches/way.h"

namespace capstan::verify {
namespace {

std::string_view stripped(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The digits that a Heidenhain's block begins with; 0: none, as in any block of another control.
std::size_t bare_number(std::string_view line) {
  const std::size_t digits = std::min(line.find_first_not_of("0123456789"), line.size());
  return digits < line.size() && line[digits] != ' ' ? 0 : digits;
}

/// Without the number of the block.
std::string_view numberless(std::string_view line) {
  line = stripped(line);
  if (!line.empty() && is_digit(line[0])) return stripped(line.substr(bare_number(line)));
  if (line.size() < 2 || line[0] != 'N' || !is_digit(line[1])) return line;
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

class Reading {
 public:
  Reading(const model::Plan& plan, model::AnyRef touch, const TouchWay& w, std::size_t setup)
      : way_(w),
        security_(plan.setups[setup].security_z_mm),
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
    const bool up = along(way_.wall, way_.axis) > along(way_.start, way_.axis);
    if (name == "axis_number") return word(line, std::to_string(way_.axis - 'X' + 1));
    if (name == "sign") return line.starts_with(up ? '+' : '-') && (line.remove_prefix(1), true);
    if (name == "direction")
      return (up || (line.starts_with('-') && (line.remove_prefix(1), true))) && word(line, "1");
    if (name == "way") return word(line, up ? "1" : "2");
    if (name == "distance")
      return number(line, std::abs(along(way_.wall, way_.axis) - along(way_.start, way_.axis)) - way_.ball);
    if (name == "security") return number(line, security_);
    if (name == "tip") return number(line, way_.start.z - way_.ball);
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

  const TouchWay way_;
  double security_;
  double slack_;
  bool points_;  ///< a length without its point counts thousandths on one machine, millimetres on another
  std::string id_, tool_;
};

}  // namespace

WithoutMacros without_macros(std::string_view text, const model::Plan& plan) {
  WithoutMacros out{std::string(text), {}};
  const auto blocks = blocks_of(model::probe_macro_blocks(plan.machine));
  if (blocks.empty() || !model::unconfirmed_probe_macro(plan.machine).empty() || plan.steps.empty())
    return out;
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
        wanted.push_back({{t, before, setup, 0, 0, 0}, Reading(plan, t, *way, setup), false});
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
      // A number alone is a block that says nothing, and those behind it go on from it.
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        const Row r = rows[i + k];
        const std::size_t number = bare_number(text.substr(r.begin, r.end - r.begin));
        std::fill(out.text.begin() + static_cast<long>(r.begin + number),
                  out.text.begin() + static_cast<long>(r.end), ' ');
      }
      i += blocks.size() - 1;
      break;
    }
  }
  for (MacroTouch& t : out.touches) {
    auto row = static_cast<std::size_t>(t.last);
    const auto empty = [&] {
      const std::string_view left(out.text);
      return numberless(left.substr(rows[row].begin, rows[row].end - rows[row].begin)).empty();
    };
    while (row < rows.size() && empty()) ++row;
    t.behind = static_cast<long>(row) + 1;
  }
  return out;
}

void check_macros(const ProgramCase& c, const std::vector<MacroTouch>& touches, Findings& findings) {
  const model::Plan& plan = *c.plan;
  for (const MacroTouch& t : touches) {
    const StandsBetween at = between_steps(c, t.first);
    const Findings::Where& where = at.where;
    const std::string name =
        "the macro of '" + plan.model.at<model::WorkpieceProbing>(t.touch).its_id.value_or("") + "' ";
    if (!stands_right(at, t.before, t.setup)) {
      findings.error(33, "CHK-PROBE-CALL", where,
                     name +
                         "does not stand where the plan measures, behind a step of "
                         "its set-up; take it there");
      continue;
    }
    if (calls_no_tool(c, at))
      findings.error(4, "CHK-PROBE-CALL", where,
                     name +
                         "stands before a step that calls no tool: it would cut with the probe; state its "
                         "call, or measure by hand");
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
    auto way = way_of(plan, t.touch, t.setup);
    const geometry::Vec3 to_wall = way->wall - way->start;
    way->wall = way->wall + (model::probe_macro_beyond_mm(plan.machine) / norm(to_wall)) * to_wall;
    const std::string what = in_the_way(plan, *way, t.setup);
    if (!what.empty())
      findings.error(what == "the piece" ? 9 : 31, "CHK-PROBE-WAY", where,
                     name + "goes down at X" + trimmed(way->start.x, 3) + " Y" + trimmed(way->start.y, 3) +
                         " to Z" + trimmed(way->start.z, 3) + ", which is not proven clear of " + what +
                         "; measure by hand at the stop");
  }
}

}  // namespace capstan::verify
