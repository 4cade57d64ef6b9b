#include "tooling/select/select.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "planner/base/number.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::Machine;
using model::Selection;
using model::ToolRequirement;
using model::WorkMaterial;

/// Sizes are compared after the printer's rounding; below this two are one.
constexpr double kSizeSlackMm = 1e-6;
constexpr double kPitchSlackMm = 1e-3;
constexpr double kAngleSlackRad = 0.5 * std::numbers::pi / 180.0;
/// The spindle's slowest turn may exceed the preset's cutting speed by this much and no more.
constexpr double kFastestOverPreset = 1.25;  // default, unsourced

/// Weights of the ranking; default, unsourced. A unit is what the largest cutter is worth over the smallest.
constexpr double kPerClass = 10.0;
constexpr double kPerExactMm = 5.0;
constexpr double kPerSize = 1.0;
constexpr double kLoaded = 1.5;
constexpr double kUsed = 0.5;
constexpr double kPerSlenderness = 0.1;  // of each diameter it sticks out beyond kStiff
constexpr double kStiff = 3.0;
constexpr double kHssPenalty = 0.4;  // where carbide pays
constexpr double kPerTooth = 0.1;
constexpr double kPerSpeedShort = 0.5;

std::string mm(double v) { return trimmed(v, 3) + " mm"; }
std::string degrees(double rad) { return trimmed(rad * 180.0 / std::numbers::pi, 1) + " deg"; }

double lower_size(const ToolRequirement& r) {
  return r.diameter_exact_mm > 0.0 ? r.diameter_exact_mm - r.diameter_tolerance_mm : r.diameter_min_mm;
}
double upper_size(const ToolRequirement& r) {
  return r.diameter_exact_mm > 0.0 ? r.diameter_exact_mm + r.diameter_tolerance_mm : r.diameter_max_mm;
}

/// A boring tool set to the wanted size, when it can be.
Cutter as_set(const Cutter& c, const ToolRequirement& r) {
  const double wanted = r.diameter_exact_mm > 0.0 ? r.diameter_exact_mm : r.diameter_max_mm;
  if (c.adjustable_to_mm <= 0.0 || wanted < c.cutting_diameter_mm || wanted > c.adjustable_to_mm) return c;
  Cutter out = c;
  out.cutting_diameter_mm = wanted;
  if (wanted != c.cutting_diameter_mm) {
    out.sources.emplace_back("cutting_diameter_mm", "derived: set to the bore, " + mm(c.cutting_diameter_mm) +
                                                        " to " + mm(c.adjustable_to_mm));
  }
  return out;
}

std::optional<std::string> wrong_size(const Cutter& c, const ToolRequirement& r) {
  const double low = lower_size(r), high = upper_size(r), d = c.cutting_diameter_mm;
  if (low > 0.0 && d < low - kSizeSlackMm) return "diameter " + mm(d) + " is below " + mm(low);
  if (high > 0.0 && d > high + kSizeSlackMm) return "diameter " + mm(d) + " is above " + mm(high);
  return std::nullopt;
}

std::optional<std::string> wrong_shape(const Cutter& c, const ToolRequirement& r) {
  if (r.corner_radius_exact_mm >= 0.0 &&
      std::abs(c.corner_radius_mm - r.corner_radius_exact_mm) > kPitchSlackMm)
    return "corner radius " + mm(c.corner_radius_mm) + " is not " + mm(r.corner_radius_exact_mm);
  if (r.corner_radius_limited && c.corner_radius_mm > r.corner_radius_max_mm + kSizeSlackMm)
    return "corner radius " + mm(c.corner_radius_mm) + " is above " + mm(r.corner_radius_max_mm);
  if (r.point_angle_rad > 0.0 && std::abs(c.point_angle_rad - r.point_angle_rad) > kAngleSlackRad)
    return "point angle " + degrees(c.point_angle_rad) + " is not " + degrees(r.point_angle_rad);
  if (r.thread_pitch_mm > 0.0 && std::abs(c.thread_pitch_mm - r.thread_pitch_mm) > kPitchSlackMm)
    return "pitch " + mm(c.thread_pitch_mm) + " is not " + mm(r.thread_pitch_mm);
  if (r.centre_cutting && !c.centre_cutting && c.maximum_ramp_angle_rad <= 0.0)
    return std::string("it neither cuts to centre nor ramps");
  return std::nullopt;
}

std::optional<std::string> too_short(const Cutter& c, const ToolRequirement& r) {
  if (r.reach_mm > c.usable_length_mm + kSizeSlackMm)
    return "reach " + mm(c.usable_length_mm) + " is below " + mm(r.reach_mm);
  if (r.depth_of_cut_mm > c.maximum_depth_of_cut_mm + kSizeSlackMm)
    return "flutes " + mm(c.maximum_depth_of_cut_mm) + " are shorter than " + mm(r.depth_of_cut_mm);
  return std::nullopt;
}

std::optional<std::string> not_for_machine(const Cutter& c, const StartValues& start, const WorkMaterial& w,
                                           const Machine& m) {
  if (m.tool_diameter_max_mm > 0.0 && c.cutting_diameter_mm > m.tool_diameter_max_mm + kSizeSlackMm)
    return "diameter " + mm(c.cutting_diameter_mm) + " is above the magazine's " + mm(m.tool_diameter_max_mm);
  if (m.tool_length_max_mm > 0.0 && c.functional_length_mm > m.tool_length_max_mm + kSizeSlackMm)
    return "length " + mm(c.functional_length_mm) + " is above the magazine's " + mm(m.tool_length_max_mm);
  if (c.maximum_speed_rpm > 0.0 && c.maximum_speed_rpm < m.spindle.rpm_min)
    return "its largest speed " + trimmed(c.maximum_speed_rpm, 0) + " 1/min is below the spindle's least " +
           trimmed(m.spindle.rpm_min, 0);
  const double wanted = start.wanted_vc_m_min;
  if (start.vc_m_min > kFastestOverPreset * wanted)
    return "the spindle's least speed " + trimmed(m.spindle.rpm_min, 0) + " 1/min gives " +
           trimmed(start.vc_m_min, 1) + " m/min, " + w.id + " bears " + trimmed(wanted, 1);
  return std::nullopt;
}

double score_of(const Cutter& c, std::size_t class_rank, const ToolRequirement& r, const StartValues& start,
                const WorkMaterial& w, double largest_mm, const Preferences& p) {
  double s = kPerClass * static_cast<double>(class_rank);
  if (r.diameter_exact_mm > 0.0)
    s += kPerExactMm * std::abs(c.cutting_diameter_mm - r.diameter_exact_mm);
  else if (largest_mm > 0.0)
    s += kPerSize * (1.0 - c.cutting_diameter_mm / largest_mm);
  if (c.pocket > 0)
    s -= kLoaded;
  else if (std::find(p.used.begin(), p.used.end(), c.id) != p.used.end())
    s -= kUsed;
  s += kPerSlenderness * std::max(0.0, c.stick_out_mm / c.cutting_diameter_mm - kStiff);
  if (c.substrate == model::Substrate::kHss && w.iso_group != "N") s += kHssPenalty;
  // Chips of aluminium need room between the teeth; in steel more teeth feed faster.
  const int teeth = w.iso_group == "N" ? std::max(0, c.teeth - 3) : std::max(0, 4 - c.teeth);
  s += kPerTooth * teeth;
  const double wanted = start.wanted_vc_m_min;
  if (wanted > 0.0) s += kPerSpeedShort * std::max(0.0, 1.0 - start.vc_m_min / wanted);
  return rounded(s, 9);
}

std::size_t rank_of(const ToolRequirement& r, CutterClass c) {
  return static_cast<std::size_t>(std::find(r.classes.begin(), r.classes.end(), c) - r.classes.begin());
}

/// What was refused for its size alone, summed up; the nearest sizes below and above are named.
void sum_up_sizes(const ToolRequirement& r, const std::map<CutterClass, std::set<double>>& sizes,
                  Selection& out) {
  const double low = lower_size(r), high = upper_size(r);
  for (const auto& [cls, all] : sizes) {
    std::string nearest;
    const auto above = high > 0.0 ? all.upper_bound(high) : all.end();
    const auto below = all.lower_bound(low);
    if (below != all.begin()) nearest = mm(*std::prev(below));
    if (above != all.end()) nearest += (nearest.empty() ? "" : " and ") + mm(*above);
    std::string wanted = low > 0.0 ? "from " + mm(low) : "";
    if (high > 0.0) wanted += (wanted.empty() ? "up to " : " to ") + mm(high);
    if (r.diameter_exact_mm > 0.0) wanted = mm(r.diameter_exact_mm);
    out.rejected.push_back({std::to_string(all.size()) + " other sizes of " + std::string(words_of(cls)),
                            "diameter is not " + wanted + "; nearest " + nearest});
  }
}

model::Reason reason_for(const Cutter& c, const ToolRequirement& r, const StartValues& start,
                         const Preferences& p, std::size_t fitting) {
  std::string text = c.description.empty() ? c.id : c.description;
  text += ": ";
  text += r.diameter_exact_mm > 0.0 ? "of the size wanted" : "diameter " + mm(c.cutting_diameter_mm);
  if (upper_size(r) > 0.0 && r.diameter_exact_mm <= 0.0) text += " within " + mm(upper_size(r));
  if (r.reach_mm > 0.0) text += ", reach " + mm(c.usable_length_mm) + " for " + mm(r.reach_mm);
  if (c.pocket > 0)
    text += ", loaded as T" + std::to_string(c.pocket);
  else if (std::find(p.used.begin(), p.used.end(), c.id) != p.used.end())
    text += ", used already";
  text += "; one of " + std::to_string(fitting) + " that fit; " + start.why.text;
  return {"tooling.select." + std::string(model::to_text(c.cutter_class)), text, start.why.source};
}

/// A cutter that meets all limits, and one that misses one.
struct Fit {
  const Cutter* cutter;
  StartValues start;
  std::size_t rank;
  double score;
};
struct Near {
  const Cutter* cutter;
  std::string why;
};

/// The largest first: they come nearest to what was wanted.
void tell_near(std::vector<Near>& near, std::size_t most, Selection& out) {
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
    const double da = a.cutter->cutting_diameter_mm, db = b.cutter->cutting_diameter_mm;
    return da != db ? da > db : a.cutter->id < b.cutter->id;
  });
  const std::size_t told = std::min(near.size(), most);
  for (std::size_t i = 0; i < told; ++i) out.rejected.push_back({near[i].cutter->id, std::move(near[i].why)});
  if (near.size() > told)
    out.rejected.push_back(
        {std::to_string(near.size() - told) + " more", "smaller, fail one of the same limits"});
}

}  // namespace

Selection select(const ToolRequirement& requirement, const std::vector<Cutter>& library,
                 const WorkMaterial& material, const Machine& machine, const Preferences& preferences) {
  const ToolRequirement& r = requirement;
  Selection out;
  std::deque<Cutter> set;  // boring tools, set to size; addresses stay
  std::vector<Fit> fits;
  std::vector<Near> near;
  std::map<CutterClass, std::set<double>> other_sizes;
  for (const Cutter& original : library) {
    const std::size_t rank = rank_of(r, original.cutter_class);
    if (rank == r.classes.size() || original.cutting_diameter_mm <= 0.0 || original.teeth <= 0) continue;
    const Cutter& c = original.adjustable_to_mm > 0.0 ? set.emplace_back(as_set(original, r)) : original;
    if (wrong_size(c, r)) {
      other_sizes[c.cutter_class].insert(rounded(c.cutting_diameter_mm, 4));
      continue;
    }
    auto why = wrong_shape(c, r);
    if (!why) why = too_short(c, r);
    StartValues start;
    if (!why) {
      start = start_values(c, material, machine);
      why = not_for_machine(c, start, material, machine);
    }
    if (why)
      near.push_back({&c, std::move(*why)});
    else
      fits.push_back({&c, std::move(start), rank, 0.0});
  }
  double largest = 0.0;
  for (const Fit& f : fits) largest = std::max(largest, f.cutter->cutting_diameter_mm);
  for (Fit& f : fits) f.score = score_of(*f.cutter, f.rank, r, f.start, material, largest, preferences);
  std::sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
    return a.score != b.score ? a.score < b.score : a.cutter->id < b.cutter->id;
  });
  for (std::size_t i = 0; i < std::min(fits.size(), preferences.most); ++i) {
    const Fit& f = fits[i];
    out.ranked.push_back({*f.cutter, f.start.vc_m_min, f.start.fz_mm, f.score,
                          reason_for(*f.cutter, r, f.start, preferences, fits.size())});
  }
  tell_near(near, preferences.most_rejected, out);
  sum_up_sizes(r, other_sizes, out);
  if (out.ranked.empty()) out.would_fit = words_of(r);
  return out;
}

std::string_view words_of(CutterClass c) {
  switch (c) {
    case CutterClass::kEndmill:
      return "end mill";
    case CutterClass::kBullnoseEndmill:
      return "bull-nose end mill";
    case CutterClass::kBallEndmill:
      return "ball end mill";
    case CutterClass::kFacemill:
      return "face mill";
    case CutterClass::kTwistDrill:
      return "twist drill";
    case CutterClass::kCenterDrill:
      return "centre drill";
    case CutterClass::kSpotDrill:
      return "spot drill";
    case CutterClass::kReamer:
      return "reamer";
    case CutterClass::kTap:
      return "tap";
    case CutterClass::kThreadMill:
      return "thread mill";
    case CutterClass::kBoringTool:
      return "boring tool";
    case CutterClass::kCountersink:
      return "countersink";
    case CutterClass::kCounterbore:
      return "counterbore";
    case CutterClass::kChamferMill:
      return "chamfer mill";
    case CutterClass::kTSlotMill:
      return "T-slot cutter";
    case CutterClass::kDovetailMill:
      return "dovetail cutter";
    case CutterClass::kGunDrill:
      return "gun drill";
    case CutterClass::kBackCounterbore:
      return "back counterbore";
    case CutterClass::kBackCountersink:
      return "back countersink";
    case CutterClass::kCornerRoundingMill:
      return "corner rounding mill";
    case CutterClass::kTaperedEndmill:
      return "tapered end mill";
    case CutterClass::kSideMill:
      return "side mill";
    case CutterClass::kTouchProbe:
      return "touch probe";
  }
  return "cutter";
}

std::string words_of(const ToolRequirement& r) {
  const bool vowel = r.diameter_exact_mm <= 0.0 && (lower_size(r) <= 0.0 || upper_size(r) <= 0.0) &&
                     !r.classes.empty() && r.classes.front() == CutterClass::kEndmill;
  std::string out = vowel ? "an " : "a ";
  const double low = lower_size(r), high = upper_size(r);
  if (r.diameter_exact_mm > 0.0)
    out += mm(r.diameter_exact_mm) + " ";
  else if (low > 0.0 && high > 0.0)
    out += mm(low) + " to " + mm(high) + " ";
  for (std::size_t i = 0; i < r.classes.size(); ++i)
    out += (i == 0 ? "" : " or ") + std::string(words_of(r.classes[i]));
  if (r.classes.empty()) out += "cutter";
  if (r.diameter_exact_mm <= 0.0 && low <= 0.0 && high > 0.0) out += " of at most " + mm(high);
  if (low > 0.0 && high <= 0.0) out += " of at least " + mm(low);
  std::string with;
  const auto add = [&](const std::string& text) { with += (with.empty() ? " with " : ", ") + text; };
  if (r.thread_pitch_mm > 0.0) add(mm(r.thread_pitch_mm) + " pitch");
  if (r.point_angle_rad > 0.0) add(degrees(r.point_angle_rad) + " point");
  if (r.corner_radius_exact_mm >= 0.0) add(mm(r.corner_radius_exact_mm) + " corner radius");
  if (r.corner_radius_limited) add("at most " + mm(r.corner_radius_max_mm) + " corner radius");
  if (r.depth_of_cut_mm > 0.0) add(mm(r.depth_of_cut_mm) + " flutes");
  if (r.reach_mm > 0.0) add(mm(r.reach_mm) + " reach");
  if (r.centre_cutting) with += ", cutting to centre or ramping";
  return out + with;
}

void assign_pockets(std::vector<Cutter>& cutters) {
  std::set<int> taken;
  for (Cutter& c : cutters) {
    if (c.pocket > 0 && !taken.insert(c.pocket).second) c.pocket = 0;
  }
  int next = 1;
  for (Cutter& c : cutters) {
    if (c.pocket > 0) continue;
    while (taken.count(next) != 0) ++next;
    c.pocket = next;
    taken.insert(next);
  }
}

}  // namespace capstan::tooling
