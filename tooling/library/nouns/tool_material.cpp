#include "tooling/library/nouns/tool_material.h"

#include <algorithm>
#include <array>
#include <limits>

#include "planner/ground/base/number.h"
#include "planner/model/plan/borne_feed.h"
#include "tooling/library/cutters/complete.h"

// Chooses what a tool is made of whose file does not say it. First by the work material's card, then by the
// speed that the file gives the tool, then by what such a tool is usually bought as today. The table's source
// is the range of sizes in which tool makers sell each class: solid carbide end mills stand in DIN 6527 up to
// 20 mm; drills of DIN 338 and 345 are HSS and of DIN 6537 carbide, of one size range, so that their class
// tells nothing; machine taps (DIN 371, 376), machine reamers (DIN 212, 208), countersinks (DIN 335) and
// counterbores (DIN 373) are HSS tools; milling cutters with indexable inserts are ISO 6462's.

namespace capstan::tooling {
namespace {

using model::CutterClass;
using model::Substrate;

/// How far a stated speed may lie above a card's and still be meant for that edge: cards differ among
/// themselves by about this. Default, unsourced; the check warns from the same factor on (CHK-SPEED-MATERIAL).
constexpr double kOverCard = 1.25;
/// By how much an edge that is coated, or of a better grade, runs faster than the cards' bare one: the least
/// that `edges` of data/cutters.yaml says of steel.
constexpr double kBestOverBare = 1.7;

struct Practice {
  CutterClass cutter_class;
  double up_to_mm;
  const char* why;
};
constexpr double kAnySize = std::numeric_limits<double>::infinity();
constexpr double kSolidCarbideMm = 20.0;
constexpr const char* kSolid = "end mills of up to 20 mm are solid carbide today (DIN 6527)";
constexpr const char* kInserts = "such a body carries carbide inserts (ISO 6462)";
/// Classes that are carbide today, up to a diameter; all else is taken as HSS.
constexpr std::array kCarbideToday = {
    Practice{CutterClass::kEndmill, kSolidCarbideMm, kSolid},
    Practice{CutterClass::kBallEndmill, kSolidCarbideMm, kSolid},
    Practice{CutterClass::kBullnoseEndmill, kSolidCarbideMm, kSolid},
    Practice{CutterClass::kTaperedEndmill, kSolidCarbideMm, kSolid},
    Practice{CutterClass::kFacemill, kAnySize, kInserts},
    Practice{CutterClass::kBoringTool, kAnySize, "boring tools carry carbide inserts"},
    Practice{CutterClass::kThreadMill, kAnySize, "thread mills are solid carbide"},
    Practice{CutterClass::kGunDrill, kAnySize, "single-lip drills have a carbide head"},
};

std::string speed(double m_min) { return trimmed(m_min, 1) + " m/min"; }

/// What the card of the work material leaves, where it leaves one only.
std::optional<ToolMaterial> by_card(const ToolMaterialHints& hints) {
  const model::WorkMaterial& m = *hints.material;
  for (const auto& [not_this, other] :
       {std::pair{Substrate::kHss, Substrate::kCarbide}, std::pair{Substrate::kCarbide, Substrate::kHss}}) {
    if (!model::card_excludes(m, not_this)) continue;
    return ToolMaterial{
        other, assumed_source(other, m.id + " is not cut with " + std::string(model::to_text(not_this)))};
  }
  return std::nullopt;
}

/// What the speed that the file gives tells; nothing where neither bears it, or the card has no speeds.
std::optional<ToolMaterial> by_speed(const ToolMaterialHints& hints) {
  const model::WorkMaterial& m = *hints.material;
  const double v = hints.vc_m_min, hss = m.vc_hss_m_min, carbide = m.vc_carbide_m_min;
  if (!(v > 0.0) || !(hss > 0.0) || !(carbide > hss)) return std::nullopt;
  const std::string in_file = "the file's " + speed(v) + " in " + m.id;
  if (v <= kOverCard * hss)
    return ToolMaterial{Substrate::kHss,
                        assumed_source(Substrate::kHss, in_file + " is a speed of HSS (" + speed(hss) + ")")};
  if (v > kOverCard * kBestOverBare * carbide) return std::nullopt;
  return ToolMaterial{Substrate::kCarbide,
                      assumed_source(Substrate::kCarbide,
                                     in_file + " is more than HSS bears (" + speed(hss) +
                                         "), and a speed of carbide (" + speed(carbide) + ")")};
}

ToolMaterial by_practice(const model::Cutter& c) {
  for (const Practice& p : kCarbideToday) {
    if (p.cutter_class == c.cutter_class && c.cutting_diameter_mm <= p.up_to_mm)
      return {Substrate::kCarbide, assumed_source(Substrate::kCarbide, p.why)};
  }
  return {Substrate::kHss,
          assumed_source(Substrate::kHss, "the slower one; such tools are sold of HSS, too")};
}

constexpr std::string_view kTaken = " taken: ";
constexpr std::string_view kSettled = "settled: ";

}  // namespace

ToolMaterial likely_material(const model::Cutter& c, const ToolMaterialHints& hints) {
  if (hints.settled) return {*hints.settled, hints.settled_by};
  if (hints.material != nullptr) {
    if (auto card = by_card(hints)) return *std::move(card);
    if (auto given = by_speed(hints)) return *std::move(given);
  }
  return by_practice(c);
}

bool material_is_open(const model::Cutter& c) {
  const std::string* source = source_of(c, "substrate");
  return source != nullptr && (source->starts_with(kNotStated) || source->starts_with(kSubstrateUnstated));
}

bool material_is_assumed(const model::Cutter& c) {
  const std::string* source = source_of(c, "substrate");
  return material_is_open(c) || (source != nullptr && source->starts_with(kSettled));
}

std::string settled_source(std::string_view option) { return std::string(kSettled) + std::string(option); }

std::string assumed_source(Substrate s, std::string_view why) {
  return std::string(kNotStated) + "; " + std::string(model::to_text(s)) + std::string(kTaken) +
         std::string(why);
}

std::string reason_of_source(std::string_view source) {
  if (source.starts_with(kSettled)) return std::string(source.substr(kSettled.size()));
  const auto at = source.find(kTaken);
  return at == std::string_view::npos ? std::string("the slower one")
                                      : std::string(source.substr(at + kTaken.size()));
}

}  // namespace capstan::tooling
