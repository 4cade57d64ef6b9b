#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter_path.h"

/// What is known of the plates of the NIST smart-manufacturing test bed, read from its files.
namespace capstan::validation::nist {

struct PlateTool {
  int number = 0;
  std::string name;
  double diameter_mm = 0.0, stickout_short_mm = 0.0, stickout_long_mm = 0.0;
};

struct PlatePart {
  int part = 0;
  bool long_tools = false, calibrates = false, interrupted = false, traced = false;
  std::map<int, double> feed_ipm = {};  ///< by tool, where the trace shows another one than the table
  double rpm = 0.0;                     ///< 0: the table's
};

/// One row of times_per_tool.csv.
struct ToolTime {
  int part = 0, tool = 0;
  double rpm = 0.0, feed_ipm = 0.0, nominal_s = 0.0, active_s = 0.0, feeding_s = 0.0;
};

/// Times that the trace of a part shows for a tool, s. The traces hold two runs: the plate's program, and
/// days later another one with the tool that was still in the spindle.
struct TraceTime {
  double active_s = 0.0, feeding_s = 0.0;              ///< in the spindle; of it with Feed_Rate above zero
  double later_active_s = 0.0, later_feeding_s = 0.0;  ///< the later run
};

/// What one tool does in a program: from its first move to its last.
struct ToolRun {
  int tool = 0;
  model::CutterPath path = {};
  model::FeedSchedule schedule = {};
  double feed_mm_min = 0.0;  ///< the one F word of the tool
};

struct Plate {
  std::vector<PlateTool> tools;
  std::vector<PlatePart> parts;
  std::vector<ToolTime> times;
  std::map<int, std::map<int, TraceTime>> traces;  ///< part, tool
  std::map<int, std::vector<ToolRun>> programs;    ///< 2 and 20
  double rapid_mm_s = 0.0, feed_max_mm_s = 0.0;
};

/// Reads all of it. `folder`: measured/nist_plate of the corpus; `setup`: nist_plate.yaml.
[[nodiscard]] Result<Plate> read_plate(const std::string& folder, const std::string& setup);

/// One row of cmm_values.csv.
struct Measured {
  int part = 0;
  std::string designator;
  double nominal = 0.0, value = 0.0;
};
[[nodiscard]] Result<std::vector<Measured>> read_measured(const std::string& folder);

}  // namespace capstan::validation::nist
