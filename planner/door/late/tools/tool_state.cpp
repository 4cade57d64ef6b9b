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

/// A word that a number follows, and where that goes.
struct Amount {
  std::string_view word;
  std::optional<double> ToolState::*into;
  double most;
};
constexpr std::array kAmounts = {
    Amount{"life-left", &ToolState::life_left_min, model::range::kToolLifeMin.most},
    Amount{"length-wear", &ToolState::length_wear_mm, model::range::kToolLengthMm.most},
    Amount{"wear", &ToolState::wear_mm, model::range::kToolLengthMm.most},
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
std::string taken_off(const Size& s, double from_mm) {
  return told(s) + ", off " + s.letter + ": " + trimmed(from_mm, 4) + " to " +
         trimmed(from_mm - s.worn_mm, 4) + " mm";
}

/// Whether the table's size is less by the wear already.
bool has_it(const Size& s, const ToolState& state, const model::Plan& brought) {
  if (state.in_table) return true;
  const std::string row = row_of(state.number);
  for (const model::Provenance& p : brought.provenance) {
    if (p.what != row) continue;
    // The table that an earlier binding gave is in effect now.
    if (p.value.find(taken_off(s, s.now_mm + s.worn_mm)) != std::string::npos) return true;
    // One that had it then has it still, unless it measures more than the tool was planned with.
    const bool had_it = p.value.find(std::string(", in ") + s.letter + " ") != std::string::npos;
    if (had_it && !(s.planned_mm && s.now_mm > *s.planned_mm + model::kSameDiameterMm)) return true;
  }
  return s.planned_mm && std::abs(*s.planned_mm - s.now_mm - s.worn_mm) <= model::kSameDiameterMm;
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
    if (has_it(s, state, brought)) {
      words.push_back(in_table(s));
      return std::optional<double>();
    }
    if (!(s.now_mm - s.worn_mm > 0.0))
      return fail({.code = "LATE-TOOL-STATE",
                   .message = name_of(state.number) + ": " + told(s) + " leaves nothing of its " +
                              trimmed(s.now_mm, 4) + " mm",
                   .hint = "correct the tool's state, or say that it is broken"});
    words.push_back(taken_off(s, s.now_mm));
    return std::optional(s.now_mm - s.worn_mm);
  };
  if (state.wear_mm && *state.wear_mm > 0.0) {
    const Size size{"wear",
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
    const Size size{"length-wear",
                    "Z",
                    *state.length_wear_mm,
                    *state.length_wear_mm,
                    model::length_offset_mm(c),
                    measured ? std::optional(model::length_offset_mm(*then)) : std::nullopt};
    // An offset that counts from a reference tool is any number.
    if (c.table_line && c.table_line->against_reference) {
      words.push_back(has_it(size, state, brought) ? in_table(size) : taken_off(size, size.now_mm));
      if (!words.back().ends_with(kOfTable)) set_word(c, "Z", size.now_mm - size.worn_mm);
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
      if (auto ok = wear(state, brought, c, words); !ok) return tl::unexpected(ok.error());
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
