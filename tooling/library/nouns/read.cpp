#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/tool.h"
#include "planner/model/nouns/workpiece.h"
#include "planner/model/plan/requirement.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/library/nouns/tool_kind.h"
#include "tooling/library/nouns/tool_material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::MachiningTool;
using model::Model;
using model::Ref;

/// From the gage line to the tool's end; 0 when a placement is missing or they lie together.
double gage_length(const Model& m, const model::ToolUsage* usage) {
  if (usage == nullptr) return 0.0;
  const auto point = [&](Ref<model::Axis2Placement3d> r) -> const model::CartesianPoint* {
    const auto* p = m.get<model::Axis2Placement3d>(r);
    const auto* at = p != nullptr ? m.get<model::CartesianPoint>(p->location) : nullptr;
    return at != nullptr && at->coordinates.items.size() == 3 ? at : nullptr;
  };
  const auto* gage = point(usage->gage_placement);
  const auto* end = point(usage->tool_end_placement);
  if (gage == nullptr || end == nullptr) return 0.0;
  const auto& g = gage->coordinates.items;
  const auto& e = end->coordinates.items;
  const double length = std::hypot(g[0] - e[0], g[1] - e[1], g[2] - e[2]);
  return std::isfinite(length) && length > kSizeSlackMm ? length : 0.0;
}

/// Reads tool_usage except its position: names and links.
void read_usage(const Model& m, const model::ToolUsage& usage, Cutter& c) {
  if (usage.its_library_reference) {
    // A link into another library, or (as we write it) the cutter's own name.
    const bool link = usage.its_id && !usage.its_id->empty() && *usage.its_id != *usage.its_library_reference;
    c.id = link ? *usage.its_id : *usage.its_library_reference;
    if (link) c.library_reference = *usage.its_library_reference;
  }
  if (usage.its_library_source) c.library_source = *usage.its_library_source;
  if (usage.its_carousel) c.carousel = *usage.its_carousel;
  if (const auto* product = m.get<model::Workpiece>(usage.its_product))
    c.product_id = product->its_id.value_or("");
  if (usage.description) c.description = *usage.description;
}

int position_of(const model::ToolUsage* usage) {
  if (usage == nullptr || !usage->its_position) return 0;
  const auto v = parse_double(*usage->its_position);
  return v && *v >= 1.0 && *v <= 99999.0 && *v == std::floor(*v) ? static_cast<int>(*v) : 0;
}

class Reader {
 public:
  Reader(const Model& m, const ToolParts& p, Cutter& c, Job& job) : m_(m), p_(p), c_(c), job_(job) {}

  void read(const std::string& reading, const ToolMaterialHints* hints) {
    c_.id = c_.description = p_.name.empty() ? "tool" : p_.name;
    c_.cutting_diameter_mm = *p_.dimension->diameter;
    stated("cutting_diameter_mm", "diameter");
    if (c_.point_angle_rad > 0.0) c_.sources.emplace_back("point_angle_rad", reading);
    read_shape();
    read_lengths();
    read_material(hints);
  }

 private:
  void stated(const char* field, const char* attribute) {
    c_.sources.emplace_back(field, std::string("stated: ") + attribute);
  }
  void pitch(const model::Real& stated_pitch) {
    if (!(stated_pitch.value_or(0.0) > 0.0)) return;
    c_.thread_pitch_mm = *stated_pitch;
    stated("thread_pitch_mm", "thread_pitch");
  }
  template <class Body>
  void thread(const Body& b) {
    pitch(b.thread_pitch);
    if (b.thread_size.value_or(0.0) > 0.0) {
      c_.thread_size_mm = *b.thread_size;
      stated("thread_size_mm", "thread_size");
    }
    if (b.thread_form_type) c_.thread_form = *b.thread_form_type;
  }
  void read_shape() {
    if (model::has(c_.cutter_class, model::CutterTrait::kSmallerDoes) &&
        p_.dimension->edge_radius.value_or(0.0) > 0.0) {
      c_.corner_radius_mm = *p_.dimension->edge_radius;
      stated("corner_radius_mm", "edge_radius");
    }
    if (p_.body->number_of_teeth.value_or(0) > 0) {
      c_.teeth = static_cast<int>(std::min<std::int64_t>(*p_.body->number_of_teeth, 1000));
      stated("teeth", "number_of_teeth");
    }
    if (p_.body->hand_of_cut.set()) {
      c_.hand = p_.body->hand_of_cut.value();
      stated("hand", "hand_of_cut");
    }
    c_.coolant_through = p_.body->coolant_through_tool.value_or(false);
    if (const auto* tap = m_.get<model::Tap>(p_.body_ref)) {
      thread(*tap);
      c_.lead_threads = std::max(0.0, tap->taper_thread_count.value_or(0.0));
    }
    if (const auto* mill = m_.get<model::ThreadMill>(p_.body_ref)) thread(*mill);
    if (const auto* reamer = m_.get<model::Reamer>(p_.body_ref))
      c_.lead_length_mm = std::max(0.0, reamer->taper_length.value_or(0.0));
    if (const auto* sink = m_.get<model::Countersink>(p_.body_ref);
        sink != nullptr && sink->minimum_cutting_diameter.value_or(0.0) > 0.0) {
      c_.tip_diameter_mm = *sink->minimum_cutting_diameter;
      stated("tip_diameter_mm", "minimum_cutting_diameter");
    }
    if (const auto* taper = m_.get<model::TaperedEndmill>(p_.body_ref);
        taper != nullptr && taper->taper_angle.value_or(0.0) > 0.0) {
      c_.taper_angle_rad = *taper->taper_angle;
      stated("taper_angle_rad", "taper_angle");
    }
    leaning(m_.get<model::Facemill>(p_.body_ref));
    leaning(m_.get<model::Endmill>(p_.body_ref));
    if (const double width = width_of(m_, p_.body_ref); width > 0.0) {
      c_.cutting_width_mm = width;
      stated("cutting_width_mm", "cutter_width");
    }
    if (p_.dimension->cutting_edge_length.value_or(0.0) > 0.0) {
      c_.maximum_depth_of_cut_mm = *p_.dimension->cutting_edge_length;
      stated("maximum_depth_of_cut_mm", "cutting_edge_length");
    }
    if (const auto* t = m_.get<model::TSlotMill>(p_.body_ref); t != nullptr && t->cutting_thickness) {
      c_.maximum_depth_of_cut_mm = *t->cutting_thickness;
      stated("maximum_depth_of_cut_mm", "cutting_thickness");
    }
    if (const auto* t = m_.get<model::DovetailMill>(p_.body_ref); t != nullptr && t->included_angle)
      c_.lead_angle_rad = 0.5 * *t->included_angle;
  }
  /// The lead angle of a mill whose edges do not stand upright: 90 degrees less the cutting edge angle.
  template <class Body>
  void leaning(const Body* b) {
    constexpr double kUpright = 0.5 * std::numbers::pi;
    const double kappa = b != nullptr ? b->tool_cutting_edge_angle.value_or(0.0) : 0.0;
    if (!(kappa > 0.0) || kappa >= kUpright) return;
    c_.lead_angle_rad = kUpright - kappa;
    c_.sources.emplace_back("lead_angle_rad", "derived: 90 degrees - tool_cutting_edge_angle");
  }
  void read_lengths() {
    double length = p_.tool->overall_assembly_length.value_or(0.0);
    const char* from = "overall_assembly_length";
    if (const double measured = gage_length(m_, m_.get<model::ToolUsage>(p_.tool->its_usage));
        measured > 0.0) {
      constexpr double kSame = 0.01;  // mm; lengths are preset to a hundredth
      if (length > 0.0 && std::abs(length - measured) > kSame)
        job_.warn("TOOL-LENGTH", p_.name + ": overall_assembly_length says " + trimmed(length, 3) +
                                     " mm, from gage_placement to tool_end_placement it is " +
                                     trimmed(measured, 3) + " mm, which holds");
      length = measured;
      from = "gage_placement and tool_end_placement";
    }
    const auto* edge = p_.tool->its_cutting_edge.empty()
                           ? nullptr
                           : m_.get<model::CuttingComponent>(p_.tool->its_cutting_edge.items[0]);
    if (length <= 0.0 && edge != nullptr) {
      length = edge->tool_offset_length.value_or(0.0);
      from = "tool_offset_length";
    }
    if (edge != nullptr && edge->expected_tool_life)
      c_.life_min = *edge->expected_tool_life / kSecondsPerMinute;
    if (length <= 0.0) return;
    if (c_.maximum_depth_of_cut_mm > length) {
      job_.warn("TOOL-LENGTH", p_.name + ": the cutting edge (" + trimmed(c_.maximum_depth_of_cut_mm, 3) +
                                   " mm) is longer than " + from + " (" + trimmed(length, 3) +
                                   " mm), which is therefore not used");
      return;
    }
    c_.functional_length_mm = c_.stick_out_mm = c_.usable_length_mm = length;
    stated("functional_length_mm", from);
    const std::string derived = std::string("derived: ") + from + ", no holder being described";
    c_.sources.emplace_back("stick_out_mm", derived);
    c_.sources.emplace_back("usable_length_mm", derived);
  }
  void read_material(const ToolMaterialHints* hints) {
    c_.substrate = model::Substrate::kHss;
    std::string source = std::string(kNotStated) + ", the slower one";
    bool stated = false;
    if (!p_.tool->its_cutting_edge.empty()) {
      const auto* edge = m_.get<model::CuttingComponent>(p_.tool->its_cutting_edge.items[0]);
      const auto* mat = edge == nullptr ? nullptr : m_.get<model::Material>(edge->its_material);
      if (mat != nullptr) {
        const std::string text =
            mat->material_identifier.value_or("") + " " + mat->standard_identifier.value_or("");
        if (text.find("CARBIDE") != std::string::npos || text.find("carbide") != std::string::npos) {
          c_.substrate = model::Substrate::kCarbide;
          stated = true;
        } else if (text.find("HSS") != std::string::npos || text.find("hss") != std::string::npos) {
          stated = true;
        }
      }
    }
    if (stated) {
      source = "stated: its_material";
    } else if (hints != nullptr) {
      ToolMaterial likely = likely_material(c_, *hints);
      c_.substrate = likely.substrate;
      source = std::move(likely.source);
    }
    c_.sources.emplace_back("substrate", source);
  }

  const Model& m_;
  const ToolParts& p_;
  Cutter& c_;
  Job& job_;
};

/// The library's cutter that tool_usage names, and the name that it has in the plan.
struct Named {
  const Cutter* cutter = nullptr;
  std::string id;
};

Named named(const Model& m, const ToolParts& p, const std::vector<Cutter>& library) {
  const auto* usage = m.get<model::ToolUsage>(p.tool->its_usage);
  if (usage == nullptr) return {};
  const auto* product = m.get<model::Workpiece>(usage->its_product);
  for (const auto* text : {&usage->its_library_reference, product != nullptr ? &product->its_id : nullptr}) {
    if (text == nullptr || !*text) continue;
    // A boring tool that a plan sets to several sizes has each behind its name, and stays as many tools.
    const std::string_view plain = std::string_view(**text).substr(0, (*text)->find('@'));
    for (const Cutter& c : library) {
      if (c.adjustable_to_mm > 0.0 && c.id == plain) return {&c, **text};
      if (c.id == **text || (!c.library_reference.empty() && c.library_reference == **text) ||
          (product != nullptr && text == &product->its_id && c.product_id == **text))
        return {&c, c.id};
    }
  }
  return {};
}

bool same_size(const ToolParts& p, const Cutter& c) {
  const bool d = std::abs(*p.dimension->diameter - c.cutting_diameter_mm) <= kSizeSlackMm;
  const bool set = c.adjustable_to_mm > 0.0 && *p.dimension->diameter >= c.cutting_diameter_mm &&
                   *p.dimension->diameter <= c.adjustable_to_mm;
  const bool r = !p.dimension->edge_radius || !model::has(c.cutter_class, model::CutterTrait::kSmallerDoes) ||
                 std::abs(*p.dimension->edge_radius - c.corner_radius_mm) <= kSizeSlackMm;
  return (d || set) && r;
}

int pocket_of(const Model& m, const ToolParts& p) {
  return position_of(m.get<model::ToolUsage>(p.tool->its_usage));
}

/// A probe is no cutter, and not a requirement either.
Result<Cutter> probe_from(const Model& m, const model::TouchProbe& probe,
                          const std::vector<Cutter>& library) {
  Cutter c;
  c.cutter_class = CutterClass::kTouchProbe;
  c.id = c.description = probe.its_id.value_or("touch probe");
  const auto* usage = m.get<model::ToolUsage>(probe.its_usage);
  if (usage != nullptr) read_usage(m, *usage, c);
  for (const Cutter& known : library) {
    if (known.id != c.id || known.cutter_class != CutterClass::kTouchProbe) continue;
    Cutter out = known;
    if (const int pocket = position_of(usage); pocket > 0) out.pocket = pocket;
    return out;
  }
  c.pocket = position_of(usage);
  c.cutting_diameter_mm = 2.0 * probe.ball_radius.value_or(0.0);
  c.neck_diameter_mm = probe.stylus_diameter.value_or(0.0);
  double length = gage_length(m, usage);
  if (!(length > 0.0)) length = probe.overall_assembly_length.value_or(0.0);
  c.functional_length_mm = c.stick_out_mm = c.usable_length_mm = length;
  c.sources.emplace_back("*", "stated: touch_probe");
  if (const auto faults = faults_of(c); !faults.empty())
    return fail({.code = "TOOL-VALUE", .message = faults.front(), .path = c.id});
  return c;
}

}  // namespace

bool is_requirement(const Model& m, Ref<MachiningTool> tool) {
  if (!tool.set()) return true;
  const auto* t = m.get<model::CuttingTool>(tool);
  if (t == nullptr) return false;
  return t->its_tool_body.set() && !t->its_usage.set() && t->its_cutting_edge.empty() &&
         !t->overall_assembly_length;
}

Result<Cutter> cutter_from_nouns(const Model& m, Ref<MachiningTool> tool, Job& job,
                                 const std::vector<Cutter>& library, const ToolMaterialHints* hints) {
  if (const auto* probe = m.get<model::TouchProbe>(tool)) return probe_from(m, *probe, library);
  const auto p = tool_parts(m, tool);
  if (!p) return fail(p.error());
  const auto [known, name] = named(m, *p, library);
  if (known != nullptr) {
    if (same_size(*p, *known)) {
      Cutter c = *known;
      c.id = name;
      c.cutting_diameter_mm = *p->dimension->diameter;
      if (const int pocket = pocket_of(m, *p); pocket > 0) c.pocket = pocket;
      return c;
    }
    job.warn("TOOL-DIFFERS", p->name + ": the file's sizes are not those of '" + known->id +
                                 "' in the library; the file's hold");
  }
  const auto k = tool_kind(m, *p, job);
  if (!k) return fail(k.error());
  Cutter c;
  c.cutter_class = k->cutter_class;
  c.point_angle_rad = k->point_angle_rad;
  Reader(m, *p, c, job).read(k->reading, hints);
  c.pocket = pocket_of(m, *p);
  if (const auto* usage = m.get<model::ToolUsage>(p->tool->its_usage)) {
    read_usage(m, *usage, c);
  }
  // The library's words are of another size.
  if (known != nullptr && c.description == known->description)
    c.description = trimmed(c.cutting_diameter_mm, 3) + " mm " + std::string(model::to_text(c.cutter_class)) +
                    ", as the file states it";
  if (c.cutting_diameter_mm > 0.0) {
    const auto& generic = shared_generic_library();
    if (!generic) return fail(generic.error());
    complete(c, *generic);
  }
  if (const auto faults = faults_of(c); !faults.empty()) {
    const model::Origin& origin = m.origin(tool);
    return fail({.code = "TOOL-VALUE",
                 .message = faults.front(),
                 .line = origin.line,
                 .instance = origin.instance,
                 .path = p->name});
  }
  return c;
}

Result<model::ToolRequirement> requirement_from_nouns(const Model& m, Ref<MachiningTool> tool, Job& job) {
  model::ToolRequirement r;
  if (!tool.set()) return r;
  const auto p = tool_parts(m, tool);
  if (!p) return fail(p.error());
  const auto k = tool_kind(m, *p, job);
  if (!k) return fail(k.error());
  const double d = *p->dimension->diameter;
  if (!(d > 0.0) || !std::isfinite(d))
    return fail({.code = "TOOL-VALUE",
                 .message = "the diameter is " + trimmed(d, 6) + " mm",
                 .path = p->name,
                 .expected = "a diameter above 0"});
  r.classes = {k->cutter_class};
  r.point_angle_rad = k->point_angle_rad;
  r.depth_of_cut_mm = p->dimension->cutting_edge_length.value_or(0.0);
  r.reach_mm = r.depth_of_cut_mm;
  const double re = p->dimension->edge_radius.value_or(0.0);
  if (model::has(k->cutter_class, model::CutterTrait::kSmallerDoes)) {
    r.diameter_max_mm = d;
    r.diameter_min_mm = 0.5 * d;
    if (model::has(k->cutter_class, model::CutterTrait::kBall) ||
        k->cutter_class == CutterClass::kBullnoseEndmill) {
      // Only this size makes this radius.
      r.corner_radius_exact_mm = model::has(k->cutter_class, model::CutterTrait::kBall) ? 0.5 * d : re;
      if (model::has(k->cutter_class, model::CutterTrait::kBall)) r.diameter_min_mm = d;
    } else {
      r.corner_radius_limited = true;
      r.corner_radius_max_mm = re;
    }
  } else {
    r.diameter_exact_mm = d;
    r.diameter_tolerance_mm = kSizeSlackMm;
  }
  r.left_hand = k->cutter_class == CutterClass::kTap && p->body->hand_of_cut.set() &&
                p->body->hand_of_cut.value() == model::Hand::kLeft;
  r.words = words_of(r);
  return r;
}

}  // namespace capstan::tooling
