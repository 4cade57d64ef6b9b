#include "tooling/library/cutters/generic.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/edges.h"
#include "tooling/shop/data/data.h"
#include "tooling/shop/data/tree.h"
#include "tooling/shop/material/iso_groups.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::WorkMaterial;

constexpr std::size_t kMostSizes = 1000;  // of one series

/// A number that depends on the size: linear with bounds, or a table of upper limits.
struct Law {
  double constant = 0.0, x_d = 0.0, x_flute = 0.0, x_pitch = 0.0;
  double least = 0.0, most = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, double>> up_to;
};
struct Given {
  double d = 0.0, flute = 0.0, pitch = 0.0;
};

/// Nothing past a table's end.
std::optional<double> value_of(const Law& law, const Given& g) {
  if (!law.up_to.empty()) {
    for (const auto& [limit, value] : law.up_to)
      if (g.d <= limit + 1e-9) return value;
    return std::nullopt;
  }
  const double v = law.constant + law.x_d * g.d + law.x_flute * g.flute + law.x_pitch * g.pitch;
  return rounded(std::clamp(v, law.least, law.most), 3);
}

std::vector<double> numbers_of(const Node& list) {
  std::vector<double> out;
  for (const Node& n : list.items)
    if (const auto v = parse_double(n.text)) out.push_back(*v);
  return out;
}

Law read_law(Fields& parent, std::string_view key) {
  Law law;
  const Node* n = parent.child(key, true);
  if (n == nullptr) return law;
  if (n->kind == Node::Kind::kScalar) {
    law.constant = parent.number(key);
    return law;
  }
  Fields f = parent.below(key, *n);
  if (const Node* table = f.child("up_to", false)) {
    for (const Node& row : table->items) {
      const std::vector<double> pair = numbers_of(row);
      if (pair.size() != 2 || (!law.up_to.empty() && pair[0] <= law.up_to.back().first)) {
        f.fault("DATA-TABLE", "rows of a table are [limit, value], limits rising", "up_to", row.line);
        break;
      }
      law.up_to.emplace_back(pair[0], pair[1]);
    }
  } else {
    law.constant = f.number_or("plus", 0.0);
    law.x_d = f.number_or("x_d", 0.0);
    law.x_flute = f.number_or("x_flute", 0.0);
    law.x_pitch = f.number_or("x_pitch", 0.0);
    law.least = f.number_or("min", 0.0);
    law.most = f.number_or("max", law.most);
  }
  f.finish();
  return law;
}

struct Feeds {
  double d_cap = 0.0, least = 0.0, most = 0.0;
  std::map<std::string, double> factor;
  std::string source;  ///< that of all feeds, where the entry has none of its own
};

struct Holding {
  Law clamped, holder;
  double gage_length = 0.0;
  double nut_height = 0.0, nut_ratio = 1.0;  ///< the nut's chamfered front
  std::string source;
};

/// One size of a series: the diameter, and what its row says beside it.
struct Size {
  double d = 0.0;
  const Node* row = nullptr;
};

struct Reader {
  const std::vector<WorkMaterial>& materials;
  std::vector<Diagnostic>& faults;
  Holding holding;
  std::map<std::string, Feeds> feeds;
  std::vector<Cutter> cutters;
  std::vector<std::uint64_t> lines;
  std::set<std::string> names;  ///< of the series so far
  Edges edges = {};
};

void read_holding(Fields top, Reader& r) {
  r.holding.clamped = read_law(top, "clamped_length");
  r.holding.holder = read_law(top, "holder_diameter");
  r.holding.gage_length = top.number("gage_length");
  r.holding.nut_height = top.number("nut_height");
  r.holding.nut_ratio = top.number("nut_ratio");
  r.holding.source = top.source();
  top.finish();
}

void read_feeds(const Node& node, Fields top, Reader& r) {
  const std::string of_all = top.source();
  for (const auto& [name, child] : node.entries) {
    if (name == "source") continue;
    (void)top.child(name, true);
    Fields f = top.below(name, child);
    Feeds& out = r.feeds[name];
    out.source = f.has("source") ? f.source() : of_all;
    out.d_cap = f.number("d_cap");
    out.least = f.number("least");
    out.most = f.number("most");
    for (const IsoGroup& g : kIsoGroups) out.factor[std::string(g.letter)] = f.number(g.letter);
    f.finish();
  }
}

void append_range(Fields f, std::vector<Size>& out) {
  const double from = f.number("from"), to = f.number("to"), step = f.number("step");
  f.finish();
  if (!(step > 0.0) || to < from || (to - from) / step > static_cast<double>(kMostSizes)) {
    f.fault("DATA-TABLE", "a range needs from <= to and a step", "", f.line());
    return;
  }
  const auto n = static_cast<std::size_t>(std::floor((to - from) / step + 1e-6));
  for (std::size_t i = 0; i <= n; ++i)
    out.push_back({rounded(from + static_cast<double>(i) * step, 4), nullptr});
}

std::vector<Size> read_sizes(Fields& f) {
  std::vector<Size> out;
  const Node* list = f.child("sizes", true);
  if (list == nullptr) return out;
  for (const Node& n : list->items) {
    if (n.kind == Node::Kind::kScalar) {
      const auto d = parse_double(n.text);
      if (!d) f.fault("DATA-NUMBER", no_number(n.text), "sizes", n.line);
      out.push_back({d.value_or(0.0), nullptr});
    } else if (n.find("from") != nullptr) {
      append_range(f.below("sizes", n), out);
    } else {
      out.push_back({parse_double(n.find("d") == nullptr ? "" : n.find("d")->text).value_or(0.0), &n});
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Size& a, const Size& b) { return a.d < b.d; });
  return out;
}

struct Series {
  Cutter base;
  std::string name, words, source, feeds;
  Law flute, shank;
  std::optional<Law> stick_out, overall, usable, holder, lead_length, cutting_width, neck_diameter,
      neck_length;
  double speed_factor = 1.0;
  std::string factor_source = "default";
  std::string edge;  ///< of Reader::edges; empty: bare
};

std::optional<Law> optional_law(Fields& f, std::string_view key) {
  if (f.has(key)) return read_law(f, key);
  (void)f.optional_number(key);
  return std::nullopt;
}

Series read_series(Fields& f) {
  Series s;
  s.name = f.text("name");
  s.words = f.text("words");
  s.source = f.source();
  const std::string cls = f.text("class"), substrate = f.text("substrate");
  const auto c = model::cutter_class_from_text(cls);
  const auto m = model::substrate_from_text(substrate);
  if (!c) f.fault("DATA-UNKNOWN", "'" + cls + "' is no class of cutter", "class", f.line_of("class"));
  if (!m) f.fault("DATA-UNKNOWN", "'" + substrate + "' is no substrate", "substrate", f.line_of("substrate"));
  s.base.cutter_class = c.value_or(CutterClass::kEndmill);
  s.base.substrate = m.value_or(model::Substrate::kHss);
  s.base.teeth = static_cast<int>(f.optional_integer("teeth").value_or(0));
  s.base.point_angle_rad = f.number_or("point_angle_deg", 0.0) * kRadPerDegree;
  s.base.helix_rad = f.number_or("helix_deg", 0.0) * kRadPerDegree;
  s.base.lead_angle_rad = f.number_or("lead_angle_deg", 0.0) * kRadPerDegree;
  s.base.maximum_ramp_angle_rad = f.number_or("max_ramp_deg", 0.0) * kRadPerDegree;
  s.base.taper_angle_rad = f.number_or("taper_deg", 0.0) * kRadPerDegree;
  s.base.thread_form = f.text_or("thread_form", "");
  s.base.lead_threads = f.number_or("lead_threads", 0.0);
  s.base.coolant_through = f.flag_or("coolant_through", false);
  if (f.flag_or("left_hand", false)) s.base.hand = model::Hand::kLeft;
  s.base.centre_cutting = f.flag_or("centre_cutting", false);
  s.flute = read_law(f, "flute_length");
  s.shank = read_law(f, "shank");
  s.stick_out = optional_law(f, "stick_out");
  s.overall = optional_law(f, "overall_length");
  s.usable = optional_law(f, "usable_length");
  s.holder = optional_law(f, "holder_diameter");
  s.lead_length = optional_law(f, "lead_length");
  s.cutting_width = optional_law(f, "cutting_width");
  s.neck_diameter = optional_law(f, "neck_diameter");
  s.neck_length = optional_law(f, "neck_length");
  // A probe neither turns nor cuts.
  const bool cuts = s.base.cutter_class != CutterClass::kTouchProbe;
  s.feeds = cuts ? f.text("feeds") : "";
  s.speed_factor = cuts ? f.number("speed_factor") : 1.0;
  if (const Node* n = cuts ? f.child("speed_factor", true) : nullptr; n != nullptr)
    if (const Node* source = n->find("source")) s.factor_source = source->text;
  s.edge = f.text_or("edge", "");
  if (!s.stick_out && !s.overall)
    f.fault("DATA-MISSING", "stick_out or overall_length is missing", "stick_out", f.line());
  return s;
}

void set_lengths(const Series& s, const Holding& h, Cutter& c, Fields& where, bool row_flute,
                 bool row_shank) {
  Given g{c.cutting_diameter_mm, c.maximum_depth_of_cut_mm, c.thread_pitch_mm};
  const auto law = [&](const Law& l, std::string_view key, double d) {
    Given at = g;
    at.d = d;
    const auto v = value_of(l, at);
    if (!v) where.fault("DATA-TABLE", "the table ends before " + trimmed(d, 4) + " mm", key, where.line());
    return v.value_or(0.0);
  };
  if (!row_flute) c.maximum_depth_of_cut_mm = law(s.flute, "flute_length", g.d);
  g.flute = c.maximum_depth_of_cut_mm;
  if (!row_shank) c.shank_diameter_mm = law(s.shank, "shank", g.d);
  c.stick_out_mm = s.stick_out ? law(*s.stick_out, "stick_out", g.d)
                               : law(*s.overall, "overall_length", g.d) -
                                     law(h.clamped, "clamped_length", c.shank_diameter_mm);
  // A shank as thick as the cutter may follow it into the work, up to near the chuck; a thicker one may not.
  constexpr double kClearOfChuckMm = 2.0;  // default, unsourced
  const bool neck_free = c.shank_diameter_mm <= c.cutting_diameter_mm;
  c.usable_length_mm = s.usable ? law(*s.usable, "usable_length", g.d)
                                : (neck_free ? c.stick_out_mm - kClearOfChuckMm : c.maximum_depth_of_cut_mm);
  c.holder_diameter_mm = s.holder ? law(*s.holder, "holder_diameter", g.d)
                                  : law(h.holder, "holder_diameter", c.shank_diameter_mm);
  c.functional_length_mm = h.gage_length + c.stick_out_mm;
  if (s.overall) c.overall_length_mm = law(*s.overall, "overall_length", g.d);
  if (s.lead_length) c.lead_length_mm = law(*s.lead_length, "lead_length", g.d);
  if (s.cutting_width && c.cutting_width_mm == 0.0)
    c.cutting_width_mm = law(*s.cutting_width, "cutting_width", g.d);
  if (s.neck_diameter && c.neck_diameter_mm == 0.0)
    c.neck_diameter_mm = law(*s.neck_diameter, "neck_diameter", g.d);
  if (s.neck_length && c.neck_length_mm == 0.0) c.neck_length_mm = law(*s.neck_length, "neck_length", g.d);
  c.holder_id = "generic/chuck/" + trimmed(c.holder_diameter_mm, 3);
  const double nut = std::min(h.nut_height, h.gage_length);
  c.holder = {{nut, rounded(h.nut_ratio * c.holder_diameter_mm, 3), c.holder_diameter_mm},
              {h.gage_length - nut, c.holder_diameter_mm, c.holder_diameter_mm}};
}

constexpr const char* kSlowestOfGroup = "vc: the slowest shipped material of the group";

/// What the start values of a series have in common, whatever the size.
struct SeriesPreset {
  SharedText of;          ///< a material's id, or the letter of a group
  std::size_t group = 0;  ///< of ISO 513, by its place in `Feeds::factor`
  double vc_m_min = 0.0;
  SharedText source;
};

std::vector<SeriesPreset> presets_of(const Series& s, const Reader& r) {
  std::vector<SeriesPreset> out;
  const auto feeds = r.feeds.find(s.feeds);
  if (feeds == r.feeds.end()) return out;
  const std::string& fz_source = feeds->second.source;
  const auto& factor = feeds->second.factor;
  const auto place_of = [&](const std::string& group) {
    return static_cast<std::size_t>(std::distance(factor.begin(), factor.find(group)));
  };
  const bool hss = s.base.substrate == model::Substrate::kHss;
  const auto edge = r.edges.find(s.edge);
  const auto over_bare = [&](const std::string& group) {
    return edge == r.edges.end() ? 1.0 : edge->second.over_bare.at(group);
  };
  const auto by_edge = [&](double times) {
    return trimmed(times, 3) + " " + std::string(kCoated) + ": " + edge->second.source + ")";
  };
  std::map<std::string, double> slowest;
  std::map<std::string_view, std::pair<double, SharedText>> of_group;  // faster than a bare edge, and why
  out.reserve(r.materials.size() + kIsoGroups.size());
  for (const WorkMaterial& m : r.materials) {
    const double bare = hss ? m.vc_hss_m_min : m.vc_carbide_m_min;
    if (!(bare > 0.0)) continue;  // no tool of this substrate is to cut it
    const auto [group, unknown] = of_group.try_emplace(m.iso_group);
    auto& [faster, source] = group->second;
    if (unknown) {
      faster = over_bare(m.iso_group);
      std::string times =
          s.speed_factor == 1.0 ? "" : trimmed(s.speed_factor, 3) + " (" + s.factor_source + ") x ";
      if (faster != 1.0) times += by_edge(faster) + " x ";
      source = "vc: " + times + std::string(kMaterialsSpeed) + "; fz: " + fz_source;
    }
    const double vc = rounded(bare * s.speed_factor * faster, 3);
    out.push_back({m.id, place_of(m.iso_group), vc, source});
    const auto [at, fresh] = slowest.emplace(m.iso_group, vc);
    if (!fresh) at->second = std::min(at->second, vc);
  }
  for (const IsoGroup& g : kIsoGroups) {
    const std::string group(g.letter);
    const auto vc = slowest.find(group);
    if (vc == slowest.end()) continue;
    const double faster = over_bare(group);
    const std::string times = faster == 1.0 ? "" : ", " + by_edge(faster);
    out.push_back({group, place_of(group), vc->second, kSlowestOfGroup + times + "; fz: " + fz_source});
  }
  return out;
}

void set_presets(const Series& s, const std::vector<SeriesPreset>& presets, const Reader& r, Cutter& c) {
  const auto it = r.feeds.find(s.feeds);
  if (it == r.feeds.end()) return;
  const Feeds& feeds = it->second;
  const double d = std::min(c.cutting_diameter_mm, feeds.d_cap);
  c.fz_min_mm = rounded(feeds.least * d, 5);
  c.fz_max_mm = rounded(feeds.most * d, 5);
  const bool tap = c.cutter_class == CutterClass::kTap;
  // A tap advances by its pitch in a turn, whatever is cut.
  if (tap) c.fz_min_mm = c.fz_max_mm = c.thread_pitch_mm / c.teeth;
  std::vector<double> fz_mm;
  for (const auto& [of, factor] : feeds.factor) fz_mm.push_back(tap ? c.fz_min_mm : rounded(factor * d, 5));
  c.presets.reserve(presets.size());
  for (const SeriesPreset& p : presets) c.presets.push_back({p.of, p.vc_m_min, fz_mm.at(p.group), p.source});
}

void set_sources(const Series& s, const Reader& r, Cutter& c) {
  c.sources.emplace_back("*", s.source);
  for (const char* field : {"stick_out_mm", "holder_diameter_mm", "holder", "functional_length_mm"})
    c.sources.emplace_back(field, r.holding.source);
  if (const auto feeds = r.feeds.find(s.feeds); feeds != r.feeds.end())
    for (const char* field : {"fz_min_mm", "fz_max_mm"}) c.sources.emplace_back(field, feeds->second.source);
}

void add_cutter(const Series& s, const std::vector<SeriesPreset>& presets, const Size& size, Fields& f,
                Reader& r) {
  poll();
  Cutter c = s.base;
  c.cutting_diameter_mm = size.d;
  bool row_flute = false, row_shank = false;
  std::string label = trimmed(size.d, 3), extra;
  if (size.row != nullptr) {
    Fields row = f.below("sizes", *size.row);
    (void)row.number("d");
    c.corner_radius_mm = row.number_or("corner_radius", 0.0);
    c.tip_diameter_mm = row.number_or("tip_diameter", 0.0);
    c.thread_pitch_mm = row.number_or("thread_pitch", 0.0);
    c.thread_size_mm = row.number_or("thread_size", 0.0);
    c.cutting_width_mm = row.number_or("cutting_width", 0.0);
    c.neck_diameter_mm = row.number_or("neck", 0.0);
    if (row.has("taper_deg")) c.taper_angle_rad = row.number("taper_deg") * kRadPerDegree;
    c.adjustable_to_mm = row.number_or("adjustable_to", 0.0);
    if (const auto z = row.optional_integer("teeth")) c.teeth = static_cast<int>(*z);
    row_flute = row.has("flute_length");
    row_shank = row.has("shank");
    c.maximum_depth_of_cut_mm = row.number_or("flute_length", 0.0);
    c.shank_diameter_mm = row.number_or("shank", 0.0);
    if (row.has("name")) label = row.text("name");
    row.finish();
    if (c.corner_radius_mm > 0.0) label += "r" + trimmed(c.corner_radius_mm, 3);
    if (c.corner_radius_mm > 0.0) extra = ", corner " + trimmed(c.corner_radius_mm, 3) + " mm";
    if (c.adjustable_to_mm > 0.0) extra = " to " + trimmed(c.adjustable_to_mm, 3) + " mm";
  }
  if (c.cutter_class == CutterClass::kTap) c.thread_size_mm = c.cutting_diameter_mm;
  if (model::has(c.cutter_class, model::CutterTrait::kBall)) c.corner_radius_mm = 0.5 * c.cutting_diameter_mm;
  c.id = "generic/" + s.name + "/" + label;
  c.description = "generic " + trimmed(size.d, 3) + " mm " + s.words + extra;
  if (size.row != nullptr && size.row->find("name") != nullptr) c.description += ", " + label;
  set_lengths(s, r.holding, c, f, row_flute, row_shank);
  set_presets(s, presets, r, c);
  set_sources(s, r, c);
  r.cutters.push_back(std::move(c));
  r.lines.push_back(size.row != nullptr ? size.row->line : f.line());
}

void read_tables(Fields& top, Reader& r) {
  if (const Node* n = top.child("holding", true)) read_holding(top.below("holding", *n), r);
  if (const Node* n = top.child("edges", false)) r.edges = read_edges(*n, top.below("edges", *n));
  if (const Node* n = top.child("feeds", true)) read_feeds(*n, top.below("feeds", *n), r);
}

void read_list(Fields& top, Reader& r) {
  const Node* list = top.child("series", true);
  if (list == nullptr) return;
  for (const Node& n : list->items) {
    poll();
    Fields f = top.below("series", n);
    const Series s = read_series(f);
    if (!r.names.insert(s.name).second)
      f.fault("DATA-DUPLICATE", "there are two series '" + s.name + "'", "name", f.line_of("name"));
    if (!s.feeds.empty() && r.feeds.count(s.feeds) == 0)
      f.fault("DATA-UNKNOWN", "there is no feed table '" + s.feeds + "'", "feeds", f.line_of("feeds"));
    if (!s.edge.empty() && r.edges.count(s.edge) == 0)
      f.fault("DATA-UNKNOWN", "there is no edge '" + s.edge + "'", "edge", f.line_of("edge"));
    const std::vector<Size> sizes = read_sizes(f);
    f.finish();
    if (!r.faults.empty()) continue;
    const std::vector<SeriesPreset> presets = presets_of(s, r);
    for (const Size& size : sizes) add_cutter(s, presets, size, f, r);
  }
}

}  // namespace

Result<std::vector<Cutter>> expand_series(const std::vector<SeriesFile>& files,
                                          const std::vector<WorkMaterial>& materials, Job& job) {
  std::vector<Diagnostic> faults;
  Reader r{materials, faults, {}, {}, {}, {}, {}, {}};
  std::vector<Cutter> out;
  for (const SeriesFile& file : files) {
    Fields top(file.root, file.name, "", "", faults);
    if (top.text("capstan_cutter_series") != "1")
      top.fault("DATA-VERSION", "not a table of cutter series of version 1", "capstan_cutter_series", 1);
    if (&file == &files.front()) read_tables(top, r);
    read_list(top, r);
    top.finish();
    if (faults.empty()) faults = check_cutters(r.cutters, file.name, r.lines);
    std::move(r.cutters.begin(), r.cutters.end(), std::back_inserter(out));
    r.cutters.clear();
    r.lines.clear();
  }
  if (auto d = tell(std::move(faults), job)) return fail(std::move(*d));
  return out;
}

Result<std::vector<Cutter>> generic_library(Sizes sizes) {
  auto materials = shipped_materials();
  if (!materials) return fail(materials.error());
  std::vector<std::string> names{"cutters.yaml"};
  for (const std::string_view name : embedded_names())
    if (name.starts_with("series/") || (sizes == Sizes::kMetricAndInch && name.starts_with("inch/")))
      names.emplace_back(name);
  std::sort(names.begin() + 1, names.end());
  std::vector<SeriesFile> files;
  for (const std::string& name : names) {
    poll();
    auto root = shipped_tree(name);
    if (!root) return fail(root.error());
    files.push_back({name, std::move(*root)});
  }
  Job job;
  return expand_series(files, *materials, job);
}

namespace {

/// Whether a preset is one that add_start_values made for the material of that id.
bool by_the_card(const model::CuttingPreset& p, const std::string& id) {
  return p.material_group == id && p.source.starts_with("vc: ") &&
         p.source.find(kMaterialsSpeed) != std::string::npos;
}

}  // namespace

Status add_start_values(const WorkMaterial& own, std::vector<Cutter>& library) {
  const auto shipped = shipped_materials();
  if (!shipped) return fail(shipped.error());
  if (std::any_of(shipped->begin(), shipped->end(), [&](const auto& m) { return m.id == own.id; })) return {};
  // The slowest speed in the group, by substrate: a series' speed is a factor times a material's.
  double slowest[2] = {0.0, 0.0};
  for (const WorkMaterial& m : *shipped) {
    if (m.iso_group != own.iso_group) continue;
    const double bare[2] = {m.vc_hss_m_min, m.vc_carbide_m_min};
    for (int i = 0; i < 2; ++i)
      if (bare[i] > 0.0 && (slowest[i] == 0.0 || bare[i] < slowest[i])) slowest[i] = bare[i];
  }
  for (Cutter& c : library) {
    const int i = c.substrate == model::Substrate::kHss ? 0 : 1;
    const double bare = i == 0 ? own.vc_hss_m_min : own.vc_carbide_m_min;
    const auto before = std::find_if(c.presets.begin(), c.presets.end(),
                                     [&](const auto& p) { return by_the_card(p, own.id); });
    const auto of_group = std::find_if(c.presets.begin(), c.presets.end(), [&](const auto& p) {
      return p.material_group == own.iso_group && p.source.starts_with(kSlowestOfGroup);
    });
    if (!(bare > 0.0) || !(slowest[i] > 0.0) || of_group == c.presets.end()) {
      if (before != c.presets.end()) c.presets.erase(before);
      continue;
    }
    model::CuttingPreset p = *of_group;
    p.material_group = own.id;
    const double factor = rounded(p.vc_m_min / slowest[i], 6);
    p.vc_m_min = rounded(factor * bare, 3);
    p.source = "vc: " + trimmed(factor, 3) + " x " + std::string(kMaterialsSpeed) +
               p.source.text().substr(std::string_view(kSlowestOfGroup).size());
    if (before != c.presets.end()) {
      *before = std::move(p);
    } else {
      c.presets.insert(c.presets.begin(), std::move(p));
    }
  }
  return {};
}

const Result<std::vector<Cutter>>& shared_generic_library() {
  static const Result<std::vector<Cutter>> kLibrary = generic_library();
  return kLibrary;
}

}  // namespace capstan::tooling
