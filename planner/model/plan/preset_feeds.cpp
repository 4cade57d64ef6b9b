#include "planner/model/plan/preset_feeds.h"

#include <algorithm>

namespace capstan::model {
namespace {

constexpr std::string_view kBorrowed = " (as generic/";

/// The first preset that `counts` for the material: by id, by name, by group where the card cuts with it.
template <class Counts>
const CuttingPreset* find_preset(const Cutter& c, const WorkMaterial& m, const Counts& counts) {
  const auto named = [&](const std::string& name) -> const CuttingPreset* {
    const auto p = std::find_if(c.presets.begin(), c.presets.end(), [&](const CuttingPreset& x) {
      return x.material_group == name && counts(x);
    });
    return p == c.presets.end() ? nullptr : &*p;
  };
  if (const auto* p = named(m.id)) return p;
  for (const std::string& name : m.names)
    if (const auto* p = named(name)) return p;
  return card_excludes(m, c.substrate) ? nullptr : named(m.iso_group);
}

const CuttingPreset* feed_preset(const Cutter& c, const WorkMaterial& m, bool of_its_like) {
  return find_preset(c, m,
                     [&](const CuttingPreset& p) { return p.fz_mm > 0.0 && borrowed(p) == of_its_like; });
}

}  // namespace

bool borrowed(const CuttingPreset& p) {
  // Searched from its bracket: sources are full of blanks, and selection calls this for every preset of every
  // candidate.
  const std::string& s = p.source.text();
  for (std::size_t at = s.find('('); at != std::string::npos; at = s.find('(', at + 1)) {
    if (at > 0 && s.compare(at - 1, kBorrowed.size(), kBorrowed) == 0) return true;
  }
  return false;
}

bool nobodys(const CuttingPreset& p) { return borrowed(p) || p.source.find("default") != std::string::npos; }

bool card_excludes(const WorkMaterial& m, Substrate s) {
  const double here = s == Substrate::kHss ? m.vc_hss_m_min : m.vc_carbide_m_min;
  const double other = s == Substrate::kHss ? m.vc_carbide_m_min : m.vc_hss_m_min;
  return !(here > 0.0) && other > 0.0;
}

const CuttingPreset* preset_of(const Cutter& c, const WorkMaterial& m, bool of_its_like) {
  return find_preset(c, m, [&](const CuttingPreset& p) { return borrowed(p) == of_its_like; });
}

double start_feed_mm(const Cutter& c, const WorkMaterial& m) {
  const auto* p = feed_preset(c, m, false);
  if (p == nullptr) p = feed_preset(c, m, true);
  return p != nullptr ? p->fz_mm : 0.0;
}

double held_to_cut_mm(const Cutter& c, const WorkMaterial& m) {
  const auto* own = feed_preset(c, m, false);
  if (own != nullptr && !nobodys(*own)) return kCutsDownTo * own->fz_mm;
  return start_feed_mm(c, m);
}

std::string of_group(std::string_view iso_group) { return " (ISO group " + std::string(iso_group) + ")"; }

double largest_tooth_feed_mm(const Cutter& c, const WorkMaterial& m) {
  const auto* own = feed_preset(c, m, false);
  double by_own = own != nullptr ? kOverPreset * own->fz_mm : 0.0;
  for (const CuttingPreset& p : c.presets) {
    if (own != nullptr || borrowed(p) || !(p.fz_mm > 0.0) || m.iso_group.empty()) continue;
    if (!p.source.ends_with(of_group(m.iso_group))) continue;
    by_own = by_own > 0.0 ? std::min(by_own, p.fz_mm) : p.fz_mm;
  }
  const bool assumed = std::any_of(c.sources.begin(), c.sources.end(), [](const auto& s) {
    return s.first == "fz_max_mm" && s.second.starts_with(kAsGeneric);
  });
  if (c.fz_max_mm > 0.0 && !(assumed && by_own > c.fz_max_mm)) return c.fz_max_mm;
  return by_own;
}

}  // namespace capstan::model
