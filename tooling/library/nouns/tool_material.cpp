#include "tooling/library/nouns/tool_material.h"

#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/model/plan/preset_feeds.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"

// Chooses what a tool is made of whose file does not say it. First by the speed that the file gives the tool,
// against the work material's card; then by what such a tool is usually bought as today: carbide where all of
// the generic series of its class are carbide, but for end mills above the sizes of DIN 6527 and for
// points that only mark. Drills and reamers are sold of either (DIN 338 and 6537, 212 and 8093), so that
// their class tells nothing; taps, countersinks, T-slot and dovetail cutters are HSS.

namespace capstan::tooling {
namespace {

using model::Substrate;

/// How far a stated speed may lie above a card's and still be meant for that edge: cards differ among
/// themselves by about this. Default, unsourced; the check warns from the same factor on
/// (CHK-SPEED-MATERIAL).
constexpr double kOverCard = 1.25;
/// By how much a coated edge runs faster than the cards' bare one. Source: HSS: end mills coated with TiCN
/// run up to 50 % faster than bare ones (bolt.com.au, tooling). Carbide: the least that `coated_mill` of
/// data/cutters.yaml says of steel.
constexpr double kCoatedHssOverBare = 1.5;
constexpr double kCoatedCarbideOverBare = 1.7;

/// End mills are made of solid carbide up to here. Source: the range of sizes of DIN 6527.
constexpr double kSolidCarbideMm = 20.0;

std::string speed(double m_min) { return trimmed(m_min, 1) + " m/min"; }

/// What the speed that the file gives tells; nothing where neither bears it, or the card has no speeds.
std::optional<ToolMaterial> by_speed(const ToolMaterialHints& hints) {
  const model::WorkMaterial& m = *hints.material;
  const double v = hints.vc_m_min, hss = m.vc_hss_m_min, carbide = m.vc_carbide_m_min;
  if (!(v > 0.0) || !(hss > 0.0) || !(carbide > hss)) return std::nullopt;
  const std::string in_file = "the file's " + speed(v) + " in " + m.id;
  if (v <= kOverCard * kCoatedHssOverBare * hss) {
    const std::string edge = v <= kOverCard * hss ? "HSS (" : "coated HSS (bare: ";
    return ToolMaterial{Substrate::kHss, assumed_source(Substrate::kHss, in_file + " is a speed of " + edge +
                                                                             speed(hss) + ")")};
  }
  if (v > kOverCard * kCoatedCarbideOverBare * carbide) return std::nullopt;
  return ToolMaterial{
      Substrate::kCarbide,
      assumed_source(Substrate::kCarbide, in_file + " is more than HSS allows (" + speed(hss) +
                                              "), and a speed of carbide (" + speed(carbide) + ")")};
}

/// Whether the generic library has the class of carbide alone.
bool only_carbide_is_generic(model::CutterClass c) {
  const auto& generic = shared_generic_library();
  if (!generic) return false;
  bool any = false;
  for (const model::Cutter& g : *generic) {
    if (g.cutter_class != c) continue;
    if (g.substrate != Substrate::kCarbide) return false;
    any = true;
  }
  return any;
}

ToolMaterial by_practice(const model::Cutter& c) {
  const bool solid = model::has(c.cutter_class, model::CutterTrait::kEndMill);
  const bool fits = !solid || c.cutting_diameter_mm <= kSolidCarbideMm;
  if (fits && !model::has(c.cutter_class, model::CutterTrait::kMarks) &&
      only_carbide_is_generic(c.cutter_class)) {
    const std::string words(model::words_of(c.cutter_class));
    return {Substrate::kCarbide,
            assumed_source(Substrate::kCarbide,
                           solid ? words + "s of up to 20 mm are solid carbide today (DIN 6527)"
                                 : words + "s are carbide today, as all of the generic series")};
  }
  return {Substrate::kHss,
          assumed_source(Substrate::kHss, "the slower one; such tools are sold of HSS, too")};
}

constexpr std::string_view kTaken = " taken: ";

}  // namespace

ToolMaterial likely_material(const model::Cutter& c, const ToolMaterialHints& hints) {
  if (hints.settled) return {*hints.settled, hints.settled_by};
  if (hints.material != nullptr) {
    // That HSS does not cut the material makes no tool carbide: one that is refused can be stated.
    if (model::card_excludes(*hints.material, Substrate::kCarbide))
      return {Substrate::kHss,
              assumed_source(Substrate::kHss, hints.material->id + " is not cut with carbide")};
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
  return material_is_open(c) || (source != nullptr && source->starts_with(model::kSettledBy));
}

std::string settled_source(std::string_view option) {
  return std::string(model::kSettledBy) + std::string(option);
}

std::string assumed_source(Substrate s, std::string_view why) {
  return std::string(kNotStated) + "; " + std::string(model::to_text(s)) + std::string(kTaken) +
         std::string(why);
}

std::string reason_of_source(std::string_view source) {
  if (source.starts_with(model::kSettledBy)) return std::string(source.substr(model::kSettledBy.size()));
  const auto at = source.find(kTaken);
  return at == std::string_view::npos ? std::string("the slower one")
                                      : std::string(source.substr(at + kTaken.size()));
}

}  // namespace capstan::tooling
