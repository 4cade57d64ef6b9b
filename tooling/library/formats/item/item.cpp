#include "tooling/library/formats/item/item.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/text.h"
#include "tooling/library/formats/item/iso_names.h"

namespace capstan::tooling {
namespace {

constexpr double kSlackMm = 1e-9;

/// Files give weights in grams, too; ours are in kilograms.
std::optional<double> kg_per_unit(std::string_view unit) {
  const std::string u = lower_text(unit);
  if (u == "kg") return 1.0;
  if (u == "g") return 1e-3;
  if (u == "lb") return 0.45359237;
  return std::nullopt;
}

/// Speeds are in revolutions per minute; one per second would be sixty times as fast.
bool per_minute(std::string_view unit) {
  const std::string u = lower_text(unit);
  return u.empty() || u == "1/min" || u == "r/min" || u == "rev/min" || u == "rpm" || u == "min-1";
}

std::optional<Diagnostic> weight(const StatedValue& v, const Place& place, Property& out) {
  const auto factor = kg_per_unit(v.unit);
  if (!factor)
    return fault_at(place, "DATA-UNIT",
                    v.unit.empty() ? "the unit of WT is missing"
                                   : "the unit '" + std::string(v.unit) + "' is none of weights",
                    "kg, g or lb");
  const auto number = number_from(v.text, place, v.decimal_comma);
  if (!number) return number.error();
  if (*number < 0.0) return fault_at(place, "TOOL-VALUE", "WT (weight) is " + std::string(v.text), "from 0");
  out = number_property("WT", *number * *factor, "", ValueState::kStated, v.source);
  out.text = trimmed_text(v.text);
  std::ranges::replace(out.text, ',', '.');
  out.unit = v.unit;
  return std::nullopt;
}

}  // namespace

std::optional<Diagnostic> add_value(CatalogueItem& item, const StatedValue& value, const Place& place) {
  if (trimmed_text(value.text).empty()) return std::nullopt;
  const IsoName* name = find_symbol(value.symbol);
  const std::string symbol(name == nullptr ? value.symbol : name->symbol);
  Property p;
  if (symbol == "RPMX" && !per_minute(value.unit))
    return fault_at(place, "DATA-UNIT", "the unit '" + std::string(value.unit) + "' is none of speeds",
                    "1/min");
  if (symbol == "WT") {
    if (auto d = weight(value, place, p)) return d;
  } else if (symbol_fact(symbol) != nullptr) {
    auto read = property_from(symbol, value.text, value.unit, value.source, place, value.decimal_comma);
    if (!read) return read.error();
    p = *std::move(read);
    p.text = trimmed_text(p.text);
  } else {
    p = text_property(symbol, trimmed_text(value.text), value.source);
    p.unit = value.unit;
    if (auto read = property_from(symbol, value.text, value.unit, "", place, value.decimal_comma)) {
      p.number = read->number;
      p.text = read->text;
    }
  }
  if (const Property* other = find(item.properties, symbol)) {
    if (other->number == p.number && (p.number || other->text == p.text)) return std::nullopt;
    return fault_at(place, "TOOL-VALUE", symbol + " is given twice: " + other->text + " and " + p.text,
                    "one value");
  }
  if (symbol == "DC" && mm_per_unit_of(value.unit) == kMmPerInch) item.inches = true;
  item.properties.push_back(std::move(p));
  return std::nullopt;
}

void add_derived(CatalogueItem& item, std::string_view symbol, double number, std::string_view unit,
                 std::string why, LossReport& report) {
  if (find(item.properties, symbol) != nullptr) return;
  item.properties.push_back(number_property(symbol, number, unit, ValueState::kDerived, why));
  report.derived.push_back({item.id, std::string(symbol), std::move(why)});
}

void add_derived_text(CatalogueItem& item, std::string_view symbol, std::string_view text, std::string why,
                      LossReport& report) {
  if (find(item.properties, symbol) != nullptr) return;
  Property p = text_property(symbol, text, why);
  p.state = ValueState::kDerived;
  item.properties.push_back(std::move(p));
  report.derived.push_back({item.id, std::string(symbol), std::move(why)});
}

std::vector<std::string> item_faults(const CatalogueItem& item) {
  std::vector<std::string> out;
  const auto dc = number_of(item, "DC"), re = number_of(item, "RE"), oal = number_of(item, "OAL");
  if (dc && *dc == 0.0) out.emplace_back("the cutting diameter (DC) is zero");
  if (dc && *dc > 0.0 && re && *re > 0.5 * *dc + kSlackMm)
    out.push_back("the corner radius " + mm_text(*re, 4) + " is larger than half the cutting diameter " +
                  mm_text(*dc, 4));
  for (const char* symbol : {"APMX", "LCF", "LU"}) {
    const auto l = number_of(item, symbol);
    if (l && oal && *l > *oal + kSlackMm)
      out.push_back("the flutes (" + std::string(symbol) + " " + mm_text(*l, 4) +
                    ") are longer than the tool (" + mm_text(*oal, 4) + ")");
  }
  if (number_of(item, "ZEFF") == 0.0 && item.cutter_class != model::CutterClass::kTouchProbe)
    out.emplace_back("the tool has 0 teeth (ZEFF)");
  if (const Property* hand = find(item.properties, "HAND"))
    if (hand->text != "R" && hand->text != "L" && hand->text != "N" && hand->text != "left" &&
        hand->text != "right")
      out.push_back("the hand '" + hand->text + "' is neither R, L nor N");
  return out;
}

void leave_out(CatalogueItem& item, const std::string& why, LossReport& report) {
  item.cutter_class.reset();
  item.kept.emplace_back(kLeftOut, why);
  report.dropped.push_back({item.id, "class", "not used for planning: " + why});
}

void class_by_radius(CatalogueItem& item) {
  const auto dc = number_of(item, "DC"), re = number_of(item, "RE");
  if (item.cutter_class != model::CutterClass::kEndmill || !dc || !re || *re <= 0.0) return;
  item.cutter_class = std::abs(*re - 0.5 * *dc) <= kSlackMm ? model::CutterClass::kBallEndmill
                                                            : model::CutterClass::kBullnoseEndmill;
}

void ItemGatherer::fault(const Place& place, std::string what, std::string expected) {
  pending_.push_back(fault_at(place, code_, std::move(what), std::move(expected)));
}

bool ItemGatherer::take(CatalogueItem item, const Place& place) {
  if (pending_.empty())
    for (std::string& what : item_faults(item)) fault(place, std::move(what));
  if (pending_.empty()) {
    if (!ids_.insert(item.id).second && !duplicate_)
      duplicate_ = fault_at(place, "TOOL-ID", "the tool '" + item.id + "' is given twice", "each tool once");
    ++out_.report.tools;
    out_.library.items.push_back(std::move(item));
    return true;
  }
  for (Diagnostic& d : pending_) {
    if (d.path.empty()) d.path = item.id;
    out_.report.dropped.push_back({item.id, "", d.message});
    dropped_.push_back(std::move(d));
  }
  pending_.clear();
  return false;
}

Status ItemGatherer::finish(std::string_view what_the_file_should_hold) {
  if (duplicate_) return fail(*duplicate_);
  if (out_.library.items.empty()) {
    if (!dropped_.empty()) return fail(dropped_.front());
    return fail(
        fault_at({file_, 0, {}}, code_, "the file holds no tool", std::string(what_the_file_should_hold)));
  }
  for (Diagnostic d : dropped_) {
    d.severity = Severity::kWarning;
    d.message += "; the tool is left out";
    job_.report(std::move(d));
  }
  return {};
}

}  // namespace capstan::tooling
