#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/library/formats/din4000/codes.h"
#include "tooling/library/formats/din4000/din4000.h"
#include "tooling/library/words/comment_words.h"

namespace capstan::tooling::din4000 {
namespace {

using model::CutterClass;

constexpr double kSlackMm = 0.05;  // files round to a tenth or a hundredth

class RecordReader {
 public:
  RecordReader(const Record& r, const std::string& file, Imported& out, ItemGatherer& gatherer)
      : r_(r), place_{file, r.line, r.id}, report_(out.report), gatherer_(gatherer) {}

  void read() {
    table_ = r_.table;
    for (const char* head : {"DIN4000-", "DIN 4000-", "DIN_4000-"})
      if (table_.starts_with(head)) table_ = table_.substr(std::string_view(head).size());
    item_.id = item_.product_id = r_.id;
    item_.manufacturer = r_.manufacturer;
    item_.kind = r_.figure.empty() ? r_.table : r_.table + " figure " + r_.figure;
    for (const auto& [code, text] : r_.values) take(code, text);
    if (item_.description.empty()) item_.description = item_.id;
    diameter_elsewhere();
    derive();
    classify();
    contradictions();
    (void)gatherer_.take(std::move(item_), place_);
  }

 private:
  void take(const std::string& code, const std::string& text) {
    if (trimmed_text(text).empty()) return;
    if (table_ == "82" && (code == "A2" || (mills_thread() && (code == "A1" || code == "A5")))) {
      item_.kept.emplace_back(code, text);  // see diameter_elsewhere
      return;
    }
    if (mills_thread() && code == "D32") {
      add("TP", code, text);
      return;
    }
    const Code* c = find_code(table_, code);
    if (c == nullptr) {
      item_.kept.emplace_back(code, text);
      report_.dropped.push_back(
          {item_.id, code, "no meaning known in " + r_.table + "; kept word for word: " + text});
      return;
    }
    if (c->symbol.empty()) {
      person(code, text);
      return;
    }
    // Makers write 0 for a mass or a speed they do not give, and for a hand.
    const bool zero = text == "0" || text == "0,0" || text == "0.0";
    if (zero && (c->symbol == "WT" || c->symbol == "RPMX")) return;
    if (zero && c->symbol == "HAND") {
      report_.dropped.push_back({item_.id, code, "0 is neither R, L nor N: no hand is given"});
      return;
    }
    add(c->symbol, code, text, c->unit);
  }

  void add(std::string_view symbol, const std::string& code, const std::string& text,
           std::string_view unit = "mm") {
    Place at = place_;
    at.path = r_.id + ", " + code;
    gatherer_.fault(add_value(item_, {symbol, text, unit, "DIN 4000-" + table_ + " " + code, true}, at));
  }

  void person(const std::string& code, const std::string& text) {
    if (code == "J23" || (code == "J22" && item_.description.empty())) item_.description = text;
    if (code == "J22" || code == "H4" || code == "H11") item_.kept.emplace_back(code, text);
    if (code == "J3" && item_.manufacturer.empty()) item_.manufacturer = text;
    if (code == "J21" && item_.id.empty()) item_.id = item_.product_id = text;
  }

  [[nodiscard]] bool mills_thread() const {
    return table_ == "82" && class_of(table_, r_.figure) == CutterClass::kThreadMill;
  }

  [[nodiscard]] bool is_end_mill() const {
    return table_ == "82" && class_of(table_, r_.figure) == CutterClass::kEndmill;
  }

  /// The cutting diameter of table 82 where A1 is not alone: of a thread mill A1 may name the thread ("M")
  /// and A5, else A2, is the diameter; of figures 1 and 2 A2 is it where A1 is missing, of others nobody
  /// knows. Two diameters say nothing.
  ///
  /// Source  a public importer of makers' files, github.com/danxdz/editool_python,
  ///         wx_gui/importTools/import_xml_wx.py: A2 for tools of its type 0, which figures 1 and 2 are, and
  ///         A5, else A2, with the pitch in D32, for thread mills.
  void diameter_elsewhere() {
    if (table_ != "82") return;
    const std::string* first = kept("A1");
    const bool is_number = first != nullptr && number_from(*first, place_, true).has_value();
    if (is_number) add("DC", "A1", *first);
    const bool known = find(item_.properties, "DC") != nullptr;
    const std::string* fifth = kept("A5");  // of a thread mill
    const std::string* other = fifth != nullptr ? fifth : kept("A2");
    if (other == nullptr) return;
    const std::string code = fifth != nullptr ? "A5" : "A2";
    if (!known && !mills_thread() && !is_end_mill()) {
      report_.dropped.push_back({item_.id, code,
                                 "no meaning known in figure '" + r_.figure + "' of " + r_.table +
                                     " without A1; kept word for word: " + *other});
    } else if (!known) {
      add("DC", code, *other);
      report_.derived.push_back({item_.id, "DC", code + ", as the file states no diameter in A1"});
    } else if (mills_thread()) {
      doubt_ = "A1 is " + *first + " and " + code + " is " + *other +
               ": which is its cutting diameter no source says";
    } else {
      report_.dropped.push_back(
          {item_.id, code, "no meaning known beside A1; kept word for word: " + *other});
    }
  }

  [[nodiscard]] const std::string* kept(std::string_view code) const { return find_kept(item_.kept, code); }

  void derive() {
    if (table_ == "82") {
      const auto around = number_of(item_, "PCEDC"), face = number_of(item_, "FCEDC");
      if (around && *around > 0.0) {
        add_derived(item_, "ZEFF", *around, "", "the peripheral edges (F21)", report_);
      } else if (face && *face > 0.0) {
        add_derived(item_, "ZEFF", *face, "", "the face edges (F22); F21 is not given", report_);
      }
    }
    // If the whole shank is clamped, the head is the stick-out.
    const auto head = number_of(item_, "LH");
    if (head && *head > 0.0)
      add_derived(item_, "LPR", *head, "mm", "B3: all but the shank stands out", report_);
    // The known codes: 0 none; 1 to 3 through the tool, along the axis, across it or slanting.
    if (const Property* coolant = find(item_.properties, "CXSC");
        coolant != nullptr && coolant->text.size() == 1) {
      const char code = coolant->text.front();
      if (code >= '0' && code <= '3')
        add_derived_text(item_, "CSP", code == '0' ? "false" : "true", "H22, exit of the coolant", report_);
    }
    substrate();
  }

  /// The body's material H4, or the cutting material H11 by ISO 513 and its German short form.
  void substrate() {
    const auto starts = [](const std::string* t, std::string_view head) {
      return t != nullptr && t->starts_with(head);
    };
    const std::string* body = kept("H4");
    const std::string* cutting = kept("H11");
    if (starts(cutting, "HSS") || starts(body, "HSS")) {
      add_derived_text(item_, "SUBSTRATE", "hss", "H11 or H4: high speed steel", report_);
    } else if (starts(cutting, "VHM") || starts(cutting, "HC") || starts(cutting, "HW") ||
               starts(cutting, "HM")) {
      add_derived_text(item_, "SUBSTRATE", "carbide", "H11 " + *cutting + ": hard metal (ISO 513)", report_);
    } else if (body != nullptr && *body == "H") {
      add_derived_text(item_, "SUBSTRATE", "carbide", "H4 H: hard metal", report_);
    }
  }

  void classify() {
    item_.cutter_class = class_of(table_, r_.figure);
    const std::string_view words = figure_words(table_, r_.figure);
    if (!item_.cutter_class) {
      if (words.empty()) {
        leave_out(item_, "what figure '" + r_.figure + "' of " + r_.table + " shows is not known", report_);
      } else {
        leave_out(item_, "a " + std::string(words) + " is no class of cutter, or its shape does not follow",
                  report_);
      }
      return;
    }
    if (!doubt_.empty()) {
      leave_out(item_, doubt_, report_);
      return;
    }
    const auto dc = number_of(item_, "DC");
    if (item_.cutter_class == CutterClass::kTap) {
      tap();
    } else if (!dc) {
      if (!gatherer_.has_fault())
        gatherer_.fault(place_, "the cutting diameter is missing", table_ == "81" ? "A11" : "A1");
    } else if (item_.cutter_class == CutterClass::kBallEndmill) {
      add_derived(item_, "RE", 0.5 * *dc, "mm", "half the diameter of a ball end mill", report_);
    }
    class_by_radius(item_);
  }

  /// What A21 and A3 leave out may be in its names: "M6".
  void tap() {
    const auto stated = number_of(item_, "TDZ");
    double size = stated.value_or(0.0);
    if (stated) {
      add_derived(item_, "DC", size, "mm", "A21: the nominal diameter of the thread", report_);
    } else {
      for (const std::string* words : {&item_.description, &item_.id}) {
        if (size > 0.0) break;
        size = thread_size_of_words(*words);
        if (size > 0.0) add_derived(item_, "DC", size, "mm", "from the words '" + *words + "'", report_);
      }
    }
    const auto pitch = [&](const std::string& words) {
      return sizes_of_words(words, CutterClass::kTap, size).pitch_mm > 0.0;
    };
    if (!(size > 0.0)) {
      leave_out(item_, "the tap has no size: neither A21 nor a thread such as 'M6' in its name", report_);
    } else if (!number_of(item_, "TP") && !pitch(item_.description) && !pitch(item_.id)) {
      leave_out(item_, "the tap has no pitch (A3)", report_);
    }
  }

  void contradict(const std::string& field, const std::string& what) {
    report_.dropped.push_back({item_.id, field, "the file contradicts itself: " + what});
  }

  /// Public files round and mix up lengths; contradictions are reported, the values stay as stated.
  void contradictions() {
    const auto oal = number_of(item_, "OAL"), ls = number_of(item_, "LS"), lh = number_of(item_, "LH");
    if (oal && ls && lh && *lh + *ls > *oal + kSlackMm)
      contradict("B3", "head " + mm_text(*lh) + " and shank " + mm_text(*ls) +
                           " together are longer than the tool, " + mm_text(*oal));
    const auto lu = number_of(item_, "LU");
    if (lu && lh && *lu > *lh + kSlackMm)
      contradict("LU", "the usable length " + mm_text(*lu) + " is longer than the head " + mm_text(*lh));
    const auto dn = number_of(item_, "DN"), dc = number_of(item_, "DC");
    if (dn && dc && *dn > *dc + 1e-9)
      contradict("A5", "the neck " + mm_text(*dn) + " is thicker than the cutting diameter " + mm_text(*dc));
    const auto sig = number_of(item_, "SIG"), pl = number_of(item_, "PL");
    if (sig && pl && dc && *sig > 0.0) {
      const double height = 0.5 * *dc / std::tan(0.5 * *sig);
      if (std::abs(height - *pl) > kSlackMm)
        contradict("B7", "a point of " + trimmed(*sig / kRadPerDegree, 1) + " deg is " + mm_text(height) +
                             " high, B7 says " + mm_text(*pl));
    }
    if (table_ == "82" && !number_of(item_, "APMX") && !number_of(item_, "LCF") && item_.cutter_class)
      report_.dropped.push_back({item_.id, "APMX", "the file states no length of cut (B2, B6)"});
  }

  const Record& r_;
  Place place_;
  LossReport& report_;
  ItemGatherer& gatherer_;
  CatalogueItem item_;
  std::string table_;
  std::string doubt_;  ///< why its sizes do not say what it is
};

}  // namespace

void read_record(const Record& record, const std::string& file, Imported& out, ItemGatherer& gatherer) {
  RecordReader(record, file, out, gatherer).read();
}

}  // namespace capstan::tooling::din4000
