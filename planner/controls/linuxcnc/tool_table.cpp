#include <cmath>
#include <string>
#include <string_view>

#include "planner/controls/gcode/header.h"
#include "planner/controls/gcode/text.h"
#include "planner/controls/linuxcnc/linuxcnc.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/model/plan/cutter/table_offsets.h"

namespace capstan::controls::linuxcnc {
namespace {

/// Six decimals, and more only where the number needs them: what a table said comes out again.
std::string table_number(double v) {
  std::string text = fixed(v, 6);
  if (const auto back = parse_double(text); !back || *back != v) text = shortest(v);
  return text.front() == '-' ? text : "+" + text;
}

/// What the machine's table says of it, but for a diameter that it has been set to since.
std::string table_words(const model::Cutter& c) {
  std::string out;
  for (const std::string_view letter : {"X", "Y", "Z", "A", "B", "C", "U", "V", "W", "D", "I", "J", "Q"}) {
    auto v = model::table_word(c, letter);
    if (letter == "Z" && !v && !c.table_line) v = c.functional_length_mm;
    if (letter == "D" && (!v || std::abs(*v - c.cutting_diameter_mm) > model::kSameDiameterMm))
      v = c.cutting_diameter_mm;
    if (v) out += " " + std::string(letter) + (letter == "Q" ? trimmed(*v, 0) : table_number(*v));
  }
  return out;
}

/// ", assumed carbide" where nobody states what the tool is made of; else nothing.
std::string assumed_words(const model::Plan& plan, const model::Cutter& c) {
  const auto assumed = model::assumed_material_of(plan, c.id);
  if (!assumed) return {};
  return ", " + std::string(model::kAssumedWord) + std::string(model::to_text(assumed->substrate));
}

}  // namespace

std::string write_tool_table(const model::Plan& plan) {
  std::string out;
  for (const model::Cutter* c : gcode::by_tool_number(plan)) {
    if (c->pocket <= 0) continue;
    const auto pocket = model::table_word(*c, "P");
    const std::string t = std::to_string(c->pocket);
    out += "T" + t + " P" + (pocket ? trimmed(*pocket, 0) : t) + table_words(*c) + " ;" +
           gcode::plain_text(c->description.empty() ? c->id : c->description).substr(0, 120) +
           assumed_words(plan, *c) + "\n";
  }
  return out;
}

}  // namespace capstan::controls::linuxcnc
