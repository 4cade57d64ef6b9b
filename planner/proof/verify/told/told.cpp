#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/told/phrases.h"
#include "planner/proof/verify/told/sayings.h"

// What a program tells the operator, against the plan: he clamps the piece, sets zero and loads the tools by
// its comments. What he writes in it himself is his own, where it does not begin as one of these.

namespace capstan::verify {
namespace {

/// Lines that may stand between a text and the line in which it goes on.
constexpr std::size_t kBetween = 20;
/// Writers cut a longer word where their lines end: what holds one is not compared.
constexpr std::size_t kLongestWord = 48;

/// Lines from `begin`, before `end`.
struct Place {
  long begin = 0, end = 0;
  Findings::Where where = {};
};

/// A saying, as phrases too.
struct Asked {
  Place place;
  Saying saying;
  std::vector<std::vector<Phrase>> heads = {}, texts = {};
};

Asked asked_at(const Place& place, Saying saying) {
  Asked out{place, std::move(saying)};
  for (const std::string& h : out.saying.heads) out.heads.push_back(phrases_of(h));
  for (const std::string& t : out.saying.texts) out.texts.push_back(phrases_of(t));
  return out;
}

/// Programs by other hands have no header to hold them to.
bool of_capstan(const ProgramCase& c) {
  static const std::vector<Phrase> kFirst = phrases_of("CAPSTAN PROGRAM");
  const auto& markers = c.program.markers;
  return !c.program.setups.empty() ||
         std::any_of(markers.begin(), markers.end(), [](const StepMarker& m) { return m.setup > 0; }) ||
         std::any_of(c.program.told.begin(), c.program.told.end(),
                     [](const Told& t) { return stands_at(kFirst, phrases_of(t.text), 0, 0.0); });
}

/// The machine that the header names, against the one that the program is judged by. Whether it names one.
bool check_machine(const ProgramCase& c, Findings& findings) {
  static const std::vector<Phrase> kHead = phrases_of("machine:");
  if (c.machine.id.empty()) return true;
  std::vector<Phrase> wanted = kHead;
  for (Phrase& p : phrases_of(c.machine.id)) wanted.push_back(std::move(p));
  const long first = c.program.markers.empty() ? c.program.lines + 1 : c.program.markers.front().line;
  for (const Told& t : c.program.told) {
    if (t.line >= first) break;
    const std::vector<Phrase> said = phrases_of(t.text);
    if (!stands_at(kHead, said, 0, 0.0)) continue;
    if (said.size() == wanted.size() && stands_at(said, wanted, 0, 0.0)) return true;
    const std::string text =
        "the header says '" + t.text + "'; the program is judged by '" + c.machine.id + "'";
    const Findings::Where at{1, "", t.line};
    if (c.plan != nullptr && of_capstan(c)) {
      findings.error(22, "CHK-HEADER-MACHINE", at, text + ", the plan's machine; write the program for that");
    } else {
      findings.note(22, "CHK-HEADER-MACHINE", at, text + "; name the machine on which it is to run");
    }
    return true;
  }
  return false;
}

class ToldChecks {
 public:
  ToldChecks(const ProgramCase& c, Findings& findings)
      : c_(c), out_(findings), unit_(0.51 * std::pow(10.0, -c.plan->machine.control.decimals)) {
    for (const Told& t : c.program.told) said_.push_back(phrases_of(t.text));
    used_.resize(said_.size(), false);
    // A program may have a part of the steps, with what there was when it was written.
    for (const long i : c.step_of_marker) {
      if (i < 0) continue;
      const model::StepResult& s = c.plan->steps[static_cast<std::size_t>(i)];
      if (s.setup < c.plan->setups.size()) used_setups_.insert(s.setup);
      const model::Cutter* t = model::find_cutter(*c.plan, s.cutter_id);
      if (t != nullptr && t->pocket > 0) used_tools_.emplace(t->pocket, t);
    }
  }

  void run(bool names_machine) {
    if (!of_capstan(c_)) return;
    if (!names_machine)
      out_.error(22, "CHK-HEADER-MACHINE", {1, "", -1},
                 "the header does not say that the program is for machine '" + c_.machine.id +
                     "'; write the program again");
    setups();
    tools();
    places();
    for (const Asked& a : asked_) look(a);
    for (const Asked& a : asked_) contradicted(a);
  }

 private:
  /// CAPSTAN SETUP: which offsets there are, and from where on rapids are safe.
  void setups() {
    for (const std::size_t i : used_setups_) {
      const auto n = static_cast<long>(i) + 1;
      const double planned = c_.plan->setups[i].security_z_mm;
      bool any = false;
      for (const HeaderSetup& h : c_.program.setups) {
        if (h.n != n) continue;
        any = true;
        if (h.security_mm && std::abs(*h.security_mm - planned) <= unit_) continue;
        out_.error(3, "CHK-HEADER-SETUP", {1, "", h.line},
                   "the header says " +
                       (h.security_mm ? "a security plane at z = " + mm(*h.security_mm)
                                      : std::string("no security plane")) +
                       " for set-up " + std::to_string(n) + "; the plan has " + mm(planned) +
                       "; write the program again");
      }
      if (!any)
        out_.error(3, "CHK-HEADER-SETUP", {1, "", -1},
                   "the header has no line (CAPSTAN SETUP n=" + std::to_string(n) +
                       " ...), which the plan's set-up has; write the program again");
    }
    for (const HeaderSetup& h : c_.program.setups) {
      if (h.n >= 1 && static_cast<std::size_t>(h.n) <= c_.plan->setups.size()) continue;
      out_.error(3, "CHK-HEADER-SETUP", {1, "", h.line},
                 "the header has a set-up " + std::to_string(h.n) + "; the plan has " +
                     std::to_string(c_.plan->setups.size()) + "; write the program again");
    }
  }

  /// CAPSTAN TOOL: what is loaded by hand, where a step of the program asks for it. Sizes that it says are
  /// held against the library (header_tools.cpp).
  void tools() {
    std::set<int> listed;
    for (const HeaderTool& h : c_.program.tools) {
      const auto at = used_tools_.find(h.tool);
      if (at == used_tools_.end()) continue;
      listed.insert(h.tool);
      const model::Cutter& t = *at->second;
      const std::string kind(model::to_text(t.cutter_class));
      const bool known = is_id(h.id, t.id) && h.kind == kind;
      if (known && h.length_mm && h.diameter_mm) continue;
      std::string text = "the header has T" + std::to_string(h.tool);
      if (known) {
        text += " without its " + std::string(h.length_mm ? "diameter" : "length");
      } else {
        text += " as '" + h.id + "' (" + h.kind + "); the plan has '" + t.id + "' (" + kind + ")";
      }
      out_.error(4, "CHK-HEADER-TOOL", {1, "", h.line}, text + "; write the program again");
    }
    for (const auto& [number, t] : used_tools_) {
      if (listed.contains(number)) continue;
      out_.error(4, "CHK-HEADER-TOOL", {1, "", -1},
                 "the header does not have T" + std::to_string(number) + ", '" + t->id +
                     "' of the plan; write the program again");
    }
  }

  /// What is to be said where: at the head, and where another set-up begins.
  void places() {
    const auto& markers = c_.program.markers;
    const long last = c_.program.lines + 1;
    const Place header{0, markers.empty() ? last : markers.front().line, {1, "", -1}};
    ask(header, sayings_of_header(*c_.plan));
    std::optional<std::size_t> before;
    for (std::size_t m = 0; m < markers.size(); ++m) {
      const long i = c_.step_of_marker[m];
      if (i < 0) continue;
      const std::size_t setup = c_.plan->steps[static_cast<std::size_t>(i)].setup;
      if (setup >= c_.plan->setups.size() || before == setup) continue;
      const long next = m + 1 < markers.size() ? markers[m + 1].line : last;
      const Place here{
          markers[m].line, std::min(next, first_move(m)), {m + 2, markers[m].id, markers[m].line}};
      ask(before ? here : header, sayings_of_setup(*c_.plan, setup, before));
      before = setup;
    }
  }

  void ask(const Place& place, std::vector<Saying> sayings) {
    for (Saying& s : sayings) asked_.push_back(asked_at(place, std::move(s)));
  }

  /// The line in which a step first moves in its work offset.
  [[nodiscard]] long first_move(std::size_t marker) const {
    const auto& blocks = c_.program.blocks;
    const auto at = std::find_if(blocks.begin(), blocks.end(), [&](const Block& b) {
      return b.kind == Block::Kind::kMove && !b.in_machine && b.marker == static_cast<int>(marker);
    });
    return at == blocks.end() ? c_.program.lines + 1 : at->line;
  }

  /// Looks for a text at that place, in one line or in lines that go on; marks them.
  bool finds(const Place& place, const std::vector<Phrase>& text) {
    const auto& told = c_.program.told;
    const auto at_line = [](const Told& t, long line) { return t.line < line; };
    auto i = static_cast<std::size_t>(std::lower_bound(told.begin(), told.end(), place.begin, at_line) -
                                      told.begin());
    for (; i < told.size() && told[i].line < place.end; ++i) {
      std::vector<std::size_t> lines;
      std::size_t have = 0;
      for (std::size_t j = i; j < told.size() && told[j].line < place.end && j - i <= kBetween; ++j) {
        if (said_[j].empty() || !stands_at(said_[j], text, have, unit_)) {
          if (j == i) break;
          continue;
        }
        lines.push_back(j);
        have += said_[j].size();
        if (have == text.size()) break;
      }
      if (have != text.size()) continue;
      for (const std::size_t j : lines) used_[j] = true;
      return true;
    }
    return false;
  }

  [[nodiscard]] bool begins(std::size_t i, const Asked& a) const {
    return std::any_of(a.heads.begin(), a.heads.end(),
                       [&](const auto& head) { return stands_at(head, said_[i], 0, unit_); });
  }

  /// Whether a line says the beginning of it: a message that has no room for more.
  [[nodiscard]] bool shortens(std::size_t i, const Asked& a) const {
    return std::any_of(a.texts.begin(), a.texts.end(),
                       [&](const auto& text) { return stands_at(said_[i], text, 0, unit_); });
  }

  [[nodiscard]] static bool holds_long_word(const std::string& text) {
    std::size_t length = 0;
    return std::any_of(text.begin(), text.end(), [&](char c) {
      length = c == ' ' ? 0 : length + 1;
      return length > kLongestWord;
    });
  }

  void look(const Asked& a) {
    const Saying& s = a.saying;
    const Place& place = a.place;
    if (holds_long_word(s.texts.front())) return;
    bool found = false;
    for (const auto& text : a.texts) found = finds(place, text) || found;
    const auto& told = c_.program.told;
    Findings::Where at = place.where;
    if (found && s.shown && c_.reader.shows_text) {
      for (std::size_t i = 0; i < told.size(); ++i) {
        if (told[i].shown && told[i].line >= place.begin && told[i].line < place.end && begins(i, a) &&
            shortens(i, a))
          return;
      }
      out_.error(33, "CHK-TEXT-TOLD", at,
                 "nothing shows to the operator, before the stop, '" + s.texts.front() +
                     "': it stands in a comment alone; write the program again");
      return;
    }
    if (found) return;
    std::string says;
    for (std::size_t i = 0; i < told.size() && says.empty(); ++i) {
      if (used_[i] || told[i].line < place.begin || told[i].line >= place.end || !begins(i, a)) continue;
      says = told[i].text;
      used_[i] = true;
      at.move = told[i].line;
    }
    out_.error(
        33, "CHK-TEXT-TOLD", at,
        (says.empty()
             ? "the program does not tell the operator '" + s.texts.front() + "', as the plan has it"
             : "the program tells the operator '" + says + "'; the plan has '" + s.texts.front() + "'") +
            "; write the program again");
  }

  /// The same thing said otherwise, beside what is right.
  void contradicted(const Asked& a) {
    const Saying& s = a.saying;
    // A step's name, its machine and its material are not what a piece is clamped by.
    if (!s.heads.front().starts_with("set-up")) return;
    for (std::size_t i = 0; i < said_.size(); ++i) {
      if (used_[i] || !begins(i, a) || shortens(i, a)) continue;
      used_[i] = true;  // once
      out_.error(33, "CHK-TEXT-TOLD", {1, "", c_.program.told[i].line},
                 "the program tells the operator '" + c_.program.told[i].text + "'; the plan has '" +
                     s.texts.front() + "'; take that line out, or write the program again");
    }
  }

  const ProgramCase& c_;
  Findings& out_;
  double unit_;  ///< numbers that differ by less are written alike
  std::vector<std::vector<Phrase>> said_;
  std::vector<bool> used_;
  std::vector<Asked> asked_;
  std::set<std::size_t> used_setups_;
  std::map<int, const model::Cutter*> used_tools_;
};

}  // namespace

void check_told(const ProgramCase& c, Findings& findings) {
  const bool named = check_machine(c, findings);
  if (c.plan != nullptr) ToldChecks(c, findings).run(named);
}

}  // namespace capstan::verify
