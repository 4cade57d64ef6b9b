#include <algorithm>

#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/own/own_list.h"
#include "tooling/shop/data/tree.h"

// Our own list, read by the table of a cutter's fields.

namespace capstan::tooling {
namespace {

using model::Cutter;

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

/// How the list states one tool. Class, substrate and hand are words of their own; every other field is read
/// by its key and kind.
class ToolReader {
 public:
  ToolReader(Fields f, double mm_per_unit) : f_(std::move(f)), mm_per_unit_(mm_per_unit) {
    c_.stated_in_inches = mm_per_unit != 1.0;
  }

  Cutter run() {
    (void)f_.child("cutting_diameter", true);
    model::for_each_field(c_, [&](const auto& row, auto& v) {
      if (row.own_key != nullptr) read(row, v);
    });
    f_.finish();
    return std::move(c_);
  }

 private:
  [[nodiscard]] double factor(model::Unit unit) const {
    return unit == model::Unit::kLength ? mm_per_unit_ : unit == model::Unit::kAngle ? kRadPerDegree : 1.0;
  }
  template <class Row>
  void state(const Row& row) {
    if (row.is_sourced)
      c_.sources.emplace_back(row.name,
                              "stated: " + (f_.source().empty() ? "the library file" : f_.source()));
  }

  template <class Row>
  void read(const Row& row, double& v) {
    const auto stated = f_.optional_number(row.own_key);
    if (!stated) return;
    v = *stated * factor(row.unit);
    state(row);
  }
  template <class Row>
  void read(const Row& row, int& v) {
    const auto stated = f_.optional_integer(row.own_key);
    if (!stated) return;
    v = static_cast<int>(*stated);
    state(row);
    if (row.member == &Cutter::teeth && v == 0 && c_.cutter_class != model::CutterClass::kTouchProbe)
      f_.fault("TOOL-VALUE", "0 teeth", row.own_key, f_.line_of(row.own_key));
  }
  template <class Row>
  void read(const Row& row, bool& v) {
    if (f_.has(row.own_key)) state(row);
    v = f_.flag_or(row.own_key, row.member == &Cutter::loaded ? c_.pocket > 0 : v);
  }
  template <class Row>
  void read(const Row& row, std::string& v) {
    v = row.member == &Cutter::id ? f_.text(row.own_key)
                                  : f_.text_or(row.own_key, row.member == &Cutter::description ? c_.id : v);
  }
  template <class Row>
  void read(const Row& row, model::CutterClass& v) {
    const std::string text = f_.text(row.own_key);
    const auto known = model::cutter_class_from_text(text);
    if (!known) unknown(row, "'" + text + "' is no class of cutter", {});
    v = known.value_or(model::CutterClass::kEndmill);
  }
  template <class Row>
  void read(const Row& row, model::Substrate& v) {
    const std::string text = f_.text_or(row.own_key, "hss");
    const auto known = model::substrate_from_text(text);
    if (!known) unknown(row, "'" + text + "' is no substrate", "hss or carbide");
    v = known.value_or(model::Substrate::kHss);
    c_.sources.emplace_back(row.name, f_.has(row.own_key) ? std::string_view("stated") : kSubstrateUnstated);
  }
  template <class Row>
  void read(const Row& row, model::Hand& v) {
    const std::string text = f_.text_or(row.own_key, "right");
    if (text != "right" && text != "left") unknown(row, "'" + text + "' is no hand", "right or left");
    v = text == "left" ? model::Hand::kLeft : model::Hand::kRight;
  }
  template <class Row>
  void read(const Row&, std::vector<model::CuttingPreset>&) {
    read_presets(f_, c_, mm_per_unit_);
  }
  template <class Row>
  void read(const Row& row, std::vector<model::HolderSegment>& v) {
    const Node* list = f_.child(row.own_key, false);
    if (list == nullptr) return;
    for (const Node& n : list->items) {
      Fields s = f_.below(row.own_key, n);
      model::for_each_field(v.emplace_back(), [&](const auto& of, double& size) {
        size = s.number(of.own_key) * factor(of.unit);
      });
      s.finish();
      c_.holder_diameter_mm =
          std::max({c_.holder_diameter_mm, v.back().lower_diameter_mm, v.back().upper_diameter_mm});
    }
    c_.sources.emplace_back("holder_diameter_mm", "derived: the widest of the holder's outline");
  }
  /// Fields without a key.
  template <class Row, class T>
  void read(const Row&, T&) {}

  template <class Row>
  void unknown(const Row& row, std::string message, std::string expected) {
    f_.fault("DATA-UNKNOWN", std::move(message), row.own_key, f_.line_of(row.own_key), std::move(expected));
  }

  Fields f_;
  Cutter c_;
  double mm_per_unit_;
};

Result<std::vector<Cutter>> finished(std::vector<Cutter> cutters, const std::vector<std::uint64_t>& lines,
                                     const std::string& file, std::vector<Diagnostic> faults, Job& job) {
  const auto& generic = shared_generic_library();
  if (!generic) return fail(generic.error());
  // The file's values are checked before missing ones are added.
  for (std::size_t i = 0; i < cutters.size(); ++i) {
    if (cutters[i].cutting_diameter_mm > 0.0) complete(cutters[i], *generic);
  }
  // Unreadable values need no further check.
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
      cutters.push_back(ToolReader(top.below("tools", n), unit == "inch" ? kMmPerInch : 1.0).run());
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
  // The key is at the beginning of a line, or in quotes if the list is JSON.
  for (auto at = text.find("capstan_tools"); at != std::string_view::npos;
       at = text.find("capstan_tools", at + 1)) {
    if (at == 0 || text[at - 1] == '\n' || text[at - 1] == '"' || text[at - 1] == '{' || text[at - 1] == ' ')
      return true;
  }
  return false;
}

}  // namespace capstan::tooling
