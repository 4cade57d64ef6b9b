#include <algorithm>

#include "planner/ground/base/number.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/json.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/library.h"

// Our own list: what `read_own_list` reads, written from the cutters that a library makes.

namespace capstan::tooling {
namespace {

using model::Cutter;

struct Field {
  const char* key;
  double Cutter::*field;
  char unit;  ///< 'L', 'D', '1'
  const char* source;
};
constexpr Field kFields[] = {
    {"cutting_diameter", &Cutter::cutting_diameter_mm, 'L', "cutting_diameter_mm"},
    {"adjustable_to", &Cutter::adjustable_to_mm, 'L', "adjustable_to_mm"},
    {"corner_radius", &Cutter::corner_radius_mm, 'L', "corner_radius_mm"},
    {"tip_diameter", &Cutter::tip_diameter_mm, 'L', "tip_diameter_mm"},
    {"maximum_depth_of_cut", &Cutter::maximum_depth_of_cut_mm, 'L', "maximum_depth_of_cut_mm"},
    {"usable_length", &Cutter::usable_length_mm, 'L', "usable_length_mm"},
    {"stick_out", &Cutter::stick_out_mm, 'L', "stick_out_mm"},
    {"functional_length", &Cutter::functional_length_mm, 'L', "functional_length_mm"},
    {"overall_length", &Cutter::overall_length_mm, 'L', "overall_length_mm"},
    {"shank_diameter", &Cutter::shank_diameter_mm, 'L', "shank_diameter_mm"},
    {"neck_diameter", &Cutter::neck_diameter_mm, 'L', "neck_diameter_mm"},
    {"neck_length", &Cutter::neck_length_mm, 'L', "neck_length_mm"},
    {"cutting_width", &Cutter::cutting_width_mm, 'L', "cutting_width_mm"},
    {"holder_diameter", &Cutter::holder_diameter_mm, 'L', "holder_diameter_mm"},
    {"thread_pitch", &Cutter::thread_pitch_mm, 'L', "thread_pitch_mm"},
    {"thread_size", &Cutter::thread_size_mm, 'L', "thread_size_mm"},
    {"lead_length", &Cutter::lead_length_mm, 'L', "lead_length_mm"},
    {"lead_threads", &Cutter::lead_threads, '1', "lead_threads"},
    {"fz_min", &Cutter::fz_min_mm, 'L', "fz_min_mm"},
    {"fz_max", &Cutter::fz_max_mm, 'L', "fz_max_mm"},
    {"point_angle_deg", &Cutter::point_angle_rad, 'D', "point_angle_rad"},
    {"helix_deg", &Cutter::helix_rad, 'D', "helix_rad"},
    {"lead_angle_deg", &Cutter::lead_angle_rad, 'D', "lead_angle_rad"},
    {"taper_angle_deg", &Cutter::taper_angle_rad, 'D', "taper_angle_rad"},
    {"maximum_ramp_angle_deg", &Cutter::maximum_ramp_angle_rad, 'D', "maximum_ramp_angle_rad"},
    {"maximum_speed_rpm", &Cutter::maximum_speed_rpm, '1', "maximum_speed_rpm"},
    {"life_min", &Cutter::life_min, '1', "life_min"},
    {"life_used_min", &Cutter::life_used_min, '1', "life_used_min"},
    {"price", &Cutter::price, '1', "price"},
};

/// What reading and `complete` fill in is found again when the list is read, and may be a better one then. A
/// value that the library itself holds by default (as the generic series do) is its own, and is written.
bool by_default(const Cutter& c, std::string_view field) {
  constexpr std::string_view kFilledIn[] = {kAsGeneric, kNotStated, kRampUnstated, kSubstrateUnstated};
  return std::any_of(c.sources.begin(), c.sources.end(), [&](const auto& s) {
    return s.first == field && std::any_of(std::begin(kFilledIn), std::end(kFilledIn),
                                           [&](std::string_view how) { return s.second.starts_with(how); });
  });
}

std::string tool_text(const Cutter& c, double mm_per_unit) {
  std::string out = "  - id: " + json_quoted(c.id) + "\n";
  const auto line = [&out](std::string_view key, const std::string& value) {
    out += "    " + std::string(key) + ": " + value + "\n";
  };
  if (!c.description.empty()) line("description", json_quoted(c.description));
  line("class", std::string(model::to_text(c.cutter_class)));
  if (!by_default(c, "substrate")) line("substrate", std::string(model::to_text(c.substrate)));
  for (const Field& f : kFields) {
    if (c.*f.field == 0.0 || by_default(c, f.source)) continue;
    if (std::string_view(f.key) == "holder_diameter" && !c.holder.empty()) continue;
    line(f.key, spelled(c.*f.field, f.unit == 'L' ? mm_per_unit : f.unit == 'D' ? kRadPerDegree : 1.0));
  }
  if (c.teeth > 0 && !by_default(c, "teeth")) line("teeth", std::to_string(c.teeth));
  if (!by_default(c, "centre_cutting")) line("centre_cutting", c.centre_cutting ? "true" : "false");
  if (c.coolant_through) line("coolant_through", "true");
  if (c.hand == model::Hand::kLeft) line("hand", "left");
  if (!c.thread_form.empty()) line("thread_form", json_quoted(c.thread_form));
  if (!c.product_id.empty()) line("product_id", json_quoted(c.product_id));
  if (c.pocket > 0) line("pocket", std::to_string(c.pocket));
  if (c.loaded != (c.pocket > 0)) line("loaded", c.loaded ? "true" : "false");
  if (!c.carousel.empty()) line("carousel", json_quoted(c.carousel));
  if (c.in_stock >= 0) line("in_stock", std::to_string(c.in_stock));
  if (!c.holder_id.empty()) line("holder_id", json_quoted(c.holder_id));
  if (!c.holder.empty()) {
    out += "    holder:\n";
    for (const auto& s : c.holder)
      out += "      - {height: " + spelled(s.height_mm, mm_per_unit) +
             ", lower_diameter: " + spelled(s.lower_diameter_mm, mm_per_unit) +
             ", upper_diameter: " + spelled(s.upper_diameter_mm, mm_per_unit) + "}\n";
  }
  std::string presets;
  for (const auto& p : c.presets) {
    if (p.source.find("(as ") != std::string::npos || p.material_group.empty()) continue;  // completed
    presets += "      - {material: " + json_quoted(p.material_group);
    if (p.vc_m_min > 0.0) presets += ", vc_m_min: " + shortest(p.vc_m_min);
    if (p.fz_mm > 0.0) presets += ", fz: " + spelled(p.fz_mm, mm_per_unit);
    presets += ", source: " + json_quoted(p.source) + "}\n";
  }
  if (!presets.empty()) out += "    presets:\n" + presets;
  return out;
}

bool recognises(std::string_view bytes, std::string_view) { return looks_like_own_list(bytes); }

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions&, Job& job) {
  const auto cutters = read_own_list(bytes, file, job);
  if (!cutters) return fail(cutters.error());
  Imported out;
  out.library = library_of(*cutters, file);
  out.library.source = file;
  out.report.tools = cutters->size();
  for (const Cutter& c : *cutters)
    for (const auto& [field, source] : c.sources)
      if (!source.starts_with("stated")) out.report.derived.push_back({c.id, field, source});
  return out;
}

Result<Exported> write(const ToolLibrary& library, const FormatOptions&, Job& job) {
  Exported out;
  LossReport making;
  const auto cutters = cutters_of(library, making, job);
  if (!cutters) return fail(cutters.error());
  out.report.dropped = std::move(making.dropped);
  const auto drop = [&out](const std::string& who, const std::string& field) {
    out.report.dropped.push_back({who, field, "our own list has no place for it"});
  };
  for (const auto& i : library.items) {
    for (const auto& [path, text] : i.kept) drop(i.id, path);
    for (const Property& p : i.properties)
      if (p.state == ValueState::kStated && symbol_fact(p.symbol) == nullptr) drop(i.id, p.symbol);
    if (!i.manufacturer.empty()) drop(i.id, "manufacturer");
    if (!i.product_link.empty()) drop(i.id, "product_link");
  }
  for (const auto& [path, text] : library.kept) drop("", path);
  bool inches = !cutters->empty();
  for (const Cutter& c : *cutters) inches = inches && c.stated_in_inches;
  out.bytes = std::string("capstan_tools: 1\nunit: ") + (inches ? "inch" : "mm") + "\ntools:\n";
  for (const Cutter& c : *cutters) out.bytes += tool_text(c, inches ? kMmPerInch : 1.0);
  if (cutters->empty()) out.bytes += "  []\n";
  out.report.tools = cutters->size();
  return out;
}

}  // namespace

const Format& own_format() {
  static const Format kFormat{
      "capstan", "Capstan's own list (YAML or JSON)", {".yaml", ".yml"}, &recognises, &read, &write};
  return kFormat;
}

}  // namespace capstan::tooling
