#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/files/exchange/records/records.h"
#include "planner/model/plan/fields.h"
#include "planner/model/plan/resources/workholding_fields.h"

// Records by the table of fields (planner/model/plan/fields.h): what has a table is described by it, piece by
// piece. A kind of value that records write in a way of their own has a `describe_value` beside its record.

namespace capstan::exchange {

/// Nothing comes before a piece's fields.
struct NothingBefore {
  void operator()(std::size_t) const {}
};

/// Describes every field that has a name in the record, each with `prefix` before it. `before(part)` is
/// called before the fields of a piece. Ends where a file of an earlier version does: what is left keeps its
/// value. Fails   throws MalformedRecord.
template <model::HasFields S, class Before = NothingBefore>
void describe_fields(RecordFields& f, S& x, const std::string& prefix = {}, const Before& before = {});

/// The same of one piece.
template <model::HasFields S, class Before = NothingBefore>
void describe_part(RecordFields& f, S& x, std::size_t part, const std::string& prefix = {},
                   const Before& before = {});

inline void describe_value(RecordFields& f, const std::string& name, model::Unit, std::string& v) {
  f.text(name, v);
}
inline void describe_value(RecordFields& f, const std::string& name, model::Unit, SharedText& v) {
  std::string text = v;
  f.text(name, text);
  if (v != text) v = std::move(text);
}
inline void describe_value(RecordFields& f, const std::string& name, model::Unit unit, double& v) {
  f.real(name, unit, v);
}
inline void describe_value(RecordFields& f, const std::string& name, model::Unit unit,
                           std::optional<double>& v) {
  f.optional_real(name, unit, v);
}
inline void describe_value(RecordFields& f, const std::string& name, model::Unit, int& v) {
  f.whole(name, v);
}
inline void describe_value(RecordFields& f, const std::string& name, model::Unit, bool& v) {
  f.truth(name, v);
}
/// Where values come from.
inline void describe_value(RecordFields& f, const std::string& name, model::Unit,
                           std::vector<std::pair<std::string, std::string>>& v) {
  v.resize(f.list(name, v.size()));
  for (std::size_t i = 0; i < v.size(); ++i) {
    f.element(i);
    f.group();
    f.text("of", v[i].first);
    f.text("is", v[i].second);
    f.end();
  }
  f.end();
}
inline void describe_value(RecordFields& f, const std::string& name, model::Unit,
                           std::vector<std::string>& v) {
  v.resize(f.list(name, v.size()));
  for (std::size_t i = 0; i < v.size(); ++i) {
    f.element(i);
    f.text("", v[i]);
  }
  f.end();
}
/// A list of groups.
template <model::HasFields S>
void describe_value(RecordFields& f, const std::string& name, model::Unit, std::vector<S>& v) {
  v.resize(f.list(name, v.size()));
  for (std::size_t i = 0; i < v.size(); ++i) {
    f.element(i);
    f.group();
    describe_fields(f, v[i]);
    f.end();
  }
  f.end();
}
/// A list of at most one.
template <model::HasFields S>
void describe_value(RecordFields& f, const std::string& name, model::Unit unit, std::optional<S>& v) {
  std::vector<S> list;
  if (v) list.push_back(std::move(*v));
  describe_value(f, name, unit, list);
  if (list.size() > 1) throw MalformedRecord{};
  v.reset();
  if (!list.empty()) v = std::move(list.front());
}
/// A struct among the fields of another.
template <model::HasFields S>
void describe_value(RecordFields& f, const std::string&, model::Unit, S& v) {
  describe_fields(f, v);
}
inline void describe_value(RecordFields& f, const std::string& name, model::Unit, geometry::Vec3& v) {
  describe_fields(f, v, name + " ");
}

template <model::HasFields S, class Before>
void describe_part(RecordFields& f, S& x, std::size_t part, const std::string& prefix, const Before& before) {
  const model::RecordPart& p = model::kRecordParts<S>[part];
  if (p.opens) f.group();
  before(part);
  model::for_each_field(x, [&](const auto& row, auto& v) {
    if (row.in_record != nullptr && row.part == part) describe_value(f, prefix + row.in_record, row.unit, v);
  });
  if (p.closes) f.end();
}

template <model::HasFields S, class Before>
void describe_fields(RecordFields& f, S& x, const std::string& prefix, const Before& before) {
  int version = 1;
  for (std::size_t part = 0; part < model::kRecordParts<S>.size(); ++part) {
    const int since = model::kRecordParts<S>[part].since;
    if (since > version && !f.more()) return;
    version = since;
    describe_part(f, x, part, prefix, before);
  }
}

}  // namespace capstan::exchange
