#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "planner/files/exchange/exchange.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "tests/corpus/ap238/annexj.h"
#include "tests/support/corpus.h"
#include "tests/support/rows.h"

// The examples of ISO 10303-238 annex J say in comments which application object begins where and by which
// instances each attribute is reached: an oracle for the mapping tables, written by others.

namespace capstan::corpus {
namespace {

using model::AnyRef;
using model::Storage;

// The object of the model for a name of the standard, where they differ.
struct Name {
  const char* keyword;  ///< of the noun that stands at the instance
  const char* inside;   ///< attribute of it that holds the kind that the name says, and which
  const char* kind;
};
const std::map<std::string, Name>& names() {
  static const std::map<std::string, Name> kNames = {
      // The model follows ISO 14649: a tool is a milling_cutting_tool whose body has the kind.
      {"ENDMILL", {"MILLING_CUTTING_TOOL", "its_tool_body", "ENDMILL"}},
      {"DRILLING_CUTTING_TOOL", {"MILLING_CUTTING_TOOL", "its_tool_body", "DRILLING_CUTTING_TOOL"}},
      {"REAMING_CUTTING_TOOL", {"MILLING_CUTTING_TOOL", "its_tool_body", "REAMER"}},
      {"BIDIRECTIONAL", {"BIDIRECTIONAL_MILLING", nullptr, nullptr}},
      {"QUALIFIED_PLUS_MINUS_VALUE", {"PLUS_MINUS_VALUE", nullptr, nullptr}},
      // The file has a PERSON without an address.
      {"PERSON_AND_ADDRESS", {"PERSON", nullptr, nullptr}},
      {"REAL_VARIABLE", {"NC_VARIABLE", nullptr, nullptr}},
      {"ASSEMBLY", {"NEXT_ASSEMBLY_USAGE", nullptr, nullptr}},
  };
  return kNames;
}

// Where the model keeps an attribute, when its name differs; and what the file's number is multiplied by.
struct Place {
  std::string path;
  double factor = 1.0;
};
Place place_of(const std::string& object, const std::string& attribute) {
  static const std::map<std::string, Place> kPlaces = {
      {"EFFECTIVE_CUTTING_DIAMETER", {"its_tool_body.dimension.diameter"}},
      {"MAXIMUM_DEPTH_OF_CUT", {"its_tool_body.dimension.cutting_edge_length"}},
      {"HAND_OF_CUT", {"its_tool_body.hand_of_cut"}},
      {"COOLANT_THROUGH_TOOL", {"its_tool_body.coolant_through_tool"}},
      {"NUMBER_OF_EFFECTIVE_TEETH", {"its_tool_body.number_of_teeth"}},
      {"EDGE_RADIUS", {"its_tool_body.dimension.edge_radius"}},
      // ISO 14649's tool_top_angle is half of the point angle.
      {"POINT_ANGLE", {"its_tool_body.dimension.tool_top_angle", 0.5}},
      {"RAPID_SPEED", {"its_speed"}},
      {"WORKPIECE.ITS_SUBASSEMBLY", {"its_components"}},
      {"ASSEMBLY.CHILD_WORKPIECE", {"child_workpiece"}},
      {"APPROVAL.PURPOSE", {"level"}},
      {"APPROVAL_STATUS.STATUS_NAME", {"name"}},
      {"FREEFORM_OPERATION.ITS_TOOLPATH", {"its_toolpath.its_list"}},
      {"CLOSED_POCKET.BASE_RADIUS", {"planar_radius"}},
      {"TOLERANCED_LENGTH_MEASURE.UPPER_LIMIT", {"implicit_tolerance.upper_limit"}},
      {"TOLERANCED_LENGTH_MEASURE.LOWER_LIMIT", {"implicit_tolerance.lower_limit"}},
      {"TOLERANCED_LENGTH_MEASURE.VALUE_COMPONENT", {"theoretical_size"}},
  };
  for (const std::string& key : {object + "." + attribute, attribute}) {
    if (const auto at = kPlaces.find(key); at != kPlaces.end()) return at->second;
  }
  std::string lower;
  for (const char c : attribute) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return {lower};
}

/// What the comments name and this test does not compare.
struct Exception {
  std::string object, attribute;  ///< an empty attribute: the whole object
  std::string comment;            ///< only where the comment gives this text; empty: whatever it gives
};
std::string key_of(const Exception& e) {
  return e.attribute.empty() ? e.object : e.object + "." + e.attribute;
}
using Exceptions = std::vector<Exception>;
const Exceptions& exceptions() {
  static const Exceptions kRows = [] {
    Exceptions out;
    for (testing::DataRow& row : testing::data_rows("tests/corpus/ap238/annexj_exceptions.csv"))
      out.push_back({row["object"], row["attribute"], row["comment"]});
    return out;
  }();
  return kRows;
}
bool excepts(const Exceptions& rows, const std::string& object, const NamedAttribute* attribute) {
  return std::any_of(rows.begin(), rows.end(), [&](const Exception& e) {
    if (e.object != object) return false;
    if (e.attribute.empty()) return true;
    return attribute != nullptr && e.attribute == attribute->name &&
           (e.comment.empty() || e.comment == attribute->text);
  });
}

std::string same_letters(std::string s) {
  for (char& c : s) c = c == '_' ? ' ' : c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return s;
}

// Texts that stand for true and false.
const std::set<std::string>& true_texts() {
  static const std::set<std::string> kTexts = {"required",
                                               "true",
                                               "multiple passes allowed",
                                               "coolant on",
                                               "chip removal on",
                                               "through spindle coolant on",
                                               "supported",
                                               "synchronized",
                                               "override not allowed"};
  return kTexts;
}
const std::set<std::string>& false_texts() {
  static const std::set<std::string> kTexts = {"not required",
                                               "false",
                                               "multiple passes not allowed",
                                               "coolant off",
                                               "chip removal off",
                                               "through spindle coolant off",
                                               "not supported",
                                               "not synchronized",
                                               "override allowed"};
  return kTexts;
}
// An enumerator of the model for a text of AP238, where the letters differ.
std::string enumerator_text(const std::string& text) {
  static const std::map<std::string, std::string> kTexts = {
      {"tool center point", "tcp"}, {"clockwise", "cw"}, {"counterclockwise", "ccw"}};
  const auto at = kTexts.find(text);
  return at == kTexts.end() ? text : at->second;
}

class Oracle {
 public:
  Oracle(const p21::File& file, const model::Plan& plan, const std::vector<NamedObject>& named,
         const Exceptions& but)
      : file_(file), m_(plan.model), named_(named), but_(but) {
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      for (const AnyRef at : m_.all(static_cast<model::TypeId>(t))) at_[m_.origin(at).instance].push_back(at);
    }
  }

  void compare(const NamedObject& o) {
    what_ = o.name + " (#" + std::to_string(o.at) + ")";
    const AnyRef at = object(o);
    if (!at.set()) return;
    std::map<std::string, std::vector<const NamedAttribute*>> lists;
    for (const NamedAttribute& a : o.attributes) {
      if (excepts(but_, o.name, &a)) continue;
      if (!a.index.empty()) {
        lists[a.name].push_back(&a);
      } else {
        attribute(o, a, at);
      }
    }
    for (const auto& [name, items] : lists) list(o, name, items, at);
  }
  /// A tolerance without limits: QUALIFIED_REPRESENTATION_ITEM($).
  [[nodiscard]] bool says_nothing(const NamedObject& o) const {
    const auto i = file_.find(o.at);
    const auto q = i ? i->part("QUALIFIED_REPRESENTATION_ITEM") : std::nullopt;
    return o.name == "QUALIFIED_PLUS_MINUS_VALUE" && q && (*q)[0].is(p21::Kind::kOmitted);
  }

  [[nodiscard]] const std::vector<std::string>& found() const { return found_; }
  [[nodiscard]] std::size_t compared() const { return compared_; }

 private:
  void differ(const std::string& attribute, const std::string& how) {
    found_.push_back(what_ + (attribute.empty() ? "" : "." + attribute) + ": " + how);
  }

  // The instance of the application object that an attribute refers to: behind an assignment, in front of
  // the person it assigns, inside a profile that the model does without.
  [[nodiscard]] std::uint64_t target(const NamedAttribute& named) const {
    const auto i = file_.find(named.at);
    if (!i) return named.at;
    const auto parameter = [&](std::size_t k) { return i->parameters()[k].reference(); };
    if (i->keyword() == "APPLIED_APPROVAL_ASSIGNMENT") return parameter(0);
    if (i->keyword() == "ITEM_DEFINED_TRANSFORMATION") return parameter(3);
    if (i->keyword() == "PERSON_AND_ORGANIZATION" && named.name == "REVISION_PEOPLE") return named.before;
    if (i->keyword() == "CIRCULAR_CLOSED_PROFILE") {
      for (const NamedObject& o : named_) {
        for (const NamedAttribute& a : o.attributes) {
          if (o.at == named.at && a.name == "DIAMETER") return a.at;
        }
      }
    }
    return named.at;
  }

  AnyRef object(const NamedObject& o) {
    ++compared_;
    const auto it = names().find(o.name);
    const std::string keyword = it == names().end() ? o.name : it->second.keyword;
    std::string there;
    for (const AnyRef at : at_[o.at]) {
      const std::string_view k = model::noun_type(at.type).keyword;
      const auto type = model::find_noun(keyword);
      if (!type || !model::is_a(at.type, *type)) {
        there += " " + std::string(k);
        continue;
      }
      if (it != names().end() && it->second.inside != nullptr) {
        const auto* a = model::find_attribute(at.type, it->second.inside);
        const AnyRef inner = a == nullptr ? AnyRef{} : model::value_of<AnyRef>(*a, m_.object(at));
        const std::string kind = inner.set() ? std::string(model::noun_type(inner.type).keyword) : "nothing";
        if (kind != it->second.kind) differ(it->second.inside, kind + " and not " + it->second.kind);
      }
      return at;
    }
    differ("", "is" + (there.empty() ? " nothing" : there));
    return {};
  }

  // The attribute at the end of a dotted path; null after saying so.
  const model::Attribute* find(const std::string& name, const std::string& path, AnyRef& at) {
    std::size_t from = 0;
    while (true) {
      const auto dot = path.find('.', from);
      const auto part = path.substr(from, dot == std::string::npos ? dot : dot - from);
      const auto* a = at.set() ? model::find_attribute(at.type, part) : nullptr;
      if (a == nullptr) {
        differ(name, "the model has no " + path);
        return nullptr;
      }
      if (dot == std::string::npos) return a;
      at = model::value_of<AnyRef>(*a, m_.object(at));
      from = dot + 1;
    }
  }

  void attribute(const NamedObject& o, const NamedAttribute& named, AnyRef at) {
    ++compared_;
    if (o.name == "APPROVING_PERSON_ORGANIZATION" && named.name == "AUTHORIZED_APPROVAL")
      return authorized(named, at);
    const Place place = place_of(o.name, named.name);
    const auto* a = find(named.name, place.path, at);
    if (a == nullptr) return;
    const void* data = m_.object(at);
    // A measure without a value says nothing.
    const bool nothing = is_measure(file_, named.at) && std::isnan(plain_value(file_, named.at));
    if (!model::has_value(*a, data)) {
      if (!nothing) differ(named.name, "unset");
      return;
    }
    if (nothing) return differ(named.name, "set, and the file says nothing");
    value(named, *a, data, place.factor);
  }

  // The model has it the other way: an approval names its approvers.
  void authorized(const NamedAttribute& named, AnyRef approver) {
    for (const AnyRef at : at_[named.at]) {
      const auto* approval = m_.get<model::Approval>(at);
      if (approval == nullptr) continue;
      const auto& approvers = approval->approvers.items;
      if (std::find(approvers.begin(), approvers.end(), approver) != approvers.end()) return;
    }
    differ(named.name, "is not among the approvers of #" + std::to_string(named.at));
  }

  void value(const NamedAttribute& named, const model::Attribute& a, const void* data, double factor) {
    const std::string text = same_letters(named.text);
    switch (a.storage) {
      case Storage::kText:
        if (const auto& v = *model::value_of<model::Text>(a, data); v != named.text)
          differ(named.name, "'" + v + "' and not '" + named.text + "'");
        return;
      case Storage::kReal:
      case Storage::kInteger: {
        const double v = a.storage == Storage::kReal
                             ? *model::value_of<model::Real>(a, data)
                             : static_cast<double>(*model::value_of<model::Integer>(a, data));
        double want = named.has_text ? parse_double(named.text).value_or(NAN) : plain_value(file_, named.at);
        const bool per_minute = a.unit == model::Unit::kSpeed || a.unit == model::Unit::kRotSpeed;
        if (!named.has_text && per_minute) want *= 60.0;
        want *= factor;
        // 75 for three quarters: the file's ratios of cuts at a hole's ends are percent, and read as such
        // (EXC-RATIO).
        if (a.unit == model::Unit::kRatio && want >= 10.0) want /= 100.0;
        if (!(std::abs(v - want) <= 1e-9 * std::max(1.0, std::abs(want))))
          differ(named.name, std::to_string(v) + " and not " + std::to_string(want));
        return;
      }
      case Storage::kBoolean: {
        const bool v = *model::value_of<model::Boolean>(a, data);
        if (!(v ? true_texts() : false_texts()).contains(text))
          differ(named.name, std::string(v ? "true" : "false") + " and not '" + named.text + "'");
        return;
      }
      case Storage::kEnum: {
        const auto code = static_cast<std::size_t>(model::value_of<model::AnyEnum>(a, data).code);
        const std::string v = same_letters(std::string(a.enumerators[code]));
        if (v != enumerator_text(text)) differ(named.name, v + " and not '" + named.text + "'");
        return;
      }
      case Storage::kRef:
        return refers(named, model::value_of<AnyRef>(a, data));
      case Storage::kSelect: {
        const auto& v = model::value_of<model::SelectValue>(a, data);
        if (v.ref.set()) return refers(named, v.ref);
        // rapid_speed 'true' is toolpath_speedprofile RAPID of ISO 14649.
        const bool rapid = named.name == "RAPID_SPEED" && text == "true" && v.text == "RAPID";
        if (!rapid) differ(named.name, v.text + " and not '" + named.text + "'");
        return;
      }
      default:
        // A list that the comment names as one reference.
        list_value({&named}, a, data, true);
    }
  }

  void refers(const NamedAttribute& named, AnyRef to) {
    // A file's measure may be an object of the model: it stands at the same instance.
    if (!to.set()) return differ(named.name, "refers to nothing");
    if (m_.origin(to).instance != target(named))
      differ(named.name, "refers to #" + std::to_string(m_.origin(to).instance) + " " +
                             std::string(model::noun_type(to.type).keyword) + " and not to #" +
                             std::to_string(target(named)));
  }

  void list(const NamedObject& o, const std::string& name, const std::vector<const NamedAttribute*>& named,
            AnyRef at) {
    ++compared_;
    const auto* a = find(name, place_of(o.name, name).path, at);
    if (a == nullptr) return;
    if (!model::has_value(*a, m_.object(at))) return differ(name, "unset");
    list_value(named, *a, m_.object(at), false);
  }

  void list_value(const std::vector<const NamedAttribute*>& named, const model::Attribute& a,
                  const void* data, bool any) {
    const std::string& name = named.front()->name;
    std::vector<AnyRef> items;
    if (a.storage == Storage::kRefList) {
      items = model::value_of<model::AnyRefList>(a, data).items;
    } else if (a.storage == Storage::kRef) {
      items = {model::value_of<AnyRef>(a, data)};
    } else {
      return differ(name, "is no list of objects");
    }
    // its_operations is a set: the comment names one operation by two ways.
    std::multiset<std::uint64_t> want, have;
    for (const auto* n : named) {
      if (name != "ITS_OPERATIONS" || !want.contains(target(*n))) want.insert(target(*n));
    }
    for (const AnyRef r : items) have.insert(m_.origin(r).instance);
    if (any ? !have.contains(target(*named.front())) : want != have) {
      std::string text;
      for (const auto n : have) text += " #" + std::to_string(n);
      differ(name, "leads to" + (text.empty() ? " nothing" : text));
      return;
    }
    for (const auto* n : named) {
      if (n->index.empty() || n->index == "*") continue;
      const auto k = static_cast<std::size_t>(std::stoul(n->index));
      if (k == 0 || k > items.size() || m_.origin(items[k - 1]).instance != target(*n))
        differ(name, "[" + n->index + "] is another");
    }
  }

  const p21::File& file_;
  const model::Model& m_;
  const std::vector<NamedObject>& named_;
  const Exceptions& but_;
  std::map<std::uint64_t, std::vector<AnyRef>> at_;
  std::string what_;
  std::vector<std::string> found_;
  std::size_t compared_ = 0;
};

struct Example {
  const char* name;
  const char* file;
  std::size_t objects;  ///< that comments name and that are no exceptions
};
void PrintTo(const Example& e, std::ostream* out) { *out << e.name; }

class AnnexJ : public ::testing::TestWithParam<Example> {
 protected:
  static std::string path() { return testing::corpus_folder() + "/ap238/" + GetParam().file; }
};

#define CAPSTAN_ANNEX_J()               \
  CAPSTAN_CORPUS_FILE(unused, "ap238"); \
  (void)unused

// "ENDMILL (#10).ITS_ID: unset" -> {"ENDMILL.ITS_ID", "ENDMILL"}
std::pair<std::string, std::string> keys_of(const std::string& difference) {
  const std::string object = difference.substr(0, difference.find(" (#"));
  const auto dot = difference.find(").");
  const auto colon = difference.find(": ");
  if (dot == std::string::npos || dot > colon) return {object, object};
  return {object + "." + difference.substr(dot + 2, colon - dot - 2), object};
}

TEST_P(AnnexJ, EveryObjectAndAttributeThatItsCommentsNameIsDecoded) {
  CAPSTAN_ANNEX_J();
  const std::string text = testing::slurp(path());
  std::vector<std::string> odd;
  const auto named = named_objects(text, odd);
  EXPECT_THAT(odd, ::testing::IsEmpty());
  Job job;
  const auto file = p21::parse(text, GetParam().file, {}, job);
  ASSERT_TRUE(file);
  const auto plan = exchange::read_ap238(*file, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  Oracle oracle(*file, *plan, named, exceptions());
  std::size_t objects = 0;
  for (const NamedObject& o : named) {
    if (excepts(exceptions(), o.name, nullptr) || oracle.says_nothing(o)) continue;
    ++objects;
    oracle.compare(o);
  }
  EXPECT_EQ(objects, GetParam().objects);
  EXPECT_THAT(oracle.found(), ::testing::IsEmpty());
  RecordProperty("compared", static_cast<int>(oracle.compared()));
}

TEST_P(AnnexJ, NothingIsUnexplained) {
  CAPSTAN_ANNEX_J();
  Job job;
  const auto plan = exchange::read(path(), job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  std::set<std::string> kept;
  for (const auto& d : job.diagnostics()) {
    EXPECT_LT(d.severity, Severity::kError) << to_text(d);
    if (d.code == "EXC-KEPT") kept.insert(d.message.substr(0, d.message.find(" is kept")));
  }
  EXPECT_THAT(kept, ::testing::IsEmpty());
}

const std::vector<Example>& examples() {
  static const std::vector<Example> kAll = {{"cc1", "ap238e4dis_annexJ_cc1.stp", 22},
                                            {"cc2", "ap238e4dis_annexJ_cc2.stp", 40},
                                            {"cc3", "ap238e4dis_annexJ_cc3.stp", 55}};
  return kAll;
}

// What the same comparison finds without the exceptions: each of them stands for a difference.
TEST(CorpusAnnexJExceptions, AreEachStillNeeded) {
  CAPSTAN_CORPUS_FILE(folder, "ap238");
  std::vector<std::string> differences;
  for (const Example& e : examples()) {
    const std::string text = testing::slurp(folder + "/" + e.file);
    std::vector<std::string> odd;
    const auto named = named_objects(text, odd);
    Job job;
    const auto file = p21::parse(text, e.file, {}, job);
    ASSERT_TRUE(file);
    const auto plan = exchange::read_ap238(*file, job);
    ASSERT_TRUE(plan) << to_text(plan.error());
    const Exceptions none;
    Oracle oracle(*file, *plan, named, none);
    for (const NamedObject& o : named) oracle.compare(o);
    differences.insert(differences.end(), oracle.found().begin(), oracle.found().end());
  }
  std::set<std::string> rows;
  ASSERT_FALSE(exceptions().empty());
  for (const Exception& e : exceptions()) {
    EXPECT_TRUE(rows.insert(key_of(e)).second) << key_of(e) << " stands twice";
    EXPECT_TRUE(std::any_of(differences.begin(), differences.end(),
                            [&](const std::string& difference) {
                              const auto [key, object] = keys_of(difference);
                              const bool of_row = e.attribute.empty() ? object == e.object : key == key_of(e);
                              return of_row && (e.comment.empty() ||
                                                difference.find("'" + e.comment + "'") != std::string::npos);
                            }))
        << key_of(e) << " is compared now: take it from annexj_exceptions.csv";
  }
}

INSTANTIATE_TEST_SUITE_P(Files, AnnexJ, ::testing::ValuesIn(examples()),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace capstan::corpus
