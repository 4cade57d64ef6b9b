#include "planner/door/late/tools/tool_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/plan/cutter/measured_length.h"
#include "planner/model/plan/cutter/table_offsets.h"
#include "planner/model/plan/range/ranges.h"

// The library says what the tools are, the states what became of them since: with them taken in, planning and
// the check know the tools as they are, and nothing else.

namespace capstan::late {
namespace {

using model::Cutter;

constexpr std::string_view kRow = "tool-state T";
constexpr std::string_view kOfTable = " of the tool table";

constexpr const char* kWear = "wear";
constexpr const char* kLengthWear = "length-wear";

/// A word that a number follows, and where that goes.
struct Amount {
  std::string_view word;
  std::optional<double> ToolState::*into;
  double most;
};
constexpr std::array kAmounts = {
    Amount{"life-left", &ToolState::life_left_min, model::range::kToolLifeMin.most},
    Amount{kLengthWear, &ToolState::length_wear_mm, model::range::kToolLengthMm.most},
    Amount{kWear, &ToolState::wear_mm, model::range::kToolLengthMm.most},
};
/// A word that stands alone.
struct Flag {
  std::string_view word;
  bool ToolState::*into;
};
constexpr std::array kFlags = {Flag{"broken", &ToolState::broken}, Flag{"in-table", &ToolState::in_table}};

constexpr const char* kExpected =
    "a tool a line: T3 broken, or T5 wear 0.02 length-wear 0.01 life-left 12.5 (mm, mm, minutes), in-table "
    "behind wear that the tool table has";

struct Where {
  const std::string& file;
  std::size_t line;
  [[nodiscard]] auto fault(std::string message) const {
    return fail({.code = "TOOL-STATE",
                 .message = std::move(message),
                 .file = file,
                 .line = line,
                 .expected = kExpected});
  }
};

std::string name_of(int number) { return "T" + std::to_string(number); }

std::optional<int> number_of(const std::string& word) {
  if (word.size() < 2 || word[0] != 'T' || word.find_first_not_of("0123456789", 1) != std::string::npos)
    return std::nullopt;
  const auto n = parse_double(word.substr(1));
  if (!n || *n < 1.0 || *n > std::numeric_limits<int>::max()) return std::nullopt;
  return static_cast<int>(*n);
}

/// The states of one line; nothing where it has none.
Result<std::optional<ToolState>> one_line(const std::string& text, const Where& at) {
  std::istringstream words(text.substr(0, text.find_first_of(";#")));
  std::string word;
  if (!(words >> word)) return std::optional<ToolState>();
  ToolState out;
  const auto number = number_of(word);
  if (!number) return at.fault("'" + word + "' is no tool number, which is T and a whole number from 1");
  out.number = *number;
  const std::string tool = name_of(out.number);
  std::vector<std::string> seen;
  while (words >> word) {
    if (std::find(seen.begin(), seen.end(), word) != seen.end())
      return at.fault("'" + word + "' of " + tool + " is there twice");
    seen.push_back(word);
    const auto flag =
        std::find_if(kFlags.begin(), kFlags.end(), [&](const Flag& f) { return f.word == word; });
    if (flag != kFlags.end()) {
      out.*(flag->into) = true;
      continue;
    }
    const auto amount =
        std::find_if(kAmounts.begin(), kAmounts.end(), [&](const Amount& a) { return a.word == word; });
    if (amount == kAmounts.end())
      return at.fault("'" + word + "' is no word of a tool's state (" + tool + ")");
    std::string value;
    const auto v = words >> value ? parse_double(value) : std::nullopt;
    if (!v || !std::isfinite(*v) || *v < 0.0 || *v > amount->most)
      return at.fault(word + " of " + tool + " is '" + value + "', no number from 0 to " +
                      trimmed(amount->most, 3));
    out.*(amount->into) = *v;
  }
  if (seen.empty()) return at.fault(tool + " has no state behind it");
  if (out.in_table && !out.wear_mm && !out.length_wear_mm)
    return at.fault("in-table of " + tool + " says where its wear is, and none is told");
  return std::optional(out);
}

/// One size of a tool, and what is told to be worn off it.
struct Size {
  const char* word;    ///< of the state
  const char* letter;  ///< of the tool table
  double worn_mm;      ///< off the size: of a diameter twice the wear
  double told_mm;
  double now_mm;                     ///< as the library has it
  std::optional<double> planned_mm;  ///< of the brought plan's tool of that number
};

std::string row_of(int number) { return std::string(kRow) + std::to_string(number); }

std::string told(const Size& s) { return std::string(s.word) + " " + trimmed(s.told_mm, 4) + " mm"; }
std::string in_table(const Size& s) {
  return told(s) + ", in " + s.letter + " " + trimmed(s.now_mm, 4) + " mm" + std::string(kOfTable);
}
/// From the size of the new edge.
std::string taken_off(const Size& s, double new_mm) {
  return told(s) + ", off " + s.letter + ": " + trimmed(new_mm, 4) + " to " + trimmed(new_mm - s.worn_mm, 4) +
         " mm";
}

/// What the plan's record says of a size: the wear that was told, the size of the new edge, and the worn one.
struct Recorded {
  double told_mm, new_mm, worn_mm;
  bool in_table;  ///< the table had it then
};
constexpr double kWrittenMm = 1.5e-4;  ///< rounding of two numbers with four decimals, as rows have them

/// A row's sentence of a size, as told, taken_off and in_table write it; nothing of another.
std::optional<Recorded> sentence_of(const Size& s, const std::string& sentence) {
  std::istringstream words(sentence);
  std::string word, told, unit, how, letter, first, to, second;
  if (!(words >> word >> told >> unit >> how >> letter >> first) || word != s.word) return std::nullopt;
  const auto wear = parse_double(told), size = parse_double(first);
  if (!wear || !size) return std::nullopt;
  if (how == "in" && letter == s.letter)
    return Recorded{*wear, *size + *wear * (s.worn_mm / s.told_mm), *size, true};
  if (how != "off" || letter != std::string(s.letter) + ":" || !(words >> to >> second)) return std::nullopt;
  const auto worn = parse_double(second);
  return worn ? std::optional(Recorded{*wear, *size, *worn, false}) : std::nullopt;
}

/// The last that a plan's record says of a size.
std::optional<Recorded> recorded(const Size& s, int number, const model::Plan& brought) {
  std::optional<Recorded> out;
  for (const model::Provenance& p : brought.provenance) {
    if (p.what != row_of(number)) continue;
    std::istringstream sentences(p.value);
    for (std::string one; std::getline(sentences, one, ';');)
      if (const auto r = sentence_of(s, one)) out = r;
  }
  return out;
}

/// By how much the table's size is less already, of the wear that is told, mm: 0 to all of it. Wear is told
/// as a whole since the edge was new, so that what an earlier binding took off is a part of it.
double already(const Size& s, const ToolState& state, const model::Plan& brought) {
  if (state.in_table) return s.worn_mm;
  if (s.planned_mm && std::abs(*s.planned_mm - s.now_mm - s.worn_mm) <= model::kSameDiameterMm)
    return s.worn_mm;
  const auto then = recorded(s, state.number, brought);
  if (!then) return 0.0;
  double out = 0.0;
  if (std::abs(then->new_mm - s.now_mm - s.worn_mm) <= kWrittenMm) {
    out = s.worn_mm;
  } else if (std::abs(s.now_mm - then->worn_mm) <= kWrittenMm) {
    // The table is the one of then, or the one that was given then.
    out = then->new_mm - then->worn_mm;
  } else if (then->in_table) {
    // One that had it then has it still, unless it measures more than the tool was planned with.
    if (!s.planned_mm || s.now_mm <= *s.planned_mm + model::kSameDiameterMm) out = s.worn_mm;
  } else if (s.now_mm > then->worn_mm && s.told_mm >= then->told_mm - kWrittenMm) {
    // The same edge, in the table of a binding before that one.
    out = then->new_mm - s.now_mm;
  }
  return out >= s.worn_mm - kWrittenMm ? s.worn_mm : std::max(0.0, out);
}

const Cutter* planned(const model::Plan& brought, int number) {
  const auto at = std::find_if(brought.cutters.begin(), brought.cutters.end(),
                               [&](const Cutter& c) { return c.pocket == number; });
  return at == brought.cutters.end() ? nullptr : &*at;
}

void set_word(Cutter& c, std::string_view letter, double value) {
  if (!c.table_line) return;
  for (model::ToolTableWord& w : c.table_line->words)
    if (w.letter == letter) w.value = value;
}

/// Takes wear off the tool, or says that its table has it: in `words`.
Status wear(const ToolState& state, const model::Plan& brought, Cutter& c, std::vector<std::string>& words) {
  const Cutter* then = planned(brought, state.number);
  const auto counts = [&](const Size& s) -> Result<std::optional<double>> {
    const double has = already(s, state, brought), left = s.now_mm + has - s.worn_mm;
    if (has >= s.worn_mm) {
      words.push_back(in_table(s));
      return std::optional<double>();
    }
    if (!(left > 0.0))
      return fail({.code = "LATE-TOOL-STATE",
                   .message = name_of(state.number) + ": " + told(s) + " leaves nothing of its " +
                              trimmed(s.now_mm, 4) + " mm",
                   .hint = "correct the tool's state, or say that it is broken"});
    words.push_back(taken_off(s, s.now_mm + has));
    return std::optional(left);
  };
  if (state.wear_mm && *state.wear_mm > 0.0) {
    const Size size{kWear,
                    "D",
                    2.0 * *state.wear_mm,
                    *state.wear_mm,
                    c.cutting_diameter_mm,
                    then == nullptr ? std::nullopt : std::optional(then->cutting_diameter_mm)};
    const auto left = counts(size);
    if (!left) return tl::unexpected(left.error());
    if (*left) {
      c.cutting_diameter_mm = **left;
      set_word(c, "D", **left);
      std::erase_if(c.sources, [](const auto& s) { return s.first == "cutting_diameter_mm"; });
      c.sources.emplace_back("cutting_diameter_mm", given::kLessWear);
    }
  }
  if (state.length_wear_mm && *state.length_wear_mm > 0.0) {
    const bool measured = then != nullptr && model::table_word(*then, "Z").has_value();
    const Size size{kLengthWear,
                    "Z",
                    *state.length_wear_mm,
                    *state.length_wear_mm,
                    model::length_offset_mm(c),
                    measured ? std::optional(model::length_offset_mm(*then)) : std::nullopt};
    // An offset that counts from a reference tool is any number.
    if (c.table_line && c.table_line->against_reference) {
      const double has = already(size, state, brought);
      words.push_back(has >= size.worn_mm ? in_table(size) : taken_off(size, size.now_mm + has));
      if (has < size.worn_mm) set_word(c, "Z", size.now_mm + has - size.worn_mm);
      return {};
    }
    const auto left = counts(size);
    if (!left) return tl::unexpected(left.error());
    if (*left && c.table_line) {
      model::ToolTableLine line = *c.table_line;
      for (model::ToolTableWord& w : line.words)
        if (w.letter == "Z") w.value = **left;
      model::take_table_line(c, line);
    } else if (*left) {
      model::take_measured_length(c, **left, given::kLessWear);
    }
  }
  return {};
}

std::string first_word(const std::string& sentence) {
  std::string out;
  std::istringstream(sentence) >> out;
  return out;
}
bool is_wear(const std::string& word) { return word == kWear || word == kLengthWear; }

/// What a library knows of lives is older than what the control tells.
void take_life(double left_min, Cutter& c) {
  if (!(c.life_min > 0.0)) return;
  c.life_min = std::max(c.life_min, left_min);
  c.life_used_min = c.life_min - left_min;
}

}  // namespace

Result<std::vector<ToolState>> parse_tool_states(const std::string& text, const std::string& file) {
  std::vector<ToolState> out;
  std::istringstream lines(text);
  std::string line;
  for (std::size_t n = 1; std::getline(lines, line); ++n) {
    const Where at{file, n};
    auto state = one_line(line, at);
    if (!state) return tl::unexpected(state.error());
    if (!*state) continue;
    const bool twice =
        std::any_of(out.begin(), out.end(), [&](const ToolState& s) { return s.number == (*state)->number; });
    if (twice) return at.fault(name_of((*state)->number) + " has a line before");
    out.push_back(**state);
  }
  return out;
}

std::string ToldTools::words() const {
  std::string out;
  for (const given::OutOfUse& o : out_of_use)
    out += (out.empty() ? "; out of use: " : ", ") + name_of(o.tool.pocket) + " (" + o.why + ")";
  return out;
}

bool is_tool_state(const model::Provenance& row) { return row.what.starts_with(kRow); }

std::vector<model::Provenance> wear_known(const model::Plan& brought,
                                          const std::vector<model::Provenance>& told) {
  std::vector<model::Provenance> out;
  for (const model::Provenance& row : brought.provenance) {
    if (!is_tool_state(row)) continue;
    std::istringstream sentences(row.value);
    for (std::string one; std::getline(sentences, one, ';');) {
      const std::string word = first_word(one);
      if (!is_wear(word)) continue;
      const bool anew = std::any_of(told.begin(), told.end(), [&](const model::Provenance& t) {
        std::istringstream now(t.value);
        bool says = false;
        for (std::string s; t.what == row.what && std::getline(now, s, ';');)
          says = says || first_word(s) == word;
        return says;
      });
      if (!anew) {
        out.push_back(row);
        break;
      }
    }
  }
  return out;
}

Result<ToldTools> take_tool_states(const std::vector<ToolState>& states, const model::Plan& brought,
                                   std::vector<Cutter>& library, Job& job) {
  ToldTools out;
  for (const ToolState& state : states) {
    const std::string name = name_of(state.number);
    const auto is = [&](const Cutter& c) { return c.loaded && c.pocket == state.number; };
    if (std::none_of(library.begin(), library.end(), is)) {
      job.warn("LATE-TOOL-STATE",
               name + " has a state and is not in the tool table: nothing is known of it, and it is not used",
               "");
      continue;
    }
    std::vector<std::string> words;
    const bool spent = state.life_left_min && !(*state.life_left_min > 0.0);
    for (Cutter& c : library) {
      if (!is(c)) continue;
      words.clear();
      if (!state.broken && !spent) {
        if (auto ok = wear(state, brought, c, words); !ok) return tl::unexpected(ok.error());
      }
      if (state.life_left_min) take_life(*state.life_left_min, c);
      if (state.broken || spent)
        out.out_of_use.push_back({c, state.broken ? "is broken" : "has no life left"});
    }
    for (const std::string& w : words) job.note("LATE-WEAR", name + ": " + w, "");
    if (state.life_left_min) {
      words.push_back("life left " + trimmed(*state.life_left_min, 3) + " min");
      if (!spent) out.life_left_min[state.number] = *state.life_left_min;
    }
    if (state.broken) words.insert(words.begin(), "broken");
    if (state.broken || spent) std::erase_if(library, is);
    std::string value;
    for (const std::string& w : words) value += (value.empty() ? "" : "; ") + w;
    if (!value.empty()) out.rows.push_back({row_of(state.number), value, "told by the control"});
  }
  return out;
}

}  // namespace capstan::late
