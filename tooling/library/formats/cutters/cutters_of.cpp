#include <algorithm>
#include <array>
#include <map>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/cutters/symbols.h"
#include "tooling/library/formats/format.h"
#include "tooling/library/formats/table_line.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/words/comment_words.h"
#include "tooling/shop/material/iso_groups.h"
#include "tooling/shop/material/material.h"

// Records to cutters.

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

/// Group name that makers use for materials in no group of ISO 513.
constexpr const char* kOtherGroup = "O";

void set_source(Cutter& c, std::string_view field, std::string text) {
  std::erase_if(c.sources, [field](const auto& s) { return s.first == field; });
  c.sources.emplace_back(field, std::move(text));
}

/// Presets, with the material's name resolved once per name.
class Presets {
 public:
  explicit Presets(const std::vector<model::WorkMaterial>& materials) : materials_(materials) {}

  void take(const CatalogueItem& item, Cutter& c) {
    const double turn_mm = std::numbers::pi * c.cutting_diameter_mm;
    const int teeth = std::max(c.teeth, 1);
    for (const Preset& p : item.presets) {
      model::CuttingPreset out;
      out.material_group = group_of(p.material.empty() ? p.name : p.material);
      out.source = p.source.empty() ? "the library's preset '" + p.name + "'" : p.source;
      if (p.vc_m_min) {
        out.vc_m_min = *p.vc_m_min;
      } else if (p.rpm) {
        out.vc_m_min = *p.rpm * turn_mm / 1000.0;
      }
      const auto per_minute = [&](double feed) {
        return p.rpm && *p.rpm > 0.0 ? feed / *p.rpm / teeth : 0.0;
      };
      const bool drills = model::has(c.cutter_class, model::CutterTrait::kAlongAxis);
      if (!drills && p.fz_mm) {
        out.fz_mm = *p.fz_mm;
      } else if (!drills && p.feed_mm_min) {
        out.fz_mm = per_minute(*p.feed_mm_min);
      } else if (p.feed_per_revolution_mm) {
        out.fz_mm = *p.feed_per_revolution_mm / teeth;
      } else if (p.plunge_mm_min) {
        out.fz_mm = per_minute(*p.plunge_mm_min);
      } else if (p.fz_mm) {
        out.fz_mm = *p.fz_mm;
      }
      if (out.vc_m_min > 0.0 || out.fz_mm > 0.0) c.presets.push_back(std::move(out));
    }
  }

 private:
  /// A group letter or a material's id where the name is known, the name itself otherwise.
  const std::string& group_of(const std::string& name) {
    const auto [at, fresh] = known_.emplace(name, name);
    if (!fresh || name.empty() || name == kOtherGroup || is_iso_group(name)) return at->second;
    Job quiet;
    const auto found = find_material(name, materials_, quiet);
    if (!found) return at->second;
    bool family = false;
    for (const Diagnostic& d : quiet.diagnostics()) family = family || d.code == "MATERIAL-FAMILY";
    at->second = family ? found->iso_group : found->id;
    return at->second;
  }

  const std::vector<model::WorkMaterial>& materials_;
  std::map<std::string, std::string> known_;
};

/// Everything of a library about one tool.
struct Together {
  const CatalogueItem* item = nullptr;
  const ToolAssembly* assembly = nullptr;
  const Holder* holder = nullptr;
  const MachineEntry* entry = nullptr;
  std::vector<const ToolInstance*> instances;
};

class Maker {
 public:
  Maker(const ToolLibrary& library, LossReport& report, Job& job, std::optional<bool> against_reference)
      : l_(library), report_(report), job_(job), lines_(library, against_reference) {}

  Result<std::vector<Cutter>> all() {
    const auto& generic = shared_generic_library();
    if (!generic) return fail(generic.error());
    const auto materials = shipped_materials();
    if (!materials) return fail(materials.error());
    Presets presets(*materials);
    index();
    std::vector<Cutter> out;
    std::map<std::string, int> ids;
    std::map<int, std::string> numbers;
    for (const Together& t : tools()) {
      auto c = cutter(t, *generic, presets);
      if (!c) continue;
      if (const int n = ++ids[c->id]; n > 1) c->id += " (" + std::to_string(n) + ")";
      if (c->pocket > 0 && !numbers.emplace(c->pocket, c->id).second) {
        report_.derived.push_back({c->id, "pocket",
                                   "tool number " + std::to_string(c->pocket) + " is that of '" +
                                       numbers[c->pocket] + "', another is given when it is loaded"});
        c->pocket = 0;
        c->loaded = false;
      }
      out.push_back(*std::move(c));
    }
    say();
    return out;
  }

 private:
  void index() {
    for (const auto& i : l_.items) items_.emplace(i.id, &i);
    for (const auto& h : l_.holders) holders_.emplace(h.id, &h);
    for (const auto& e : l_.entries)
      if (!e.assembly.empty()) entries_.emplace(e.assembly, &e);
    for (const auto& i : l_.instances) instances_[i.item].push_back(&i);
  }

  std::vector<Together> tools() const {
    std::vector<Together> out;
    std::map<std::string, bool> assembled;
    for (const auto& a : l_.assemblies) {
      const auto item = items_.find(a.item);
      if (item == items_.end()) continue;
      assembled[a.item] = true;
      Together t;
      t.item = item->second;
      t.assembly = &a;
      if (const auto h = holders_.find(a.holder); h != holders_.end()) t.holder = h->second;
      if (const auto e = entries_.find(a.id); e != entries_.end()) t.entry = e->second;
      add_instances(t);
      out.push_back(std::move(t));
    }
    for (const auto& i : l_.items) {
      if (assembled.contains(i.id)) continue;
      Together t;
      t.item = &i;
      add_instances(t);
      out.push_back(std::move(t));
    }
    return out;
  }
  /// The piece of the assembly first.
  void add_instances(Together& t) const {
    const auto at = instances_.find(t.item->id);
    if (at == instances_.end()) return;
    t.instances = at->second;
    if (t.assembly == nullptr || t.assembly->instance.empty()) return;
    std::stable_partition(t.instances.begin(), t.instances.end(),
                          [&t](const ToolInstance* i) { return i->id == t.assembly->instance; });
  }

  std::optional<Cutter> cutter(const Together& t, const std::vector<Cutter>& generic, Presets& presets) {
    const CatalogueItem& item = *t.item;
    const std::string who = item.description.empty() ? item.id : item.description;
    if (!item.cutter_class) {
      const std::string* why = find_kept(item.kept, "left out");
      left_out(who, why != nullptr ? *why : "no cutter describes a '" + item.kind + "'");
      return std::nullopt;
    }
    Cutter c;
    c.id = t.assembly != nullptr ? t.assembly->id : item.id;
    c.description = item.description;
    c.cutter_class = *item.cutter_class;
    c.product_id = item.product_id;
    c.stated_in_inches = item.inches;
    for (const Property& p : item.properties)
      if (p.symbol == "CLASS") c.sources.emplace_back("cutter_class", words_of(p));
    numbers(item, c);
    texts(item, c);
    together(t, c);
    pieces(t, c);
    size_of_tap(item, c);
    if (c.cutting_diameter_mm <= 0.0) {
      left_out(who, "it has no cutting diameter");
      return std::nullopt;
    }
    const std::size_t before = c.sources.size();
    words(item, c);
    presets.take(item, c);
    const bool own_presets = !c.presets.empty();
    complete(c, generic);
    pointed(item, c);
    if (own_presets) widen_feeds(c);
    if (t.entry != nullptr) lines_.give(*t.entry, item.inches ? kMmPerInch : 1.0, c, job_);
    for (std::size_t k = before; k < c.sources.size(); ++k)
      report_.derived.push_back({c.id, c.sources[k].first, c.sources[k].second});
    if (const auto faults = faults_of(c); !faults.empty()) {
      left_out(who, faults.front());
      return std::nullopt;
    }
    if (const std::string odd = unlikely_of(c); !odd.empty())
      job_.report({.code = "TOOL-UNLIKELY",
                   .severity = Severity::kWarning,
                   .message = "'" + who + "': " + odd,
                   .file = l_.source,
                   .hint = "look at the unit: millimetres read as inches are 25.4 times too large"});
    return c;
  }

  static void numbers(const CatalogueItem& item, Cutter& c) {
    // Of a bare tool, LF runs from the tip to its shank's end at most: no length in a holder.
    const auto lf = number_of(item, "LF"), oal = number_of(item, "OAL");
    const bool bare = lf && oal && *lf <= *oal + 1e-9;
    for (const SymbolRow& f : kCutterSymbols) {
      const Property* p = find(item.properties, f.symbol);
      if (p == nullptr || !p->number || *p->number == 0.0 || c.*f.field != 0.0) continue;
      if (bare && std::string_view(f.symbol) == "LF") continue;
      c.*f.field = *p->number;
      c.sources.emplace_back(f.name, words_of(*p));
    }
    for (const char* symbol : {"ZEFF", "PCEDC"}) {
      const Property* p = find(item.properties, symbol);
      if (p == nullptr || !p->number || *p->number < 1.0 || c.teeth != 0) continue;
      c.teeth = static_cast<int>(*p->number);
      c.sources.emplace_back("teeth", words_of(*p));
    }
    // One pitch is meant when the range has no width.
    if (const auto least = number_of(item, "TPN"), most = number_of(item, "TPX");
        c.thread_pitch_mm == 0.0 && least && least == most && *least > 0.0) {
      c.thread_pitch_mm = *least;
      c.sources.emplace_back("thread_pitch_mm", "derived: TPN = TPX");
    }
    if (const auto kapr = number_of(item, "KAPR"); kapr && c.lead_angle_rad == 0.0 &&
                                                   c.cutter_class == CutterClass::kFacemill && *kapr > 0.0 &&
                                                   *kapr < 0.5 * std::numbers::pi) {
      c.lead_angle_rad = 0.5 * std::numbers::pi - *kapr;
      c.sources.emplace_back("lead_angle_rad", "derived: 90 degrees - KAPR");
    }
  }

  /// A tap is as wide as its thread: where no number says so, its names may ("M6").
  static void size_of_tap(const CatalogueItem& item, Cutter& c) {
    if (c.cutter_class != CutterClass::kTap || c.cutting_diameter_mm > 0.0) return;
    for (const std::string* text : {&item.description, &item.id, &item.kind}) {
      const double size = thread_size_of_words(*text);
      if (!(size > 0.0)) continue;
      c.cutting_diameter_mm = size;
      set_source(c, "cutting_diameter_mm", "derived: from the words '" + *text + "'");
      return;
    }
  }
  /// Takes sizes that the numbers leave open from the tool's names.
  static void words(const CatalogueItem& item, Cutter& c) {
    for (const std::string* text : {&item.description, &item.id, &item.kind}) {
      const CommentSizes s =
          sizes_of_words(*text, c.cutter_class, c.cutting_diameter_mm, item.inches ? kMmPerInch : 1.0);
      const auto take = [&](double& field, double value, const char* name) {
        if (field != 0.0 || value <= 0.0) return;
        field = value;
        set_source(c, name, "derived: from the words '" + *text + "'");
      };
      take(c.thread_pitch_mm, s.pitch_mm, "thread_pitch_mm");
      take(c.corner_radius_mm, s.corner_radius_mm, "corner_radius_mm");
      take(c.point_angle_rad, s.point_angle_rad, "point_angle_rad");
      take(c.tip_diameter_mm, s.tip_mm, "tip_diameter_mm");
    }
  }
  /// A V-bit comes to a point; the flat of a chamfer mill is not assumed of it.
  static void pointed(const CatalogueItem& item, Cutter& c) {
    const std::string* source = source_of(c, "tip_diameter_mm");
    if (source == nullptr || !source->starts_with("default")) return;
    for (const std::string* text : {&item.description, &item.id, &item.kind}) {
      if (!sizes_of_words(*text, c.cutter_class, c.cutting_diameter_mm).pointed) continue;
      c.tip_diameter_mm = 0.0;
      set_source(c, "tip_diameter_mm", "derived: a V-bit comes to a point");
      return;
    }
  }

  static void texts(const CatalogueItem& item, Cutter& c) {
    const auto text = [&item](std::string_view symbol) -> const Property* {
      return find(item.properties, symbol);
    };
    std::string substrate(kSubstrateUnstated);
    c.substrate = model::Substrate::kHss;
    for (const char* symbol : {"SUBSTRATE", "BMC"}) {
      const Property* p = text(symbol);
      if (p == nullptr) continue;
      const std::string t = lower_text(p->text);
      const bool hard = t.find("carbide") != std::string::npos || t == "hm" || t == "vhm" || t == "hw" ||
                        t == "hc" || t.find("hartmetall") != std::string::npos;
      const bool steel = t.find("hss") != std::string::npos || t.find("speed steel") != std::string::npos;
      if (!hard && !steel) continue;
      c.substrate = hard ? model::Substrate::kCarbide : model::Substrate::kHss;
      substrate = words_of(*p);
      if (steel && !hard && t != "hss") substrate += ", " + p->text;  // "HSS-E": its grade
      break;
    }
    // A coating belongs to the edge's grade: `grade_of` reads it here.
    if (const Property* p = text("COATING"); p != nullptr && substrate != kSubstrateUnstated) {
      const std::string t = lower_text(p->text);
      if (!t.empty() && t != "none" && t != "no" && t != "-") substrate += ", coating " + p->text;
    }
    c.sources.emplace_back("substrate", substrate);
    if (const auto* p = text("HAND"))
      c.hand = p->text == "left" || p->text == "L" ? model::Hand::kLeft : model::Hand::kRight;
    if (const auto* p = text("CCC")) {
      c.centre_cutting = yes(p->text);
      c.sources.emplace_back("centre_cutting", words_of(*p));
    }
    if (const auto* p = text("CSP")) c.coolant_through = yes(p->text);
    if (const auto* p = text("THFT")) c.thread_form = p->text;
    if (const auto life = number_of(item, "LIFE")) c.life_min = *life;
    if (const auto price = number_of(item, "PRICE")) c.price = *price;
    if (const auto* p = text("PLIB")) c.library_reference = p->text;
    if (const auto* p = text("PLIBSOURCE")) c.library_source = p->text;
  }

  static void together(const Together& t, Cutter& c) {
    const auto put = [&c](double& field, const char* name, const std::optional<double>& v, const char* why) {
      if (!v || *v <= 0.0) return;
      field = *v;
      set_source(c, name, why);
    };
    if (t.assembly != nullptr) {
      put(c.stick_out_mm, "stick_out_mm", t.assembly->stick_out_mm, "stated: the assembly's stick-out");
      put(c.functional_length_mm, "functional_length_mm", t.assembly->functional_length_mm,
          "stated: the assembly's length");
    }
    if (t.holder != nullptr) {
      c.holder_id = t.holder->id;
      c.holder = t.holder->segments;
      double widest = 0.0;
      for (const auto& s : c.holder) widest = std::max({widest, s.lower_diameter_mm, s.upper_diameter_mm});
      if (widest > 0.0) {
        c.holder_diameter_mm = widest;
        set_source(c, "holder_diameter_mm", "derived: the widest of the holder's outline");
      }
    }
    if (t.entry != nullptr) {
      c.pocket = std::max(0, t.entry->number);
      c.carousel = t.entry->carousel;
      c.loaded = t.entry->pocket.has_value() && c.pocket > 0;
    }
  }

  static void pieces(const Together& t, Cutter& c) {
    for (std::size_t k = 0; k < t.instances.size(); ++k) {
      const ToolInstance& i = *t.instances[k];
      if (k == 0) {
        if (i.in_stock) c.in_stock = *i.in_stock;
        if (i.price) c.price = *i.price;
        if (i.life_min) c.life_min = *i.life_min;
        if (i.life_used_min) c.life_used_min = *i.life_used_min;
        measured(i, c);
      } else if (!i.group.empty() && i.group == t.instances.front()->group) {
        c.sisters.push_back({i.id, 0, i.life_min.value_or(c.life_min) - i.life_used_min.value_or(0.0)});
      }
    }
  }
  static void measured(const ToolInstance& i, Cutter& c) {
    for (const SymbolRow& f : kCutterSymbols) {
      const Property* p = find(i.measured, f.symbol);
      if (p == nullptr || !p->number || *p->number == 0.0) continue;
      c.*f.field = *p->number;
      set_source(c, f.name, "stated: measured" + (p->source.empty() ? "" : ", " + p->source));
    }
  }

  /// A least feed that we assume gives way to what the library's presets say; a largest one does by material
  /// (model::preset_feeds).
  static void widen_feeds(Cutter& c) {
    const std::string* least = source_of(c, "fz_min_mm");
    const bool lower = least != nullptr && least->starts_with("default");
    for (const auto& p : c.presets) {
      if (p.fz_mm <= 0.0) continue;
      if (lower && p.fz_mm < c.fz_min_mm) {
        c.fz_min_mm = p.fz_mm;
        set_source(c, "fz_min_mm", "derived: the least of the library's presets");
      }
    }
  }

  void left_out(const std::string& who, const std::string& why) {
    report_.dropped.push_back({who, "", "not used for planning: " + why});
    left_.emplace_back(who, why);
  }
  /// One line for people; the report has them all.
  void say() {
    for (std::size_t k = 0; k < left_.size() && k < kEntriesShown; ++k)
      job_.report({.code = "TOOL-LEFT-OUT",
                   .severity = Severity::kWarning,
                   .message = "'" + left_[k].first + "' is not used: " + left_[k].second,
                   .file = l_.source});
    if (left_.size() > kEntriesShown)
      job_.report({.code = "TOOL-LEFT-OUT",
                   .severity = Severity::kWarning,
                   .message = std::to_string(left_.size() - kEntriesShown) + " more tools are not used",
                   .file = l_.source,
                   .hint = "capstan tools import --report lists them"});
  }

  const ToolLibrary& l_;
  LossReport& report_;
  Job& job_;
  std::map<std::string, const CatalogueItem*> items_;
  std::map<std::string, const Holder*> holders_;
  std::map<std::string, const MachineEntry*> entries_;
  std::map<std::string, std::vector<const ToolInstance*>> instances_;
  std::vector<std::pair<std::string, std::string>> left_;
  TableLines lines_;
};

}  // namespace

Result<std::vector<Cutter>> cutters_of(const ToolLibrary& library, LossReport& report, Job& job,
                                       std::optional<bool> offsets_against_reference) {
  return Maker(library, report, job, offsets_against_reference).all();
}

}  // namespace capstan::tooling
