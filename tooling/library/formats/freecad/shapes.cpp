#include "tooling/library/formats/freecad/shapes.h"

#include <array>
#include <utility>

namespace capstan::tooling::freecad {
namespace {

using model::CutterClass;

constexpr std::array kShapes = {
    Shape{"Endmill", "endmill.fcstd", CutterClass::kEndmill},
    Shape{"Ballend", "ballend.fcstd", CutterClass::kBallEndmill},
    Shape{"Bullnose", "bullnose.fcstd", CutterClass::kBullnoseEndmill},
    Shape{"Chamfer", "chamfer.fcstd", CutterClass::kChamferMill},
    Shape{"VBit", "v-bit.fcstd", CutterClass::kChamferMill},
    Shape{"Drill", "drill.fcstd", CutterClass::kTwistDrill},
    Shape{"Reamer", "reamer.fcstd", CutterClass::kReamer},
    Shape{"Tap", "tap.fcstd", CutterClass::kTap},
    Shape{"ThreadMill", "thread-mill.fcstd", CutterClass::kThreadMill},
    Shape{"Dovetail", "dovetail.fcstd", CutterClass::kDovetailMill},
    Shape{"Radius", "radius.fcstd", CutterClass::kCornerRoundingMill},
    Shape{"TaperedBallNose", "taperedballnose.fcstd", CutterClass::kTaperedEndmill},
    Shape{"SlittingSaw", "slittingsaw.fcstd", CutterClass::kSideMill},
    Shape{"Probe", "probe.fcstd", CutterClass::kTouchProbe},
    Shape{"Fillet", "fillet.fcstd", std::nullopt},
    Shape{"Custom", "", std::nullopt},
};

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
  for (const Shape& s : kShapes)
    if (folded(s.type) == wanted) return &s;
  return nullptr;
}

const Shape* shape_of(CutterClass c, bool& exact) {
  exact = true;
  for (const Shape& s : kShapes)
    if (s.cutter_class == c) return &s;
  exact = false;
  switch (c) {
    case CutterClass::kFacemill:
    case CutterClass::kCounterbore:
      return find_shape("Endmill");
    case CutterClass::kCountersink:
      return find_shape("Chamfer");
    case CutterClass::kCenterDrill:
    case CutterClass::kSpotDrill:
    case CutterClass::kGunDrill:
      return find_shape("Drill");
    default:
      return nullptr;
  }
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
