#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/fields.h"
#include "planner/model/plan/plan_fields.h"
#include "planner/model/plan/resources/machine_fields.h"
#include "planner/model/plan/resources/material_fields.h"

/// @file The fields of the plan's plain structs, named once: the writer, the reader, the schema (and the test
/// that fills everything) visit them through these. Names wear their units. Optional members may be absent.

namespace capstan::json {

template <class T, class U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

/// A type with a table of fields is visited by it; a visitor that asks for more than names has `row`.
template <class V>
void fields(V& v, model::HasFields auto& x) {
  model::for_each_field(x, [&v](const auto& row, auto& value) {
    if constexpr (requires { v.row(row, value); }) {
      v.row(row, value);
    } else {
      v(row.name, value);
    }
  });
}
template <class V>
void fields(V& v, Is<std::pair<std::string, std::string>> auto& x) {
  v("of", x.first), v("source", x.second);
}
template <class V>
void fields(V& v, Is<model::Unplanned> auto& x) {
  v("feature", x.feature), v("reason", x.reason), v("needed_by", x.needed_by);
}
template <class V>
void fields(V& v, Is<model::Provenance> auto& x) {
  v("what", x.what), v("value", x.value), v("source", x.source);
}
template <class V>
void fields(V& v, Is<model::Reason> auto& x) {
  v("id", x.id), v("text", x.text), v("source", x.source);
}
template <class V>
void fields(V& v, Is<model::DecisionKey> auto& x) {
  v("object", x.object), v("attribute", x.attribute);
}
template <class V>
void fields(V& v, Is<model::Rejected> auto& x) {
  v("what", x.what), v("why", x.why);
}
template <class V>
void fields(V& v, Is<model::Decision> auto& x) {
  v("state", x.state), v("binder", x.binder), v("pinned", x.pinned), v("reason", x.reason),
      v("lexeme", x.lexeme);
  v("value_hash", x.value_hash), v("depends_on", x.depends_on), v("rejected", x.rejected);
}
template <class V>
void fields(V& v, Is<model::FeedSchedule> auto& x) {
  v("feed_mm_min", x.feed_mm_min), v("spindle_rpm", x.spindle_rpm), v("dwell_s", x.dwell_s);
}
template <class V>
void fields(V& v, Is<model::SectionSeries> auto& x) {
  v("move", x.move), v("at_mm", x.at_mm), v("ad_max_mm", x.ad_max_mm), v("rd_max_mm", x.rd_max_mm);
  v("x_max_ofs_mm", x.x_max_ofs_mm), v("y_max_ofs_mm", x.y_max_ofs_mm), v("csa_mm2", x.csa_mm2);
  v("x_cg_ofs_mm", x.x_cg_ofs_mm), v("y_cg_ofs_mm", x.y_cg_ofs_mm), v("removed_mm3", x.removed_mm3);
}
template <class V>
void fields(V& v, Is<model::CutterPath> auto& x) {
  v("x", x.x), v("y", x.y), v("z", x.z), v("cx", x.cx), v("cy", x.cy), v("kind", x.kind), v("role", x.role);
}
template <class V>
void fields(V& v, Is<geometry::Mesh> auto& x) {
  v("vertices", x.vertices), v("triangles", x.triangles);
}
/// Members of the plan that are neither objects, nor the ledger, nor shared columns.
template <class V>
void fields(V& v, Is<model::Plan> auto& x) {
  v("project", x.project), v("file_name", x.file_name), v("header_description", x.header_description);
  v("header_time_stamp", x.header_time_stamp), v("header_authors", x.header_authors);
  v("header_organizations", x.header_organizations), v("machine", x.machine), v("material", x.material);
  v("stock", x.stock), v("cutters", x.cutters), v("setups", x.setups), v("steps", x.steps);
  v("unplanned", x.unplanned), v("provenance", x.provenance), v("kept", x.kept);
}

/// The field that is written as sixteen hexadecimal digits.
inline constexpr std::string_view kHashField = "value_hash";

/// The spellings of an enumeration, in order of its codes.
template <class E>
[[nodiscard]] std::vector<std::string_view> spellings() {
  std::vector<std::string_view> out;
  if constexpr (std::is_same_v<E, model::CutterClass>) {
    for (int i = 0; i <= static_cast<int>(model::kLastCutterClass); ++i) {
      out.push_back(model::to_text(static_cast<model::CutterClass>(i)));
    }
  } else if constexpr (std::is_same_v<E, model::Substrate>) {
    out = {model::to_text(model::Substrate::kHss), model::to_text(model::Substrate::kCarbide)};
  } else if constexpr (std::is_same_v<E, model::Hand>) {
    out = {"left", "right", "neutral"};
  } else if constexpr (std::is_same_v<E, model::DecisionState>) {
    out = {"open", "bound"};
  } else {
    static_assert(std::is_same_v<E, model::Binder>);
    for (int i = 0; i <= static_cast<int>(model::Binder::kRecognition); ++i) {
      out.push_back(model::to_text(static_cast<model::Binder>(i)));
    }
  }
  return out;
}

/// Tells structs with `fields` from other types.
struct NoVisit {
  template <class T>
  void operator()(const char*, const T&) {}
};
template <class T>
concept Described = requires(NoVisit& v, T& x) {
  fields(v, x);
};

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;
template <class T>
inline constexpr bool kIsShared = false;
template <class T>
inline constexpr bool kIsShared<std::shared_ptr<const T>> = true;

/// Names of shared columns.
template <class T>
[[nodiscard]] constexpr std::string_view shared_name() {
  if constexpr (std::is_same_v<T, model::CutterPath>) return "path";
  if constexpr (std::is_same_v<T, model::SectionSeries>) return "sections";
  return "schedule";
}

}  // namespace capstan::json
