#include "planner/files/exchange/brep/read_pmi.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "planner/files/exchange/brep/pmi_values.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/base/text.h"

// A statement names a shape aspect. Which faces an aspect is: those that a usage ties to it, and those of the
// aspects that a relationship makes parts of it. A datum is reached the other way, from its datum feature.

namespace capstan::exchange {
namespace {

using p21::Instance;
using p21::Kind;
using p21::Value;

constexpr double kUmPerMm = 1000.0;
/// Aspects that one statement may reach.
constexpr std::size_t kMostAspects = 100'000;
/// Faces that all aspects together may reach, each counted for each: 32 MiB.
constexpr std::size_t kMostFaces = 4'000'000;
constexpr const char* kTooMany = "it is of more shape aspects or faces than are followed";

class Reader {
 public:
  explicit Reader(const p21::File& file) : file_(file) { index(); }

  Pmi read() {
    for (const Instance& i : file_) {
      tick();
      if (is(i, "ANGULAR_SIZE") || is(i, "ANGULAR_LOCATION")) {
        unread(i, "angles are not read", is_limited(i.id()));
      } else if (const char* why = kind_not_read(i); why != nullptr) {
        unread(i, why, is_zone(i) || is_limited(i.id()));
      } else if (is_dimension(i)) {
        size(i);
      } else if (is_zone(i)) {
        zone(i);
      } else if (const auto p = as(i, "DATUM")) {
        if (!is(i, "COMMON_DATUM")) datum(i, *p);  // it is of others, which stand for themselves
      } else if (const auto t = as(i, "PROPERTY_DEFINITION")) {
        if (text_at(*t, 0) == "surface_condition") texture(i, *t);
      }
    }
    return std::move(out_);
  }

 private:
  void index() {
    for (const Instance& i : file_) {
      tick();
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
      if (const auto p = as(i, "PROJECTED_ZONE_DEFINITION")) {
        // The zone is inherited from TOLERANCE_ZONE_DEFINITION: first in a simple instance, apart in a
        // complex one.
        const auto apart = i.is_complex() ? i.part("TOLERANCE_ZONE_DEFINITION") : p;
        const auto zone = apart ? reference_at(*apart, 0) : std::nullopt;
        if (zone) projected_zones_.insert(*zone);
      }
      if (const auto p = as(i, "TOLERANCE_ZONE")) {
        const auto form = reference_at(*p, 5);
        const auto named = form ? file_.find(*form) : std::nullopt;
        const auto f = named ? as(*named, "TOLERANCE_ZONE_FORM") : std::nullopt;
        std::vector<std::uint64_t> of;
        if (p->size() > 4) references_in((*p)[4], of);
        for (const std::uint64_t t : of) {
          if (f) forms_[t] = text_at(*f, 0);
          zones_of_[t].push_back(i.id());
        }
      }
    }
  }

  void unread(const Instance& i, std::string why, bool has_tolerance = true) {
    std::string what(i.keyword());
    for (std::size_t k = 0; i.is_complex() && k < i.part_count(); ++k) {
      if (what.empty() || kZones.count(i.part(k).keyword) != 0) what = i.part(k).keyword;
    }
    out_.unread.push_back(
        {static_cast<std::int64_t>(i.id()), std::move(what), std::move(why), has_tolerance});
  }

  /// A dimension, whatever subtype of ISO 10303-47 or -242 it is.
  static bool is_dimension(const Instance& i) {
    return is(i, "DIMENSIONAL_SIZE") || is(i, "DIMENSIONAL_LOCATION") ||
           is(i, "DIRECTED_DIMENSIONAL_LOCATION");
  }

  /// Why a subtype of what is read says more than is read; nullptr: it does not.
  [[nodiscard]] const char* kind_not_read(const Instance& i) const {
    for (const auto& [keyword, why] : kNotRead) {
      if (is(i, keyword)) return why;
    }
    // As a simple instance its attributes are those of a size and of a datum feature, in no order we know.
    if (!i.is_complex() && i.keyword() == "DIMENSIONAL_SIZE_WITH_DATUM_FEATURE")
      return "a size that is a datum feature as well is read as a complex instance only";
    if (const auto of = zones_of_.find(i.id()); of != zones_of_.end()) {
      for (const std::uint64_t zone : of->second) {
        if (projected_zones_.count(zone) != 0) return "its zone is projected out of the feature";
      }
    }
    return nullptr;
  }

  /// Whether a dimension has deviations, a fit or limits.
  [[nodiscard]] bool is_limited(std::uint64_t dimension) const {
    if (ranges_.count(dimension) != 0) return true;
    for (const std::uint64_t id : values_of(dimension)) {
      const auto item = file_.find(id);
      if (item && lower_text(name_of(file_, *item)).ends_with(" limit")) return true;
    }
    return false;
  }

  struct Faces {
    std::vector<std::int64_t> ids;  ///< ascending, each once
    bool cut = false;               ///< there are more
  };

  /// The faces of an aspect.
  const Faces& faces_of(std::uint64_t aspect) {
    if (const auto known = faces_.find(aspect); known != faces_.end()) return known->second;
    std::set<std::int64_t> faces;
    std::set<std::uint64_t> seen;
    std::vector<std::uint64_t> pending{aspect};
    while (!pending.empty() && seen.size() < kMostAspects) {
      tick();
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
    Faces out;
    // What is left may be known already; only another aspect counts as more.
    out.cut = std::any_of(pending.begin(), pending.end(), [&](std::uint64_t a) { return !seen.count(a); }) ||
              faces.size() > kMostFaces - face_count_;
    if (!out.cut) {
      out.ids.assign(faces.begin(), faces.end());
      face_count_ += faces.size();
    }
    return faces_.emplace(aspect, std::move(out)).first->second;
  }

  /// False: the aspect reaches more than is followed.
  bool about(std::uint64_t aspect, StatedOf& s) {
    const Faces& faces = faces_of(aspect);
    s.faces = faces.ids;
    const auto i = file_.find(aspect);
    s.whole = i && (is(*i, "PRODUCT_DEFINITION_SHAPE") || is(*i, "PRODUCT_DEFINITION"));
    return !faces.cut;
  }

  /// The items of the representations of a dimension.
  [[nodiscard]] std::vector<std::uint64_t> values_of(std::uint64_t dimension) const {
    std::vector<std::uint64_t> items;
    const auto by = measures_.find(dimension);
    if (by == measures_.end()) return items;
    for (const std::uint64_t representation : by->second) {
      const auto r = file_.find(representation);
      const auto p = r ? as(*r, "SHAPE_DIMENSION_REPRESENTATION") : std::nullopt;
      const auto plain = r && !p && r->is_complex() ? r->part("REPRESENTATION") : p;
      if (plain && plain->size() > 1) references_in((*plain)[1], items);
    }
    return items;
  }

  void take_values(std::uint64_t dimension, StatedSize& s) const {
    for (const std::uint64_t id : values_of(dimension)) {
      tick();
      const auto item = file_.find(id);
      const auto mm = length_of(file_, id);
      if (!item || !mm) continue;
      const std::string name = lower_text(name_of(file_, *item));
      if (name == "upper limit") {
        s.greatest_mm = mm;
      } else if (name == "lower limit") {
        s.least_mm = mm;
      } else {
        s.nominal_mm = mm;
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
      s.lower_mm = lower ? length_of(file_, *lower) : std::nullopt;
      s.upper_mm = upper ? length_of(file_, *upper) : std::nullopt;
      if (s.lower_mm && s.upper_mm) return {};
      s.lower_mm = s.upper_mm = std::nullopt;
      return "a bound of its tolerance is no length";
    }
    const auto p = as(*range, "LIMITS_AND_FITS");
    if (!p) return "its tolerance is no tolerance_value and no limits_and_fits";
    std::string grade = text_at(*p, 2);
    if (lower_text(grade).starts_with("it")) grade.erase(0, 2);
    if (text_at(*p, 0).empty() || grade.empty()) return "its fit has no letter or no grade";
    s.fit = text_at(*p, 0) + grade;
    const std::string of = lower_text(text_at(*p, 1));
    if (!of.empty() && of != "shaft" && of != "hole")
      return "its fit is of \"" + of + "\", no hole and no shaft";
    // Where it is not stated the letter tells: ISO 286-1 writes those of holes in capitals.
    s.of_shaft = of.empty() ? s.fit.front() >= 'a' && s.fit.front() <= 'z' : of == "shaft";
    return {};
  }

  void size(const Instance& i) {
    StatedSize s;
    s.id = static_cast<std::int64_t>(i.id());
    s.line = i.line();
    bool cut = false;
    const auto take_faces = [&](std::uint64_t aspect, std::vector<std::int64_t>& to) {
      const Faces& faces = faces_of(aspect);
      to = faces.ids;
      cut = cut || faces.cut;
    };
    if (const auto p = as(i, "DIMENSIONAL_SIZE")) {
      s.kind = text_at(*p, 1);
      if (const auto of = reference_at(*p, 0)) take_faces(*of, s.faces);
    } else {
      // In a complex instance the name and the ends stand in its SHAPE_ASPECT_RELATIONSHIP.
      const auto l = i.is_complex() ? i.part("SHAPE_ASPECT_RELATIONSHIP") : i.parameters();
      if (!l) return unread(i, "its ends are missing", is_limited(i.id()));
      s.kind = text_at(*l, 0);
      if (const auto of = reference_at(*l, 2)) take_faces(*of, s.faces);
      if (const auto to = reference_at(*l, 3)) take_faces(*to, s.to);
    }
    take_values(i.id(), s);
    if (std::string why = take_range(i.id(), s); !why.empty()) return unread(i, std::move(why));
    const bool limited = is_limited(i.id());
    if (!s.nominal_mm && !s.least_mm) return unread(i, "it has no value that is a length", limited);
    if (s.nominal_mm.value_or(0.0) < 0.0 || s.least_mm.value_or(0.0) < 0.0)
      return unread(i, "its value is below 0", limited);
    if (cut) return unread(i, kTooMany, limited);
    out_.sizes.push_back(std::move(s));
  }

  static bool is_zone(const Instance& i) {
    if (i.is_complex()) return i.part("GEOMETRIC_TOLERANCE").has_value();
    const std::string_view k = i.keyword();
    return k == "GEOMETRIC_TOLERANCE" || k.starts_with("GEOMETRIC_TOLERANCE_WITH_") ||
           k.ends_with("_GEOMETRIC_TOLERANCE") || kZones.count(k) != 0;
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
    const auto mm = magnitude ? length_of(file_, *magnitude) : std::nullopt;
    if (!mm) return unread(i, "its magnitude is no length");
    if (*mm < 0.0) return unread(i, "its magnitude is below 0");
    z.value_mm = *mm;
    if (const auto of = reference_at(own, 3); of && !about(*of, z)) return unread(i, kTooMany);
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
    if (std::string why = take_datums(systems, z); !why.empty()) return unread(i, std::move(why));
    out_.zones.push_back(std::move(z));
  }

  static std::string no_datum(std::uint64_t id) {
    return "its datum reference #" + std::to_string(id) + " leads to no datum with a letter";
  }

  /// The letters of datum systems, or of datum references, which have their precedence. Why it has none;
  /// empty: it has.
  std::string take_datums(const std::vector<std::uint64_t>& systems, StatedZone& z) const {
    std::map<double, std::uint64_t> by_precedence;
    std::vector<std::uint64_t> compartments;
    for (const std::uint64_t id : systems) {
      const auto at = file_.find(id);
      if (!at) return no_datum(id);
      if (const auto system = as(*at, "DATUM_SYSTEM")) {
        const std::size_t before = compartments.size();
        const std::size_t n = at->is_complex() ? 0 : 4;
        if (system->size() > n) references_in((*system)[n], compartments);
        if (compartments.size() == before) return no_datum(id);
      } else if (const auto r = reference_of(*at)) {
        if (r->empty() || !(*r)[0].is_number())
          return "datum reference #" + std::to_string(id) + " has no precedence";
        if (!by_precedence.emplace((*r)[0].as_real(), id).second)
          return "datum reference #" + std::to_string(id) + " has the precedence of another";
      } else {
        compartments.push_back(id);
      }
    }
    for (const auto& [precedence, id] : by_precedence) compartments.push_back(id);
    for (const std::uint64_t compartment : compartments) {
      std::vector<std::string> letters;
      if (!take_letters(compartment, letters)) return no_datum(compartment);
      z.datums.push_back(std::move(letters));
    }
    return {};
  }

  /// A reference of ISO 10303-47: (precedence, datum).
  static std::optional<Value> reference_of(const Instance& i) {
    if (auto p = as(i, "DATUM_REFERENCE")) return p;
    return i.is_complex() ? std::nullopt : as(i, "REFERENCED_MODIFIED_DATUM");
  }

  /// False: it, or a part of it, leads to no datum.
  bool take_letters(std::uint64_t compartment, std::vector<std::string>& letters) const {
    std::set<std::uint64_t> seen;
    std::vector<std::uint64_t> pending{compartment};
    while (!pending.empty()) {
      tick();
      const std::uint64_t id = pending.back();
      pending.pop_back();
      const auto at = file_.find(id);
      if (!at) return false;
      if (!seen.insert(id).second) continue;  // A-A: several features of one datum
      std::vector<std::uint64_t> bases;
      if (is(*at, "COMMON_DATUM")) {
        if (const auto of = parts_.find(id); of != parts_.end()) bases = of->second;
      } else if (const auto d = as(*at, "DATUM")) {
        letters.push_back(letter_of(*at, *d));
        if (letters.back().empty()) return false;
        continue;
      } else if (const auto r = reference_of(*at)) {
        if (const auto base = reference_at(*r, 1)) bases.push_back(*base);
      } else {
        for (const char* keyword :
             {"DATUM_REFERENCE_COMPARTMENT", "DATUM_REFERENCE_ELEMENT", "GENERAL_DATUM_REFERENCE"}) {
          const auto p = as(*at, keyword);
          const std::size_t base = at->is_complex() ? 0 : 4;
          if (p && p->size() > base) references_in((*p)[base], bases);
        }
      }
      if (bases.empty()) return false;
      pending.insert(pending.end(), bases.rbegin(), bases.rend());
    }
    return !letters.empty();
  }

  static std::string letter_of(const Instance& i, const Value& p) {
    return i.is_complex() ? text_at(p, 0) : text_at(p, 4);
  }

  void datum(const Instance& i, const Value& p) {
    StatedDatum d;
    d.id = static_cast<std::int64_t>(i.id());
    d.line = i.line();
    d.letter = letter_of(i, p);
    std::vector<std::uint64_t> of{i.id()};
    if (const auto from = wholes_.find(i.id()); from != wholes_.end())
      of.insert(of.end(), from->second.begin(), from->second.end());
    std::set<std::int64_t> faces;
    for (const std::uint64_t feature : of) {
      const Faces& known = faces_of(feature);
      if (known.cut) return unread(i, kTooMany, false);
      faces.insert(known.ids.begin(), known.ids.end());
    }
    d.faces.assign(faces.begin(), faces.end());
    out_.datums.push_back(std::move(d));
  }

  void texture(const Instance& i, const Value& p) {
    StatedTexture t;
    t.id = static_cast<std::int64_t>(i.id());
    t.line = i.line();
    if (const auto of = reference_at(p, 2); of && !about(*of, t)) return unread(i, kTooMany);
    const auto by = represented_.find(i.id());
    bool any = false;
    for (const std::uint64_t r : by == represented_.end() ? std::vector<std::uint64_t>{} : by->second) {
      const auto representation = file_.find(r);
      if (!representation) continue;
      auto q = as(*representation, "SURFACE_TEXTURE_REPRESENTATION");
      if (representation->is_complex()) q = representation->part("REPRESENTATION");
      std::vector<std::uint64_t> items;
      if (q && q->size() > 1) references_in((*q)[1], items);
      t.method.clear();
      std::vector<std::uint64_t> parameters;
      for (const std::uint64_t id : items) {
        const auto item = file_.find(id);
        const auto d = item ? as(*item, "DESCRIPTIVE_REPRESENTATION_ITEM") : std::nullopt;
        if (d && text_at(*d, 0) == "measuring method") t.method = text_at(*d, 1);
        if (item && !d && number_of(*item)) parameters.push_back(id);
      }
      for (const std::uint64_t id : parameters) {
        tick();
        any = true;
        t.parameter = name_of(file_, *file_.find(id));
        const auto mm = length_of(file_, id);
        if (!mm || *mm <= 0.0) {
          unread(i, "its " + (t.parameter.empty() ? "value" : t.parameter) +
                        (mm ? " is not above 0" : " is no length"));
          continue;
        }
        t.value_um = *mm * kUmPerMm;
        out_.textures.push_back(t);
      }
    }
    if (!any) unread(i, "it has no value that is a length");
  }

  static const std::set<std::string_view> kZones;
  /// Subtypes that say more than their supertypes, and what.
  static const std::vector<std::pair<std::string_view, const char*>> kNotRead;

  const p21::File& file_;
  std::map<std::uint64_t, std::vector<std::uint64_t>> items_;        ///< aspect -> items of the shape
  std::map<std::uint64_t, std::vector<std::uint64_t>> parts_;        ///< aspect -> aspects
  std::map<std::uint64_t, std::vector<std::uint64_t>> wholes_;       ///< the other way
  std::map<std::uint64_t, std::vector<std::uint64_t>> measures_;     ///< dimension -> representations
  std::map<std::uint64_t, std::vector<std::uint64_t>> ranges_;       ///< dimension -> tolerances
  std::map<std::uint64_t, std::vector<std::uint64_t>> represented_;  ///< property -> representations
  std::map<std::uint64_t, std::string> forms_;                       ///< tolerance -> form of its zone
  std::map<std::uint64_t, std::vector<std::uint64_t>> zones_of_;     ///< tolerance -> its zones
  std::set<std::uint64_t> projected_zones_;
  std::map<std::uint64_t, Faces> faces_;  ///< of aspects that were followed
  std::size_t face_count_ = 0;            ///< of faces_
  Pmi out_;
};

const std::vector<std::pair<std::string_view, const char*>> Reader::kNotRead = {
    {"DIMENSIONAL_SIZE_WITH_PATH", "sizes along a path are not read"},
    {"DIMENSIONAL_LOCATION_WITH_PATH", "distances along a path are not read"},
    {"GEOMETRIC_TOLERANCE_WITH_DEFINED_UNIT", "tolerances for each unit of length or area are not read"},
    {"UNEQUALLY_DISPOSED_GEOMETRIC_TOLERANCE", "zones that are not in the middle are not read"}};

const std::set<std::string_view> Reader::kZones = {
    "ANGULARITY_TOLERANCE",      "CIRCULAR_RUNOUT_TOLERANCE", "COAXIALITY_TOLERANCE",
    "CONCENTRICITY_TOLERANCE",   "CYLINDRICITY_TOLERANCE",    "FLATNESS_TOLERANCE",
    "LINE_PROFILE_TOLERANCE",    "PARALLELISM_TOLERANCE",     "PERPENDICULARITY_TOLERANCE",
    "POSITION_TOLERANCE",        "ROUNDNESS_TOLERANCE",       "STRAIGHTNESS_TOLERANCE",
    "SURFACE_PROFILE_TOLERANCE", "SYMMETRY_TOLERANCE",        "TOTAL_RUNOUT_TOLERANCE"};

}  // namespace

Pmi read_pmi(const p21::File& file) { return Reader(file).read(); }

}  // namespace capstan::exchange
