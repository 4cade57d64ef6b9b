#include "tooling/catalogue/fusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "planner/base/number.h"
#include "tooling/catalogue/check.h"
#include "tooling/catalogue/complete.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMmPerInch = 25.4;

constexpr std::array<std::pair<const char*, CutterClass>, 17> kTypes{{
    {"flat end mill", CutterClass::kEndmill},
    {"bull nose end mill", CutterClass::kBullnoseEndmill},
    {"ball end mill", CutterClass::kBallEndmill},
    {"face mill", CutterClass::kFacemill},
    {"drill", CutterClass::kTwistDrill},
    {"center drill", CutterClass::kCenterDrill},
    {"spot drill", CutterClass::kSpotDrill},
    {"reamer", CutterClass::kReamer},
    {"tap right hand", CutterClass::kTap},
    {"tap left hand", CutterClass::kTap},
    {"thread mill", CutterClass::kThreadMill},
    {"boring bar", CutterClass::kBoringTool},
    {"boring head", CutterClass::kBoringTool},
    {"counter sink", CutterClass::kCountersink},
    {"counter bore", CutterClass::kCounterbore},
    {"chamfer mill", CutterClass::kChamferMill},
    {"slot mill", CutterClass::kTSlotMill},
}};

std::string text_of(const Node& n, std::string_view key) {
  const Node* v = n.find(key);
  return v != nullptr && v->kind == Node::Kind::kScalar ? v->text : std::string();
}

/// Zero where it is absent; nothing where it is no number.
std::optional<double> number_of(const Node& n, std::string_view key) {
  const Node* v = n.find(key);
  if (v == nullptr || v->kind == Node::Kind::kNull) return 0.0;
  return parse_double(v->text);
}

struct Reader {
  const Node& geometry;
  Cutter& c;
  double mm_per_unit;
  std::string fault = {};

  double take(const char* key, double& field, const char* name, double factor) {
    const auto v = number_of(geometry, key);
    if (!v) {
      fault = std::string(key) + " is not a number: '" + text_of(geometry, key) + "'";
      return 0.0;
    }
    if (*v == 0.0) return 0.0;
    field = *v * factor;
    c.sources.emplace_back(name, std::string("stated: ") + key);
    return field;
  }
  void length(const char* key, double& field, const char* name) { take(key, field, name, mm_per_unit); }
};

void read_geometry(Reader& r) {
  Cutter& c = r.c;
  r.length("DC", c.cutting_diameter_mm, "cutting_diameter_mm");
  if (c.cutter_class == CutterClass::kBallEndmill || c.cutter_class == CutterClass::kBullnoseEndmill)
    r.length("RE", c.corner_radius_mm, "corner_radius_mm");
  r.length("LCF", c.maximum_depth_of_cut_mm, "maximum_depth_of_cut_mm");
  r.length("LB", c.stick_out_mm, "stick_out_mm");
  r.length("SFDM", c.shank_diameter_mm, "shank_diameter_mm");
  r.length("TP", c.thread_pitch_mm, "thread_pitch_mm");
  double gauge = 0.0, shoulder = 0.0, teeth = 0.0, half = 0.0;
  if (const auto v = number_of(r.geometry, "assemblyGaugeLength")) gauge = *v * r.mm_per_unit;
  // Libraries give the stick-out here when no holder is chosen: then the length is not known.
  if (gauge > c.stick_out_mm) {
    c.functional_length_mm = gauge;
    c.sources.emplace_back("functional_length_mm", "stated: assemblyGaugeLength");
  }
  if (const auto v = number_of(r.geometry, "shoulder-length")) shoulder = *v * r.mm_per_unit;
  if (c.shank_diameter_mm > c.cutting_diameter_mm && shoulder > 0.0 && shoulder <= c.stick_out_mm) {
    c.usable_length_mm = shoulder;
    c.sources.emplace_back("usable_length_mm", "stated: shoulder-length");
  }
  r.take("NOF", teeth, "teeth", 1.0);
  if (teeth != std::floor(teeth) || teeth < 0.0 || teeth > 1000.0)
    r.fault = "NOF is " + trimmed(teeth, 3);
  else
    c.teeth = static_cast<int>(teeth);
  if (c.cutter_class == CutterClass::kChamferMill) {
    r.take("TA", half, "point_angle_rad", kDegree);
    c.point_angle_rad = 2.0 * half;
  } else if (c.cutter_class != CutterClass::kCenterDrill) {  // of these SIG is the pilot's
    r.take("SIG", c.point_angle_rad, "point_angle_rad", kDegree);
  }
  const bool tipped = c.cutter_class == CutterClass::kChamferMill ||
                      c.cutter_class == CutterClass::kCountersink ||
                      c.cutter_class == CutterClass::kCenterDrill;
  if (tipped) r.length("tip-diameter", c.tip_diameter_mm, "tip_diameter_mm");
  if (text_of(r.geometry, "HAND") == "false") c.hand = model::Hand::kLeft;
}

/// Why the tool cannot be used; empty when it can.
std::string read_tool(const Node& tool, std::size_t index, const std::vector<Cutter>& generic, Cutter& c) {
  const std::string type = text_of(tool, "type"), unit = text_of(tool, "unit");
  const auto it = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == type; });
  if (it == kTypes.end()) return "no cutter describes a '" + type + "'";
  if (unit != "millimeters" && unit != "inches") return "the unit '" + unit + "' is not known";
  const Node* geometry = tool.find("geometry");
  if (geometry == nullptr) return "it has no geometry";
  c.cutter_class = it->second;
  c.description = text_of(tool, "description");
  c.id = text_of(tool, "guid");
  if (c.id.empty()) c.id = "tool " + std::to_string(index + 1);
  const std::string bmc = text_of(tool, "BMC");
  c.substrate = bmc == "carbide" ? model::Substrate::kCarbide : model::Substrate::kHss;
  c.sources.emplace_back("substrate",
                         bmc == "carbide" || bmc == "hss" ? "stated: BMC" : "default: the slower one");
  Reader r{*geometry, c, unit == "inches" ? kMmPerInch : 1.0};
  read_geometry(r);
  if (!r.fault.empty()) return r.fault;
  if (const Node* post = tool.find("post-process")) {
    const auto number = number_of(*post, "number");
    if (number && *number >= 1.0 && *number <= 99999.0 && *number == std::floor(*number))
      c.pocket = static_cast<int>(*number);
  }
  if (c.cutting_diameter_mm > 0.0) complete(c, generic);
  const auto faults = faults_of(c);
  return faults.empty() ? std::string() : faults.front();
}

}  // namespace

std::vector<Cutter> read_fusion(const Node& root, const std::string& file, Job& job,
                                const std::vector<Cutter>& generic) {
  std::vector<Cutter> out;
  std::set<std::string> ids;
  std::set<int> numbers;
  const Node* data = root.find("data");
  for (std::size_t i = 0; data != nullptr && i < data->items.size(); ++i) {
    const Node& tool = data->items[i];
    if (text_of(tool, "type") == "holder") continue;
    Cutter c;
    std::string why = read_tool(tool, i, generic, c);
    if (why.empty() && !ids.insert(c.id).second) why = "its guid is that of another tool";
    if (!why.empty()) {
      job.report({.code = "FUSION-TOOL",
                  .severity = Severity::kWarning,
                  .message = "tool " + std::to_string(i + 1) + " '" + text_of(tool, "description") +
                             "' is not used: " + why,
                  .file = file,
                  .line = tool.line});
      continue;
    }
    if (c.pocket > 0 && !numbers.insert(c.pocket).second) {
      job.note("FUSION-NUMBER", file + ": tool number " + std::to_string(c.pocket) + " is given again, to '" +
                                    c.description + "', which gets another");
      c.pocket = 0;
    }
    out.push_back(std::move(c));
  }
  job.note("FUSION-LEFT", file + ": holders' outlines and presets are not read");
  return out;
}

}  // namespace capstan::tooling
