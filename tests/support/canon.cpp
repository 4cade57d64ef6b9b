#include "tests/support/canon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "planner/ground/base/number.h"

namespace capstan::testing {
namespace {

constexpr double kSame = 1e-9;

struct Call {
  std::string name, text;
  std::vector<double> numbers;
};

// "   12 NAME(arguments)" or "   12 N..... NAME(arguments)"
bool parse(const std::string& line, Call& out) {
  const auto open = line.find('(');
  const auto close = line.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close < open) return false;
  const auto space = line.rfind(' ', open);
  const auto begin = space == std::string::npos ? 0 : space + 1;
  out.name = line.substr(begin, open - begin);
  out.text = line.substr(open + 1, close - open - 1);
  out.numbers.clear();
  std::string words = out.text;
  std::replace(words.begin(), words.end(), ',', ' ');
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    if (const auto v = parse_double(word)) out.numbers.push_back(*v);
  }
  return true;
}

double swept(const CanonMove& m, int turns) {
  const double a = std::atan2(m.from_y - m.cy, m.from_x - m.cx);
  const double b = std::atan2(m.y - m.cy, m.x - m.cx);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kRounding = 1e-4;  // rad: lists are printed to 1e-4 mm
  double part = turns < 0 ? a - b : b - a;
  while (part <= kRounding) part += kTurn;
  while (part > kTurn + kRounding) part -= kTurn;
  part += kTurn * (std::abs(turns) - 1);
  return turns < 0 ? -part : part;
}

class Reader {
 public:
  void take(const Call& c, long line) {
    move_.line = line;
    if (c.name == "COMMENT") return comment(c.text);
    if (c.name == "CHANGE_TOOL") {
      move_.tool = c.text;
      out_.tools.push_back(c.text);
    } else if (c.name == "SET_SPINDLE_SPEED" && !c.numbers.empty()) {
      speed_ = c.numbers.back();
      if (turning_ != 0.0) move_.rpm = turning_ * speed_;
    } else if (c.name == "START_SPINDLE_CLOCKWISE") {
      turn(1.0);
    } else if (c.name == "START_SPINDLE_COUNTERCLOCKWISE") {
      turn(-1.0);
    } else if (c.name == "STOP_SPINDLE_TURNING") {
      turn(0.0);
    } else if (c.name == "SET_FEED_RATE" && !c.numbers.empty()) {
      move_.feed_mm_min = c.numbers.front();
    } else if (c.name == "FLOOD_ON") {
      move_.flood = true;
    } else if (c.name == "FLOOD_OFF") {
      move_.flood = false;
    } else if (c.name == "PROGRAM_END") {
      out_.ended = true;
    } else {
      motion(c);
    }
  }

  CanonProgram done() { return std::move(out_); }

 private:
  void comment(const std::string& text) {
    static const std::string kMarker = "CAPSTAN STEP id=\"";
    const auto at = text.find(kMarker);
    if (at == std::string::npos) return;
    const auto begin = at + kMarker.size();
    move_.step = text.substr(begin, text.find('"', begin) - begin);
  }

  void turn(double way) {
    turning_ = way;
    move_.rpm = way * speed_;
  }

  void motion(const Call& c) {
    const auto& n = c.numbers;
    CanonMove m = move_;
    m.from_x = move_.x;
    m.from_y = move_.y;
    m.from_z = move_.z;
    if ((c.name == "STRAIGHT_TRAVERSE" || c.name == "STRAIGHT_FEED") && n.size() >= 3) {
      m.kind = c.name == "STRAIGHT_FEED" ? CanonMove::Kind::kFeed : CanonMove::Kind::kTraverse;
      m.x = n[0];
      m.y = n[1];
      m.z = n[2];
    } else if (c.name == "ARC_FEED" && n.size() >= 6) {
      m.kind = CanonMove::Kind::kArc;
      m.x = n[0];
      m.y = n[1];
      m.cx = n[2];
      m.cy = n[3];
      m.z = n[5];
      m.sweep = swept(m, static_cast<int>(n[4]));
    } else {
      return;
    }
    out_.moves.push_back(m);
    move_.x = m.x;
    move_.y = m.y;
    move_.z = m.z;
  }

  CanonProgram out_;
  CanonMove move_;  ///< the state, and where the tool is
  double speed_ = 0.0, turning_ = 0.0;
};

bool still(const CanonMove& m) {
  return m.kind != CanonMove::Kind::kArc &&
         std::abs(m.x - m.from_x) + std::abs(m.y - m.from_y) + std::abs(m.z - m.from_z) < kSame;
}

}  // namespace

CanonProgram read_canon(std::string_view text) {
  Reader reader;
  std::istringstream lines{std::string(text)};
  long n = 0;
  Call call;
  for (std::string line; std::getline(lines, line);) {
    ++n;
    if (parse(line, call)) reader.take(call, n);
  }
  return reader.done();
}

std::vector<CanonMove> motion_below(const std::vector<CanonMove>& moves, double height_mm) {
  std::vector<CanonMove> out;
  bool high = true;
  for (const CanonMove& m : moves) {
    const bool traverse = m.kind == CanonMove::Kind::kTraverse;
    // Machine coordinates of a retract come out far from the part, on either side.
    constexpr double kFar = 1000.0;
    if (traverse && (m.z >= height_mm - kSame || m.z < -kFar)) {
      high = true;
      continue;
    }
    if (traverse && high && std::abs(m.x - m.from_x) + std::abs(m.y - m.from_y) < kSame) {
      high = false;
      continue;
    }
    high = false;
    if (still(m)) continue;
    if (!out.empty() && m.kind == CanonMove::Kind::kArc && out.back().kind == CanonMove::Kind::kArc &&
        std::abs(m.cx - out.back().cx) + std::abs(m.cy - out.back().cy) < 1e-3 &&
        (m.sweep > 0.0) == (out.back().sweep > 0.0)) {
      CanonMove& whole = out.back();
      whole.x = m.x;
      whole.y = m.y;
      whole.z = m.z;
      whole.sweep += m.sweep;
      continue;
    }
    out.push_back(m);
  }
  return out;
}

}  // namespace capstan::testing
