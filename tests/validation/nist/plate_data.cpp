#include "tests/validation/nist/plate_data.h"

#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/proof/verify/program/linuxcnc/reader.h"

namespace capstan::validation::nist {
namespace {

constexpr double kInch = 25.4;

std::vector<std::string_view> split(std::string_view line, char at) {
  std::vector<std::string_view> out;
  for (;;) {
    const auto end = line.find(at);
    out.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return out;
    line.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> lines_of(std::string_view text) {
  auto out = split(text, '\n');
  for (auto& l : out) {
    if (!l.empty() && l.back() == '\r') l.remove_suffix(1);
  }
  return out;
}

double number(std::string_view text) { return parse_double(text).value_or(0.0); }

Status read_setup(const std::string& file, Plate& out) {
  try {
    const YAML::Node root = YAML::LoadFile(file);
    for (const auto& t : root["tools"]) {
      out.tools.push_back(
          {t["number"].as<int>(), t["name"].as<std::string>(), kInch * t["diameter_in"].as<double>(),
           kInch * t["stickout_short_in"].as<double>(0.0), kInch * t["stickout_long_in"].as<double>(0.0)});
    }
    for (const auto& p : root["parts"]) {
      PlatePart part{.part = p["part"].as<int>(),
                     .long_tools = p["length"].as<std::string>() == "long",
                     .calibrates = p["role"].as<std::string>() == "calibrate",
                     .interrupted = p["interrupted"].as<bool>(false),
                     .rpm = p["rpm"].as<double>(0.0)};
      for (const auto& f : p["feeds"]) part.feed_ipm[f.first.as<int>()] = f.second.as<double>();
      out.parts.push_back(part);
    }
    out.rapid_mm_s = root["machine"]["rapid_mm_s"].as<double>();
    out.feed_max_mm_s = root["machine"]["feed_max_mm_s"].as<double>();
  } catch (const YAML::Exception& e) {
    return fail("VALID-SETUP", file + ": " + e.what());
  }
  return {};
}

// Seconds of "2017-02-01T14:59:58.2656250Z" within its month; negative for another line.
double seconds_of(std::string_view stamp) {
  if (stamp.size() < 20 || stamp[10] != 'T') return -1.0;
  if (stamp.back() == 'Z') stamp.remove_suffix(1);
  return ((number(stamp.substr(8, 2)) * 24.0 + number(stamp.substr(11, 2))) * 60.0 +
          number(stamp.substr(14, 2))) *
             60.0 +
         number(stamp.substr(17));
}

std::map<int, TraceTime> trace_times(std::string_view text) {
  std::map<int, TraceTime> out;
  bool active = false;
  int run = 0, tool = 0;
  double feed = 0.0, before = 0.0;
  for (const auto line : lines_of(text)) {
    const auto cells = split(line, '|');
    const double at = seconds_of(cells[0]);
    if (cells.size() < 3 || at < 0.0) continue;
    if (active && tool != 0) {
      TraceTime& t = out[tool];
      const double passed = at - before;
      (run == 1 ? t.active_s : t.later_active_s) += passed;
      if (feed > 0.0) (run == 1 ? t.feeding_s : t.later_feeding_s) += passed;
    }
    before = at;
    if (cells[1] == "Program_Status") {
      active = cells[2] == "ACTIVE";
      if (active) ++run;
    } else if (cells[1] == "Current_Tool" && !cells[2].empty()) {
      tool = static_cast<int>(number(cells[2]));
    } else if (cells[1] == "Feed_Rate") {
      feed = number(cells[2]);
    }
  }
  return out;
}

// Moves before the first known position are left out: the way from the tool changer is not in the program.
std::vector<ToolRun> runs_of(const verify::Program& program) {
  std::vector<ToolRun> out;
  std::optional<double> height;
  for (const verify::Block& b : program.blocks) {
    if (b.kind == verify::Block::Kind::kToolChange) out.push_back({.tool = b.tool});
    if (b.kind != verify::Block::Kind::kMove || out.empty() || !b.known_to[0] || !b.known_to[1]) continue;
    // The checker takes no height for known after a change of tools; this machine's axis stays where it was.
    if (b.known_to[2]) height = b.to.z;
    if (!height) continue;
    const geometry::Vec3 to{b.to.x, b.to.y, *height};
    ToolRun& run = out.back();
    const auto timed = [&] {
      run.schedule.feed_mm_min.push_back(b.feed_mm_min);
      run.schedule.spindle_rpm.push_back(b.spindle_rpm);
      run.schedule.dwell_s.push_back(0.0);
    };
    if (run.path.size() == 0) {
      run.path.start(to);
      timed();
      continue;
    }
    using model::MoveKind;
    switch (b.move) {
      case MoveKind::kRapid:
        run.path.rapid(to);
        break;
      case MoveKind::kLine:
        run.path.line(to, model::MoveRole::kCut);
        break;
      case MoveKind::kArcCw:
      case MoveKind::kArcCcw:
        run.path.arc(to, b.centre, b.move == MoveKind::kArcCw, model::MoveRole::kCut);
        break;
      case MoveKind::kDwell:
        continue;
    }
    timed();
    if (b.move != MoveKind::kRapid) run.feed_mm_min = b.feed_mm_min;
  }
  return out;
}

Status read_times(const std::string& file, Plate& out) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  bool head = true;
  for (const auto line : lines_of(*text)) {
    const auto c = split(line, ',');
    if (head || c.size() < 9) {
      head = false;
      continue;
    }
    out.times.push_back({static_cast<int>(number(c[0])), static_cast<int>(number(c[1])), number(c[2]),
                         number(c[3]), number(c[6]), number(c[7]), number(c[8])});
  }
  return {};
}

}  // namespace

Result<Plate> read_plate(const std::string& folder, const std::string& setup) {
  Plate out;
  if (auto s = read_setup(setup, out); !s) return tl::unexpected(s.error());
  if (auto s = read_times(folder + "/times_per_tool.csv", out); !s) return tl::unexpected(s.error());
  for (const int n : {2, 20}) {
    const auto text = read_file(folder + "/nc/NIST_MTC_CRADA_PLATE-" + std::to_string(n) + ".NC");
    if (!text) return tl::unexpected(text.error());
    out.programs[n] = runs_of(verify::linuxcnc::read_program(*text));
  }
  for (PlatePart& p : out.parts) {
    const std::string two = (p.part < 10 ? "0" : "") + std::to_string(p.part);
    const std::string file = folder + "/traces/Plate-Hurco04-" + two + "of20.txt";
    if (!std::filesystem::exists(file)) continue;
    const auto text = read_file(file);
    if (!text) return tl::unexpected(text.error());
    out.traces[p.part] = trace_times(*text);
    p.traced = true;
  }
  return out;
}

Result<std::vector<Measured>> read_measured(const std::string& folder) {
  const auto text = read_file(folder + "/cmm_values.csv");
  if (!text) return tl::unexpected(text.error());
  std::vector<Measured> out;
  for (const auto line : lines_of(*text)) {
    const auto c = split(line, ',');
    if (c.size() < 8 || c[0] == "part_index") continue;
    out.push_back({static_cast<int>(number(c[0])), std::string(c[3]), number(c[4]), number(c[7])});
  }
  return out;
}

}  // namespace capstan::validation::nist
