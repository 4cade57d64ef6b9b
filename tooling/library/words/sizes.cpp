#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/words/comment_words.h"

// Sizes that people write into the names and comments of tools.

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

constexpr double kSameSize = 0.03;                    // of the nominal size; M6 and 1/4 in lie 6 % apart
constexpr double kCoarsestOfSize = 0.26;              // pitch by nominal size: M1 has 0.25 mm, ISO 261
constexpr double kFewestTpi = 3.0, kMostTpi = 120.0;  // threads per inch; default, unsourced
constexpr double kLeastIncludedDeg = 60.0;            // below it "45 deg" may as well be meant of one side

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) { return c >= 'a' && c <= 'z'; }

/// In lower case, with a point where a number has a comma.
std::string plain_words(std::string_view s) {
  std::string out = lower_text(s);
  for (std::size_t i = 1; i + 1 < out.size(); ++i) {
    if (out[i] == ',' && digit(out[i - 1]) && digit(out[i + 1])) out[i] = '.';
  }
  return out;
}

class Scan {
 public:
  explicit Scan(const std::string& text, std::size_t at = 0) : text_(text), at_(at) {}
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  [[nodiscard]] char before() const { return at_ > 0 ? text_[at_ - 1] : '\0'; }
  [[nodiscard]] bool end() const { return at_ >= text_.size(); }
  [[nodiscard]] std::size_t at() const { return at_; }
  void step(std::size_t n = 1) { at_ += n; }
  void spaces() {
    while (peek() == ' ' || peek() == '_' || peek() == ':' || peek() == '=') step();
  }
  bool word(std::string_view w) {
    if (text_.compare(at_, w.size(), w) != 0) return false;
    step(w.size());
    return true;
  }
  /// Digits with a point at most, without a sign.
  std::optional<double> number() {
    std::size_t end = at_;
    bool point = false;
    while (end < text_.size() && (digit(text_[end]) || (text_[end] == '.' && !point))) {
      point = point || text_[end] == '.';
      ++end;
    }
    auto v = parse_double(std::string_view(text_).substr(at_, end - at_));
    if (!v && end > at_ && text_[end - 1] == '.')
      v = parse_double(std::string_view(text_).substr(at_, end - at_ - 1));
    if (!v && end > at_ + 1 && text_[at_] == '.') v = parse_double("0" + text_.substr(at_, end - at_));
    if (v) at_ = end;
    return v;
  }
  /// A number and, where one follows, its unit; mm.
  std::optional<double> length(double mm_per_unit) {
    const auto v = number();
    if (!v) return v;
    spaces();
    if (word("mm")) return *v;
    if (peek() == '"' || (word("in") && !letter(peek()))) return *v * kMmPerInch;
    return *v * mm_per_unit;
  }

 private:
  const std::string& text_;
  std::size_t at_;
};

bool same_size(double a, double b) { return std::abs(a - b) <= kSameSize * a; }

/// Taps are as wide as their thread, thread mills narrower.
bool may_cut(double nominal_mm, CutterClass c, double diameter_mm) {
  return c == CutterClass::kTap ? same_size(nominal_mm, diameter_mm) : diameter_mm < nominal_mm;
}

double coarse_pitch(double nominal_mm) {
  const auto& generic = shared_generic_library();
  if (!generic) return 0.0;
  for (const Cutter& g : *generic)
    if (g.cutter_class == CutterClass::kTap && std::abs(g.cutting_diameter_mm - nominal_mm) < 1e-3)
      return g.thread_pitch_mm;
  return 0.0;
}

/// "M6x0.75", "6x1", "M8-1.25"; "M6" alone: the coarse series.
double metric_pitch(const std::string& text, CutterClass c, double diameter_mm) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char previous = i > 0 ? text[i - 1] : ' ';
    if (letter(previous) || digit(previous) || previous == '.' || previous == '/') continue;
    Scan s(text, i);
    const bool m = s.word("mf") || s.word("m");
    if (!digit(s.peek())) continue;
    const auto nominal = s.number();
    if (!nominal || *nominal <= 0.0 || !may_cut(*nominal, c, diameter_mm)) continue;
    s.spaces();
    if (s.word("x") || s.word("*") || s.word("\xC3\x97")) {
      s.spaces();
      const auto p = s.number();
      if (p && *p > 0.05 && *p <= kCoarsestOfSize * *nominal) return *p;
      continue;
    }
    if (!m) continue;
    if (s.peek() == '-' && digit(s.peek(1))) {
      s.step();
      const bool fraction = s.peek(1) == '.' || s.peek(2) == '.';
      const auto p = s.number();
      if (p && letter(s.peek())) return coarse_pitch(*nominal);  // a tolerance: M6-6H
      if (p && fraction && *p > 0.05 && *p <= kCoarsestOfSize * *nominal) return *p;
      continue;
    }
    // Which of the fine pitches is not said.
    if (text.find("fine") != std::string::npos || text.find("fein") != std::string::npos ||
        text.compare(i, 2, "mf") == 0)
      continue;
    return coarse_pitch(*nominal);
  }
  return 0.0;
}

/// Possible meanings, in mm, of the digits before the dash of "1/4-20".
std::vector<double> inch_sizes(const std::string& text, std::size_t dash) {
  std::size_t from = dash;
  while (from > 0 && (digit(text[from - 1]) || text[from - 1] == '.' || text[from - 1] == '/')) --from;
  const std::string_view token = std::string_view(text).substr(from, dash - from);
  std::vector<double> out;
  const auto slash = token.find('/');
  if (slash == std::string_view::npos) {
    auto v = parse_double(token);
    if (!v && token.starts_with('.')) v = parse_double("0" + std::string(token));
    if (!v) return out;
    out.push_back(*v * kMmPerInch);
    if (*v == std::floor(*v) && *v <= 14.0) out.push_back((0.060 + 0.013 * *v) * kMmPerInch);  // ASME B1.1
    if (*v == std::floor(*v) && *v >= 60.0) out.push_back(*v * 0.001 * kMmPerInch);
    return out;
  }
  const auto a = parse_double(token.substr(0, slash)), b = parse_double(token.substr(slash + 1));
  if (!a || !b || *b <= 0.0) return out;
  out.push_back(*a / *b * kMmPerInch);
  if (from >= 2 && digit(text[from - 2]) && (text[from - 1] == ' ' || text[from - 1] == '-'))
    out.push_back((text[from - 2] - '0' + *a / *b) * kMmPerInch);
  return out;
}

/// "1/4-20", "#10-32", "375-16", "20 TPI".
double inch_pitch(const std::string& text, CutterClass c, double diameter_mm) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != '-' || !digit(text[i - 1]) || !digit(text[i + 1])) continue;
    Scan s(text, i + 1);
    const auto threads = s.number();
    if (!threads || *threads < kFewestTpi || *threads > kMostTpi || s.peek() == '/') continue;
    for (const double nominal : inch_sizes(text, i)) {
      const double pitch = kMmPerInch / *threads;
      if (may_cut(nominal, c, diameter_mm) && pitch <= kCoarsestOfSize * nominal) return pitch;
    }
  }
  if (const auto at = text.find("tpi"); at != std::string::npos) {
    std::size_t end = at;
    while (end > 0 && (text[end - 1] == ' ' || text[end - 1] == '-')) --end;
    std::size_t from = end;
    while (from > 0 && digit(text[from - 1])) --from;
    if (from > 0 && (text[from - 1] == '.' || text[from - 1] == '/')) return 0.0;
    const auto threads = parse_double(std::string_view(text).substr(from, end - from));
    if (threads && *threads >= kFewestTpi && *threads <= kMostTpi) return kMmPerInch / *threads;
  }
  return 0.0;
}

/// High speed steels that are called as a thread is, M and a number.
/// Source  ASTM A600-92a(2016), scope; M35 is what the trade calls HS6-5-2-5 (ISO 4957).
constexpr std::array kSteelGrades = {1.0,  2.0,  3.0,  4.0,  6.0,  7.0,  10.0, 30.0, 33.0, 34.0, 35.0,
                                     36.0, 41.0, 42.0, 43.0, 44.0, 46.0, 47.0, 48.0, 50.0, 52.0, 62.0};

bool of_word(char c) { return letter(c) || digit(c); }
bool all_digits(std::string_view word) { return std::ranges::all_of(word, digit); }

/// The word that ends before a place, past marks and one number ("cobalt 8 % M42").
std::string_view word_before(std::string_view text, std::size_t at) {
  std::string_view word;
  for (int k = 0; k < 2 && all_digits(word); ++k) {
    while (at > 0 && !of_word(text[at - 1])) --at;
    const std::size_t end = at;
    while (at > 0 && of_word(text[at - 1])) --at;
    word = text.substr(at, end - at);
  }
  return word;
}

/// The word that begins behind a place, past marks and one number ("M42 8 % cobalt").
std::string_view word_behind(std::string_view text, std::size_t at) {
  std::string_view word;
  for (int k = 0; k < 2 && all_digits(word); ++k) {
    while (at < text.size() && !of_word(text[at])) ++at;
    const std::size_t from = at;
    while (at < text.size() && of_word(text[at])) ++at;
    word = text.substr(from, at - from);
    if (word == "high" && word_behind(text, at) == "speed") return "highspeed";
  }
  return word;
}

/// Whether a word is of a steel's name: "hss", "hsse", "hsco", "pm", "co8", "kobalt", "werkzeugstahl".
bool names_steel(std::string_view word) {
  if (word.starts_with("hss") || word.starts_with("hsco") || word.starts_with("highspeed")) return true;
  if (word.starts_with("co") && all_digits(word.substr(2))) return true;
  if (word.find("cobalt") != std::string_view::npos || word.find("kobalt") != std::string_view::npos)
    return true;
  return word == "pm" || word.ends_with("steel") || word.ends_with("stahl");
}

/// Whether the "M2" in these bounds may be a steel's grade: it is one, and a word beside it is a steel's
/// ("HSS M2", "M2 high speed steel", "HSS-E M4"). It may be the size all the same: which it is, is not
/// guessed.
bool may_be_grade(const std::string& text, std::size_t at, std::size_t end, double number) {
  if (std::ranges::find(kSteelGrades, number) == kSteelGrades.end()) return false;
  const std::string_view before = word_before(text, at);
  return before == "e" || before == "speed" || before == "grade" || names_steel(before) ||
         names_steel(word_behind(text, end));
}

/// The sizes of "M6", "M8x1": where no pitch follows, those of the coarse series only, and none that may be a
/// grade of steel.
void metric_sizes(const std::string& text, std::vector<double>& out) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char previous = i > 0 ? text[i - 1] : ' ';
    if (letter(previous) || digit(previous) || previous == '.' || previous == '/') continue;
    Scan s(text, i);
    if (!s.word("mf") && !s.word("m")) continue;
    if (!digit(s.peek())) continue;
    const auto nominal = s.number();
    if (!nominal || *nominal <= 0.0 || (letter(s.peek()) && s.peek() != 'x')) continue;
    const std::size_t end = s.at();
    const bool toleranced = s.peek() == '-' && digit(s.peek(1)) && letter(s.peek(2));  // M6-6H
    const bool is_thread = toleranced || text[i + 1] == 'f';
    s.spaces();
    if (s.word("x") || s.word("*") || s.word("\xC3\x97")) {
      s.spaces();
      const auto p = s.number();
      if (p && *p > 0.05 && *p <= kCoarsestOfSize * *nominal) out.push_back(*nominal);
    } else if (coarse_pitch(*nominal) > 0.0 && (is_thread || !may_be_grade(text, i, end, *nominal))) {
      out.push_back(*nominal);
    }
  }
}

/// The sizes of "1/4-20": a fraction of an inch whose number of threads suits one reading of it.
void fraction_sizes(const std::string& text, std::vector<double>& out) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != '-' || !digit(text[i - 1]) || !digit(text[i + 1])) continue;
    std::size_t from = i;
    while (from > 0 && (digit(text[from - 1]) || text[from - 1] == '/')) --from;
    if (text.find('/', from) >= i) continue;
    Scan s(text, i + 1);
    const auto threads = s.number();
    if (!threads || *threads < kFewestTpi || *threads > kMostTpi || s.peek() == '/') continue;
    std::vector<double> fit;
    for (const double nominal : inch_sizes(text, i))
      if (kMmPerInch / *threads <= kCoarsestOfSize * nominal) fit.push_back(nominal);
    if (fit.size() == 1) out.push_back(fit.front());
  }
}

double after_word(const std::string& text, std::string_view word, double mm_per_unit) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (at > 0 && letter(text[at - 1])) continue;
    Scan s(text, at + word.size());
    s.spaces();
    if (const auto v = s.length(mm_per_unit); v && *v > 0.0) return *v;
  }
  return 0.0;
}

double pitch_of(const std::string& text, CutterClass c, double diameter_mm) {
  if (const double p = after_word(text, "pitch", 1.0); p > 0.0 && p < diameter_mm) return p;
  if (const double p = metric_pitch(text, c, diameter_mm); p > 0.0) return p;
  return inch_pitch(text, c, diameter_mm);
}

/// "R1.5", "CR 0.5", "radius 1 mm", "corner 0.1 mm" as the program's own tables say.
double radius_of(const std::string& text, double diameter_mm, double mm_per_unit) {
  const auto fits = [&](double r) { return r > 0.0 && r <= 0.5 * diameter_mm + 1e-9; };
  for (const char* word : {"radius", "corner"}) {
    if (const double r = after_word(text, word, mm_per_unit); fits(r)) return r;
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != 'r' ||
        (i > 0 && letter(text[i - 1]) && !(text[i - 1] == 'c' && (i < 2 || !letter(text[i - 2])))))
      continue;
    Scan s(text, i + 1);
    s.spaces();
    if (const auto r = s.length(mm_per_unit); r && fits(*r)) return *r;
  }
  return 0.0;
}

/// "30 Deg.", "90-degree", "82°", in radians; the full angle.
double angle_of(const std::string& text, CutterClass c) {
  const bool included = text.find("v-bit") != std::string::npos || text.find("vbit") != std::string::npos ||
                        text.find("v bit") != std::string::npos || text.find("incl") != std::string::npos;
  for (const std::string_view unit : {"deg", "\xC2\xB0", "grad"}) {
    for (auto at = text.find(unit); at != std::string::npos; at = text.find(unit, at + 1)) {
      std::size_t end = at;
      while (end > 0 && (text[end - 1] == ' ' || text[end - 1] == '-' || text[end - 1] == '_')) --end;
      std::size_t from = end;
      while (from > 0 && (digit(text[from - 1]) || text[from - 1] == '.')) --from;
      const auto v = parse_double(std::string_view(text).substr(from, end - from));
      if (!v || *v <= 0.0 || *v >= 180.0) continue;
      if (c == CutterClass::kChamferMill && !included && *v < kLeastIncludedDeg) continue;
      return *v * std::numbers::pi / 180.0;
    }
  }
  return 0.0;
}

constexpr std::size_t kLongest = 4096;  // characters; default, unsourced: far above any comment

}  // namespace

double thread_size_of_words(std::string_view words) {
  const std::string text = plain_words(words.substr(0, kLongest));
  std::vector<double> found;
  metric_sizes(text, found);
  fraction_sizes(text, found);
  if (found.empty()) return 0.0;
  const bool one = std::ranges::all_of(found, [&](double v) { return v == found.front(); });
  return one ? found.front() : 0.0;
}

CommentSizes sizes_of_words(std::string_view words, CutterClass c, double diameter_mm, double mm_per_unit) {
  const std::string text = plain_words(words.substr(0, kLongest));
  CommentSizes out;
  if (model::has(c, model::CutterTrait::kThreads)) out.pitch_mm = pitch_of(text, c, diameter_mm);
  if (c == CutterClass::kBullnoseEndmill) out.corner_radius_mm = radius_of(text, diameter_mm, mm_per_unit);
  if (model::has(c, model::CutterTrait::kPointAngle)) {
    out.point_angle_rad = angle_of(text, c);
    if (const double tip = after_word(text, "tip", mm_per_unit); tip < diameter_mm) out.tip_mm = tip;
    out.pointed = text.find("v-bit") != std::string::npos || text.find("vbit") != std::string::npos;
  }
  return out;
}

}  // namespace capstan::tooling
