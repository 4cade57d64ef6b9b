#include "casebase/record/case.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "casebase/record/encoding.h"
#include "casebase/record/fields.h"
#include "casebase/record/sha256.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"

namespace capstan::casebase {
namespace {

constexpr std::size_t kIdDigits = 32;
constexpr std::size_t kKeywordMax = 80, kTextMax = 1000;
constexpr double kLeastCutterMm = 0.01;  // below, no milling cutter or drill is made; default, unsourced
// A cutting speed in m/s, or a speed in 1/min taken for m/min, is caught. Default, unsourced.
constexpr double kRpmMax = 300000.0;

constexpr std::array<std::string_view, 3> kOrigins = {"measured", "entered", "simulated"};
constexpr std::array<std::string_view, 3> kVerdicts = {"unknown", "good", "bad"};
constexpr std::array<std::string_view, 5> kCoolants = {"unknown", "dry", "mist", "flood", "through"};

template <class E, std::size_t N>
std::optional<E> from_word(const std::array<std::string_view, N>& words, std::string_view word) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<E>(found - words.begin());
}

bool is_keyword(std::string_view text) {
  constexpr std::string_view kOthers = "_./+-";
  return !text.empty() && text.size() <= kKeywordMax && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kOthers.find(c) != std::string_view::npos;
  });
}

bool has_control_character(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
}

/// "2016-06-28T17:32:31Z"; a year from 1900 on, so that a clock that was never set is seen.
bool is_time(std::string_view text) {
  constexpr std::string_view kForm = "dddd-dd-ddTdd:dd:ddZ";
  if (text.size() != kForm.size()) return false;
  for (std::size_t i = 0; i < kForm.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kForm[i] == 'd' ? !digit : text[i] != kForm[i]) return false;
  }
  const auto two = [&](std::size_t i) { return (text[i] - '0') * 10 + (text[i + 1] - '0'); };
  return two(0) >= 19 && two(5) >= 1 && two(5) <= 12 && two(8) >= 1 && two(8) <= 31 && two(11) <= 23 &&
         two(14) <= 59 && two(17) <= 60;
}

std::string said(double v) { return std::isfinite(v) ? shortest(v) : "not a finite number"; }

using Fault = std::optional<std::string>;

Fault fault_of_number(const Field& f, double v, std::string_view what = {}) {
  if (v >= f.low && v <= f.high) return std::nullopt;
  return std::string(f.name) + std::string(what) + " is " + said(v) + ", outside " + shortest(f.low) +
         " to " + shortest(f.high);
}

Fault fault_of_text(const Field& f, const std::string& text) {
  const std::string name(f.name);
  switch (f.text) {
    case TextKind::kMaybeKeyword:
      if (text.empty()) return std::nullopt;
      [[fallthrough]];
    case TextKind::kKeyword:
      if (is_keyword(text)) return std::nullopt;
      return name + " is not a keyword of 1 to 80 letters, digits and _ . / + -";
    case TextKind::kTime:
      if (text.empty() || is_time(text)) return std::nullopt;
      return name + " is not a time like 2016-06-28T17:32:31Z";
    case TextKind::kSource:
      if (text.empty()) return name + " is empty";
      [[fallthrough]];
    case TextKind::kText:
      if (text.size() <= kTextMax && !has_control_character(text)) return std::nullopt;
      return name + " is longer than 1000 bytes or has control characters";
  }
  return std::nullopt;
}

Fault fault_of_figure(const Field& f, const std::optional<Figure>& figure) {
  if (!figure) return std::nullopt;
  if (auto fault = fault_of_number(f, figure->value)) return fault;
  if (!(figure->std_dev >= 0.0 && figure->std_dev <= f.high - f.low))
    return std::string(f.name) + " has a standard deviation of " + said(figure->std_dev);
  return std::nullopt;
}

Fault fault_of_series(const Field& f, const Series& series) {
  const std::string name(f.name);
  if (series.samples.size() > kMaxSamples)
    return name + " has more than " + std::to_string(kMaxSamples) + " samples; thin it out";
  if (series.samples.empty() && series.origin != Origin::kMeasured)
    return name + " has an origin, but no sample";
  double before = 0.0;
  for (const Sample& s : series.samples) {
    if (!(s.t_s >= before && s.t_s <= 1e9))
      return name + " has a time of " + said(s.t_s) + " s; times rise from 0";
    if (auto fault = fault_of_number(f, s.value, " at " + shortest(s.t_s) + " s")) return fault;
    before = s.t_s;
  }
  return std::nullopt;
}

Fault fault_of_field(const Field& f, const Case& c) {
  if (const auto* t = std::get_if<TextAt>(&f.at)) return fault_of_text(f, value(*t, c));
  if (const auto* n = std::get_if<NumberAt>(&f.at)) return fault_of_number(f, value(*n, c));
  if (const auto* n = std::get_if<CountAt>(&f.at)) return fault_of_number(f, value(*n, c));
  if (const auto* g = std::get_if<FigureAt>(&f.at)) return fault_of_figure(f, value(*g, c));
  if (const auto* s = std::get_if<SeriesAt>(&f.at)) return fault_of_series(f, value(*s, c));
  const WordAt& w = std::get<WordAt>(f.at);
  if (w.get(c).empty()) return std::string(f.name) + " is none of its words";
  return std::nullopt;
}

/// Why numbers that are possible one by one are impossible together.
Fault fault_together(const Case& c) {
  const double d = c.asked.cutter_diameter_mm;
  if (!(d >= kLeastCutterMm)) return "cutter_diameter_mm is " + said(d) + ": a case names its cutter";
  if (c.asked.teeth < 1) return "teeth is " + std::to_string(c.asked.teeth) + ": a case names its cutter";
  const double rpm = 1000.0 * c.bound.vc_m_min / (std::numbers::pi * d);
  if (!(rpm <= kRpmMax)) {
    return "vc_m_min " + shortest(c.bound.vc_m_min) + " on a diameter of " + shortest(d) + " mm would be " +
           trimmed(rpm, 0) + " 1/min; is the unit m/min";
  }
  if (c.bound.ae_mm > d * (1.0 + 1e-9))
    return "ae_mm " + shortest(c.bound.ae_mm) + " is wider than the cutter, " + shortest(d) + " mm";
  if (c.bound.fz_mm > d) return "fz_mm " + shortest(c.bound.fz_mm) + " is more than the cutter's diameter";
  // A simulation that says that it was measured would count as evidence.
  if (c.origin == Origin::kSimulated) {
    for (const Field& f : fields()) {
      const auto* g = std::get_if<FigureAt>(&f.at);
      if (g != nullptr && value(*g, c) && value(*g, c)->origin == Origin::kMeasured)
        return std::string(f.name) + " is measured, but the case is simulated";
    }
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_text(Origin o) {
  const auto i = static_cast<std::size_t>(o);
  return i < kOrigins.size() ? kOrigins[i] : std::string_view();
}
std::string_view to_text(Verdict v) {
  const auto i = static_cast<std::size_t>(v);
  return i < kVerdicts.size() ? kVerdicts[i] : std::string_view();
}
std::string_view to_text(Coolant c) {
  const auto i = static_cast<std::size_t>(c);
  return i < kCoolants.size() ? kCoolants[i] : std::string_view();
}
std::optional<Origin> origin_of(std::string_view word) { return from_word<Origin>(kOrigins, word); }
std::optional<Verdict> verdict_of(std::string_view word) { return from_word<Verdict>(kVerdicts, word); }
std::optional<Coolant> coolant_of(std::string_view word) { return from_word<Coolant>(kCoolants, word); }

bool is_of_calendar(std::string_view text) {
  if (!is_time(text)) return false;
  const auto two = [&](std::size_t i) { return (text[i] - '0') * 10 + (text[i + 1] - '0'); };
  return std::chrono::year_month_day{std::chrono::year{two(0) * 100 + two(2)},
                                     std::chrono::month{static_cast<unsigned>(two(5))},
                                     std::chrono::day{static_cast<unsigned>(two(8))}}
      .ok();
}

std::optional<std::string> fault_of(const Question& q) {
  Case c;
  c.asked = q;
  for (const Field& f : question_fields()) {
    if (auto fault = fault_of_field(f, c)) return fault;
  }
  return std::nullopt;
}

std::optional<std::string> fault_of(const Case& c) {
  for (const Field& f : fields()) {
    if (auto fault = fault_of_field(f, c)) return fault;
  }
  return fault_together(c);
}

std::optional<std::string> fault_of(const Remark& r) {
  for (const auto& [what, text] : {std::pair{"who said it", &r.by}, {"the reason", &r.reason}}) {
    if (!is_utf8(*text)) return std::string(what) + " is not UTF-8";
    if (text->size() > kTextMax || has_control_character(*text))
      return std::string(what) + " is longer than 1000 bytes or has control characters";
  }
  if (!r.time_utc.empty() && !is_time(r.time_utc)) return "the time is not one like 2016-06-28T17:32:31Z";
  if (!r.time_utc.empty() && !is_of_calendar(r.time_utc)) return "there is no day " + r.time_utc.substr(0, 10);
  return std::nullopt;
}

std::string id_of(const Case& c) {
  Case told;
  std::string text;
  if (c.origin == Origin::kSimulated && !c.from.plan_hash.empty()) {
    text = "capstan simulation 2\n";
    told.asked = c.asked;
    told.from.plan_hash = c.from.plan_hash;
    told.from.workingstep = c.from.workingstep;
  } else {
    text = "capstan case 2\n";
    told = c;
    told.observed.verdict = Verdict::kUnknown;
  }
  return sha256(text + encoded(told)).substr(0, kIdDigits);
}

}  // namespace capstan::casebase
