#include "tooling/selection/select.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/selection/limits.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::Machine;
using model::Selection;
using model::ToolRequirement;
using model::WorkMaterial;

/// Weights beside the estimated seconds; defaults, unsourced. A class that the rules like less has to save
/// this much; so has a millimetre from the wanted diameter.
constexpr double kPerClassS = 600.0;
constexpr double kPerExactMmS = 600.0;
/// A tool that is used already but not loaded may still drop out of the plan: part of its loading.
constexpr double kUsedShare = 0.25;
/// Of each diameter that it sticks out beyond kStiff.
constexpr double kPerSlendernessS = 2.0;
constexpr double kStiff = 3.0;
/// Between equals the larger cutter, which is worth this over the smallest; not of countersinks: of these as
/// much cuts as the cone is wide, whatever their size.
constexpr double kPerSizeS = 1.0;

/// A boring tool set to the wanted size, when it can be, and has to be.
std::optional<Cutter> as_set(const Cutter& c, const ToolRequirement& r) {
  const double wanted = r.diameter_exact_mm > 0.0 ? r.diameter_exact_mm : r.diameter_max_mm;
  if (c.adjustable_to_mm <= 0.0 || wanted <= c.cutting_diameter_mm || wanted > c.adjustable_to_mm)
    return std::nullopt;
  Cutter out = c;
  out.cutting_diameter_mm = wanted;
  out.sources.emplace_back(
      "cutting_diameter_mm",
      "derived: set to the bore, " + mm_text(c.cutting_diameter_mm) + " to " + mm_text(c.adjustable_to_mm));
  return out;
}

/// Seconds until the cutter can cut: the change, and loading what the magazine does not hold.
double ready_s(const Cutter& c, const Machine& m, const Preferences& p, bool magazine_known) {
  const bool used = std::find(p.used.begin(), p.used.end(), c.id) != p.used.end();
  const double change = used ? 0.0 : m.tool_change_s + m.spindle.spin_up_s;
  const double loading = !magazine_known || c.loaded ? 0.0 : (used ? kUsedShare : 1.0) * kLoadingS;
  return change + loading / std::max(1, p.batch);
}

double score_of(const Cutter& c, std::size_t class_rank, const ToolRequirement& r, const Estimate& e,
                const Machine& m, double largest_mm, const Preferences& p, bool magazine_known) {
  double s = e.cutting_s + e.tool_s + ready_s(c, m, p, magazine_known);
  s += kPerClassS * static_cast<double>(class_rank);
  if (r.diameter_exact_mm > 0.0)
    s += kPerExactMmS * std::abs(c.cutting_diameter_mm - r.diameter_exact_mm);
  else if (largest_mm > 0.0 && c.cutter_class != CutterClass::kCountersink)
    s += kPerSizeS * (1.0 - c.cutting_diameter_mm / largest_mm);
  s += kPerSlendernessS * std::max(0.0, c.stick_out_mm / c.cutting_diameter_mm - kStiff);
  return rounded(s, 9);
}

std::size_t rank_of(const ToolRequirement& r, CutterClass c) {
  return static_cast<std::size_t>(std::find(r.classes.begin(), r.classes.end(), c) - r.classes.begin());
}

/// Summarises cutters refused for their size alone; names the nearest sizes below and above.
void sum_up_sizes(const ToolRequirement& r, const std::map<CutterClass, std::set<double>>& sizes,
                  Selection& out) {
  const double low = lower_size(r), high = upper_size(r);
  for (const auto& [cls, all] : sizes) {
    std::string nearest;
    const auto above = high > 0.0 ? all.upper_bound(high) : all.end();
    const auto below = all.lower_bound(low);
    if (below != all.begin()) nearest = mm_text(*std::prev(below));
    if (above != all.end()) nearest += (nearest.empty() ? "" : " and ") + mm_text(*above);
    std::string wanted = low > 0.0 ? "from " + mm_text(low) : "";
    if (high > 0.0) wanted += (wanted.empty() ? "up to " : " to ") + mm_text(high);
    if (r.diameter_exact_mm > 0.0) wanted = mm_text(r.diameter_exact_mm);
    out.rejected.push_back(
        {std::to_string(all.size()) + " other sizes of " + std::string(model::words_of(cls)),
         "diameter is not " + wanted + "; nearest " + nearest});
  }
}

/// What a drill leaves in a conical bottom that asks a sharper point: between two cones on its diameter.
struct PointRest {
  double height_mm = 0.0, volume_mm3 = 0.0;
};
PointRest rest_under_point(const Cutter& c, double asked_rad) {
  const double r = 0.5 * c.cutting_diameter_mm;
  const double h = r / std::tan(0.5 * asked_rad) - r / std::tan(0.5 * c.point_angle_rad);
  return {h, std::numbers::pi * r * r * h / 3.0};
}
/// Less than this is the rounding of drawn points, 118 as 120 degrees. Default, unsourced.
constexpr double kTellRestMm = 0.1;

model::Reason reason_for(const Cutter& c, const ToolRequirement& r, const StartValues& start,
                         const Preferences& p, std::size_t fitting, const Estimate& e) {
  std::string text = c.description.empty() ? c.id : c.description;
  text += ": ";
  text += r.diameter_exact_mm > 0.0 ? "of the size wanted" : "diameter " + mm_text(c.cutting_diameter_mm);
  if (upper_size(r) > 0.0 && r.diameter_exact_mm <= 0.0) text += " within " + mm_text(upper_size(r));
  if (r.reach_mm > 0.0) text += ", reach " + mm_text(reach_of(c)) + " for " + mm_text(r.reach_mm);
  if (r.point_angle_rad > 0.0 && r.point_angle_most_rad > 0.0 && c.cutter_class == CutterClass::kTwistDrill) {
    const PointRest rest = rest_under_point(c, r.point_angle_rad);
    if (rest.height_mm > kTellRestMm)
      text += ", its point of " + deg_text(c.point_angle_rad) + " leaves " + trimmed(rest.height_mm, 2) +
              " mm, " + trimmed(rest.volume_mm3, 1) + " mm3, in the bottom's cone of " +
              deg_text(r.point_angle_rad);
  }
  if (c.loaded)
    text += ", loaded as T" + std::to_string(c.pocket);
  else if (std::find(p.used.begin(), p.used.end(), c.id) != p.used.end())
    text += ", used already";
  if (e.cutting_s > 0.0) {
    text += "; about " + trimmed(e.cutting_s, 1) + " s of cutting";
    if (!e.limited_by.empty()) text += ", held back by " + e.limited_by;
    if (e.tool_s > 0.0) text += ", and " + trimmed(e.tool_s, 1) + " s worth of tool";
  }
  text += "; one of " + std::to_string(fitting) + " that fit; " + start.why.text;
  return {"tooling.select." + std::string(model::to_text(c.cutter_class)), text, start.why.source};
}

/// A cutter that meets all limits, and one that misses one.
struct Fit {
  const Cutter* cutter;
  StartValues start;
  std::size_t rank;
  Estimate estimate;
  double score;
  bool unmeasured;  ///< its tool table gives it no length: it cannot run as it is
};
struct Near {
  const Cutter* cutter;
  std::string why;
};

/// Cutters that have all that is wanted, but cannot be used on the machine: the narrowest of them asks least
/// of a spindle that turns too fast or is too weak.
struct Unable {
  const Cutter* narrowest = nullptr;
  std::string why;
  std::size_t count = 0;
  void add(const Cutter& c, const std::string& reason) {
    ++count;
    if (narrowest != nullptr && c.cutting_diameter_mm >= narrowest->cutting_diameter_mm) return;
    narrowest = &c;
    why = reason;
  }
  [[nodiscard]] std::string text() const {
    if (narrowest == nullptr) return {};
    return ", if the machine could use it (" +
           (count > 1 ? "of " + std::to_string(count) + " such cutters the narrowest, " : std::string()) +
           narrowest->id + ": " + why + ")";
  }
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
  const Turning turning(machine);
  std::deque<Cutter> set;  // boring tools, set to size; addresses stay
  std::vector<Fit> fits;
  std::vector<Near> near;
  std::map<CutterClass, std::set<double>> other_sizes;
  std::string not_of;  // what the material is not cut with, of the first that would fit else
  Unable unable;
  for (const Cutter& original : library) {
    const std::size_t rank = rank_of(r, original.cutter_class);
    if (rank == r.classes.size() || original.cutting_diameter_mm <= 0.0) continue;
    if (original.teeth <= 0 && original.cutter_class != CutterClass::kTouchProbe) continue;
    auto to_size = as_set(original, r);
    const Cutter& c = to_size ? set.emplace_back(*std::move(to_size)) : original;
    if (is_other_size(c, r)) {
      other_sizes[c.cutter_class].insert(rounded(c.cutting_diameter_mm, 4));
      continue;
    }
    auto why = wrong_shape(c, r);
    if (!why) why = too_short(c, r);
    StartValues start;
    if (!why) {
      if (c.cutter_class != CutterClass::kTouchProbe) start = start_numbers(c, material, machine);
      why = not_for_machine(c, start, material, turning, preferences);
      const auto never = not_cut_with(c, start, material);
      if (never && not_of.empty())
        not_of = ", not of " + std::string(model::to_text(c.substrate)) + " (" + c.id + ": " + *never + ")";
      if (why && !never) unable.add(c, *why);
    }
    if (why)
      near.push_back({&c, std::move(*why)});
    else
      fits.push_back({&c, start, rank, estimate(c, r, start, material, turning, preferences), 0.0,
                      !model::offset_fault(c).empty()});
  }
  double largest = 0.0;
  for (const Fit& f : fits) largest = std::max(largest, f.cutter->cutting_diameter_mm);
  // Where nothing is loaded, nothing is known of the magazine.
  const bool magazine_known =
      std::any_of(library.begin(), library.end(), [](const Cutter& c) { return c.loaded; });
  for (Fit& f : fits)
    f.score = score_of(*f.cutter, f.rank, r, f.estimate, machine, largest, preferences, magazine_known);
  std::sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
    if (a.unmeasured != b.unmeasured) return b.unmeasured;
    return a.score != b.score ? a.score < b.score : a.cutter->id < b.cutter->id;
  });
  out.ranked.reserve(std::min(fits.size(), preferences.most));
  for (std::size_t i = 0; i < std::min(fits.size(), preferences.most); ++i) {
    const Fit& f = fits[i];
    out.ranked.push_back({*f.cutter, f.start.vc_m_min, f.start.fz_mm, f.score,
                          rounded(f.estimate.cutting_s + f.estimate.tool_s, 6),
                          reason_for(*f.cutter, r, start_values(*f.cutter, material, machine), preferences,
                                     fits.size(), f.estimate)});
  }
  tell_near(near, preferences.most_rejected, out);
  sum_up_sizes(r, other_sizes, out);
  if (out.ranked.empty()) out.would_fit = words_of(r) + not_of + unable.text();
  return out;
}

void assign_pockets(std::vector<Cutter>& cutters) {
  std::set<int> taken;
  // Tools in the magazine stay there; of the others, the first that prefers a number gets it.
  for (const bool loaded : {true, false}) {
    for (Cutter& c : cutters) {
      if (c.loaded == loaded && c.pocket > 0 && !taken.insert(c.pocket).second) {
        c.pocket = 0;
        c.loaded = false;
      }
    }
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
