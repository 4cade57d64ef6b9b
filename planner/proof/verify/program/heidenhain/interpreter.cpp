#include "planner/proof/verify/program/heidenhain/interpreter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/reader_options.h"

// One block after another: which kind it is, its words, its move, the cycle behind it, its stop. M0, M1, M2,
// M5, M9 and M30 act when the block's move has ended, M99 calls the cycle then.

namespace capstan::verify::heidenhain {

using model::MoveKind;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMost = 99999.9999;  ///< mm or degrees of a word: TNC 640 ISO programming, 19.3

}  // namespace

bool Interpreter::Said::has_m(int code) const { return std::find(m.begin(), m.end(), code) != m.end(); }

namespace {
/// Modal cycle calls, machine coordinates and ways along a contour: no builder's, whatever a file lists.
/// Source: HEIDENHAIN, TNC 640, miscellaneous functions M89 to M148.
constexpr bool is_own_m(int m) { return m >= 89 && m <= 148; }
}  // namespace

Interpreter::Interpreter(const model::Machine& machine) {
  builders_codes(option(machine, "shop_codes"), option(machine, "through_coolant"));
  const std::string_view proves = option(machine, "prove_out");
  proves_out_ = proves == "m1" || proves == "skip_m0";
  pecking_ = option(machine, "pecking_cycle");
  longest_block_ = static_cast<std::size_t>(option_number(machine, "line_length"));
}

void Interpreter::unfollowed(const std::string& what) {
  fault(33, "CHK-UNVERIFIABLE", what + " is not followed: what it moves, shifts or sets is not known", true);
}

void Interpreter::comments(const Line& l) {
  for (const std::string& text : l.comments) {
    table_angle(text);
    if (!read_comment(text, line_, out_)) continue;
    marker_ = static_cast<int>(out_.markers.size()) - 1;
    restate();
  }
}

/// A control numbers the blocks of a file itself; here a gap says that a block is missing or doubled.
void Interpreter::block_number(const Line& l) {
  if (!l.number) return;
  const long wanted = last_number_ ? *last_number_ + 1 : 0;
  if (*l.number != wanted)
    fault(33, "CHK-SYNTAX",
          "the block has the number " + std::to_string(*l.number) + " where " + std::to_string(wanted) +
              " comes: a block may be missing or doubled; write the program again, or number it anew",
          true);
  last_number_ = *l.number;
}

void Interpreter::block_line(const Line& l, long number) {
  line_ = number;
  comments(l);
  block_number(l);
  if (!l.fault.empty()) fault(33, "CHK-SYNTAX", l.fault);
  if (l.goes_on) fault(33, "CHK-SYNTAX", "the text ends within a block: a line follows behind ~");
  if (l.words.empty()) return;
  if (closed_) return fault(32, "CHK-END", "text goes on after END PGM");
  if (out_.ended && l.words.front() != "END")
    return fault(32, "CHK-END", "text goes on after the end of the program");
  if (l.length > longest_block_)
    fault(33, "CHK-SYNTAX",
          "the block has " + std::to_string(l.length) + " characters; this machine's have " +
              std::to_string(longest_block_) + " at most");
  if (l.skipped && (l.words == std::vector<std::string>{"M0"} || l.words == std::vector<std::string>{"M1"}))
    return optional_stop();
  if (l.skipped)
    fault(33, "CHK-UNVERIFIABLE", "a block that may be skipped (/) is taken as not skipped", true);
  dispatch(l);
}

void Interpreter::dispatch(const Line& l) {
  const std::vector<std::string>& w = l.words;
  const std::string second = w.size() > 1 ? w[1] : "";
  const auto is = [&](const char* a, const char* b) { return w[0] == a && second == b; };
  if (is("BEGIN", "PGM")) return begin_program(w);
  if (!begun_) {
    begun_ = true;
    fault(33, "CHK-SYNTAX", "the program does not begin with BEGIN PGM, its name and MM");
  }
  if (waits_for_dwell_ && !(is("CYCL", "DEF") && w.size() > 2 && w[2] == "9.1")) {
    fault(33, "CHK-CYCLE", "cycle 9 has no line 9.1 with the time it waits");
    waits_for_dwell_ = false;
  }
  if (is("END", "PGM")) return end_program(w);
  if (is("BLK", "FORM")) return;  // the raw piece of the control's own simulation
  if (is("TOOL", "CALL")) return tool_call(w);
  if (is("TOOL", "DEF")) return tool_definition(w);
  if (is("CYCL", "DEF")) return cycle_definition(w);
  if (is("CYCL", "CALL")) {
    if (w.size() > 2) return unfollowed("CYCL CALL with " + w[2]);
    return call_cycle();
  }
  if (w[0] == "STOP") return misc(w);
  if (w[0] == "CC") return pole(w);
  if (w[0] == "L" || w[0] == "C" || w[0] == "CR" || w[0] == "CP") return move(w);
  if (w[0].front() == 'M' && number_behind(w[0], "M")) return misc(w);
  if (is("PLANE", "RESET") && w.size() == 3 && w[2] == "STAY") return;
  unfollowed(w[0] + (second.empty() ? "" : " " + second));
}

void Interpreter::begin_program(const std::vector<std::string>& w) {
  if (begun_) return fault(33, "CHK-SYNTAX", "BEGIN PGM stands within the program");
  begun_ = true;
  if (w.size() != 4 || (w[3] != "MM" && w[3] != "INCH"))
    return fault(33, "CHK-SYNTAX", "BEGIN PGM takes the program's name and MM or INCH");
  name_ = w[2];
  units_stated_ = true;
  if (w[3] == "INCH") {
    inch_ = true;
    fault(2, "CHK-UNVERIFIABLE", "the program is in inch: how its feeds count is not followed", true);
  }
  restate();
}

void Interpreter::end_program(const std::vector<std::string>& w) {
  closed_ = true;
  if (w.size() != 4 || w[2] != name_ || w[3] != (inch_ ? "INCH" : "MM"))
    fault(33, "CHK-SYNTAX", "END PGM does not name the program and the unit of BEGIN PGM");
  if (!out_.ended) after_move({30});
}

/// M functions in a block of their own, perhaps with STOP.
void Interpreter::misc(const std::vector<std::string>& w) {
  std::vector<int> m;
  const bool stops = w[0] == "STOP";
  for (std::size_t i = stops ? 1 : 0; i < w.size(); ++i) {
    const auto code = number_behind(w[i], "M");
    if (!code || *code < 0.0 || *code > 999.0 || *code != std::floor(*code))
      return fault(33, "CHK-WORD", w[i] + " is no M function, and stands in a block of these");
    if (std::find(m.begin(), m.end(), static_cast<int>(*code)) == m.end())
      m.push_back(static_cast<int>(*code));
  }
  if (std::find(m.begin(), m.end(), 91) != m.end())
    return fault(33, "CHK-WORD", "M91 stands in a block without a move");
  before_move(m);
  if (std::find(m.begin(), m.end(), 99) != m.end()) call_cycle();
  after_move(m, stops);
}

void Interpreter::once(bool before, const std::string& what) {
  if (before) fault(33, "CHK-WORD-TWICE", what + " stands twice in one block; leave one of them");
}

bool Interpreter::take_radius(const std::string& word, Said& s) {
  if (word != "R0" && word != "RL" && word != "RR") return false;
  once(s.radius, "a radius compensation (R0, RL, RR)");
  s.radius = true;
  if (word == "R0") {
    radius_ = -1;
    stated_ |= kStatedRadius;
    return true;
  }
  left_ = word == "RL";
  radius_ = tool_;
  return true;
}

bool Interpreter::take_axis(const std::string& word, Said& s) {
  const bool by_increment = word.front() == 'I' && word.size() > 1;
  const char axis = by_increment ? word[1] : word[0];
  if (axis < 'X' || axis > 'Z') return false;
  const std::string letters = by_increment ? std::string("I") + axis : std::string(1, axis);
  const auto value = number_behind(word, letters);
  if (!value) {
    fault(1, "CHK-NUMBER", letters + " is not followed by a number (\"" + word.substr(0, 20) + "\")");
    return true;
  }
  if (std::abs(*value) > kMost)
    fault(33, "CHK-WORD", word + " is more than the control takes, " + plain(kMost));
  const int i = axis - 'A', at = axis - 'X';
  once(s.axes.has[i], std::string("the axis ") + axis);
  const double now[3] = {at_.x, at_.y, at_.z};
  if (by_increment && !known_[at])
    fault(27, "CHK-POSITION", letters + " counts from a place that is not known");
  s.axes.has[i] = true;
  s.incremental = s.incremental || by_increment;
  s.axes.value[i] = by_increment ? now[at] / units() + *value : *value;
  return true;
}

/// DR, IPA of CP and R of CR. `followed` false: the block is not.
bool Interpreter::take_arc(const std::string& word, std::string_view kind, Said& s, bool& followed) {
  if (word == "DR+" || word == "DR-") {
    once(s.clockwise.has_value(), "DR");
    s.clockwise = word == "DR-";
    return true;
  }
  if (kind == "CP" && word.starts_with("IPA")) {
    once(s.angle.has_value(), "IPA");
    s.angle = number_behind(word, "IPA");
    followed = s.angle.has_value();
    if (!s.angle) fault(1, "CHK-NUMBER", "IPA is not followed by a number (\"" + word.substr(0, 20) + "\")");
    if (s.angle && std::abs(*s.angle) > kMost)
      fault(33, "CHK-WORD", word + " is more than the control takes, " + plain(kMost) + " degrees");
    return true;
  }
  if (kind == "CR" && word.front() == 'R') {
    const auto radius = number_behind(word, "R");
    once(s.axes.is('R'), "R");
    followed = radius.has_value();
    if (!followed) fault(1, "CHK-NUMBER", "R of CR is not followed by a number");
    s.axes.has['R' - 'A'] = true;
    s.axes.value['R' - 'A'] = radius.value_or(0.0);
    return true;
  }
  return false;
}

/// False: the block is not followed.
bool Interpreter::take(const std::string& word, std::string_view kind, Said& s) {
  bool followed = true;
  if (take_radius(word, s) || take_arc(word, kind, s, followed)) return followed;
  if (take_axis(word, s)) return true;
  if (word == "FMAX") {
    once(s.rapid, "FMAX");
    s.rapid = true;
    return true;
  }
  if (word.front() == 'F') {
    const auto feed = number_behind(word, "F");
    if (!feed || *feed < 0.0) {
      fault(33, "CHK-UNVERIFIABLE", word + " is no feed in mm/min and is not followed", true);
      return false;
    }
    once(s.feed.has_value(), "F");
    s.feed = feed;
    return true;
  }
  if (const auto m = number_behind(word, "M"); m && *m >= 0.0 && *m <= 999.0 && *m == std::floor(*m)) {
    const int code = static_cast<int>(*m);
    if (code == 91) {
      s.in_machine = true;
    } else {
      s.m.push_back(code);
    }
    return true;
  }
  fault(33, "CHK-UNVERIFIABLE", "the word " + word.substr(0, 20) + " of this block is not followed", true);
  return false;
}

void Interpreter::move(const std::vector<std::string>& w) {
  const std::string& kind = w[0];
  Said s;
  for (std::size_t i = 1; i < w.size(); ++i) {
    if (!take(w[i], kind, s)) return;
  }
  if (s.in_machine && s.incremental)
    return fault(
        33, "CHK-WORD",
        "an increment (I) and M91 stand in one block: it counts from the last place with M91, which is "
        "not followed; state the machine's place without I");
  if (s.rapid && s.feed) fault(33, "CHK-WORD", "FMAX and another feed stand in one block");
  if (s.feed) {
    feed_ = *s.feed * units();
    stated_ |= kStatedFeed;
  }
  before_move(s.m);
  if (kind == "L") {
    if (s.clockwise) fault(33, "CHK-WORD", "DR stands in a straight block");
    if (s.in_machine && !s.rapid) unfollowed("M91 at a feed");
    straight(s.axes, s.rapid ? 0 : 1, s.in_machine);
  } else {
    arc_block(kind, s);
  }
  if (s.has_m(99)) call_cycle();
  after_move(s.m);
}

void Interpreter::pole(const std::vector<std::string>& w) {
  pole_.reset();
  const auto x = w.size() == 3 ? number_behind(w[1], "X") : std::nullopt;
  const auto y = w.size() == 3 ? number_behind(w[2], "Y") : std::nullopt;
  if (!x || !y)
    return fault(33, "CHK-UNVERIFIABLE", "CC without both X and Y as absolute places is not followed", true);
  pole_ = geometry::Vec2{*x * units(), *y * units()};
}

void Interpreter::arc_block(std::string_view kind, Said& s) {
  if (s.in_machine) return unfollowed("an arc with M91");
  if (s.rapid) fault(33, "CHK-UNVERIFIABLE", "an arc with FMAX is taken at the last feed", true);
  if (!s.clockwise) return fault(23, "CHK-ARC", "the arc has no direction (DR+ or DR-)");
  if (kind == "CR") {
    if (!s.axes.is('R')) return fault(23, "CHK-ARC", "CR has no radius (R)");
    if (s.axes.is('Z')) return unfollowed("CR with Z");
    return arc(s.axes, *s.clockwise);
  }
  if (!pole_) return fault(23, "CHK-ARC", "the arc has no centre: CC comes before it");
  if (kind == "CP") return helix(s);
  if (s.axes.is('Z')) return unfollowed("C with Z");
  if (!s.any_axis()) return fault(23, "CHK-ARC", "C has no end (X, Y)");
  s.axes.has['I' - 'A'] = s.axes.has['J' - 'A'] = true;
  s.axes.value['I' - 'A'] = (pole_->x - at_.x) / units();
  s.axes.value['J' - 'A'] = (pole_->y - at_.y) / units();
  arc(s.axes, *s.clockwise);
}

/// CP turns about the pole by IPA from where the tool is, up or down in step.
void Interpreter::helix(const Said& s) {
  if (s.axes.is('X') || s.axes.is('Y') || !s.angle)
    return fault(23, "CHK-ARC", "CP is followed with IPA, perhaps Z, and DR only", true);
  if (!known_[0] || !known_[1] || !known_[2])
    return fault(23, "CHK-ARC", "an arc starts where the position is not known");
  const double total = std::abs(*s.angle) / 180.0 * kPi;
  if (total == 0.0 || (*s.angle < 0.0) != *s.clockwise)
    return fault(23, "CHK-ARC", "IPA " + plain(*s.angle) + " and DR do not turn the same way");
  Block b = block();
  b.move = *s.clockwise ? MoveKind::kArcCw : MoveKind::kArcCcw;
  b.centre = *pole_;
  for (int i = 0; i < 3; ++i) b.words[i] = true;
  const double way = *s.clockwise ? -1.0 : 1.0, c = std::cos(way * total), t = std::sin(way * total);
  const geometry::Vec2 spoke = xy(b.from) - *pole_;
  b.to.x = pole_->x + c * spoke.x - t * spoke.y;
  b.to.y = pole_->y + t * spoke.x + c * spoke.y;
  if (s.axes.is('Z')) b.to.z = s.axes.of('Z') * units();
  half_turns(b, total);
}

/// Some of these act before the block's move and some behind it: of two of one kind nobody means both.
void Interpreter::one_of_a_kind(const std::vector<int>& m) {
  static constexpr std::array<std::pair<std::string_view, std::array<int, 5>>, 4> kKinds = {{
      {"spindle", {3, 4, 5, 13, 14}},
      {"coolant", {8, 9, 13, 14, -1}},
      {"coolant", {7, 9, -1, -1, -1}},
      {"stop or end", {0, 1, 2, 30, -1}},
  }};
  for (const auto& [kind, codes] : kKinds) {
    int said = -1;
    for (const int code : m) {
      if (std::find(codes.begin(), codes.end(), code) == codes.end() || code == said) continue;
      if (said >= 0)
        return fault(33, "CHK-WORD",
                     "M" + std::to_string(said) + " and M" + std::to_string(code) + " stand in one block (" +
                         std::string(kind) + "); state one of them, or two blocks");
      said = code;
    }
  }
}

void Interpreter::before_move(const std::vector<int>& m) {
  one_of_a_kind(m);
  for (const int code : m) {
    switch (code) {
      case 3:
      case 4:
      case 13:
      case 14:
        start(code == 3 || code == 13 ? 1 : -1);
        if (code > 4) flood_ = true;
        break;
      case 7:
      case 8:
        coolant(code);
        break;
      case 0:
      case 1:
      case 2:
      case 5:
      case 9:
      case 30:
      case 99:
      case 129:  // M128, which moves the tool about its tip, is off
        break;
      default:
        if (!is_own_m(code) && builders(code)) break;
        fault(33, "CHK-CODE", "M" + std::to_string(code) + " is not followed: what it does is not known",
              true);
    }
  }
}

/// Where the machine's tools are proved out it stands between two of them, with the tool away and all off.
void Interpreter::optional_stop() {
  if (!proves_out_ || !machine_z_ || spindle_ != 0 || flood_ || mist_ || through_)
    out_.odd.emplace_back(line_, "M1");
}

/// M0 also stops the spindle and turns the coolant off; STOP by itself leaves them.
void Interpreter::after_move(const std::vector<int>& m, bool stop_block) {
  const auto has = [&](int code) { return std::find(m.begin(), m.end(), code) != m.end(); };
  if (has(5)) spindle_ = 0;
  if (has(9)) coolant(9);
  if (has(1)) optional_stop();
  if (has(0) || stop_block) stop();
  if (has(0)) {
    spindle_ = 0;
    mist_ = flood_ = through_ = false;
  }
  if (!has(2) && !has(30)) return;
  Block b = block();
  b.kind = Block::Kind::kEnd;
  out_.blocks.push_back(b);
  out_.ended = true;
}

Program Interpreter::finish(long lines) {
  out_.lines = lines;
  if (!closed_) {
    line_ = lines;
    fault(32, "CHK-END", "the program has no END PGM: its end is missing");
  }
  return std::move(out_);
}

Program read_program(std::string_view text, const model::Machine& machine) {
  if (text.size() > kProgramCap) return too_large_program();
  Interpreter control(machine);
  Line line;
  long number = 0, begins = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    ++number;
    if (!line.goes_on) {
      line = Line{};
      begins = number;
    }
    add_line(text.substr(0, end), line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!line.goes_on || text.empty()) control.block_line(line, begins);
  }
  return control.finish(number);
}

}  // namespace capstan::verify::heidenhain
