#include <algorithm>

#include "planner/ground/base/number.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/json.h"
#include "tooling/library/formats/own/own_list.h"
#include "tooling/library/formats/values.h"

// Our own list: what `read_own_list` reads, written from the cutters that a library makes.

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::Unit;

/// True for values that reading and `complete` fill in: they are found again when the list is read, and may
/// be better then. A default that the library itself holds (as the generic series do) is its own, and is
/// written.
bool by_default(const Cutter& c, std::string_view field) {
  constexpr std::string_view kFilledIn[] = {kAsGeneric, kNotStated, kRampUnstated, kSubstrateUnstated};
  return std::any_of(c.sources.begin(), c.sources.end(), [&](const auto& s) {
    return s.first == field && std::any_of(std::begin(kFilledIn), std::end(kFilledIn),
                                           [&](std::string_view how) { return s.second.starts_with(how); });
  });
}

/// Writes the list's text of each field; empty for values that are found again when the list is read.
class Writer {
 public:
  Writer(const Cutter& c, double mm_per_unit) : c_(c), mm_per_unit_(mm_per_unit) {}

  [[nodiscard]] std::string text() {
    std::vector<std::pair<int, std::string>> lines;
    model::for_each_field(c_, [&](const auto& row, const auto& v) {
      if (row.own_key == nullptr || (row.is_sourced && by_default(c_, row.name))) return;
      const std::string value = value_of(row, v);
      if (!value.empty())
        lines.emplace_back(row.own_place, "    " + std::string(row.own_key) + ":" + value + "\n");
    });
    std::stable_sort(lines.begin(), lines.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string out;
    for (const auto& line : lines) out += line.second;
    return out.replace(0, 4, "  - ");
  }

 private:
  [[nodiscard]] double factor(Unit unit) const {
    return unit == Unit::kLength ? mm_per_unit_ : unit == Unit::kAngle ? kRadPerDegree : 1.0;
  }
  template <class Row>
  std::string value_of(const Row& row, double v) const {
    if (v == 0.0 || (row.member == &Cutter::holder_diameter_mm && !c_.holder.empty())) return {};
    return " " + spelled(v, factor(row.unit));
  }
  template <class Row>
  std::string value_of(const Row& row, int v) const {
    return v > kUnsaid.*row.member ? " " + std::to_string(v) : std::string();
  }
  template <class Row>
  std::string value_of(const Row& row, bool v) const {
    const bool unsaid = row.member == &Cutter::loaded ? c_.pocket > 0 : kUnsaid.*row.member;
    if (v == unsaid && !row.is_sourced) return {};
    return v ? " true" : " false";
  }
  template <class Row>
  std::string value_of(const Row& row, const std::string& v) const {
    return v.empty() && row.member != &Cutter::id ? std::string() : " " + json_quoted(v);
  }
  template <class Row>
  std::string value_of(const Row&, model::CutterClass v) const {
    return " " + std::string(model::to_text(v));
  }
  template <class Row>
  std::string value_of(const Row&, model::Substrate v) const {
    return " " + std::string(model::to_text(v));
  }
  template <class Row>
  std::string value_of(const Row&, model::Hand v) const {
    return v == model::Hand::kLeft ? " left" : "";
  }
  template <class Row>
  std::string value_of(const Row&, const std::vector<model::HolderSegment>& holder) const {
    std::string out;
    for (const auto& segment : holder) {
      std::string item;
      model::for_each_field(segment, [&](const auto& row, double v) {
        item += (item.empty() ? "" : ", ") + std::string(row.own_key) + ": " + spelled(v, factor(row.unit));
      });
      out += "\n      - {" + item + "}";
    }
    return out;
  }
  template <class Row>
  std::string value_of(const Row&, const std::vector<model::CuttingPreset>& presets) const {
    std::string out;
    for (const auto& p : presets) {
      if (p.source.find("(as ") != std::string::npos || p.material_group.empty()) continue;  // completed
      out += "\n      - {material: " + json_quoted(p.material_group.text());
      if (p.vc_m_min > 0.0) out += ", vc_m_min: " + shortest(p.vc_m_min);
      if (p.fz_mm > 0.0) out += ", fz: " + spelled(p.fz_mm, mm_per_unit_);
      out += ", source: " + json_quoted(p.source.text()) + "}";
    }
    return out;
  }
  /// Fields without a key.
  template <class Row, class T>
  std::string value_of(const Row&, const T&) const {
    return {};
  }

  inline static const Cutter kUnsaid;
  const Cutter& c_;
  double mm_per_unit_;
};

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
  for (const Cutter& c : *cutters) out.bytes += Writer(c, inches ? kMmPerInch : 1.0).text();
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
