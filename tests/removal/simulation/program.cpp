#include "tests/removal/simulation/program.h"

#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>

#include "tests/support/rs274.h"

namespace capstan::testing::removal {
namespace {

constexpr const char* kMachineMove = "REMOVAL G53";
constexpr double kInch = 25.4;
constexpr double kSame = 1e-3;

std::optional<double> word(const std::string& line, char letter) {
  for (std::size_t i = 0; i + 1 < line.size() && line[i] != ';'; ++i) {
    if (line[i] != letter || (i > 0 && line[i - 1] != ' ')) continue;
    char* end = nullptr;
    const double v = std::strtod(line.c_str() + i + 1, &end);
    if (end != line.c_str() + i + 1) return v;
  }
  return std::nullopt;
}

// The stand-alone interpreter takes the table's numbers as inches: it gets them as inches.
std::string in_inches(const std::string& table, std::map<int, double>& length_mm) {
  std::istringstream lines(table);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    const auto t = word(line, 'T');
    const auto z = word(line, 'Z');
    const auto d = word(line, 'D');
    if (!t) continue;
    const int tool = static_cast<int>(*t);
    length_mm[tool] = z.value_or(0.0);
    std::ostringstream text;
    text.precision(12);
    text << 'T' << tool << " P" << tool << " Z" << z.value_or(0.0) / kInch << " D" << d.value_or(0.0) / kInch
         << "\n";
    out += text.str();
  }
  return out;
}

// Moves in machine coordinates are told from others by a comment before them.
std::string with_machine_moves_marked(const std::string& program) {
  std::istringstream lines(program);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("G53") != std::string::npos && line.front() != '(')
      out += std::string("(") + kMachineMove + ")\n";
    out += line + "\n";
  }
  return out;
}

double swept(const Motion& m, int turns) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kRounding = 1e-4;
  const double a = std::atan2(m.from.y - m.centre_y, m.from.x - m.centre_x);
  const double b = std::atan2(m.to.y - m.centre_y, m.to.x - m.centre_x);
  double part = turns < 0 ? a - b : b - a;
  while (part <= kRounding) part += kTurn;
  while (part > kTurn + kRounding) part -= kTurn;
  part += kTurn * (std::abs(turns) - 1);
  return turns < 0 ? -part : part;
}

int number_after(const std::string& text, const std::string& key, int otherwise) {
  const auto at = text.find(key);
  return at == std::string::npos ? otherwise : std::atoi(text.c_str() + at + key.size());
}

class Reader {
 public:
  explicit Reader(std::map<int, double> lengths) : lengths_(std::move(lengths)) {
    out_.steps.push_back({"before the first step", 0});
  }

  void take(const CanonCall& c) {
    const auto& n = c.numbers;
    if (c.name == "COMMENT") {
      comment(c.text);
    } else if (c.name == "SELECT_TOOL" && !n.empty()) {
      selected_ = static_cast<int>(n[0]);
    } else if (c.name == "CHANGE_TOOL") {  // its number is the place in the table, not the tool's
      tool_ = selected_;
    } else if (c.name == "USE_TOOL_LENGTH_OFFSET" && n.size() >= 3) {
      offset_ = n[2];
    } else if ((c.name == "STRAIGHT_TRAVERSE" || c.name == "STRAIGHT_FEED") && n.size() >= 3) {
      Motion m = next(c.name == "STRAIGHT_TRAVERSE");
      finish(m, n[0], n[1], n[2]);
    } else if (c.name == "ARC_FEED" && n.size() >= 6) {
      Motion m = next(false);
      m.arc = true;
      m.centre_x = n[2];
      m.centre_y = n[3];
      m.to.x = n[0];
      m.to.y = n[1];
      m.sweep_rad = swept(m, static_cast<int>(n[4]));
      finish(m, n[0], n[1], n[5]);
    } else if (c.name == "RIGID_TAP" && n.size() >= 3) {
      const Point top = at_;
      finish(next(false), n[0], n[1], n[2]);
      at_ = top;
    } else if (c.name == "PROGRAM_END") {
      ended_ = true;
    }
  }

  Motions done(int status) {
    out_.status = status;
    if (!ended_) out_.fault = "the program does not end";
    return std::move(out_);
  }

 private:
  void comment(const std::string& text) {
    if (text.find(kMachineMove) != std::string::npos) {
      machine_move_ = true;
      return;
    }
    static const std::string kMarker = "CAPSTAN STEP id=\"";
    const auto at = text.find(kMarker);
    if (at == std::string::npos) return;
    const auto begin = at + kMarker.size();
    const auto end = text.find('"', begin);
    const std::string rest = text.substr(end);
    out_.steps.push_back({text.substr(begin, end - begin), number_after(rest, "tool=", 0)});
    setup_ = number_after(rest, "setup=", setup_);
  }

  Motion next(bool rapid) const {
    Motion m;
    m.rapid = rapid;
    m.from = at_;
    m.tool = tool_;
    m.setup = setup_;
    m.step = out_.steps.size() - 1;
    return m;
  }

  void finish(Motion m, double x, double y, double z) {
    // Where the axis is, then where the tip of what is in the spindle is.
    const double machine_z = z + offset_;
    if (machine_move_) {
      far_z_ = machine_z;
      machine_move_ = false;
    }
    const auto length = lengths_.find(tool_);
    double tip = machine_z - (length == lengths_.end() ? 0.0 : length->second);
    if (far_z_ && std::abs(*far_z_ - machine_z) < kSame) {
      tip = kFarAbove;
    } else {
      far_z_.reset();
    }
    m.to = {x, y, tip};
    at_ = m.to;
    out_.moves.push_back(m);
  }

  Motions out_;
  std::map<int, double> lengths_;
  Point at_{0.0, 0.0, kFarAbove};
  int selected_ = 0, tool_ = 0, setup_ = 1;
  double offset_ = 0.0;
  bool machine_move_ = false, ended_ = false;
  std::optional<double> far_z_;
};

}  // namespace

Motions read_motions(const std::string& program, const std::string& tool_table) {
  std::map<int, double> lengths;
  const std::string table = in_inches(tool_table, lengths);
  const Rs274Run run = run_rs274(table, with_machine_moves_marked(program));
  Reader reader(std::move(lengths));
  for (const CanonCall& c : run.calls) reader.take(c);
  Motions out = reader.done(run.status);
  if (run.status != 0)
    out.fault += " rs274: " + run.output.substr(run.output.size() > 400 ? run.output.size() - 400 : 0);
  return out;
}

}  // namespace capstan::testing::removal
