#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/files/json/fields.h"
#include "planner/files/json/ids.h"
#include "planner/files/json/printer.h"
#include "planner/files/json/summary.h"
#include "planner/files/json/tree/tree.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/workpiece.h"
#include "planner/model/plan/decision/edited.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/range/columns_agree.h"

// Values of the plan's JSON into the plan's own types, by `fields.h`. What is wrong ends the reading with the
// place and what was expected there. Tree is the JSON library's value, which stays in sources.

namespace capstan::json {

/// Where in the document; printed only when something is wrong there.
struct Place {
  const Place* up = nullptr;
  std::string_view name = {};
  std::size_t index = 0;
  [[nodiscard]] std::string text() const {
    if (up == nullptr) return {};
    return up->text() + "/" + (name.empty() ? std::to_string(index) : std::string(name));
  }
};

/// Thrown by what reads values, caught by `read_json`.
struct Fault {
  std::string place, expected;
};

[[noreturn]] inline void fault(const Place& at, std::string expected) {
  throw Fault{at.text(), std::move(expected)};
}

template <class Tree>
void need_object(const Tree& t, const Place& at) {
  if (!t.is_object()) fault(at, "an object");
}
template <class Tree>
void need_array(const Tree& t, const Place& at) {
  if (!t.is_array()) fault(at, "an array");
}
template <class Tree>
const Tree& child(const Tree& t, std::string_view name, const Place& at) {
  const auto it = t.find(name);
  if (it == t.end()) fault({&at, name}, "this field");
  return *it;
}
template <class Tree>
const std::string& string_of(const Tree& t, const Place& at) {
  if (!t.is_string()) fault(at, "a text");
  return t.template get_ref<const std::string&>();
}
template <class Tree>
void only(const Tree& t, const std::vector<std::string_view>& names, const Place& at) {
  for (const auto& item : t.items()) {
    if (std::find(names.begin(), names.end(), item.key()) == names.end()) {
      fault({&at, item.key()}, "no field of that name");
    }
  }
}

/// The names of a structure's fields.
struct Names {
  std::vector<std::string_view> names;
  template <class T>
  void operator()(const char* name, const T& /*value*/) {
    names.emplace_back(name);
  }
};

/// Reads values of a plan whose objects are made: references are held against them.
template <class Tree>
class ValueReader {
 public:
  using AnyRef = model::AnyRef;
  using TypeId = model::TypeId;

  explicit ValueReader(const model::Model& model) : model_(model) {}

  /// The columns that steps share, by name in the document.
  void shared_columns(const Tree& tree, const Place& top) {
    shared_columns(tree, "paths", paths_, top);
    shared_columns(tree, "schedules", schedules_, top);
    shared_columns(tree, "sections", sections_, top);
  }

  /// A structure's fields, one by one.
  struct FieldReader {
    ValueReader& reader;
    const Tree& tree;
    const Place& at;
    template <class T>
    void operator()(const char* name, T& x) {
      const Place here{&at, name};
      const auto it = tree.find(name);
      if (it == tree.end()) {
        if constexpr (kIsOptional<T>) return;
        fault(here, "this field");
      }
      if constexpr (std::is_same_v<T, std::uint64_t>) {
        if (here.name == kHashField) return reader.hash(*it, x, here);
      }
      reader.get(*it, x, here);
    }
  };
  template <class T>
  void get(const Tree& t, T& x, const Place& at) {
    if constexpr (std::is_same_v<T, bool>) {
      if (!t.is_boolean()) fault(at, "true or false");
      x = t.template get<bool>();
    } else if constexpr (std::is_integral_v<T>) {
      integer(t, x, at);
    } else if constexpr (std::is_floating_point_v<T>) {
      if (!t.is_number()) fault(at, "a number");
      x = t.template get<double>();
    } else if constexpr (IsText<T>) {
      x = unquoted_bytes(string_of(t, at));
    } else if constexpr (std::is_enum_v<T>) {
      x = static_cast<T>(spelled(string_of(t, at), spellings<T>(), at));
    } else if constexpr (std::is_base_of_v<AnyRef, T>) {
      reference(t, x, at);
      if constexpr (!std::is_same_v<T, AnyRef>) must_be(x, target_of(x), at);
    } else if constexpr (kIsOptional<T>) {
      x.emplace();
      get(t, *x, at);
    } else if constexpr (kIsShared<T>) {
      shared(t, x, at);
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveKind>>) {
      letters(t, x, kMoveKinds, at);
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveRole>>) {
      letters(t, x, kMoveRoles, at);
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      sequence(t, x, at);
    } else {
      structure(t, x, at);
    }
  }

  template <class T>
  static TypeId target_of(const model::Ref<T>&) {
    return T::kType;
  }

  template <class T>
  static void integer(const Tree& t, T& x, const Place& at) {
    bool fits = t.is_number_integer();
    if (fits && t.is_number_unsigned()) {
      fits = t.template get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<T>::max());
    } else if (fits) {
      const auto v = t.template get<std::int64_t>();
      fits = std::is_signed_v<T> && v >= static_cast<std::int64_t>(std::numeric_limits<T>::min());
    }
    if (!fits) fault(at, "a whole number in range");
    x = t.template get<T>();
  }

  template <class Names>
  static std::size_t spelled(const std::string& text, const Names& names, const Place& at) {
    const auto it = std::find(names.begin(), names.end(), text);
    if (it == names.end()) fault(at, "one of the values that the schema lists");
    return static_cast<std::size_t>(it - names.begin());
  }

  static void hash(const Tree& t, std::uint64_t& x, const Place& at) {
    const auto read = model::hash_from_text(string_of(t, at));
    if (!read) fault(at, "sixteen hexadecimal digits");
    x = *read;
  }

  template <class T>
  void sequence(const Tree& t, T& x, const Place& at) {
    if (t.is_binary()) return column(t, x, at);
    need_array(t, at);
    if constexpr (kIsArray<T>) {
      if (t.size() != x.size()) fault(at, std::to_string(x.size()) + " items");
    } else {
      x.resize(t.size());
    }
    for (std::size_t i = 0; i < t.size(); ++i) get(t[i], x[i], {&at, {}, i});
  }

  /// Numbers that were read as they stood.
  template <class T>
  void column(const Tree& t, T& x, const Place& at) {
    if constexpr (std::is_same_v<T, std::vector<double>>) {
      x = numbers_of(t);
    } else {
      if constexpr (std::is_same_v<T, std::vector<std::uint32_t>>) {
        constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
        const std::vector<double> values = numbers_of(t);
        if (is_whole(t) &&
            std::all_of(values.begin(), values.end(), [](double v) { return v >= 0.0 && v <= kMost; })) {
          x.resize(values.size());
          std::transform(values.begin(), values.end(), x.begin(),
                         [](double v) { return static_cast<std::uint32_t>(v); });
          return;
        }
      }
      sequence(expanded(t), x, at);
    }
  }

  template <class E>
  static void letters(const Tree& t, std::vector<E>& x, std::string_view alphabet, const Place& at) {
    const std::string& text = string_of(t, at);
    x.reserve(text.size());
    for (const char c : text) {
      const auto code = alphabet.find(c);
      if (code == std::string_view::npos) fault(at, "letters of " + std::string(alphabet));
      x.push_back(static_cast<E>(code));
    }
  }

  template <class T>
  void structure(const Tree& t, T& x, const Place& at) {
    need_object(t, at);
    FieldReader each{*this, t, at};
    fields(each, x);
    Names known;
    fields(known, x);
    if constexpr (std::is_same_v<T, model::StepResult>)
      known.names.insert(known.names.end(), std::begin(kDerivedOfStep), std::end(kDerivedOfStep));
    only(t, known.names, at);
    if constexpr (std::is_same_v<T, model::CutterPath>) {
      if (!model::columns_agree(x)) fault(at, "columns of one length");
    }
  }

  template <class T>
  void shared_columns(const Tree& tree, const char* name, std::vector<std::shared_ptr<const T>>& out,
                      const Place& at) {
    const Tree& list = child(tree, name, at);
    const Place here{&at, name};
    need_array(list, here);
    for (std::size_t i = 0; i < list.size(); ++i) {
      poll();
      auto item = std::make_shared<T>();
      get(list[i], *item, {&here, {}, i});
      out.push_back(std::move(item));
    }
  }
  auto& shared_of(const model::CutterPath*) { return paths_; }
  auto& shared_of(const model::FeedSchedule*) { return schedules_; }
  auto& shared_of(const model::SectionSeries*) { return sections_; }
  template <class T>
  void shared(const Tree& t, std::shared_ptr<const T>& x, const Place& at) {
    if (t.is_null()) return;
    const auto& all = shared_of(static_cast<const T*>(nullptr));
    const auto index = shared_from_id(shared_name<T>(), string_of(t, at));
    if (!index || *index >= all.size())
      fault(at, "the id of one of the " + std::string(shared_name<T>()) + "s");
    x = all[*index];
  }

  void reference(const Tree& t, AnyRef& x, const Place& at) const {
    x = {};
    if (t.is_null()) return;
    const auto r = object_from_id(string_of(t, at));
    if (!r || r->index >= model_.count(r->type)) fault(at, "the id of an object");
    x = *r;
  }
  static void must_be(AnyRef r, TypeId target, const Place& at) {
    if (r.set() && r.type != TypeId::kKeptInstance && !model::is_a(r.type, target)) {
      fault(at, "the id of a " + kind_name(target));
    }
  }

 private:
  const model::Model& model_;
  std::vector<std::shared_ptr<const model::CutterPath>> paths_;
  std::vector<std::shared_ptr<const model::FeedSchedule>> schedules_;
  std::vector<std::shared_ptr<const model::SectionSeries>> sections_;
};

}  // namespace capstan::json
