#include "tests/linuxcnc/reference.h"

#include <algorithm>
#include <sstream>

#include "planner/ground/base/number.h"
#include "planner/physics/motion/time.h"

namespace capstan::linuxcnc {
namespace {

/// Where the number of an F word begins, or npos; comments have none.
std::size_t feed_word(const std::string& line) {
  if (line.starts_with("(")) return std::string::npos;
  const auto at = line.find(" F");
  return at == std::string::npos ? at : at + 2;
}

/// The least feed of a program, mm/min.
double least_feed(const std::string& program) {
  double out = 1e300;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    const auto at = feed_word(line);
    if (at != std::string::npos) out = std::min(out, parse_double(line.substr(at)).value_or(out));
  }
  return out;
}

std::string with_one_feed(const std::string& program, double feed_mm_min) {
  std::string out;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    const auto at = feed_word(line);
    out += (at == std::string::npos ? line : line.substr(0, at) + trimmed(feed_mm_min, 1)) + "\n";
  }
  return out;
}

void execute(ReferenceRun& out) {
  out.record = run(
      {.program = out.planned.program, .tools = out.planned.tools, .offsets = offsets_for(out.planned.plan)});
  out.failed = out.record.failed;
  if (out.failed.empty() && out.record.absent.empty())
    out.measured = measured(out.planned.program, out.record);
}

ReferenceRun run_with(const std::string& feeds) {
  ReferenceRun out;
  out.planned = plan({"examples/reference_pocket.p21", "--machine", "examples/reference_pocket_machine.yaml",
                      "--tools", "examples/reference_pocket_tools.yaml", "--feeds", feeds});
  out.failed = out.planned.failed;
  if (!out.failed.empty()) return out;
  execute(out);
  if (!out.failed.empty() || !out.record.absent.empty()) return out;
  const auto foreseen = predicted(out.planned.plan);
  if (!foreseen) {
    out.failed = to_text(foreseen.error());
    return out;
  }
  out.time = compare(out.measured, *foreseen);
  return out;
}

std::string row(const std::vector<std::string>& cells) {
  std::string out;
  for (const std::string& c : cells) out += (out.empty() ? "" : ",") + c;
  return out + "\n";
}

/// What stands between the machine's coordinates and the part's: the work offset and the tool's length.
geometry::Vec3 zero_of(const model::Plan& plan) {
  const std::string offset = offsets_for(plan).front();
  const double z = parse_double(offset.substr(offset.rfind(',') + 1)).value_or(0.0);
  return {0.0, 0.0, z + plan.cutters.front().functional_length_mm};
}

void add_motion(const std::string& name, const ReferenceRun& r, std::string& out) {
  constexpr std::size_t kEach = 10;  // periods
  const geometry::Vec3 zero = zero_of(r.planned.plan);
  std::size_t n = 0;
  for (std::size_t i = 0; i < r.record.size(); ++i) {
    if (!(r.record.speed_mm_s[i] > 0.0)) continue;
    if (n++ % kEach != 0) continue;
    out += row({name, fixed(kServoPeriod * static_cast<double>(n - 1), 3),
                fixed(r.record.x_mm[i] - zero.x, 3), fixed(r.record.y_mm[i] - zero.y, 3),
                fixed(r.record.z_mm[i] - zero.z, 3), fixed(60.0 * r.record.speed_mm_s[i], 1)});
  }
}

void add_path(const std::string& name, const model::Plan& plan, std::string& out) {
  for (const model::StepResult& step : plan.steps) {
    if (!step.path || !step.sections) continue;
    const model::FeedSchedule schedule = motion::schedule_of(step);
    std::vector<double> begins(step.path->size(), 0.0);
    for (std::size_t i = 1; i < begins.size(); ++i)
      begins[i] = begins[i - 1] + model::move_length(*step.path, i - 1);
    const model::SectionSeries& s = *step.sections;
    for (std::size_t k = 0; k < s.size(); ++k) {
      if (s.move[k] >= begins.size()) continue;
      out += row({name, model::step_id(plan, step), fixed(begins[s.move[k]] + s.at_mm[k], 3),
                  fixed(s.ad_max_mm[k], 3), fixed(s.rd_max_mm[k], 3), fixed(s.csa_mm2[k], 3),
                  fixed(schedule.feed_mm_min[s.move[k]], 1)});
    }
  }
}

void add_times(const std::string& name, const ReferenceRun& r, std::string& out) {
  const auto foreseen = predicted(r.planned.plan);
  const bool planned = r.time.predicted_s > 0.0 && foreseen;
  for (std::size_t i = 0; i < r.measured.size(); ++i) {
    const double p = planned && i < foreseen->steps.size() ? foreseen->steps[i].path_s : 0.0;
    out += row({name, r.measured[i].id, fixed(r.measured[i].path_s, 3), fixed(p, 3)});
  }
  out += row({name, "all", fixed(r.time.measured_s, 3), fixed(r.time.predicted_s, 3)});
}

}  // namespace

Reference reference() {
  Reference out;
  out.scheduled = run_with("scheduled");
  if (!out.failed().empty() || !out.absent().empty()) return out;
  out.constant = run_with("constant");
  if (!out.failed().empty() || !out.absent().empty()) return out;
  out.one_feed_mm_min = least_feed(out.constant.planned.program);
  out.one_feed.planned = out.constant.planned;
  out.one_feed.planned.program = with_one_feed(out.constant.planned.program, out.one_feed_mm_min);
  execute(out.one_feed);
  out.one_feed.time = compare(out.one_feed.measured, {});
  return out;
}

double path_length_mm(const model::Plan& plan) {
  double out = 0.0;
  for (const model::StepResult& step : plan.steps) {
    for (std::size_t i = 1; step.path && i < step.path->size(); ++i) out += model::move_length(*step.path, i);
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> tables(const Reference& r) {
  std::string motion = "run,time_s,x_mm,y_mm,z_mm,feed_mm_min\n";
  std::string path = "run,step,at_mm,depth_mm,width_mm,section_mm2,feed_mm_min\n";
  std::string times = "run,step,measured_s,predicted_s\n";
  for (const auto& [name, run] : {std::pair<std::string, const ReferenceRun&>{"scheduled", r.scheduled},
                                  std::pair<std::string, const ReferenceRun&>{"constant", r.constant}}) {
    add_motion(name, run, motion);
    add_path(name, run.planned.plan, path);
    add_times(name, run, times);
  }
  add_times("one feed", r.one_feed, times);
  return {{"reference_pocket.csv", motion},
          {"reference_pocket_path.csv", path},
          {"reference_pocket_times.csv", times}};
}

}  // namespace capstan::linuxcnc
