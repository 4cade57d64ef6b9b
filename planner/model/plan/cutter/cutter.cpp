#include "planner/model/plan/cutter/cutter.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/model/plan/cutter/measured_length.h"
#include "planner/model/plan/cutter/outline/outline.h"
#include "planner/model/plan/cutter/stated.h"
#include "planner/model/plan/requirement.h"

namespace capstan::model {
namespace {

/// Null: a flat end with rounded corners.
const outline::Outline* outline_of(const Cutter& c) {
  static const std::vector<outline::Outline> kOutlines = outline::outlines();
  for (const outline::Outline& o : kOutlines)
    if (o.describes(c)) return &o;
  return nullptr;
}

}  // namespace

bool is_stated(const Cutter& c, std::string_view field) {
  for (const std::string_view of : {field, std::string_view("*")}) {
    for (const auto& [name, source] : c.sources)
      if (name == of) return source.starts_with("stated");
  }
  return false;
}

geometry::CutterProfile profile_of(const Cutter& c) {
  if (const outline::Outline* o = outline_of(c)) return o->of(c);
  return geometry::bull_profile(c.cutting_diameter_mm, c.corner_radius_mm, c.maximum_depth_of_cut_mm);
}

double end_radius_mm(const Cutter& c) {
  const outline::Outline* o = outline_of(c);
  return o != nullptr && o->end_radius_mm != nullptr ? o->end_radius_mm(c) : c.corner_radius_mm;
}

double flank_lean_rad(const Cutter& c) {
  const outline::Outline* o = outline_of(c);
  return o != nullptr && o->flank_lean_rad != nullptr ? o->flank_lean_rad(c) : 0.0;
}

double reach_of(const Cutter& c) {
  const double reach = c.usable_length_mm;
  // Chips leave a drill by its flutes, whatever is above them.
  if (has(c.cutter_class, CutterTrait::kDrills)) return reach;
  const double d = c.cutting_diameter_mm + kSizeSlackMm;
  if (c.holder.empty() || !(c.shank_diameter_mm > 0.0) || c.shank_diameter_mm > d) return reach;
  double clear = c.stick_out_mm;
  bool through = false;
  for (const auto& s : c.holder) {
    if (std::max(s.lower_diameter_mm, s.upper_diameter_mm) > d) break;
    clear += s.height_mm;
    through = true;
  }
  return through ? std::max(reach, clear) : reach;
}

double tip_length(const Cutter& c) { return profile_of(c).height(0.5 * c.cutting_diameter_mm); }

std::optional<double> table_word(const Cutter& c, std::string_view letter) {
  if (!c.table_line) return std::nullopt;
  for (const ToolTableWord& w : c.table_line->words) {
    if (w.letter == letter) return w.value;
  }
  return std::nullopt;
}

double length_offset_mm(const Cutter& c) { return table_word(c, "Z").value_or(c.functional_length_mm); }

void take_table_line(Cutter& c, const ToolTableLine& line) {
  c.table_line = line;
  if (line.against_reference || !offset_fault(c).empty()) return;
  take_measured_length(c, *table_word(c, "Z"), "stated: the tool table's Z");
}

void take_measured_length(Cutter& c, double length_mm, const std::string& source) {
  constexpr double kTraceMm = 0.001;
  const double shorter = c.functional_length_mm - length_mm, before = c.stick_out_mm;
  const auto forget = [&](std::string_view field) {
    std::erase_if(c.sources, [&](const auto& s) { return s.first == field; });
  };
  if (before > 0.0 && shorter > 0.0 && !is_stated(c, "stick_out_mm")) {
    c.stick_out_mm = std::max(before - shorter, kTraceMm);
    forget("stick_out_mm");
    c.sources.emplace_back("stick_out_mm", "derived: the tool is " + trimmed(length_mm, 4) +
                                               " mm long where " + trimmed(c.functional_length_mm, 4) +
                                               " was assumed, and its holder is not shorter for that");
  }
  c.functional_length_mm = length_mm;
  c.stick_out_mm = std::min(c.stick_out_mm, length_mm);
  if (before > 0.0 && !is_stated(c, "maximum_depth_of_cut_mm"))
    c.maximum_depth_of_cut_mm = std::min(c.maximum_depth_of_cut_mm, c.stick_out_mm);
  c.usable_length_mm = std::min(c.usable_length_mm, c.stick_out_mm);
  forget("functional_length_mm");
  c.sources.emplace_back("functional_length_mm", source);
}

std::string offset_fault(const Cutter& c) {
  if (!c.table_line) return {};
  const double z = table_word(c, "Z").value_or(0.0);
  const std::string t = "T" + std::to_string(c.pocket) + " has Z" + trimmed(z, 4) + " in the tool table: ";
  if (c.table_line->against_reference) {
    if (!c.table_line->untouched) return {};
    return t + "so has another tool, and only the reference itself has 0; one of them is not measured";
  }
  if (z == 0.0) return t + "it is not measured";
  if (z < 0.0) return t + "no tool has a negative length from the gage line";
  if (z < c.maximum_depth_of_cut_mm) {
    return t + "no length from the gage line, for its flutes alone are " +
           trimmed(c.maximum_depth_of_cut_mm, 4) + " mm long";
  }
  return {};
}

}  // namespace capstan::model
