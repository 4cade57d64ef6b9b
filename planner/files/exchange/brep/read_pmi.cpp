#include "planner/files/exchange/brep/read_pmi.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "planner/ground/base/text.h"

// A statement names a shape aspect. Which faces an aspect is: those that a usage ties to it, and those of the
// aspects that a relationship makes parts of it. A datum is reached the other way, from its datum feature.

namespace capstan::exchange {
namespace {

using p21::Instance;
using p21::Kind;
using p21::Value;

constexpr double kMmPerMetre = 1000.0;
constexpr double kUmPerMm = 1000.0;
/// Units that are defined by another may be nested so deep.
constexpr int kDeepestUnit = 8;
/// Aspects that one statement may reach.
constexpr std::size_t kMostAspects = 100'000;

/// The parameters of an instance as one of a kind: its own, or those of its part.
std::optional<Value> as(const Instance& i, std::string_view keyword) {
  if (i.is_complex()) return i.part(keyword);
  if (i.keyword() == keyword) return i.parameters();
  return std::nullopt;
}

bool is(const Instance& i, std::string_view keyword) { return as(i, keyword).has_value(); }

std::optional<std::uint64_t> reference_at(const Value& list, std::size_t n) {
  if (!list.is(Kind::kList) || n >= list.size() || !list[n].is(Kind::kReference)) return std::nullopt;
  return list[n].reference();
}

std::string text_at(const Value& list, std::size_t n) {
  return list.is(Kind::kList) && n < list.size() && list[n].is(Kind::kString) ? list[n].as_text()
                                                                              : std::string();
}

/// The references in a value, however it wraps them: #1, (#1,#2), SET_REPRESENTATION_ITEM((#1,#2)).
void references_in(const Value& v, std::vector<std::uint64_t>& out) {
  std::vector<Value> pending{v};
  while (!pending.empty()) {
    const Value at = pending.back();
    pending.pop_back();
    if (at.is(Kind::kReference)) out.push_back(at.reference());
    for (std::size_t i = at.size(); i-- > 0;) pending.push_back(at[i]);
  }
}

class Reader {
 public:
  explicit Reader(const p21::File& file) : file_(file) { index(); }

  Pmi read() {
    for (const Instance& i : file_) {
      if (is(i, "DIMENSIONAL_SIZE") || is(i, "DIMENSIONAL_LOCATION")) {
        size(i);
      } else if (is(i, "ANGULAR_SIZE") || is(i, "ANGULAR_LOCATION")) {
        unread(i, "angles are not read");
      } else if (is_zone(i)) {
        zone(i);
      } else if (const auto p = as(i, "DATUM")) {
        datum(i, *p);
      } else if (const auto t = as(i, "PROPERTY_DEFINITION")) {
        if (text_at(*t, 0) == "surface_condition") texture(i, *t);
      }
    }
    return std::move(out_);
  }

 private:
  void index() {
    for (const Instance& i : file_) {
      for (const char* keyword : {"GEOMETRIC_ITEM_SPECIFIC_USAGE", "ITEM_IDENTIFIED_REPRESENTATION_USAGE"}) {
        const auto p = as(i, keyword);
        const auto of = p ? reference_at(*p, 2) : std::nullopt;
        if (of && p->size() > 4) references_in((*p)[4], items_[*of]);
      }
      for (const char* keyword : {"SHAPE_ASPECT_RELATIONSHIP", "SHAPE_ASPECT_DERIVING_RELATIONSHIP",
                                  "FEATURE_FOR_DATUM_TARGET_RELATIONSHIP"}) {
        if (is(i, "DIMENSIONAL_LOCATION")) continue;  // its ends are no parts of each other
        const auto p = as(i, keyword);
        const auto whole = p ? reference_at(*p, 2) : std::nullopt;
        const auto part = p ? reference_at(*p, 3) : std::nullopt;
        if (!whole || !part) continue;
        parts_[*whole].push_back(*part);
        wholes_[*part].push_back(*whole);
      }
      if (const auto p = as(i, "DIMENSIONAL_CHARACTERISTIC_REPRESENTATION")) {
        const auto of = reference_at(*p, 0), by = reference_at(*p, 1);
        if (of && by) measures_[*of].push_back(*by);
      }
      if (const auto p = as(i, "PLUS_MINUS_TOLERANCE")) {
        const auto range = reference_at(*p, 0), of = reference_at(*p, 1);
        if (of && range) ranges_[*of].push_back(*range);
      }
      if (const auto p = as(i, "PROPERTY_DEFINITION_REPRESENTATION")) {
        const auto of = reference_at(*p, 0), by = reference_at(*p, 1);
        if (of && by) represented_[*of].push_back(*by);
      }
      if (const auto p = as(i, "TOLERANCE_ZONE")) {
        const auto form = reference_at(*p, 5);
        const auto named = form ? file_.find(*form) : std::nullopt;
        const auto f = named ? as(*named, "TOLERANCE_ZONE_FORM") : std::nullopt;
        std::vector<std::uint64_t> of;
        if (f && p->size() > 4) references_in((*p)[4], of);
        for (const std::uint64_t t : of) forms_[t] = text_at(*f, 0);
      }
    }
  }

  void unread(const Instance& i, std::string why) {
    std::string what(i.keyword());
    for (std::size_t k = 0; i.is_complex() && k < i.part_count(); ++k) {
      if (what.empty() || i.part(k).keyword.ends_with("_TOLERANCE")) what = i.part(k).keyword;
    }
    out_.unread.push_back({static_cast<std::int64_t>(i.id()), std::move(what), std::move(why)});
  }

  /// Adds the faces of an aspect.
  void faces_of(std::uint64_t aspect, std::set<std::int64_t>& faces) const {
    std::set<std::uint64_t> seen;
    std::vector<std::uint64_t> pending{aspect};
    while (!pending.empty() && seen.size() < kMostAspects) {
      const std::uint64_t at = pending.back();
      pending.pop_back();
      if (!seen.insert(at).second) continue;
      const auto instance = file_.find(at);
      if (!instance) continue;
      if (is(*instance, "ADVANCED_FACE") || is(*instance, "FACE_SURFACE"))
        faces.insert(static_cast<std::int64_t>(at));
      // A tolerance of a dimension is about what the dimension is of.
      if (const auto p = as(*instance, "DIMENSIONAL_SIZE"); p && reference_at(*p, 0))
        pending.push_back(*reference_at(*p, 0));
      for (const auto* by : {&items_, &parts_}) {
        if (const auto it = by->find(at); it != by->end())
          pending.insert(pending.end(), it->second.begin(), it->second.end());
      }
    }
  }
  [[nodiscard]] std::vector<std::int64_t> faces_of(std::uint64_t aspect) const {
    std::set<std::int64_t> out;
    faces_of(aspect, out);
    return {out.begin(), out.end()};
  }

  void about(std::uint64_t aspect, StatedOf& s) const {
    s.faces = faces_of(aspect);
    const auto i = file_.find(aspect);
    s.whole = i && (is(*i, "PRODUCT_DEFINITION_SHAPE") || is(*i, "PRODUCT_DEFINITION"));
  }

  /// The number and the unit of a measure.
  static std::optional<std::pair<double, std::uint64_t>> number_of(const Instance& i) {
    std::optional<Value> p;
    std::size_t at = 0;
    if (i.is_complex()) {
      p = i.part("MEASURE_WITH_UNIT");
    } else if (i.keyword() == "MEASURE_REPRESENTATION_ITEM") {
      p = i.parameters();
      at = 1;
    } else if (i.keyword().ends_with("MEASURE_WITH_UNIT")) {
      p = i.parameters();
    }
    if (!p || p->size() < at + 2) return std::nullopt;
    Value number = (*p)[at];
    if (number.is(Kind::kTyped)) number = number[0];
    const auto unit = reference_at(*p, at + 1);
    if (!number.is_number() || !unit) return std::nullopt;
    return std::pair{number.as_real(), *unit};
  }

  /// How many mm a unit of length is.
  [[nodiscard]] std::optional<double> mm_of(std::uint64_t unit) const {
    double factor = 1.0;
    for (int depth = 0; depth < kDeepestUnit; ++depth) {
      const auto i = file_.find(unit);
      if (!i) return std::nullopt;
      if (const auto si = as(*i, "SI_UNIT")) {
        static const std::map<std::string_view, double> kPrefixes = {
            {"KILO", 1e3}, {"DECI", 1e-1}, {"CENTI", 1e-2}, {"MILLI", 1e-3}, {"MICRO", 1e-6}};
        const std::size_t last = si->size();
        if (last < 2 || !(*si)[last - 1].is(Kind::kEnumeration)) return std::nullopt;
        if ((*si)[last - 1].enumeration() != "METRE") return std::nullopt;
        const Value prefix = (*si)[last - 2];
        if (!prefix.is(Kind::kEnumeration)) return factor * kMmPerMetre;
        const auto known = kPrefixes.find(prefix.enumeration());
        if (known == kPrefixes.end()) return std::nullopt;
        return factor * kMmPerMetre * known->second;
      }
      const auto by = as(*i, "CONVERSION_BASED_UNIT");
      const auto of = by ? reference_at(*by, 1) : std::nullopt;
      const auto measure = of ? file_.find(*of) : std::nullopt;
      const auto number = measure ? number_of(*measure) : std::nullopt;
      if (!number) return std::nullopt;
      factor *= number->first;
      unit = number->second;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<double> length_of(std::uint64_t id) const {
    const auto i = file_.find(id);
    const auto number = i ? number_of(*i) : std::nullopt;
    const auto unit = number ? mm_of(number->second) : std::nullopt;
    if (!unit || !std::isfinite(number->first * *unit)) return std::nullopt;
    return number->first * *unit;
  }

  /// The name of a measure, by its own or by a qualifier of its kind.
  [[nodiscard]] std::string name_of(const Instance& i) const {
    if (!i.is_complex()) return text_at(i.parameters(), 0);
    const auto q = i.part("QUALIFIED_REPRESENTATION_ITEM");
    std::vector<std::uint64_t> qualifiers;
    if (q) references_in(*q, qualifiers);
    for (const std::uint64_t id : qualifiers) {
      const auto qualifier = file_.find(id);
      const auto type = qualifier ? as(*qualifier, "TYPE_QUALIFIER") : std::nullopt;
      if (!type) continue;
      const std::string said = text_at(*type, 0);
      if (said == "maximum") return "upper limit";
      if (said == "minimum") return "lower limit";
    }
    const auto item = i.part("REPRESENTATION_ITEM");
    return item ? text_at(*item, 0) : std::string();
  }

  void take_values(std::uint64_t dimension, StatedSize& s) const {
    const auto by = measures_.find(dimension);
    if (by == measures_.end()) return;
    for (const std::uint64_t representation : by->second) {
      const auto r = file_.find(representation);
      const auto p = r ? as(*r, "SHAPE_DIMENSION_REPRESENTATION") : std::nullopt;
      const auto plain = r && !p && r->is_complex() ? r->part("REPRESENTATION") : p;
      std::vector<std::uint64_t> items;
      if (plain && plain->size() > 1) references_in((*plain)[1], items);
      for (const std::uint64_t id : items) {
        const auto item = file_.find(id);
        const auto mm = length_of(id);
        if (!item || !mm) continue;
        const std::string name = lower_text(name_of(*item));
        if (name == "upper limit") {
          s.greatest_mm = mm;
        } else if (name == "lower limit") {
          s.least_mm = mm;
        } else {
          s.nominal_mm = mm;
        }
      }
    }
    if (s.least_mm.has_value() != s.greatest_mm.has_value()) s.least_mm = s.greatest_mm = std::nullopt;
  }

  /// Why its tolerance is not understood; empty: it is, or there is none.
  [[nodiscard]] std::string take_range(std::uint64_t dimension, StatedSize& s) const {
    const auto by = ranges_.find(dimension);
    if (by == ranges_.end()) return {};
    if (by->second.size() > 1) return "it has more than one plus_minus_tolerance";
    const auto range = file_.find(by->second.front());
    if (!range) return "its tolerance is missing";
    if (const auto p = as(*range, "TOLERANCE_VALUE")) {
      const auto lower = reference_at(*p, 0), upper = reference_at(*p, 1);
      s.lower_mm = lower ? length_of(*lower) : std::nullopt;
      s.upper_mm = upper ? length_of(*upper) : std::nullopt;
      if (s.lower_mm && s.upper_mm) return {};
      s.lower_mm = s.upper_mm = std::nullopt;
      return "a bound of its tolerance is no length";
    }
    const auto p = as(*range, "LIMITS_AND_FITS");
    if (!p) return "its tolerance is no tolerance_value and no limits_and_fits";
    std::string grade = text_at(*p, 2);
    if (lower_text(grade).starts_with("it")) grade.erase(0, 2);
    s.fit = text_at(*p, 0) + grade;
    s.of_shaft = lower_text(text_at(*p, 1)) == "shaft";
    return {};
  }

  void size(const Instance& i) {
    StatedSize s;
    s.id = static_cast<std::int64_t>(i.id());
    s.line = i.line();
    if (const auto p = as(i, "DIMENSIONAL_SIZE")) {
      s.kind = text_at(*p, 1);
      if (const auto of = reference_at(*p, 0)) s.faces = faces_of(*of);
    } else if (const auto l = as(i, "DIMENSIONAL_LOCATION")) {
      // In a complex instance the name and the ends stand in its SHAPE_ASPECT_RELATIONSHIP.
      const auto apart = i.is_complex() ? i.part("SHAPE_ASPECT_RELATIONSHIP") : l;
      if (!apart) return unread(i, "its ends are missing");
      s.kind = text_at(*apart, 0);
      if (const auto of = reference_at(*apart, 2)) s.faces = faces_of(*of);
      if (const auto to = reference_at(*apart, 3)) s.to = faces_of(*to);
    }
    take_values(i.id(), s);
    if (std::string why = take_range(i.id(), s); !why.empty()) return unread(i, std::move(why));
    if (!s.nominal_mm && !s.least_mm) return unread(i, "it has no value that is a length");
    out_.sizes.push_back(std::move(s));
  }

  static bool is_zone(const Instance& i) {
    if (i.is_complex()) return i.part("GEOMETRIC_TOLERANCE").has_value();
    const std::string_view k = i.keyword();
    return k == "GEOMETRIC_TOLERANCE" || kZones.count(k) != 0;
  }

  void zone(const Instance& i) {
    StatedZone z;
    z.id = static_cast<std::int64_t>(i.id());
    z.line = i.line();
    const Value own = i.is_complex() ? *i.part("GEOMETRIC_TOLERANCE") : i.parameters();
    for (std::size_t k = 0; i.is_complex() && k < i.part_count(); ++k) {
      if (kZones.count(i.part(k).keyword) != 0) z.keyword = i.part(k).keyword;
    }
    if (!i.is_complex()) z.keyword = i.keyword();
    if (kZones.count(z.keyword) == 0) return unread(i, "which tolerance it is stands nowhere");
    const auto magnitude = reference_at(own, 2);
    const auto mm = magnitude ? length_of(*magnitude) : std::nullopt;
    if (!mm) return unread(i, "its magnitude is no length");
    z.value_mm = *mm;
    if (const auto of = reference_at(own, 3)) about(*of, z);
    if (const auto form = forms_.find(i.id()); form != forms_.end()) z.form = form->second;
    if (const auto m = i.is_complex() ? i.part("GEOMETRIC_TOLERANCE_WITH_MODIFIERS") : std::nullopt;
        m && !m->empty() && (*m)[0].is(Kind::kList)) {
      for (std::size_t k = 0; k < (*m)[0].size(); ++k) {
        if ((*m)[0][k].is(Kind::kEnumeration)) z.modifiers.push_back(lower_text((*m)[0][k].enumeration()));
      }
    }
    std::vector<std::uint64_t> systems;
    if (i.is_complex()) {
      if (const auto d = i.part("GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE")) references_in(*d, systems);
    } else if (own.size() > 4) {
      references_in(own[4], systems);
    }
    for (const std::uint64_t system : systems) take_datums(system, z);
    out_.zones.push_back(std::move(z));
  }

  /// The letters of a datum system, or of one datum reference.
  void take_datums(std::uint64_t id, StatedZone& z) const {
    const auto at = file_.find(id);
    if (!at) return;
    const auto system = as(*at, "DATUM_SYSTEM");
    std::vector<std::uint64_t> compartments;
    if (system && system->size() > 4) {
      references_in((*system)[4], compartments);
    } else if (!system) {
      compartments.push_back(id);
    }
    for (const std::uint64_t compartment : compartments) {
      std::vector<std::string> letters;
      take_letters(compartment, letters);
      if (!letters.empty()) z.datums.push_back(std::move(letters));
    }
  }
  void take_letters(std::uint64_t compartment, std::vector<std::string>& letters) const {
    std::set<std::uint64_t> seen;
    std::vector<std::uint64_t> pending{compartment};
    while (!pending.empty()) {
      const std::uint64_t id = pending.back();
      pending.pop_back();
      const auto at = file_.find(id);
      if (!at || !seen.insert(id).second) continue;
      if (const auto d = as(*at, "DATUM")) {
        letters.push_back(letter_of(*at, *d));
        continue;
      }
      for (const char* keyword :
           {"DATUM_REFERENCE_COMPARTMENT", "DATUM_REFERENCE_ELEMENT", "GENERAL_DATUM_REFERENCE"}) {
        const auto p = as(*at, keyword);
        const std::size_t base = at->is_complex() ? 0 : 4;
        if (!p || p->size() <= base) continue;
        std::vector<std::uint64_t> bases;
        references_in((*p)[base], bases);
        pending.insert(pending.end(), bases.rbegin(), bases.rend());
      }
      if (const auto p = as(*at, "DATUM_REFERENCE")) {
        if (const auto base = reference_at(*p, 1)) pending.push_back(*base);
      }
    }
  }

  static std::string letter_of(const Instance& i, const Value& p) {
    return i.is_complex() ? text_at(p, 0) : text_at(p, 4);
  }

  void datum(const Instance& i, const Value& p) {
    StatedDatum d;
    d.id = static_cast<std::int64_t>(i.id());
    d.line = i.line();
    d.letter = letter_of(i, p);
    std::set<std::int64_t> faces;
    if (const auto from = wholes_.find(i.id()); from != wholes_.end()) {
      for (const std::uint64_t feature : from->second) faces_of(feature, faces);
    }
    faces_of(i.id(), faces);
    d.faces.assign(faces.begin(), faces.end());
    out_.datums.push_back(std::move(d));
  }

  void texture(const Instance& i, const Value& p) {
    StatedTexture t;
    t.id = static_cast<std::int64_t>(i.id());
    t.line = i.line();
    if (const auto of = reference_at(p, 2)) about(*of, t);
    const auto by = represented_.find(i.id());
    bool any = false;
    for (const std::uint64_t r : by == represented_.end() ? std::vector<std::uint64_t>{} : by->second) {
      const auto representation = file_.find(r);
      if (!representation) continue;
      auto q = as(*representation, "SURFACE_TEXTURE_REPRESENTATION");
      if (representation->is_complex()) q = representation->part("REPRESENTATION");
      std::vector<std::uint64_t> items;
      if (q && q->size() > 1) references_in((*q)[1], items);
      for (const std::uint64_t id : items) {
        const auto item = file_.find(id);
        if (!item) continue;
        if (const auto d = as(*item, "DESCRIPTIVE_REPRESENTATION_ITEM")) {
          if (text_at(*d, 0) == "measuring method") t.method = text_at(*d, 1);
          continue;
        }
        const auto mm = length_of(id);
        if (!mm) continue;
        t.parameter = name_of(*item);
        t.value_um = *mm * kUmPerMm;
        any = true;
      }
    }
    if (!any) return unread(i, "it has no value that is a length");
    out_.textures.push_back(std::move(t));
  }

  static const std::set<std::string_view> kZones;

  const p21::File& file_;
  std::map<std::uint64_t, std::vector<std::uint64_t>> items_;        ///< aspect -> items of the shape
  std::map<std::uint64_t, std::vector<std::uint64_t>> parts_;        ///< aspect -> aspects
  std::map<std::uint64_t, std::vector<std::uint64_t>> wholes_;       ///< the other way
  std::map<std::uint64_t, std::vector<std::uint64_t>> measures_;     ///< dimension -> representations
  std::map<std::uint64_t, std::vector<std::uint64_t>> ranges_;       ///< dimension -> tolerances
  std::map<std::uint64_t, std::vector<std::uint64_t>> represented_;  ///< property -> representations
  std::map<std::uint64_t, std::string> forms_;                       ///< tolerance -> form of its zone
  Pmi out_;
};

const std::set<std::string_view> Reader::kZones = {
    "ANGULARITY_TOLERANCE",      "CIRCULAR_RUNOUT_TOLERANCE", "COAXIALITY_TOLERANCE",
    "CONCENTRICITY_TOLERANCE",   "CYLINDRICITY_TOLERANCE",    "FLATNESS_TOLERANCE",
    "LINE_PROFILE_TOLERANCE",    "PARALLELISM_TOLERANCE",     "PERPENDICULARITY_TOLERANCE",
    "POSITION_TOLERANCE",        "ROUNDNESS_TOLERANCE",       "STRAIGHTNESS_TOLERANCE",
    "SURFACE_PROFILE_TOLERANCE", "SYMMETRY_TOLERANCE",        "TOTAL_RUNOUT_TOLERANCE"};

}  // namespace

Pmi read_pmi(const p21::File& file) { return Reader(file).read(); }

}  // namespace capstan::exchange
