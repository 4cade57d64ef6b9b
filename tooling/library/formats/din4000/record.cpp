#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/library/formats/din4000/codes.h"
#include "tooling/library/formats/din4000/din4000.h"

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
    derive();
    classify();
    contradictions();
    (void)gatherer_.take(std::move(item_), place_);
  }

 private:
  void take(const std::string& code, const std::string& text) {
    if (trimmed_text(text).empty()) return;
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
    // Makers write 0 for a mass or a speed they do not give.
    if ((c->symbol == "WT" || c->symbol == "RPMX") && (text == "0" || text == "0,0" || text == "0.0")) return;
    Place at = place_;
    at.path = r_.id + ", " + code;
    gatherer_.fault(
        add_value(item_, {c->symbol, text, c->unit, "DIN 4000-" + table_ + " " + code, true}, at));
  }

  void person(const std::string& code, const std::string& text) {
    if (code == "J23" || (code == "J22" && item_.description.empty())) item_.description = text;
    if (code == "J22" || code == "H4" || code == "H11") item_.kept.emplace_back(code, text);
    if (code == "J3" && item_.manufacturer.empty()) item_.manufacturer = text;
    if (code == "J21" && item_.id.empty()) item_.id = item_.product_id = text;
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
    const auto dc = number_of(item_, "DC");
    if (item_.cutter_class == CutterClass::kTap) {
      if (const auto size = number_of(item_, "TDZ"))
        add_derived(item_, "DC", *size, "mm", "A21: the nominal diameter of the thread", report_);
      if (!number_of(item_, "TP")) leave_out(item_, "the tap has no pitch (A3)", report_);
    } else if (!dc) {
      if (!gatherer_.has_fault())
        gatherer_.fault(place_, "the cutting diameter is missing", table_ == "81" ? "A11" : "A1");
    } else if (item_.cutter_class == CutterClass::kBallEndmill) {
      add_derived(item_, "RE", 0.5 * *dc, "mm", "half the diameter of a ball end mill", report_);
    }
    class_by_radius(item_);
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
};

}  // namespace

void read_record(const Record& record, const std::string& file, Imported& out, ItemGatherer& gatherer) {
  RecordReader(record, file, out, gatherer).read();
}

}  // namespace capstan::tooling::din4000
