#include "tooling/library/cutters/complete.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "tooling/library/cutters/edge_kind.h"
#include "tooling/library/cutters/edges.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

/// Nearest in diameter of the class, with edges that lean alike; of equals one of the same substrate and
/// teeth, then the shorter.
const Cutter* nearest(const Cutter& c, const std::vector<Cutter>& generic) {
  constexpr double kUnlikeMm = 1e3;  // farther than any diameter
  const Cutter* best = nullptr;
  double best_distance = 0.0;
  for (const Cutter& g : generic) {
    if (g.cutter_class != c.cutter_class) continue;
    double d = std::abs(g.cutting_diameter_mm - c.cutting_diameter_mm);
    if (g.substrate != c.substrate) d += 1e-3;
    if (c.teeth > 0 && g.teeth != c.teeth) d += 1e-4;
    if (!edges_lean_alike(c, g)) d += kUnlikeMm;
    if (c.thread_pitch_mm > 0.0) d += std::abs(g.thread_pitch_mm - c.thread_pitch_mm);
    if (best == nullptr || d < best_distance || (d == best_distance && g.stick_out_mm < best->stick_out_mm)) {
      best = &g;
      best_distance = d;
    }
  }
  return best;
}

class Filler {
 public:
  Filler(Cutter& c, const Cutter& g) : c_(c), source_(std::string(kAsGeneric) + g.id) {}
  void take(double& field, double value, const char* name) {
    if (field != 0.0 || value == 0.0) return;
    field = value;
    c_.sources.emplace_back(name, source_);
  }
  void note(const char* name, const std::string& why) { c_.sources.emplace_back(name, why); }
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  Cutter& c_;
  std::string source_;
};

void fill_lengths(Cutter& c, const Cutter& g, Filler& f) {
  constexpr double kBehindFlutesMm = 2.0;  // default, unsourced
  const double gage = g.functional_length_mm - g.stick_out_mm;
  // The nearest generic one may be longer than this whole tool.
  const auto within_whole = [&](double mm) {
    return c.overall_length_mm > 0.0 ? std::min(mm, c.overall_length_mm) : mm;
  };
  if (c.maximum_depth_of_cut_mm == 0.0) {
    f.take(c.maximum_depth_of_cut_mm, g.maximum_depth_of_cut_mm, "maximum_depth_of_cut_mm");
    if (c.stick_out_mm > 0.0) c.maximum_depth_of_cut_mm = std::min(c.maximum_depth_of_cut_mm, c.stick_out_mm);
    c.maximum_depth_of_cut_mm = within_whole(c.maximum_depth_of_cut_mm);
  }
  if (c.stick_out_mm == 0.0) {
    f.take(c.stick_out_mm, std::max(g.stick_out_mm, c.maximum_depth_of_cut_mm + kBehindFlutesMm),
           "stick_out_mm");
    if (c.functional_length_mm > 0.0) c.stick_out_mm = std::min(c.stick_out_mm, c.functional_length_mm);
    c.stick_out_mm = within_whole(c.stick_out_mm);
  }
  f.take(c.functional_length_mm, c.stick_out_mm + gage, "functional_length_mm");
  if (c.usable_length_mm == 0.0) {
    f.take(c.usable_length_mm, std::max(g.usable_length_mm, c.maximum_depth_of_cut_mm), "usable_length_mm");
    c.usable_length_mm = std::min(c.usable_length_mm, c.stick_out_mm);
  }
}

/// The speed of a bare edge: what its source says the coated one is faster by is taken back, "1.3 (coated:
/// ...)".
void as_bare(model::CuttingPreset& p) {
  const std::string& said = p.source.text();
  const auto coated = said.find(kCoated);
  if (coated == std::string::npos || coated == 0) return;
  const auto begin = said.find_last_of(' ', coated - 2) + 1;
  auto end = said.find(") x ", coated);
  const bool of_group = end == std::string::npos;  // "..., 1.3 (coated: ...); fz: ..."
  if (of_group) end = said.find("; fz: ", coated);
  const auto faster = parse_double(std::string_view(said).substr(begin, coated - 1 - begin));
  if (!faster || !(*faster > 0.0) || end == std::string::npos) {
    p.vc_m_min = 0.0;
    return;
  }
  p.vc_m_min = rounded(p.vc_m_min / *faster, 3);
  std::string bare = said;
  bare.erase(of_group ? begin - 2 : begin, of_group ? end - (begin - 2) : end + 4 - begin);
  p.source = std::move(bare);
}

/// An own preset that names a shipped material says in its source of which group that is.
void tell_groups(Cutter& c) {
  static const auto materials = shipped_materials();
  if (!materials) return;
  for (model::CuttingPreset& p : c.presets) {
    if (borrowed(p)) continue;
    for (const model::WorkMaterial& m : *materials) {
      const bool it = m.id == p.material_group ||
                      std::find(m.names.begin(), m.names.end(), p.material_group) != m.names.end();
      if (!it) continue;
      if (!p.source.ends_with(model::of_group(m.iso_group)))
        p.source = p.source.text() + model::of_group(m.iso_group);
      break;
    }
  }
}

/// The nearest in diameter of the same class and tool material: a carbide reamer, too, cuts slower than a
/// carbide mill. Null if there is none.
const Cutter* nearest_of_material(const Cutter& c, const std::vector<Cutter>& generic) {
  const Cutter* best = nullptr;
  for (const Cutter& g : generic) {
    if (g.cutter_class != c.cutter_class || g.substrate != c.substrate) continue;
    if (best == nullptr || std::abs(g.cutting_diameter_mm - c.cutting_diameter_mm) <
                               std::abs(best->cutting_diameter_mm - c.cutting_diameter_mm))
      best = &g;
  }
  return best;
}

/// The speed at which a cutter starts in a material, as a bare edge. 0: it has none.
struct Speed {
  double vc_m_min = 0.0;
  std::string source;
};
Speed speed_of_like(const Cutter* like, const std::string& material) {
  if (like == nullptr) return {};
  for (model::CuttingPreset p : like->presets) {
    if (p.material_group != material) continue;
    as_bare(p);
    return {p.vc_m_min, p.source.text().substr(0, p.source.find("; fz: "))};
  }
  return {};
}

/// A thread mill with one profile stands on a neck that clears the thread, or it would cut one turn only:
/// thinner by its profile, 0.65 of the pitch, and 0.1 mm on either side, as those of the generic series.
void fill_neck_of_ring(Cutter& c, Filler& f) {
  if (!model::mills_threads(c.cutter_class) || c.neck_diameter_mm > 0.0 || !(c.thread_pitch_mm > 0.0) ||
      !(c.maximum_depth_of_cut_mm < 2.0 * c.thread_pitch_mm))
    return;
  const double neck = rounded(c.cutting_diameter_mm - 1.3 * c.thread_pitch_mm - 0.2, 3);
  if (!(neck > 0.0)) return;
  const double reach = c.neck_length_mm > 0.0 ? c.neck_length_mm : c.usable_length_mm;
  if (!(reach > c.maximum_depth_of_cut_mm)) return;
  c.neck_diameter_mm = neck;
  c.neck_length_mm = reach;
  f.note("neck_diameter_mm", std::string(kNotStated) + ", that of the generic series for its pitch");
}

/// As kCoated, of a bare edge of cobalt steel.
constexpr std::string_view kCobalt = "(cobalt";

/// The speed that a stated grade gives to a preset for a bare edge: the factor of `edges` in the preset's
/// group times its speed, and where it has none times the card's for the material. Said in the source; also
/// where `edges` has no more for the group than the bare edge.
class ByGrade {
 public:
  explicit ByGrade(const Cutter& c) : c_(c), grade_(grade_of(c)) {
    const auto at = shipped_edges().find(edge_of(grade_, c));
    if (at != shipped_edges().end()) edge_ = &at->second;
  }

  void apply(model::CuttingPreset& p) const {
    if (edge_ == nullptr) return;
    const model::WorkMaterial* m = material(p.material_group);
    const std::string group = m != nullptr ? m->iso_group : p.material_group.text();
    const auto times = edge_->over_bare.find(group);
    if (times == edge_->over_bare.end()) return;
    if (times->second == 1.0) {
      p.source = p.source.text() + " (as bare: no figure for " + grade_.said + " in group " + group + ")";
      return;
    }
    const std::string factor = trimmed(times->second, 3) + " " +
                               std::string(grade_.coated ? kCoated : kCobalt) + ", as '" + grade_.said +
                               "' says: " + edge_->source + ")";
    const double card = m == nullptr                             ? 0.0
                        : c_.substrate == model::Substrate::kHss ? m->vc_hss_m_min
                                                                 : m->vc_carbide_m_min;
    std::string source = p.source;
    if (p.vc_m_min > 0.0) {
      p.vc_m_min = rounded(times->second * p.vc_m_min, 3);
    } else if (card > 0.0) {
      p.vc_m_min = rounded(times->second * card, 3);
      source = "vc: " + std::string(kMaterialsSpeed) + "; " + source;
    } else {
      return;
    }
    if (const auto fz_at = source.find("; fz: "); m == nullptr && fz_at != std::string::npos) {
      source.insert(fz_at, ", " + factor);
    } else if (source.starts_with("vc: ")) {
      source.insert(4, factor + " x ");
    }
    p.source = std::move(source);
  }

 private:
  static const model::WorkMaterial* material(const std::string& id) {
    static const auto materials = shipped_materials();
    if (!materials) return nullptr;
    for (const model::WorkMaterial& m : *materials)
      if (m.id == id) return &m;
    return nullptr;
  }

  const Cutter& c_;
  Grade grade_;
  const Edge* edge_ = nullptr;
};

void fill_feeds(Cutter& c, const Cutter& g, const std::vector<Cutter>& generic, Filler& f) {
  // A smaller tooth allows less; a larger one is not given more.
  const double scale = std::min(1.0, c.cutting_diameter_mm / g.cutting_diameter_mm);
  if (c.cutter_class == CutterClass::kTap) {
    if (c.fz_min_mm == 0.0 && c.fz_max_mm == 0.0)
      c.fz_min_mm = c.fz_max_mm = c.thread_pitch_mm / std::max(c.teeth, 1);
  } else {
    // A start value of its own that is higher applies to that material only: model::preset_feeds.
    double least = 0.0;
    for (const model::CuttingPreset& p : c.presets) {
      if (borrowed(p) || !(p.fz_mm > 0.0)) continue;
      least = least > 0.0 ? std::min(least, p.fz_mm) : p.fz_mm;
    }
    if (c.fz_max_mm == 0.0) {
      f.take(c.fz_max_mm, rounded(g.fz_max_mm * scale, 5), "fz_max_mm");
      tell_groups(c);
    }
    if (c.fz_min_mm == 0.0) {
      const double like = rounded(g.fz_min_mm * scale, 5);
      f.take(c.fz_min_mm, std::min(c.fz_max_mm, least > 0.0 ? std::min(least, like) : like), "fz_min_mm");
    }
  }
  std::string own;
  for (const model::CuttingPreset& p : c.presets) {
    // Whoever was completed before has them already.
    if (borrowed(p)) return;
    own += (own.empty() ? "" : ", ") + p.material_group.text();
  }
  const Cutter* same_material = c.substrate == g.substrate ? &g : nearest_of_material(c, generic);
  const std::size_t stated = c.presets.size();
  const ByGrade by_grade(c);
  const std::string of_like =
      " (as " + g.id + (own.empty() ? "" : "; its own values are for " + own + " only") + ")";
  for (model::CuttingPreset p : g.presets) {
    const auto end = c.presets.begin() + static_cast<std::ptrdiff_t>(stated);
    if (std::any_of(c.presets.begin(), end,
                    [&](const auto& o) { return o.material_group == p.material_group; }))
      continue;
    p.fz_mm = rounded(p.fz_mm * scale, 5);
    // What the generic edge is faster by is taken back. Of another tool material the speed is that of its
    // like; where there is none, the work material's own is taken. Then what is stated of the edge counts.
    if (c.substrate == g.substrate) {
      as_bare(p);
    } else {
      const Speed like = speed_of_like(same_material, p.material_group);
      p.vc_m_min = like.vc_m_min;
      if (const auto fz_at = p.source.find("; fz: "); fz_at != std::string::npos)
        p.source = like.vc_m_min > 0.0 ? like.source + p.source.text().substr(fz_at)
                                       : p.source.text().substr(fz_at + 2);
    }
    by_grade.apply(p);
    p.source = p.source.text() + of_like;
    c.presets.push_back(std::move(p));
  }
}

}  // namespace

void complete(Cutter& c, const std::vector<Cutter>& generic) {
  const Cutter* g = nearest(c, generic);
  if (g == nullptr) return;
  Filler f(c, *g);
  if (model::has(c.cutter_class, model::CutterTrait::kBall) && c.corner_radius_mm == 0.0) {
    c.corner_radius_mm = 0.5 * c.cutting_diameter_mm;
    f.note("corner_radius_mm", "derived: half the diameter of a ball end mill");
  }
  if (c.teeth == 0) {
    c.teeth = g->teeth;
    f.note("teeth", f.source());
  }
  // A pitch, a corner and the angle of a cone are never assumed: see `faults_of`. Points of drills are.
  if (model::has(c.cutter_class, model::CutterTrait::kOpensSolid))
    f.take(c.point_angle_rad, g->point_angle_rad, "point_angle_rad");
  f.take(c.tip_diameter_mm, std::min(g->tip_diameter_mm, c.cutting_diameter_mm), "tip_diameter_mm");
  f.take(c.helix_rad, g->helix_rad, "helix_rad");
  f.take(c.shank_diameter_mm, g->shank_diameter_mm, "shank_diameter_mm");
  f.take(c.holder_diameter_mm, g->holder_diameter_mm, "holder_diameter_mm");
  fill_lengths(c, *g, f);
  fill_neck_of_ring(c, f);
  fill_feeds(c, *g, generic, f);
  if (model::has(c.cutter_class, model::CutterTrait::kToCentre) && !c.centre_cutting) {
    c.centre_cutting = true;
    f.note("centre_cutting", "derived: a drill");
  }
  if (model::has(c.cutter_class, model::CutterTrait::kRamps) && !c.centre_cutting &&
      c.maximum_ramp_angle_rad == 0.0) {
    c.maximum_ramp_angle_rad = model::kUsualRampRad;
    f.note("centre_cutting", std::string(kNotStated) + ", held not to cut to the centre");
    f.note("maximum_ramp_angle_rad", std::string(kRampUnstated));
  }
}

const std::string* source_of(const Cutter& c, std::string_view field) {
  for (const auto& [name, source] : c.sources)
    if (name == field) return &source;
  for (const auto& [name, source] : c.sources)
    if (name == "*") return &source;
  return nullptr;
}

}  // namespace capstan::tooling
