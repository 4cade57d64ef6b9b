#include "tooling/library/formats/freecad/shapes.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace capstan::tooling::freecad {
namespace {

using model::CutterClass;

/// Shapes beside a class's own, and shapes of no class; the vocabulary has the rest.
constexpr std::array kOtherShapes = {
    Shape{"VBit", CutterClass::kChamferMill},
    Shape{"Fillet", std::nullopt},
    Shape{"Custom", std::nullopt},
};

std::span<const Shape> shapes() {
  static const std::vector<Shape> kShapes = [] {
    std::vector<Shape> all;
    for (const model::CutterClassRow& r : model::cutter_classes())
      if (!r.freecad.empty()) all.push_back({r.freecad, r.value});
    all.insert(all.end(), kOtherShapes.begin(), kOtherShapes.end());
    return all;
  }();
  return kShapes;
}

constexpr std::array kAliases = {
    std::pair{"torus", "Bullnose"},
    std::pair{"conicalballnose", "TaperedBallNose"},
    std::pair{"taperballnose", "TaperedBallNose"},
};

/// The first of a symbol is written, all are read.
constexpr std::array kParameters = {
    std::pair{"Diameter", "DC"},
    std::pair{"Length", "OAL"},
    std::pair{"ShankDiameter", "DMM"},
    std::pair{"ShaftDiameter", "DMM"},
    std::pair{"CuttingEdgeHeight", "APMX"},
    std::pair{"CuttingEdgeLength", "APMX"},
    std::pair{"CornerRadius", "RE"},
    std::pair{"CuttingRadius", "RE"},
    std::pair{"TipAngle", "SIG"},
    std::pair{"CuttingEdgeAngle", "SIG"},
    std::pair{"TipDiameter", "DCN"},
    std::pair{"NeckDiameter", "DN"},
    std::pair{"NeckLength", "LN"},
    std::pair{"NeckHeight", "LN"},
    std::pair{"Flutes", "ZEFF"},
    std::pair{"Pitch", "TP"},
    std::pair{"BladeThickness", "CW"},
};

std::string folded(std::string_view s) {
  std::string out;
  for (const char c : s) {
    if (c == '-' || c == '_' || c == ' ') continue;
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  }
  return out;
}

/// Of parameters that more than one symbol or shape claims: whether this shape has it under this symbol.
bool belongs(const Shape& shape, std::string_view parameter) {
  const std::string_view t = shape.type;
  if (parameter == "CuttingEdgeLength") return t == "Tap";
  // Above the cone of a V-bit, the cylinder: no depth of cut by itself.
  if (parameter == "CuttingEdgeHeight") return t != "Tap" && t != "VBit";
  if (parameter == "CuttingEdgeAngle") return t == "Chamfer" || t == "VBit";
  if (parameter == "TipAngle") return t == "Drill";
  if (parameter == "CuttingRadius") return t == "Radius";
  if (parameter == "CornerRadius") return t == "Bullnose";
  if (parameter == "NeckHeight") return t == "Dovetail";
  if (parameter == "NeckLength") return t != "Dovetail";
  if (parameter == "ShaftDiameter") return t == "Probe";
  if (parameter == "ShankDiameter") return t != "Probe";
  return true;
}

}  // namespace

const Shape* find_shape(std::string_view type) {
  if (const auto slash = type.find_last_of("/\\"); slash != std::string_view::npos)
    type.remove_prefix(slash + 1);
  std::string wanted = folded(type);
  if (const auto dot = wanted.rfind(".fcstd"); dot != std::string::npos) wanted.erase(dot);
  for (const auto& [alias, name] : kAliases)
    if (wanted == alias) wanted = folded(name);
  for (const Shape& s : shapes())
    if (folded(s.type) == wanted) return &s;
  return nullptr;
}

std::string file_of(const Shape& shape) {
  if (shape.type == "Custom") return {};
  if (shape.type == "VBit") return "v-bit.fcstd";
  if (shape.type == "ThreadMill") return "thread-mill.fcstd";
  return folded(shape.type) + ".fcstd";
}

const Shape* shape_of(CutterClass c, bool& exact) {
  const auto own = [](CutterClass k) {
    const auto all = shapes();
    const auto it = std::find_if(all.begin(), all.end(), [&](const Shape& s) { return s.cutter_class == k; });
    return it == all.end() ? nullptr : &*it;
  };
  const Shape* s = own(c);
  exact = s != nullptr;
  return exact ? s : own(model::row_of(c).stand_in);
}

std::string_view symbol_of(const Shape& shape, std::string_view parameter) {
  for (const auto& [name, symbol] : kParameters)
    if (parameter == name) return belongs(shape, name) ? symbol : std::string_view{};
  return {};
}

std::string_view parameter_of(const Shape& shape, std::string_view symbol) {
  for (const auto& [name, s] : kParameters)
    if (symbol == s && belongs(shape, name)) return name;
  return {};
}

}  // namespace capstan::tooling::freecad
