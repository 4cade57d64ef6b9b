#include "tests/linuxcnc/times.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "planner/ground/base/number.h"
#include "planner/physics/motion/time.h"

namespace capstan::linuxcnc {
namespace {

constexpr std::string_view kMarker = "(CAPSTAN STEP id=\"";

std::string cell(const std::string& text, std::size_t width) {
  return text.size() >= width ? text + " " : std::string(width - text.size(), ' ') + text;
}

// Where the lines of a program belong.
class Reader {
 public:
  void take(const std::string& line, double moving_s) {
    if (line.starts_with(kMarker)) {
      const auto end = line.find('"', kMarker.size());
      out_.push_back({.id = line.substr(kMarker.size(), end - kMarker.size())});
      part_ = Part::kLink;
      across_ = false;
    } else if (line.starts_with("G53 G0") || line.find(" M6") != std::string::npos) {
      // The way up belongs to the step that follows, like the change itself.
      if (line.starts_with("G53")) part_ = Part::kUp;
      if (part_ == Part::kLink) part_ = Part::kChange;
    }
    if (part_ == Part::kUp) {
      up_s_ += moving_s;
      return;
    }
    if (out_.empty()) return;
    StepSeconds& step = out_.back();
    if (part_ == Part::kPath) {
      step.path_s += moving_s + dwell_s(line);
      return;
    }
    if (part_ == Part::kChange) {
      step.change_s += moving_s + up_s_;
      up_s_ = 0.0;
    } else {
      step.link_s += moving_s;
    }
    // Across to above the first point, then down to the security plane: there the path begins.
    if (line.starts_with("G0 X") || line.starts_with("G0 Y")) across_ = true;
    if (across_ && line.starts_with("G0 Z")) part_ = Part::kPath;
  }

  [[nodiscard]] std::vector<StepSeconds> done() { return std::move(out_); }

 private:
  enum class Part { kUp, kLink, kChange, kPath };

  static double dwell_s(const std::string& line) {
    return line.starts_with("G4 P") ? parse_double(line.substr(4)).value_or(0.0) : 0.0;
  }

  std::vector<StepSeconds> out_;
  Part part_ = Part::kUp;
  bool across_ = false;
  double up_s_ = 0.0;
};

}  // namespace

std::vector<StepSeconds> measured(const std::string& program, const Record& record) {
  std::map<int, double> moving_s;
  for (std::size_t i = 0; i < record.size(); ++i) {
    if (record.speed_mm_s[i] > 0.0) moving_s[record.line[i]] += kServoPeriod;
  }
  Reader reader;
  std::istringstream lines(program);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto it = moving_s.find(++number);
    reader.take(line, it == moving_s.end() ? 0.0 : it->second);
  }
  return reader.done();
}

Result<Predicted> predicted(const model::Plan& plan) {
  Predicted out;
  for (const model::StepResult& step : plan.steps) {
    if (!step.path || step.path->size() == 0) continue;
    const auto time = motion::time_of(*step.path, motion::schedule_of(step), plan.machine);
    if (!time) return tl::unexpected(time.error());
    out.steps.push_back(
        {.id = model::step_id(plan, step), .path_s = time->cutting_s + time->rapid_s + time->dwell_s});
  }
  const auto whole = motion::time_of(plan);
  if (!whole) return tl::unexpected(whole.error());
  out.link_s = whole->link_s;
  return out;
}

Comparison compare(const std::vector<StepSeconds>& measured, const Predicted& predicted) {
  Comparison out;
  std::string& t = out.table;
  const auto row = [&](const std::string& name, double m, double p) {
    t += cell(name, 42) + cell(fixed(m, 3), 10) + cell(fixed(p, 3), 11) +
         cell(m > 0.0 ? fixed(100.0 * (p / m - 1.0), 1) : "-", 8) + "\n";
  };
  t += cell("step", 42) + cell("measured s", 11) + cell("predicted s", 12) + cell("%", 7) + "\n";
  double link_s = 0.0;
  for (std::size_t i = 0; i < std::max(measured.size(), predicted.steps.size()); ++i) {
    const StepSeconds m = i < measured.size() ? measured[i] : StepSeconds{};
    const double p = i < predicted.steps.size() ? predicted.steps[i].path_s : 0.0;
    row(m.id.empty() ? predicted.steps[i].id : m.id, m.path_s, p);
    out.measured_s += m.path_s + m.link_s;
    out.predicted_s += p;
    out.change_s += m.change_s;
    link_s += m.link_s;
  }
  out.predicted_s += predicted.link_s;
  row("between steps with the same tool", link_s, predicted.link_s);
  row("in all", out.measured_s, out.predicted_s);
  t += cell("to tool changes and back, in neither", 42) + cell(fixed(out.change_s, 3), 10) + "\n";
  return out;
}

std::vector<std::string> offsets_for(const model::Plan& plan) {
  // Away from the end of the travel, so that rounding does not touch it.
  constexpr double kMarginMm = 1.0;
  const double top = plan.machine.axes[2].travel_max_mm;
  double highest = 0.0;
  for (const model::SetupResult& s : plan.setups) highest = std::max(highest, s.security_z_mm);
  double longest = 0.0;
  for (const model::Cutter& c : plan.cutters) longest = std::max(longest, c.functional_length_mm);
  std::set<std::string> offsets;
  for (const model::SetupResult& s : plan.setups) {
    offsets.insert(s.work_offset + ":0,0," + fixed(top - kMarginMm - highest - longest, 3));
  }
  return {offsets.begin(), offsets.end()};
}

}  // namespace capstan::linuxcnc
