#include "tooling/library/library.h"

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/store/store.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling {
namespace {

using model::Cutter;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kLibraryBytesCap = std::size_t{256} << 20;

/// Reads one field when the file has it, and remembers where it is from.
class CutterFields {
 public:
  CutterFields(Fields& f, Cutter& c, double mm_per_unit) : f_(f), c_(c), mm_per_unit_(mm_per_unit) {}
  void length(const char* key, double& field) { number(key, field, mm_per_unit_); }
  void angle(const char* key, double& field) { number(key, field, kDegree); }
  void number(const char* key, double& field, double factor = 1.0) {
    const auto v = f_.optional_number(key);
    if (!v) return;
    field = *v * factor;
    state(key);
  }
  void state(const char* key) {
    c_.sources.emplace_back(key, "stated: " + (f_.source().empty() ? "the library file" : f_.source()));
  }

 private:
  Fields& f_;
  Cutter& c_;
  double mm_per_unit_;
};

void read_presets(Fields& f, Cutter& c, double mm_per_unit) {
  const Node* list = f.child("presets", false);
  if (list == nullptr) return;
  for (const Node& n : list->items) {
    Fields p = f.below("presets", n);
    model::CuttingPreset out;
    out.material_group = p.text("material");
    out.vc_m_min = p.number_or("vc_m_min", 0.0);
    out.fz_mm = p.number_or("fz", 0.0) * mm_per_unit;
    out.source = p.source().empty() ? "the library file" : p.source();
    if (out.vc_m_min < 0.0 || out.fz_mm < 0.0)
      p.fault("TOOL-VALUE", "a preset is negative", "material", p.line());
    p.finish();
    c.presets.push_back(std::move(out));
  }
}

void read_holder(Fields& f, Cutter& c, double mm_per_unit) {
  c.holder_id = f.text_or("holder_id", "");
  const Node* list = f.child("holder", false);
  if (list == nullptr) return;
  for (const Node& n : list->items) {
    Fields s = f.below("holder", n);
    c.holder.push_back({s.number("height") * mm_per_unit, s.number("lower_diameter") * mm_per_unit,
                        s.number("upper_diameter") * mm_per_unit});
    s.finish();
    const auto& last = c.holder.back();
    if (c.holder_diameter_mm < std::max(last.lower_diameter_mm, last.upper_diameter_mm))
      c.holder_diameter_mm = std::max(last.lower_diameter_mm, last.upper_diameter_mm);
  }
  c.sources.emplace_back("holder_diameter_mm", "derived: the widest of the holder's outline");
}

void read_names(Fields& f, Cutter& c) {
  c.id = f.text("id");
  c.description = f.text_or("description", c.id);
  const std::string cls = f.text("class"), substrate = f.text_or("substrate", "hss");
  const auto k = model::cutter_class_from_text(cls);
  if (!k) f.fault("DATA-UNKNOWN", "'" + cls + "' is no class of cutter", "class", f.line_of("class"));
  c.cutter_class = k.value_or(model::CutterClass::kEndmill);
  const auto s = model::substrate_from_text(substrate);
  if (!s)
    f.fault("DATA-UNKNOWN", "'" + substrate + "' is no substrate", "substrate", f.line_of("substrate"),
            "hss or carbide");
  c.substrate = s.value_or(model::Substrate::kHss);
  c.sources.emplace_back("substrate", f.has("substrate") ? std::string_view("stated") : kSubstrateUnstated);
  const std::string hand = f.text_or("hand", "right");
  if (hand != "right" && hand != "left")
    f.fault("DATA-UNKNOWN", "'" + hand + "' is no hand", "hand", f.line_of("hand"), "right or left");
  c.hand = hand == "left" ? model::Hand::kLeft : model::Hand::kRight;
}

Cutter read_cutter(Fields f, double mm_per_unit) {
  Cutter c;
  c.stated_in_inches = mm_per_unit != 1.0;
  read_names(f, c);
  CutterFields r(f, c, mm_per_unit);
  (void)f.child("cutting_diameter", true);
  r.length("cutting_diameter", c.cutting_diameter_mm);
  r.length("corner_radius", c.corner_radius_mm);
  r.length("tip_diameter", c.tip_diameter_mm);
  r.length("maximum_depth_of_cut", c.maximum_depth_of_cut_mm);
  r.length("usable_length", c.usable_length_mm);
  r.length("stick_out", c.stick_out_mm);
  r.length("functional_length", c.functional_length_mm);
  r.length("shank_diameter", c.shank_diameter_mm);
  r.length("holder_diameter", c.holder_diameter_mm);
  r.length("thread_pitch", c.thread_pitch_mm);
  r.length("adjustable_to", c.adjustable_to_mm);
  r.length("overall_length", c.overall_length_mm);
  r.length("neck_diameter", c.neck_diameter_mm);
  r.length("neck_length", c.neck_length_mm);
  r.length("cutting_width", c.cutting_width_mm);
  r.length("thread_size", c.thread_size_mm);
  r.length("lead_length", c.lead_length_mm);
  r.number("lead_threads", c.lead_threads);
  r.angle("taper_angle_deg", c.taper_angle_rad);
  r.number("life_used_min", c.life_used_min);
  r.length("fz_min", c.fz_min_mm);
  r.length("fz_max", c.fz_max_mm);
  r.angle("point_angle_deg", c.point_angle_rad);
  r.angle("helix_deg", c.helix_rad);
  r.angle("lead_angle_deg", c.lead_angle_rad);
  r.angle("maximum_ramp_angle_deg", c.maximum_ramp_angle_rad);
  r.number("maximum_speed_rpm", c.maximum_speed_rpm);
  r.number("life_min", c.life_min);
  r.number("price", c.price);
  if (const auto z = f.optional_integer("teeth")) {
    c.teeth = static_cast<int>(*z);
    r.state("teeth");
    if (*z == 0 && c.cutter_class != model::CutterClass::kTouchProbe)
      f.fault("TOOL-VALUE", "0 teeth", "teeth", f.line_of("teeth"));
  }
  if (const auto p = f.optional_integer("pocket")) c.pocket = static_cast<int>(*p);
  if (f.has("centre_cutting")) r.state("centre_cutting");
  c.centre_cutting = f.flag_or("centre_cutting", false);
  c.coolant_through = f.flag_or("coolant_through", false);
  c.thread_form = f.text_or("thread_form", "");
  c.product_id = f.text_or("product_id", "");
  c.carousel = f.text_or("carousel", "");
  c.loaded = f.flag_or("loaded", c.pocket > 0);
  if (const auto n = f.optional_integer("in_stock")) c.in_stock = static_cast<int>(*n);
  read_holder(f, c, mm_per_unit);
  read_presets(f, c, mm_per_unit);
  f.finish();
  return c;
}

Result<std::vector<Cutter>> finished(std::vector<Cutter> cutters, const std::vector<std::uint64_t>& lines,
                                     const std::string& file, std::vector<Diagnostic> faults, Job& job) {
  const auto& generic = shared_generic_library();
  if (!generic) return fail(generic.error());
  // What the file says is judged before what we add.
  for (std::size_t i = 0; i < cutters.size(); ++i) {
    if (cutters[i].cutting_diameter_mm > 0.0) complete(cutters[i], *generic);
  }
  // Values that could not be read need not be judged, too.
  if (faults.empty()) faults = check_cutters(cutters, file, lines);
  if (auto d = tell(std::move(faults), job)) return fail(std::move(*d));
  for (std::size_t i = 0; i < cutters.size(); ++i)
    if (const std::string odd = unlikely_of(cutters[i]); !odd.empty())
      job.report({.code = "TOOL-UNLIKELY",
                  .severity = Severity::kWarning,
                  .message = "'" + cutters[i].id + "': " + odd,
                  .file = file,
                  .line = i < lines.size() ? lines[i] : 0,
                  .hint = "look at the unit: millimetres read as inches are 25.4 times too large"});
  return cutters;
}

Result<std::vector<Cutter>> read_own(const Node& root, const std::string& file, Job& job) {
  std::vector<Diagnostic> faults;
  Fields top(root, file, "", "", faults);
  if (top.text("capstan_tools") != "1")
    top.fault("DATA-VERSION", "not a tool list of version 1", "capstan_tools", 1, "capstan_tools: 1");
  const std::string unit = top.text_or("unit", "");
  if (unit != "mm" && unit != "inch")
    top.fault("DATA-UNIT", unit.empty() ? "the unit is missing" : "the unit '" + unit + "' is not known",
              "unit", top.line_of("unit"), "mm or inch");
  std::vector<Cutter> cutters;
  std::vector<std::uint64_t> lines;
  if (const Node* list = top.child("tools", true)) {
    for (const Node& n : list->items) {
      cutters.push_back(read_cutter(top.below("tools", n), unit == "inch" ? kMmPerInch : 1.0));
      lines.push_back(n.line);
    }
  }
  top.finish();
  return finished(std::move(cutters), lines, file, std::move(faults), job);
}

}  // namespace

Result<std::vector<Cutter>> read_own_list(std::string_view text, const std::string& file, Job& job) {
  const auto root = parse_tree(text, file);
  if (!root) return fail(root.error());
  return read_own(*root, file, job);
}

bool looks_like_own_list(std::string_view text) {
  // The key stands at the beginning of a line, or in quotes where the list is JSON.
  for (auto at = text.find("capstan_tools"); at != std::string_view::npos;
       at = text.find("capstan_tools", at + 1)) {
    if (at == 0 || text[at - 1] == '\n' || text[at - 1] == '"' || text[at - 1] == '{' || text[at - 1] == ' ')
      return true;
  }
  return false;
}

Result<std::vector<Cutter>> read_library(std::string_view text, const std::string& file, Job& job,
                                         const LibraryOptions& options) {
  // Our own list names every field of a cutter: no way round by the records.
  if (own_format().recognises(text, file)) return read_own_list(text, file, job);
  if (looks_like_store(text)) {
    const auto store = ToolStore::from_bytes(std::string(text), file);
    if (!store) return fail(store.error());
    return store->all_cutters();
  }
  FormatOptions o;
  o.mm_per_unit = options.mm_per_unit;
  const auto imported = import_bytes(text, file, o, job);
  if (!imported) return fail(imported.error());
  LossReport report;
  return cutters_of(imported->library, report, job, options.offsets_against_reference);
}

Result<std::vector<Cutter>> load_library(const std::string& path, Job& job, const LibraryOptions& options) {
  if (path == "generic") return generic_library();
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) {
    const auto text = read_file(path, kLibraryBytesCap);
    if (!text && only_a_name(path)) {
      Diagnostic d = unknown_name("tool library", path, {"generic"}, "capstan tools list");
      d.hint = "a file or folder of tools, or 'generic', which `capstan tools list` shows";
      return fail(std::move(d));
    }
    if (!text) return fail(text.error());
    return read_library(*text, path, job, options);
  }
  FormatOptions o;
  o.mm_per_unit = options.mm_per_unit;
  const auto imported = import_library(path, o, job);
  if (!imported) return fail(imported.error());
  LossReport report;
  return cutters_of(imported->library, report, job, options.offsets_against_reference);
}

}  // namespace capstan::tooling
