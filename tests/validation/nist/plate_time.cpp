#include "tests/validation/nist/plate_time.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/making/optimise/solver/solver.h"
#include "planner/physics/motion/time.h"
#include "tooling/shop/machine/machine.h"

namespace capstan::validation::nist {
model::Machine machine_of(const Plate& plate, const MachineFit& fit) {
  model::Machine m;
  m.id = "hurco";
  for (std::size_t i = 0; i < 3; ++i) {
    m.axes[i].name = std::string(1, "XYZ"[i]);
    m.axes[i].rapid_mm_min = 60.0 * plate.rapid_mm_s;
    m.axes[i].feed_max_mm_min = 60.0 * plate.feed_max_mm_s;
    m.axes[i].acceleration_mm_s2 = fit.acceleration_mm_s2;
  }
  m.control.path_tolerance_mm = fit.path_tolerance_mm;
  m.control.block_time_s = fit.block_time_s;
  return m;
}

namespace {

constexpr double kInch = 25.4;
constexpr double kWanted = 0.10;  // times within 10 %
constexpr int kEngraver = 23;
constexpr int kWithoutLaterRun = 1;  // its engraver has no later run: 154 s where the other parts have 196 s
constexpr double kWaiting_s =
    20.0;  // standing still that long is waiting for the operator (M01), not the machine
constexpr double kTopSpeed_rpm = 12000.0;

const ToolRun* run_of(const Plate& plate, const PlatePart& part, int tool) {
  const int program = part.part >= 19 ? 20 : 2;
  const auto found = plate.programs.find(program);
  if (found == plate.programs.end()) return nullptr;
  for (const ToolRun& r : found->second) {
    if (r.tool == tool) return &r;
  }
  return nullptr;
}

Result<double> moving_s(const ToolRun& run, double feed_ipm, const model::Machine& machine) {
  model::FeedSchedule schedule = run.schedule;
  std::fill(schedule.feed_mm_min.begin(), schedule.feed_mm_min.end(), kInch * feed_ipm);
  const auto t = motion::time_of(run.path, schedule, machine);
  if (!t) return tl::unexpected(t.error());
  return t->cutting_s + t->rapid_s;
}

double nominal_s(const ToolRun& run, double feed_ipm) {
  double length = 0.0;
  for (std::size_t i = 1; i < run.path.size(); ++i) {
    if (run.path.kind[i] != model::MoveKind::kRapid) length += model::move_length(run.path, i);
  }
  return 60.0 * length / (kInch * feed_ipm);
}

Status predict(const Plate& plate, const model::Machine& machine, double handling_s, std::vector<Row>& rows,
               bool calibrating_only) {
  for (Row& r : rows) {
    if (calibrating_only && !r.part->calibrates) continue;
    const auto s = moving_s(*run_of(plate, *r.part, r.time->tool), r.feed_ipm, machine);
    if (!s) return tl::unexpected(s.error());
    r.predicted_s = *s + handling_s;
  }
  return {};
}
Status predict(const Plate& plate, const MachineFit& fit, std::vector<Row>& rows, bool calibrating_only) {
  return predict(plate, machine_of(plate, fit), fit.handling_s, rows, calibrating_only);
}

double rms_of(const std::vector<Row>& rows) {
  double sum = 0.0;
  int n = 0;
  for (const Row& r : rows) {
    if (!r.part->calibrates) continue;
    const double e = std::log(r.predicted_s / r.measured_s);
    sum += e * e;
    ++n;
  }
  return n == 0 ? 0.0 : std::sqrt(sum / n);
}

// The mean of the later run over the calibrating traces.
LaterRun later_run(const Plate& plate) {
  LaterRun out;
  int n = 0;
  for (const PlatePart& p : plate.parts) {
    const auto trace = plate.traces.find(p.part);
    if (!p.calibrates || trace == plate.traces.end()) continue;
    for (const auto& [tool, t] : trace->second) {
      if (t.later_feeding_s <= 0.0) continue;
      out.moving_s += t.later_feeding_s;
      out.active_s += t.later_active_s;
      ++n;
    }
  }
  if (n > 0) out = {out.moving_s / n, out.active_s / n};
  return out;
}

Row row_of(const Plate& plate, const PlatePart& part, const ToolTime& t, const LaterRun& later) {
  Row row{.time = &t, .part = &part, .feed_ipm = t.feed_ipm, .measured_s = t.feeding_s};
  row.rpm = t.rpm;
  row.active_s = t.active_s;
  if (const auto stated = part.feed_ipm.find(t.tool); stated != part.feed_ipm.end()) {
    row.feed_ipm = stated->second;
    row.feed_from_trace = true;
    row.rpm = part.rpm;
  }
  const auto trace = plate.traces.find(part.part);
  if (trace != plate.traces.end()) {
    const auto of_tool = trace->second.find(t.tool);
    if (of_tool != trace->second.end()) {
      row.measured_s = of_tool->second.feeding_s;
      row.active_s = of_tool->second.active_s;
    }
  } else if (t.tool == kEngraver && part.part != kWithoutLaterRun) {
    row.measured_s -= later.moving_s;
    row.active_s -= later.active_s;
  }
  return row;
}

Result<MachineFit> calibrate(const Plate& plate, std::vector<Row> rows) {
  using optimise::Walk;
  optimise::Problem problem;
  problem.variables = {{"acceleration", "mm/s2", 100.0, 20000.0, 1500.0, Walk::kLogarithmic},
                       {"path tolerance", "mm", 1e-4, 0.5, 0.02, Walk::kLogarithmic},
                       {"block time", "s", 1e-4, 0.1, 0.01, Walk::kLogarithmic},
                       {"handling", "s", 0.5, 30.0, 6.0, Walk::kLogarithmic}};
  const auto fit_at = [](std::span<const double> x) {
    return MachineFit{
        .acceleration_mm_s2 = x[0], .path_tolerance_mm = x[1], .block_time_s = x[2], .handling_s = x[3]};
  };
  problem.model = optimise::central_differences(
      [&](std::span<const double> x, double& objective, std::span<double>) {
        objective = predict(plate, fit_at(x), rows, true) ? rms_of(rows) : 1e3;
      },
      problem.variables);
  Job job;
  optimise::Options options;
  options.algorithm = optimise::Algorithm::kCobyla;
  options.fall_back = false;
  options.starts = 3;
  options.evaluation_budget = 900;
  const auto solution = optimise::solve(problem, options, job);
  if (!solution) return tl::unexpected(solution.error());
  MachineFit fit = fit_at(solution->x);
  fit.rms = solution->objective;
  return fit;
}

// Least squares of standing still = exchange + top (n / 12,000)^2 over the calibrating rows.
void fit_standing(const std::vector<Row>& rows, MachineFit& fit) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const Row& r : rows) {
    const double y = r.active_s - r.measured_s;
    if (!r.part->calibrates || r.part->interrupted || y > kWaiting_s) continue;
    const double x = std::pow(r.rpm / kTopSpeed_rpm, 2.0);
    n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double det = n * sxx - sx * sx;
  if (!(std::abs(det) > 0.0)) return;
  fit.spindle_12000_s = (n * sxy - sx * sy) / det;
  fit.tool_exchange_s = (sy - fit.spindle_12000_s * sx) / n;
}

std::string remark_of(const Row& r) {
  if (r.part->interrupted) return "interrupted";
  if (r.part->calibrates) return r.feed_from_trace ? "calibrating; feed of the trace" : "calibrating";
  if (r.part->part == 7) return "schedule's feed, doubtful";
  return "";
}

// A row that counts for the aim: not calibrating, not interrupted.
bool counts(const Row& r) { return !r.part->calibrates && !r.part->interrupted; }

Result<std::vector<Row>> rows_of(const Plate& plate, const LaterRun& later) {
  std::vector<Row> out;
  for (const PlatePart& p : plate.parts) {
    for (const ToolTime& t : plate.times) {
      if (t.part != p.part) continue;
      const ToolRun* run = run_of(plate, p, t.tool);
      if (run == nullptr) return fail("VALID-PROGRAM", "no program runs tool " + std::to_string(t.tool));
      Row row = row_of(plate, p, t, later);
      row.nominal_s = nominal_s(*run, row.feed_ipm);
      out.push_back(row);
    }
  }
  return out;
}

}  // namespace

Result<std::vector<Row>> times_on(const Plate& plate, const model::Machine& machine) {
  auto rows = rows_of(plate, later_run(plate));
  if (!rows) return rows;
  if (auto s = predict(plate, machine, 0.0, *rows, false); !s) return tl::unexpected(s.error());
  return rows;
}

Result<model::Machine> uncalibrated_machine(const Plate& plate) {
  Job job;
  auto machine = tooling::load_machine(std::string(tooling::kDefaultMachine), job);
  if (!machine) return machine;
  for (model::LinearAxis& axis : machine->axes) {
    axis.rapid_mm_min = 60.0 * plate.rapid_mm_s;
    axis.feed_max_mm_min = 60.0 * plate.feed_max_mm_s;
  }
  return machine;
}

Result<TimeStudy> study_times(const Plate& plate) {
  TimeStudy out;
  out.later = later_run(plate);
  auto rows = rows_of(plate, out.later);
  if (!rows) return tl::unexpected(rows.error());
  out.rows = *std::move(rows);
  auto fit = calibrate(plate, out.rows);
  if (!fit) return tl::unexpected(fit.error());
  out.fit = *fit;
  if (auto s = predict(plate, out.fit, out.rows, false); !s) return tl::unexpected(s.error());
  fit_standing(out.rows, out.fit);
  for (Row& r : out.rows) {
    r.active_predicted_s = r.predicted_s + out.fit.tool_exchange_s +
                           out.fit.spindle_12000_s * std::pow(r.rpm / kTopSpeed_rpm, 2.0);
  }
  return out;
}

Result<std::vector<Row>> part_7_as_part_9(const Plate& plate, const TimeStudy& study) {
  std::vector<Row> out;
  for (const Row& seven : study.rows) {
    if (seven.part->part != 7) continue;
    for (const Row& nine : study.rows) {
      if (nine.part->part != 9 || nine.time->tool != seven.time->tool) continue;
      out.push_back(seven);
      out.back().feed_ipm = nine.feed_ipm;
    }
  }
  if (auto s = predict(plate, study.fit, out, false); !s) return tl::unexpected(s.error());
  return out;
}

namespace {

Table machine_table(const TimeStudy& study) {
  const MachineFit& fit = study.fit;
  return {{"parameter", "value"},
          {{"acceleration of each axis", fixed(fit.acceleration_mm_s2, 0) + " mm/s²"},
           {"path tolerance", fixed(fit.path_tolerance_mm, 4) + " mm"},
           {"least time per block", fixed(1000.0 * fit.block_time_s, 1) + " ms"},
           {"ways between tool changer and work, per tool", fixed(fit.handling_s, 1) + " s"},
           {"rms of ln(predicted/measured), calibrating rows", fixed(fit.rms, 3)},
           {"standing still per tool", fixed(fit.tool_exchange_s, 1) + " s"},
           {"start and stop of the spindle, at 12,000 rpm", fixed(fit.spindle_12000_s, 1) + " s"},
           {"later run with the engraver, taken off where there is no trace",
            fixed(study.later.moving_s, 1) + " s moving, " + fixed(study.later.active_s, 1) + " s in all"}}};
}

Table every_row(const TimeStudy& study) {
  Table rows{{"part", "tool", "feed, in/min", "path ÷ feed, s", "moving, measured, s", "predicted, s",
              "error", "in the spindle, measured, s", "predicted, s", "error", "remark"},
             {}};
  for (const Row& r : study.rows) {
    rows.rows.push_back({std::to_string(r.time->part), std::to_string(r.time->tool), shortest(r.feed_ipm),
                         fixed(r.nominal_s, 1), fixed(r.measured_s, 1), fixed(r.predicted_s, 1),
                         percent(r.error()), fixed(r.active_s, 1), fixed(r.active_predicted_s, 1),
                         percent(r.active_error()), remark_of(r)});
  }
  return rows;
}

Table data_of(const TimeStudy& study) {
  Table data{{"part", "tool", "measured", "predicted", "nominal", "set"}, {}};
  for (const Row& r : study.rows) {
    const char* set = r.part->part == 7 ? "3" : r.part->interrupted ? "2" : r.part->calibrates ? "0" : "1";
    data.rows.push_back({std::to_string(r.time->part), std::to_string(r.time->tool), fixed(r.measured_s, 2),
                         fixed(r.predicted_s, 2), fixed(r.nominal_s, 2), set});
  }
  return data;
}

}  // namespace

Comparison compare_times(const Plate& plate, const TimeStudy& study) {
  Comparison out{.name = "nist-times"};
  Table summary{{"tested rows", "n", "within 10 %", "median of amounts", "worst"}, {}};
  const auto add = [&](const std::string& name, const auto& wanted, const auto& error) {
    std::vector<double> errors;
    for (const Row& r : study.rows) {
      if (wanted(r)) errors.push_back(error(r));
    }
    const Spread s = spread_of(errors, kWanted);
    if (out.headline.empty()) {
      out.headline = std::to_string(s.within) + " of " + std::to_string(s.n) +
                     " tested times of tools in motion within 10 % (part 7, whose feeds are not known, is "
                     "told apart), median error " +
                     fixed(100.0 * s.median, 1) + " %";
    }
    summary.rows.push_back({name, std::to_string(s.n), std::to_string(s.within),
                            fixed(100.0 * s.median, 1) + " %", percent(s.worst)});
  };
  const auto error = [](const Row& r) { return r.error(); };
  const auto tested = [](const Row& r) { return counts(r) && r.part->part != 7; };
  add("test parts 4, 9, 14, 16, 18, 20: moving", tested, error);
  add("the same: tool in the spindle", tested, [](const Row& r) { return r.active_error(); });
  add("the same: moving, by path ÷ feed alone", tested,
      [](const Row& r) { return r.nominal_s / r.measured_s - 1.0; });
  for (const PlateTool& t : plate.tools) {
    add(
        "moving, T" + std::to_string(t.number) + ", " + t.name,
        [&](const Row& r) { return tested(r) && r.time->tool == t.number; }, error);
  }
  add(
      "test part 7 with the schedule's feeds: moving", [](const Row& r) { return r.part->part == 7; }, error);
  add(
      "interrupted parts 1, 11, 19: moving",
      [](const Row& r) { return r.part->interrupted && !r.part->calibrates; }, error);
  if (const auto other = part_7_as_part_9(plate, study)) {
    std::vector<double> errors;
    for (const Row& r : *other) errors.push_back(r.error());
    const Spread s = spread_of(errors, kWanted);
    summary.rows.push_back({"part 7 with the feeds of part 9 (not counted): moving", std::to_string(s.n),
                            std::to_string(s.within), fixed(100.0 * s.median, 1) + " %", percent(s.worst)});
  }
  out.text = markdown(machine_table(study)) + "\n" + markdown(summary) +
             "\n<details><summary>every tool of every part</summary>\n\n" + markdown(every_row(study)) +
             "\n</details>\n";
  out.data.emplace_back("nist_times.dat", columns(data_of(study)));
  return out;
}

}  // namespace capstan::validation::nist
