#include "tooling/library/nouns/tool_kind.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/edge_kind.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;
using model::MachiningTool;
using model::Model;
using model::Ref;

/// Smaller face mills are not made, but with edges that lean; the word is used for end mills that face.
constexpr double kLeastFacemillMm = 25.0;

/// Files use tapered kinds without a taper for plain tools.
bool is_tapered(const Model& m, model::AnyRef body) {
  model::Real angle;
  if (const auto* e = m.get<model::TaperedEndmill>(body)) angle = e->taper_angle;
  if (const auto* d = m.get<model::TaperedDrill>(body)) angle = d->taper_angle;
  if (const auto* r = m.get<model::TaperedReamer>(body)) angle = r->taper_angle;
  if (const auto* t = m.get<model::TaperedTap>(body)) angle = t->taper_angle;
  return angle.value_or(0.0) != 0.0;
}

/// The first class that is written as this noun, or as the nearest noun above it.
std::optional<CutterClass> class_of_noun(model::TypeId body) {
  for (model::TypeId t = body; t != model::TypeId::kNone; t = model::noun_type(t).parent) {
    for (const model::CutterClassRow& r : model::cutter_classes())
      if (r.body == t) return r.value;
  }
  return std::nullopt;
}

/// The class of a tool that the standard has no noun for, by its words.
std::optional<CutterClass> class_of_words(const model::UserDefinedTool& u, double corner_mm) {
  for (const model::CutterClassRow& r : model::cutter_classes()) {
    if (r.body != model::TypeId::kUserDefinedTool || u.identifier.value_or("") != r.words) continue;
    const bool rounds = r.value == CutterClass::kCornerRoundingMill;
    return rounds && corner_mm <= 0.0 ? std::nullopt : std::optional(r.value);
  }
  return std::nullopt;
}

/// The class of a body: its noun decides, and if one noun has several classes, its stated values.
std::optional<CutterClass> class_of_body(const Model& m, const ToolParts& p, double point_angle_rad) {
  const double d = p.dimension->diameter.value_or(0.0), re = p.dimension->edge_radius.value_or(0.0);
  const model::AnyRef b = p.body_ref;
  if (is_tapered(m, b))
    return m.holds<model::TaperedEndmill>(b) ? std::optional(CutterClass::kTaperedEndmill) : std::nullopt;
  if (const auto* u = m.get<model::UserDefinedTool>(b)) return class_of_words(*u, re);
  if (width_of(m, b) > 0.0) return CutterClass::kSideMill;
  if (m.holds<model::CenterDrill>(b))
    return point_angle_rad > 75.0 * kRadPerDegree ? CutterClass::kSpotDrill : CutterClass::kCenterDrill;
  if (m.holds<model::Drill>(b)) {
    // Neither standard has a word for them: one lip, coolant through it, and a point that guides it.
    const bool gun = point_angle_rad < kFlatPointRad && p.body->number_of_teeth.value_or(0) == 1 &&
                     p.body->coolant_through_tool.value_or(false);
    return gun ? CutterClass::kGunDrill : CutterClass::kTwistDrill;
  }
  const auto* face = m.get<model::Facemill>(b);
  if (face != nullptr && d < kLeastFacemillMm && !face->tool_cutting_edge_angle) return CutterClass::kEndmill;
  if (m.holds<model::MillingThreadingTool>(b)) return CutterClass::kThreadMill;
  // A side mill without a width, or a tapered kind without a taper, is the plain tool, or has no class.
  const auto by_noun = m.holds<model::SideMill>(b) ? std::nullopt : class_of_noun(b.type);
  const bool plain = by_noun == CutterClass::kEndmill || by_noun == CutterClass::kTaperedEndmill;
  if (!plain) return by_noun;
  if (re <= 0.0) return CutterClass::kEndmill;
  return re >= 0.5 * d - kSizeSlackMm ? CutterClass::kBallEndmill : CutterClass::kBullnoseEndmill;
}

/// The points that each class is sold with, deg.
std::span<const double> usual_points(CutterClass c) {
  static constexpr std::array<double, 7> kDrill{118, 140, 135, 130, 120, 90, 172};
  static constexpr std::array<double, 4> kCentre{60, 90, 120, 142};
  static constexpr std::array<double, 5> kSink{90, 60, 82, 120, 30};
  if (model::has(c, model::CutterTrait::kDrills)) return kDrill;
  if (model::has(c, model::CutterTrait::kMarks)) return kCentre;
  return kSink;
}

}  // namespace

Result<ToolParts> tool_parts(const Model& m, Ref<MachiningTool> tool) {
  ToolParts p;
  p.tool = m.get<model::CuttingTool>(tool);
  if (p.tool == nullptr) return fail("TOOL-NONE", "there is no milling tool");
  p.name = p.tool->its_id.value_or("");
  const model::Origin& origin = m.origin(tool);
  p.told = !p.name.empty()        ? "tool '" + p.name + "'"
           : origin.instance != 0 ? "tool #" + std::to_string(origin.instance)
                                  : "a tool without a name";
  const auto refuse = [&](std::string message) {
    return fail({.code = "TOOL-BODY",
                 .message = std::move(message),
                 .line = origin.line,
                 .instance = origin.instance,
                 .path = p.name});
  };
  p.body_ref = p.tool->its_tool_body;
  p.body = m.get<model::MillingToolBody>(p.body_ref);
  if (p.body == nullptr) return refuse("the tool has no milling tool body");
  p.dimension = m.get<model::MillingToolDimension>(p.body->dimension);
  if (p.dimension == nullptr || !p.dimension->diameter) return refuse("the tool has no diameter");
  return p;
}

double width_of(const Model& m, model::AnyRef body) {
  if (const auto* s = m.get<model::SideMill>(body)) return s->cutter_width.value_or(0.0);
  if (const auto* w = m.get<model::WoodruffKeyseatMill>(body)) return w->cutter_width.value_or(0.0);
  return 0.0;
}

double point_angle_from(double tool_top_angle_rad, CutterClass c, std::string& reading) {
  if (!(tool_top_angle_rad > 0.0)) {
    reading = kNotStated;
    return 0.0;
  }
  constexpr double kNearDeg = 1.0;
  const double a = tool_top_angle_rad / kRadPerDegree;
  const std::array<std::pair<double, const char*>, 3> readings{
      {{2.0 * a, "stated: tool_top_angle, half of it"},
       {180.0 - 2.0 * a, "derived: the file holds the complement of half the point angle"},
       {a, "derived: the file holds the full point angle"}}};
  for (const auto& [full, how] : readings) {
    for (const double usual : usual_points(c)) {
      if (std::abs(full - usual) > kNearDeg) continue;
      reading = how;
      return full * kRadPerDegree;
    }
  }
  reading = "default: no reading of it is a usual point";
  return 0.0;
}

Result<ToolKind> tool_kind(const Model& m, const ToolParts& p, Job& job) {
  ToolKind k{CutterClass::kEndmill, 0.0, {}};
  const bool centre = m.holds<model::CenterDrill>(p.body_ref);
  const bool pointed = centre || m.holds<model::Drill>(p.body_ref) || m.holds<model::Countersink>(p.body_ref);
  if (pointed) {
    const CutterClass about = centre                              ? CutterClass::kCenterDrill
                              : m.holds<model::Drill>(p.body_ref) ? CutterClass::kTwistDrill
                                                                  : CutterClass::kCountersink;
    const double a = p.dimension->tool_top_angle.value_or(0.0);
    k.point_angle_rad = point_angle_from(a, about, k.reading);
    if (a > 0.0 && !k.reading.starts_with("stated"))
      job.note("TOOL-POINT",
               p.told + ": tool_top_angle " + trimmed(a / kRadPerDegree, 2) + " deg " +
                   (k.point_angle_rad > 0.0
                        ? "read as a point of " + trimmed(k.point_angle_rad / kRadPerDegree, 1) + " deg; " +
                              k.reading
                        : std::string("is no usual point; the default is used")));
  }
  const auto cls = class_of_body(m, p, k.point_angle_rad);
  if (!cls) {
    return fail({.code = "TOOL-KIND",
                 .message = "no cutter describes a " +
                            std::string(model::noun_type(p.body_ref.type).keyword) + " of this form",
                 .path = p.name});
  }
  k.cutter_class = *cls;
  if (m.holds<model::Facemill>(p.body_ref) && *cls == CutterClass::kEndmill)
    job.warn("TOOL-CLASS", p.told + ": face mill of " + trimmed(*p.dimension->diameter, 3) +
                               " mm read as an end mill that is not centre-cutting");
  return k;
}

}  // namespace capstan::tooling
