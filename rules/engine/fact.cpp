#include "rules/engine/fact.h"

#include <algorithm>
#include <stdexcept>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/shape_kind.h"

namespace capstan::rules {
namespace {

FactType number(std::string_view name, double from, double below, std::string_view meaning) {
  return {name, FactKind::kNumber, from, below, {}, meaning};
}
FactType symbols(std::string_view name, std::vector<std::string_view> values, std::string_view meaning) {
  return {name, FactKind::kSymbol, 0.0, 0.0, std::move(values), meaning};
}

/// Kinds of shape; a countersink is a kind of its own beside other holes.
std::vector<std::string_view> shapes() {
  std::vector<std::string_view> out{to_text(model::ShapeKind::kHole), "countersink"};
  for (const model::ShapeKindRow& r : model::shape_kinds())
    if (r.value != model::ShapeKind::kHole) out.push_back(r.name);
  return out;
}

std::size_t index_of(std::string_view name) {
  const auto i = find_fact(name);
  if (!i) throw std::logic_error("there is no fact named " + std::string(name));
  return *i;
}

}  // namespace

const std::vector<FactType>& fact_types() {
  static const std::vector<FactType> kTypes{
      number("depth_mm", 0.0, 10000.0, "depth of the feature"),
      number("depth_ratio", 0.0, 10000.0, "depth by diameter, width or passage"),
      {"it_grade",
       FactKind::kInteger,
       0.0,
       19.0,
       {},
       "ISO 286 grade to be held: of the tightest size, or what tables texture, position and form take it "
       "for; "
       "0: below IT1"},
      {"depth_it_grade", FactKind::kInteger, 0.0, 19.0, {}, "ISO 286 grade of the depth"},
      symbols("material_group", {"P", "M", "K", "N", "S", "H", "unknown"}, "ISO 513 group of the material"),
      number("diameter_mm", 0.0, 10000.0, "diameter of a hole at its top"),
      symbols("bottom", {"through", "flat", "flat_with_radius", "conical", "spherical"}, "bottom of a hole"),
      symbols("taper", {"none", "countersink", "countersink_below", "other"},
              "wall of a hole: upright, a cone a countersink can cut from above or from below, another cone"),
      symbols("point", {"none", "drill", "countersink", "other"},
              "conical bottom: that of a standard drill, of a countersink, of neither"),
      symbols("reamer", {"fits", "none"},
              "whether a standard H7 reamer makes the hole: its tolerance, and its position as the drill "
              "left it"),
      symbols("core", {"none", "hole", "above"},
              "whether a smaller coaxial hole goes on below the bottom, or is the only way in from above"),
      symbols("access", {"closed", "open"}, "whether a cutter can enter from the side"),
      symbols("sides", {"free", "wall"}, "of a face: free all round, or solid stands beside it"),
      symbols("wall", {"upright", "drafted"}, "walls along the tool axis, or sloped"),
      symbols("floor", {"open", "closed"}, "whether the bottom is a surface of the part"),
      symbols("floor_edge", {"sharp", "rounded"}, "edge between wall and bottom"),
      number("passage_mm", 0.0, 20000.0, "diameter of the largest cutter that reaches every passage"),
      symbols("slot_form", {"square", "vee", "radiused_vee", "round", "tee", "dovetail", "other"},
              "profile of a slot"),
      number("slot_angle_deg", 0.0, 180.0, "full angle of a vee slot"),
      symbols("thread_hand", {"right", "left"}, "direction of a thread"),
      number("thread_major_mm", 0.0, 2000.0, "major diameter of a thread"),
      number("thread_runout_pitches", 0.0, 10001.0, "depth below the thread by the pitch; 10000: through"),
      number("chamfer_angle_deg", 0.0, 90.0, "chamfer against the plane of its edge"),
      number("round_radius_mm", 0.0, 10000.0, "radius of an edge round"),
      number("surface_radius_mm", 0.0, 100000.0, "smallest concave radius of a surface; 0 unknown"),
      symbols(
          "surface_form", {"curved", "walls", "prismatic"},
          "of a surface: no upright walls within the raw piece, curved with such walls, or walls and level "
          "floors only"),
      symbols("shape", shapes(),
              "what kind of feature it is; countersink: a hole whose wall is a countersink's cone"),
      number("ra_um", 0.0, 1001.0, "surface roughness Ra asked; 1000: not asked"),
      number("position_mm", 0.0, 1001.0, "zone of position, coaxiality or symmetry; 1000: not asked"),
      number("form_mm", 0.0, 1001.0, "tightest zone of form, orientation, run-out, profile; 1000: not asked"),
      number("corner_radius_mm", 0.0, 10001.0, "concave corners of the walls; 10000: sharp, none or unknown"),
      number("corner_ratio", 0.0, 1001.0,
             "cutter that the corners admit by the one the passage admits; 1000: corners limit nothing"),
      number("slenderness", 0.0, 10001.0,
             "depth by the diameter of the widest cutter that passages and corners admit; 0: they limit "
             "nothing"),
      number("wall_thickness_mm", 0.0, 10001.0, "thinnest wall that stays beside; 10000: not known"),
      number("floor_thickness_mm", 0.0, 10001.0, "what stays below; 10000: not known"),
      number("wall_ratio", 0.0, 10001.0, "depth by the thickness of that wall; 0: not known"),
      number("floor_ratio", 0.0, 10001.0, "widest span by the thickness below it; 0: not known"),
      number("hardness_hb", 0.0, 2001.0, "Brinell hardness of the material; 0: not known"),
      symbols("rigid_tapping", {"yes", "no"}, "whether the control synchronises spindle and feed"),
      symbols("through_coolant", {"yes", "no"}, "whether coolant comes through the spindle"),
      symbols("probe", {"yes", "no"}, "whether the machine has a touch probe"),
      {"batch", FactKind::kInteger, 1.0, 1000001.0, {}, "pieces to be made"},
      number("edge_break_mm", 0.0, 1000.0, "chamfer that the shop wants on edges; 0: none"),
  };
  return kTypes;
}

std::optional<std::size_t> find_fact(std::string_view name) {
  const auto& types = fact_types();
  const auto it = std::find_if(types.begin(), types.end(), [&](const FactType& t) { return t.name == name; });
  if (it == types.end()) return std::nullopt;
  return static_cast<std::size_t>(it - types.begin());
}

void Facts::set(std::string_view fact, double value) {
  const std::size_t i = index_of(fact);
  if (fact_types()[i].kind == FactKind::kSymbol) throw std::logic_error("a symbolic fact takes no number");
  values_[i] = value;
}

void Facts::set(std::string_view fact, std::string_view symbol) {
  const std::size_t i = index_of(fact);
  const auto& domain = fact_types()[i].symbols;
  const auto it = std::find(domain.begin(), domain.end(), symbol);
  if (it == domain.end()) throw std::logic_error("no such symbol: " + std::string(symbol));
  values_[i] = static_cast<double>(it - domain.begin());
}

std::optional<double> Facts::number(std::string_view fact) const { return values_[index_of(fact)]; }

std::string_view Facts::symbol(std::string_view fact) const {
  const std::size_t i = index_of(fact);
  if (!values_[i]) return {};
  return fact_types()[i].symbols.at(static_cast<std::size_t>(*values_[i]));
}

std::string Facts::text(std::size_t fact) const {
  const FactType& type = fact_types().at(fact);
  const std::string name(type.name);
  if (!values_.at(fact)) return name + " is unknown";
  if (type.kind == FactKind::kSymbol)
    return name + " = " + std::string(type.symbols.at(static_cast<std::size_t>(*values_[fact])));
  const std::string text = trimmed(*values_[fact], 4);
  // "ra_um = 1000 (not asked)": the meaning names the value that stands for "none".
  const std::size_t at = type.meaning.rfind("; " + text + ": ");
  if (at == std::string_view::npos) return name + " = " + text;
  return name + " = " + text + " (" + std::string(type.meaning.substr(at + text.size() + 4)) + ")";
}

}  // namespace capstan::rules
