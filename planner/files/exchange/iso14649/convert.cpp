#include "planner/files/exchange/iso14649/convert.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/files/exchange/common/text.h"
#include "planner/files/exchange/iso14649/units.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/stand_in.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;
using p21::Kind;
using p21::Value;

namespace {

class Conversion {
 public:
  Conversion(Reading& r, AnyRef object, const Attribute& a) : r_(r), object_(object), a_(a) {}

  void run(const Value& v) {
    if (v.is(Kind::kOmitted)) return missing();
    if (v.is(Kind::kDerived)) return wrong(v, "a value: nothing redeclares this attribute");
    switch (a_.storage) {
      case Storage::kReal:
        if (const auto x = number(v)) slot<model::Real>() = *x;
        break;
      case Storage::kInteger:
        if (const auto x = integer(v)) slot<model::Integer>() = *x;
        break;
      case Storage::kBoolean:
        boolean(v);
        break;
      case Storage::kText:
        if (const auto x = text(v)) slot<model::Text>() = *x;
        break;
      case Storage::kEnum:
        enumeration(v);
        break;
      case Storage::kRef:
        if (const auto x = reference(v)) slot<AnyRef>() = *x;
        break;
      case Storage::kSelect:
        if (auto x = select(v)) slot<model::SelectValue>() = std::move(*x);
        break;
      case Storage::kRefList:
        list(v, slot<model::AnyRefList>(), [&](const Value& e) { return reference(e); });
        break;
      case Storage::kSelectList:
        list(v, slot<model::SelectList>(), [&](const Value& e) { return select(e); });
        break;
      case Storage::kRealList:
        list(v, slot<model::RealList>(), [&](const Value& e) { return number(e); });
        break;
      case Storage::kIntegerList:
        list(v, slot<model::IntegerList>(), [&](const Value& e) { return integer(e); });
        break;
      case Storage::kTextList:
        list(v, slot<model::TextList>(), [&](const Value& e) { return text(e); });
        break;
      case Storage::kRefTable:
        table(v, slot<model::RefTable>(), [&](const Value& e) { return reference(e); });
        break;
      case Storage::kRealTable:
        table(v, slot<model::RealTable>(), [&](const Value& e) { return number(e); });
        break;
      case Storage::kPath:
        break;  // never in ISO 14649
    }
  }

 private:
  template <class T>
  T& slot() {
    return *static_cast<T*>(a_.at(r_.plan.model.object(object_)));
  }
  [[nodiscard]] std::string name() const { return attribute_name(object_, a_.name); }

  void warn(std::string code, std::string message) {
    tell(Severity::kWarning, std::move(code), std::move(message));
  }

  /// What is read as it was meant, so that nobody needs to act.
  void note(std::string code, std::string message) {
    tell(Severity::kNote, std::move(code), std::move(message));
  }

  void tell(Severity severity, std::string code, std::string message) {
    r_.reporter.about(r_.plan.model, object_,
                      {.code = std::move(code), .severity = severity, .message = std::move(message)});
  }

  void missing() {
    if (!a_.required) return;
    const bool is_list = a_.storage == Storage::kRefList || a_.storage == Storage::kSelectList ||
                         a_.storage == Storage::kRealList || a_.storage == Storage::kIntegerList ||
                         a_.storage == Storage::kTextList || a_.storage == Storage::kRefTable ||
                         a_.storage == Storage::kRealTable;
    // Open decisions are reported separately, when all is read.
    static constexpr std::array<std::string_view, 3> kOpen = {"its_tool", "its_technology", "its_operation"};
    if (std::find(kOpen.begin(), kOpen.end(), a_.name) != kOpen.end()) return;
    // Nothing is made otherwise without them.
    static constexpr std::array<std::string_view, 3> kIdle = {"its_instructions", "axis_clamping",
                                                              "other_functions"};
    const bool idle = std::find(kIdle.begin(), kIdle.end(), a_.name) != kIdle.end();
    tell(is_list && idle ? Severity::kNote : Severity::kWarning, "P21-MANDATORY",
         name() + (is_list ? " is missing; taken as empty" : " is missing; left unset"));
  }

  void wrong(const Value& v, std::string expected) {
    std::string shown = spelling(v);
    if (shown.size() > 60) shown = shown.substr(0, 57) + "...";
    r_.doubt(
        object_,
        {.code = "EXC-VALUE", .message = name() + " cannot be " + shown, .expected = std::move(expected)},
        refers() ? a_.name : std::string_view{});
  }

  [[nodiscard]] bool refers() const {
    return a_.storage == Storage::kRef || a_.storage == Storage::kRefList || a_.storage == Storage::kRefTable;
  }

  // A measure may wear its type: LENGTH_MEASURE(1.5).
  static Value bare(const Value& v) { return v.is(Kind::kTyped) ? v[0] : v; }

  std::optional<double> number(const Value& typed) {
    const Value v = bare(typed);
    if (!v.is_number()) {
      wrong(typed, "a number");
      return std::nullopt;
    }
    if (v.is(Kind::kInteger))
      note("EXC-NUMBER", name() + ": integer " + std::string(v.lexeme()) + " read as a real");
    const double x = from_file(v.as_real(), a_.unit);
    if (!std::isfinite(x)) {
      wrong(v, "a number that is finite in the model's unit");
      return std::nullopt;
    }
    return x;
  }

  std::optional<std::int64_t> integer(const Value& typed) {
    const Value v = bare(typed);
    if (v.is(Kind::kInteger)) return v.as_integer();
    if (v.is(Kind::kReal) && std::trunc(v.as_real()) == v.as_real() && std::abs(v.as_real()) < kExactWhole) {
      warn("EXC-NUMBER", name() + ": real " + std::string(v.lexeme()) + " read as an integer");
      return static_cast<std::int64_t>(v.as_real());
    }
    wrong(typed, "an integer");
    return std::nullopt;
  }

  std::optional<std::string> text(const Value& typed) {
    const Value v = bare(typed);
    if (v.is(Kind::kString)) return v.as_text();
    wrong(typed, "a string");
    return std::nullopt;
  }

  void boolean(const Value& v) {
    if (v.is(Kind::kEnumeration) && (v.enumeration() == "T" || v.enumeration() == "F")) {
      slot<model::Boolean>() = v.enumeration() == "T";
    } else {
      wrong(v, ".T. or .F.");
    }
  }

  void enumeration(const Value& v) {
    if (v.is(Kind::kEnumeration)) {
      const auto it = std::find(a_.enumerators.begin(), a_.enumerators.end(), v.enumeration());
      if (it != a_.enumerators.end()) {
        slot<model::AnyEnum>().code = static_cast<std::int8_t>(it - a_.enumerators.begin());
        return;
      }
    }
    std::string expected = "one of";
    for (const auto e : a_.enumerators) expected += " ." + std::string(e) + ".";
    wrong(v, expected);
  }

  [[nodiscard]] bool fits(AnyRef target) const {
    if (a_.targets.empty() || target.type == TypeId::kKeptInstance) return true;
    return std::any_of(a_.targets.begin(), a_.targets.end(),
                       [&](TypeId t) { return model::is_a(target.type, t); });
  }

  // Where a reference to the wrong kind of entity does not keep the file from being read: what the attribute
  // says is missing then, and whoever needs it says so by name (a hole without its bottom, a slot without its
  // profile have no shape, and are not planned), or it only describes. Everywhere else its absence would mean
  // something (no placement, no boss, another step): there it is an error.
  [[nodiscard]] bool missing_is_told() const {
    if (a_.name == "its_material") return object_.type != TypeId::kWorkpiece;
    static constexpr std::array<std::string_view, 6> kOfShapes = {
        "bottom_condition", "depth", "diameter", "feature_boundary", "open_boundary", "swept_shape"};
    if (object_.type != TypeId::kKeptInstance && !model::is_a(object_.type, TypeId::kManufacturingFeature))
      return false;
    // A pocket whose bottom is not stated is taken for one with a plane bottom.
    if (a_.name == "bottom_condition" && !model::is_a(object_.type, TypeId::kRoundHole)) return false;
    return std::find(kOfShapes.begin(), kOfShapes.end(), a_.name) != kOfShapes.end();
  }

  // Deviations of real files that lose nothing: kept, and told.
  std::optional<AnyRef> tolerated(AnyRef target) {
    if (model::may_stand_in(a_, target.type)) {
      warn("EXC-REFERENCE",
           name() + " is a TOLERANCED_LENGTH_MEASURE; taken as the depth below the feature's top");
      return target;
    }
    if (a_.name == "segments" && model::is_a(target.type, TypeId::kBoundedCurve)) {
      note("EXC-REFERENCE", name() + " points straight at a " +
                                std::string(model::noun_type(target.type).keyword) +
                                "; taken as a segment in the same sense");
      model::CompositeCurveSegment s;
      s.transition = model::TransitionCode::kContinuous;
      s.same_sense = true;
      s.parent_curve = model::Ref<model::Curve>(target);
      return r_.plan.model.add(std::move(s));
    }
    return std::nullopt;
  }

  std::optional<AnyRef> reference(const Value& v) {
    if (!v.is(Kind::kReference)) {
      wrong(v, "a reference");
      return std::nullopt;
    }
    const AnyRef target = r_.find(v.reference());
    if (!target.set()) {
      r_.doubt(object_,
               {.code = "EXC-REFERENCE",
                .severity = a_.required ? Severity::kError : Severity::kWarning,
                .message = name() + " points to #" + std::to_string(v.reference()) +
                           ", which the file does not hold; left unset"},
               a_.name);
      return std::nullopt;
    }
    if (fits(target)) return target;
    if (const auto other = tolerated(target)) return other;
    std::string expected;
    for (const TypeId t : a_.targets)
      expected += (expected.empty() ? "" : " or ") + std::string(model::noun_type(t).keyword);
    const bool told = missing_is_told();
    r_.doubt(
        object_,
        {.code = "EXC-REFERENCE",
         .severity = told ? Severity::kWarning : Severity::kError,
         .message = name() + " points to #" + std::to_string(v.reference()) + ", which is " +
                    std::string(model::noun_type(target.type).keyword) + (told ? "; taken as missing" : ""),
         .expected = expected},
        a_.name == "its_material" && told ? std::string_view{} : a_.name);
    return std::nullopt;
  }

  std::optional<model::SelectValue> select(const Value& v) {
    model::SelectValue out;
    if (v.is(Kind::kReference)) {
      const auto target = reference(v);
      if (!target) return std::nullopt;
      out.ref = *target;
    } else if (v.is(Kind::kEnumeration)) {
      out.text = v.enumeration();
    } else if (v.is(Kind::kTyped) && v[0].is(Kind::kEnumeration)) {
      out.type = v.keyword();
      out.text = v[0].enumeration();
    } else if (bare(v).is_number()) {
      if (v.is(Kind::kTyped)) out.type = v.keyword();
      out.real = bare(v).as_real();
    } else {
      wrong(v, "a reference, a measure or an enumerator");
      return std::nullopt;
    }
    return out;
  }

  template <class List, class Element>
  void list(const Value& v, List& out, const Element& element) {
    if (!v.is(Kind::kList)) return wrong(v, "a list");
    out.given = true;
    out.items.reserve(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (auto x = element(v[i])) out.items.push_back(std::move(*x));
    }
  }

  template <class Table, class Element>
  void table(const Value& v, Table& out, const Element& element) {
    if (!v.is(Kind::kList)) return wrong(v, "a list of lists");
    out.given = true;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (!v[i].is(Kind::kList)) return wrong(v, "a list of lists");
      auto& row = out.items.emplace_back();
      for (std::size_t j = 0; j < v[i].size(); ++j) {
        if (auto x = element(v[i][j])) row.push_back(std::move(*x));
      }
    }
  }

  Reading& r_;
  AnyRef object_;
  const Attribute& a_;
};

}  // namespace

void convert(Reading& reading, AnyRef object, const Attribute& attribute, const Value& v) {
  Conversion(reading, object, attribute).run(v);
}

}  // namespace capstan::exchange
