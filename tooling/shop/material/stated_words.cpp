#include "tooling/shop/material/stated_words.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "planner/ground/base/number.h"
#include "tooling/shop/material/folded_text.h"

// The text is folded to capitals. First every unit of hardness and strength is found, longest names first;
// from left to right each takes the numbers before it, else those behind it, and no number is read twice ("HB
// 200, 900 N/mm2"). Then the words of states are found: a stem with an ending, judged by what it is
// compounded with
// ("ein-satz-gehärtet", "un-hardened") and by its neighbours ("case", "not").

namespace capstan::tooling {
namespace {

constexpr double kHarderThanAnyCard = std::numeric_limits<double>::infinity();

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) { return c >= 'A' && c <= 'Z'; }
bool of_numbers(char c) { return digit(c) || std::string_view(" .,+-/").find(c) != std::string_view::npos; }

/// A run of numbers: where it begins and ends.
struct Run {
  std::size_t begin = 0, end = 0;
};

/// A number of a text, and where the run of numbers begins that it stands in.
struct Number {
  double value = 0.0;
  std::size_t begin = 0;
};

/// "160,000" as 160000; nothing where its marks do not part groups of three digits.
std::optional<double> without_thousands(const std::string& spelled) {
  const auto mark = spelled.find_first_of(".,");
  if (mark == std::string::npos || mark > 3 || (spelled.size() - mark) % 4 != 0) return std::nullopt;
  std::string out = spelled.substr(0, mark);
  for (std::size_t i = mark; i < spelled.size(); i += 4) {
    if (spelled[i] != spelled[mark] || spelled.find_first_of(".,", i + 1) < i + 4) return std::nullopt;
    out += spelled.substr(i + 1, 3);
  }
  return parse_double(out);
}

/// What a run of numbers means at most: "48-52" is 52, "58+2" is 60, "58,5" is 58.5; numbers that are no
/// hardness in this unit, such as those of a grade before it, are passed over.
std::optional<Number> most_of(const std::string& text, Run run, const ScaleUnit& unit, bool behind_unit) {
  std::optional<Number> out;
  double before = 0.0;  // the last number, where it is one of this unit
  bool plus = false;    // between it and here
  for (std::size_t i = run.begin; i < run.end;) {
    if (!digit(text[i])) {
      if (text[i] == '+') plus = true;
      if (text[i] != '+' && text[i] != ' ') before = 0.0;
      ++i;
      continue;
    }
    const std::size_t from = i;
    while (i < run.end &&
           (digit(text[i]) || ((text[i] == '.' || text[i] == ',') && i + 1 < run.end && digit(text[i + 1]))))
      ++i;
    const std::string spelled = text.substr(from, i - from);
    std::string word = spelled;
    std::replace(word.begin(), word.end(), ',', '.');
    // "X40" is a grade, "HRC40" a hardness.
    if (from > 0 && letter(text[from - 1]) && !(behind_unit && from == run.begin)) continue;
    auto value = parse_double(word);
    if (!value || *value < unit.lo) {
      // "1.400 N/mm2", "160,000 psi": groups of three digits.
      if (const auto whole = without_thousands(spelled)) value = whole;
    }
    if (!value) continue;
    const double most = plus ? before + *value : *value;
    plus = false;
    const bool fits = most >= unit.lo && most <= unit.hi;
    if (fits && (!out || most > out->value)) out = Number{most, out ? out->begin : from};
    before = fits ? most : 0.0;
  }
  return out;
}

/// The first number of a run with what is joined to it: "200" of " 200, 900 ", "48-52" of " 48-52 ".
Run first_of(const std::string& text, Run run) {
  std::size_t i = run.begin;
  while (i < run.end && !digit(text[i])) ++i;
  for (;;) {
    while (i < run.end &&
           (digit(text[i]) || ((text[i] == '.' || text[i] == ',') && i + 1 < run.end && digit(text[i + 1]))))
      ++i;
    std::size_t next = i;
    while (next < run.end && text[next] == ' ') ++next;
    if (next >= run.end || std::string_view("+-/").find(text[next]) == std::string_view::npos) break;
    i = next + 1;
    while (i < run.end && !digit(text[i])) ++i;
  }
  return {run.begin, i};
}

struct Found {
  const ScaleUnit* unit = nullptr;
  std::size_t begin = 0, end = 0;
};

std::vector<Found> units_of(const std::string& t) {
  std::vector<Found> out;
  for (const ScaleUnit& unit : kScaleUnits) {
    for (auto at = t.find(unit.word); at != std::string::npos; at = t.find(unit.word, at + 1)) {
      const std::size_t end = at + unit.word.size();
      if ((at > 0 && letter(t[at - 1])) || (end < t.size() && letter(t[end]))) continue;
      const bool taken =
          std::any_of(out.begin(), out.end(), [&](const Found& f) { return at < f.end && f.begin < end; });
      if (!taken) out.push_back({&unit, at, end});
    }
  }
  std::sort(out.begin(), out.end(), [](const Found& a, const Found& b) { return a.begin < b.begin; });
  return out;
}

/// Behind "ROCKWELL C", "HRC": blanks and words that say nothing ("hardness = ").
std::size_t behind(const std::string& t, std::size_t at) {
  constexpr std::array<std::string_view, 11> kSayNothing = {
      "HARDNESS", "HAERTE", "NUMBER", "SCALE", "VALUE", "OF", "IS", "MIN", "MAX", "A", "D"};
  for (;;) {
    while (at < t.size() && std::string_view(" =:.(~<>").find(t[at]) != std::string_view::npos) ++at;
    std::size_t end = at;
    while (end < t.size() && letter(t[end])) ++end;
    const std::string_view word = std::string_view(t).substr(at, end - at);
    if (std::find(kSayNothing.begin(), kSayNothing.end(), word) == kSayNothing.end()) return at;
    at = end;
  }
}

/// Whether the words before a strength, from `first` on, call it another one than the tensile strength.
bool not_tensile(const std::string& t, std::size_t first, std::size_t at) {
  std::size_t from = at;
  while (from > first && t[from - 1] != ';' && !(t[from - 1] == ',' && from < t.size() && t[from] == ' '))
    --from;
  for (const std::string_view word :
       {"YIELD", "STRECK", "DEHN", "PROOF", "SHEAR", "SCHER", "FATIGUE", "MODUL", "ELASTI", "COMPRESS",
        "FLEX", "BIEGE", "DRUCK", "PRESSURE", "CREEP", "CUTTING", "SPECIFIC"}) {
    if (t.find(word, from) < at) return true;
  }
  for (std::size_t i = from; i < at;) {
    std::size_t end = i;
    while (end < at && letter(t[end])) ++end;
    const std::string_view word = std::string_view(t).substr(i, end - i);
    for (const std::string_view other : {"RE", "RP", "REH", "REL", "KC"})
      if (word == other) return true;
    if (word == "E" && (i == 0 || !digit(t[i - 1])) && !digit(t[end])) return true;  // no "C45E", "E295"
    i = std::max(end, i + 1);
  }
  return false;
}

struct Stated {
  StatedHardness hardness;
  std::size_t begin = 0;  ///< in the folded text
};

std::vector<Stated> hardness_of(const std::string& t) {
  const std::vector<Found> units = units_of(t);
  std::vector<Stated> out;
  std::optional<Stated> unread;
  std::size_t claimed = 0;  // up to here numbers belong to the units before
  for (std::size_t k = 0; k < units.size(); ++k) {
    const auto& [unit, begin, end] = units[k];
    Run before{begin, begin};
    while (before.begin > claimed && of_numbers(t[before.begin - 1])) --before.begin;
    Run after{behind(t, end), 0};
    for (after.end = after.begin; after.end < t.size() && of_numbers(t[after.end]);) ++after.end;
    const auto left = most_of(t, before, *unit, false);
    if (k + 1 < units.size() && after.end >= units[k + 1].begin) {
      // The numbers between two units: the first is this one's where it has none before it.
      after = left ? Run{after.begin, after.begin} : first_of(t, {after.begin, units[k + 1].begin});
    } else if (left && unit->scale == Scale::kBrinell &&
               t.substr(after.begin, after.end - after.begin).find('/') != std::string::npos) {
      after.end = after.begin;  // how it was measured: "500 HBW 10/3000"
    }
    const auto right = most_of(t, after, *unit, true);
    claimed = std::max(end, right ? after.end : end);
    const std::string name(unit->as.empty() ? unit->word : unit->as);
    if (!left && !right) {
      // "Rockwell C hardness 38 HRC" names its unit twice.
      if (!out.empty() && out.back().hardness.scale == unit->scale) continue;
      if (unit->must || unit->scale == Scale::kBrinell || unit->scale == Scale::kVickers) {
        Stated none{{unit->scale, kHarderThanAnyCard, "a hardness in " + name + " that cannot be read"},
                    begin};
        if (unit->must)
          out.push_back(std::move(none));
        else
          unread = std::move(none);
      }
      continue;
    }
    const double value = std::max(left ? left->value : 0.0, right ? right->value : 0.0);
    const std::size_t at = left ? std::min(left->begin, begin) : begin;
    const Scale scale = unit->scale == Scale::kStrength && not_tensile(t, k > 0 ? units[k - 1].end : 0, at)
                            ? Scale::kOther
                            : unit->scale;
    out.push_back({{scale, brinell_of(scale, value * unit->factor), trimmed(value, 4) + " " + name}, at});
  }
  if (out.empty() && unread) out.push_back(*std::move(unread));
  return out;
}

struct Word {
  std::string_view text;
  std::size_t begin = 0, end = 0;
};

std::vector<Word> words_of(const std::string& t) {
  std::vector<Word> out;
  for (std::size_t i = 0; i < t.size();) {
    std::size_t end = i;
    while (end < t.size() && letter(t[end])) ++end;
    if (end > i) out.push_back({std::string_view(t).substr(i, end - i), i, end});
    i = std::max(end, i + 1);
  }
  return out;
}

struct Stem {
  std::string_view text;
  State state;
};
/// What follows such a stem is an ending at most; before it stands what it is compounded with.
constexpr std::array kStems = {
    Stem{"HARDENED", State::kHard},       Stem{"GEHAERTET", State::kHard},
    Stem{"GEHARTET", State::kHard},       Stem{"QUENCHED", State::kHard},
    Stem{"ABGESCHRECKT", State::kHard},   Stem{"TREMPE", State::kHard},
    Stem{"TEMPERADO", State::kHard},      Stem{"TEMPRATO", State::kHard},
    Stem{"TEMPLADO", State::kHard},       Stem{"NITRIDED", State::kSurface},
    Stem{"NITRIERT", State::kSurface},    Stem{"NITRETADO", State::kSurface},
    Stem{"NITRURADO", State::kSurface},   Stem{"NITRURATO", State::kSurface},
    Stem{"NITRURE", State::kSurface},     Stem{"CARBURIZED", State::kSurface},
    Stem{"CARBURISED", State::kSurface},  Stem{"CARBURIERT", State::kSurface},
    Stem{"KARBURIERT", State::kSurface},  Stem{"AUFGEKOHLT", State::kSurface},
    Stem{"CEMENTADO", State::kSurface},   Stem{"CEMENTATO", State::kSurface},
    Stem{"CEMENTE", State::kSurface},     Stem{"BORIDED", State::kSurface},
    Stem{"BORONIZED", State::kSurface},   Stem{"BORIERT", State::kSurface},
    Stem{"CYANIDED", State::kSurface},    Stem{"TUFFTRIDED", State::kSurface},
    Stem{"TENIFER", State::kSurface},     Stem{"TEMPERED", State::kTempered},
    Stem{"VERGUETET", State::kTempered},  Stem{"VERGUTET", State::kTempered},
    Stem{"ANGELASSEN", State::kTempered}, Stem{"WAERMEBEHANDELT", State::kTempered},
    Stem{"BONIFICATO", State::kTempered}, Stem{"BENEFICIADO", State::kTempered},
    Stem{"ANNEALED", State::kSoft},       Stem{"NORMALIZED", State::kSoft},
    Stem{"NORMALISED", State::kSoft},     Stem{"NORMALISIERT", State::kSoft},
    Stem{"GEGLUEHT", State::kSoft},       Stem{"GEGLUHT", State::kSoft},
    Stem{"UNTREATED", State::kSoft},      Stem{"UNBEHANDELT", State::kSoft},
    Stem{"RECOZIDO", State::kSoft},       Stem{"RECOCIDO", State::kSoft},
    Stem{"RICOTTO", State::kSoft},        Stem{"RECUIT", State::kSoft}};

template <std::size_t N>
bool one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Compounded with the hardened part of a piece: "casehardened", "randschichtgehärtet".
constexpr std::array<std::string_view, 16> kOfSurface = {
    "CASE",     "SURFACE",    "INDUCTION", "FLAME", "LASER",       "SKIN",         "FACE",        "EINSATZ",
    "INDUKTIV", "INDUKTIONS", "FLAMM",     "RAND",  "RANDSCHICHT", "OBERFLAECHEN", "LASERSTRAHL", "EDGE"};
constexpr std::array<std::string_view, 6> kOfAge = {"AGE", "PRECIPITATION", "DISPERSION",
                                                    "AUS", "KALTAUS",       "WARMAUS"};
constexpr std::array<std::string_view, 5> kNot = {"UN", "NOT", "NON", "NICHT", "KEIN"};
constexpr std::array<std::string_view, 3> kBeforehand = {"PRE", "VOR", "VORAB"};

struct StateInWords {
  State state;
  std::size_t first = 0, last = 0;  ///< words
};

/// The state that a word says with its neighbours.
std::optional<StateInWords> state_at(const std::vector<Word>& words, std::size_t i, const std::string& t) {
  const std::string_view w = words[i].text;
  const auto at = [&](std::size_t k) { return k < words.size() ? words[k].text : std::string_view(); };
  const std::string_view previous = i > 0 ? words[i - 1].text : std::string_view();
  const auto follows_number = [&] { return words[i].end < t.size() && digit(t[words[i].end]); };
  if (w == "QT" && !follows_number()) return StateInWords{State::kTempered, i, i};
  if (w == "SOFT" || w == "WEICH") return StateInWords{State::kSoft, i, i};
  if (w == "Q" && (at(i + 1) == "T" || (at(i + 1) == "AND" && at(i + 2) == "T"))) {
    const std::size_t last = at(i + 1) == "T" ? i + 1 : i + 2;
    if (words[last].begin - words[i].end <= 5 &&
        (last == i + 2 || t.find_first_of("&+", words[i].end) < words[last].begin))
      return StateInWords{State::kTempered, i, last};
  }
  if (w == "HEAT" && at(i + 1) == "TREATED")
    return StateInWords{previous == "SOLUTION" ? State::kSoft : State::kTempered, i, i + 1};
  if (w == "HEATTREATED") return StateInWords{State::kTempered, i, i};
  if (w == "H" && (i == 0 || words[i].begin == 0 || (!digit(t[words[i].begin - 1])))) {
    // ASTM A564: the conditions H900 and H925 of 17-4PH are harder than its card.
    for (const std::string_view condition : {"900", "925"}) {
      const std::size_t end = words[i].end + condition.size();
      if (t.compare(words[i].end, condition.size(), condition) == 0 && (end >= t.size() || !digit(t[end])))
        return StateInWords{State::kAged, i, i};
    }
  }
  for (const Stem& stem : kStems) {
    const auto p = w.rfind(stem.text);
    if (p == std::string_view::npos || w.size() - p - stem.text.size() > 2) continue;
    StateInWords out{stem.state, i, i};
    if (stem.state == State::kSoft) {
      if (one_of(previous, kNot)) return std::nullopt;
      return out;
    }
    const std::string_view with = w.substr(0, p);
    const auto said = [&](const auto& list) { return one_of(with, list) || one_of(previous, list); };
    const auto widen = [&](const auto& list) {
      if (one_of(previous, list)) out.first = i - 1;
    };
    // "hardened and tempered", "quenched + tempered".
    const bool joined = at(i + 1) == "AND" || at(i + 1) == "UND";
    const std::size_t next = joined ? i + 2 : i + 1;
    const std::string_view second = at(next);
    if (stem.state == State::kHard && (second == "TEMPERED" || second.starts_with("ANGELASSEN"))) {
      out.state = State::kTempered;
      out.last = next;
    } else if (stem.state == State::kHard && said(kOfSurface)) {
      out.state = State::kSurface;
      widen(kOfSurface);
    } else if (stem.state == State::kHard && said(kOfAge)) {
      out.state = State::kAged;
      widen(kOfAge);
    } else if (stem.state == State::kHard && said(kBeforehand)) {
      out.state = State::kTempered;
      widen(kBeforehand);
    }
    const std::string_view ahead = out.first > 0 ? words[out.first - 1].text : std::string_view();
    if (one_of(with, kNot) || one_of(ahead, kNot)) {
      out.state = State::kSoft;
      if (one_of(ahead, kNot)) --out.first;
    }
    return out;
  }
  return std::nullopt;
}

/// "48 TO 52", "MIN 48 MAX 52": the word between two numbers is a dash.
void join_ranges(std::string& t) {
  for (const std::string_view word : {" TO ", " BIS ", " MAX ", " AND ", " UND "}) {
    for (auto at = t.find(word); at != std::string::npos; at = t.find(word, at + 1)) {
      const std::size_t end = at + word.size();
      if (at == 0 || end >= t.size() || !digit(t[at - 1]) || !digit(t[end])) continue;
      std::fill(t.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                t.begin() + static_cast<std::ptrdiff_t>(end) - 1, '-');
    }
  }
}

}  // namespace

StatedWords stated_words(std::string_view text) {
  FoldedText t = folded(text);
  join_ranges(t.text);
  StatedWords out;
  std::size_t first = t.text.size();
  for (Stated& s : hardness_of(t.text)) {
    first = std::min(first, s.begin);
    out.hardness.push_back(std::move(s.hardness));
  }
  std::string plain(text);
  const std::vector<Word> words = words_of(t.text);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto found = state_at(words, i, t.text);
    if (!found) continue;
    const std::size_t begin = t.at[words[found->first].begin], end = t.at[words[found->last].end];
    out.states.push_back({found->state, std::string(text.substr(begin, end - begin))});
    std::fill(plain.begin() + static_cast<std::ptrdiff_t>(begin),
              plain.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    i = found->last;
  }
  out.before = std::string(text.substr(0, t.at[first]));
  out.plain = plain.substr(0, t.at[first]);
  return out;
}

std::vector<StatedState> states_behind_grade(std::string_view rest) {
  const FoldedText t = folded(rest);
  const auto from = t.text.find_first_not_of(" +-_");
  if (from == std::string::npos) return {};
  std::size_t end = from;
  while (end < t.text.size() && letter(t.text[end])) ++end;
  if (end < t.text.size() && digit(t.text[end])) return {};
  const std::string_view word = std::string_view(t.text).substr(from, end - from);
  for (const std::string_view tempered : {"V", "HT", "PH", "Q"})
    if (word == tempered)
      return {{State::kTempered, std::string(rest.substr(t.at[from], t.at[end] - t.at[from]))}};
  return {};
}

}  // namespace capstan::tooling
