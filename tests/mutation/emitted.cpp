#include "tests/mutation/emitted.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/operation.h"
#include "tests/proof/verify/plans.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::mutation {
namespace {

using model::MoveRole;
namespace plans = verify::testing;

/// Heidenhain's blocks without their numbers: of a gap in these alone no edit is to be found.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const bool goes_on = text[at] == ' ';
    const std::size_t begin = goes_on ? at : text.find(' ', at) + 1;
    out += text.substr(begin, end + 1 - begin);
    at = end + 1;
  }
  return out;
}

Emitted written(std::string name, model::Plan plan, std::set<std::string> found = {}) {
  // What a table's comment says is all that a check by the table alone knows of a tool's kind.
  for (model::Cutter& c : plan.cutters) {
    if (c.description.empty())
      c.description =
          trimmed(c.cutting_diameter_mm, 2) + " mm " + std::string(model::to_text(c.cutter_class));
  }
  Job job;
  auto text = controls::write_program(plan, job);
  const std::string dialect = plan.machine.control.dialect;
  if (!text) throw std::runtime_error(name + ": " + to_text(text.error()));
  if (dialect == "heidenhain") text = without_numbers(*text);
  std::string table = controls::tool_table_of(plan);
  return {std::move(name), std::move(plan), *std::move(text), std::move(table), dialect, std::move(found)};
}

void extend(model::Plan& plan, std::size_t step, std::size_t moves, double feed, double rpm, double dwell_s) {
  plans::edit_schedule(plan, step, [&](auto& s) {
    for (std::size_t i = 0; i < moves; ++i) {
      s.feed_mm_min.push_back(feed);
      s.spindle_rpm.push_back(rpm);
      s.dwell_s.push_back(dwell_s);
    }
  });
}

model::Plan pocket_and_hole() {
  auto k = plans::good_plan();
  plans::with_reamer(k, 300.0);
  k.plan.machine.spindle.spin_up_s = 2.0;
  plans::edit_path(k.plan, 0, [](auto& p) {
    p.arc({35, 55, 10}, {35, 45}, false, MoveRole::kLink);
    p.arc({45, 45, 6}, {35, 45}, true, MoveRole::kLink);
    p.dwell();
    p.arc({45, 45, 4}, {40, 45}, false, MoveRole::kLink);
    p.rapid({45, 45, 10}, MoveRole::kRetract);
  });
  extend(k.plan, 0, 5, 600, 3000, 0.5);
  return k.plan;
}

model::Plan two_setups() {
  auto k = plans::good_plan();
  k.plan.machine.spindle.spin_up_s = 1.5;
  k.plan.setups.push_back(k.plan.setups[0]);
  k.plan.setups[1].work_offset = "G55";
  k.plan.steps[1].setup = 1;
  return k.plan;
}

/// The drill goes on in the second set-up.
model::Plan one_tool_in_two_setups() {
  auto k = plans::good_plan();
  k.plan.machine.spindle.spin_up_s = 1.5;
  k.plan.setups.push_back(k.plan.setups[0]);
  k.plan.setups[1].work_offset = "G55";
  model::CutterPath p = plans::drill_path();
  for (double& y : p.y) y = 85.0;
  k.step<model::Drilling>("drill anew", k.hole("H2", 15, 85, 8, 20), "d8", p, 225, 1500).setup = 1;
  return k.plan;
}

model::Plan tapped() {
  auto k = plans::empty_plan();
  k.plan.machine.spindle.spin_up_s = 1.0;
  k.plan.machine.abilities.rigid_tapping = true;
  k.step<model::Drilling>("drill", k.hole("H", 15, 15, 8, 20), "d8", plans::drill_path(), 225, 1500);
  model::Cutter t = plans::drill();
  t.id = "m10";
  t.cutter_class = model::CutterClass::kTap;
  t.thread_pitch_mm = 1.5;
  t.cutting_diameter_mm = 10.0;
  t.description = "tap M10x1.5";
  t.pocket = 3;
  k.plan.cutters.push_back(t);
  model::CutterPath p;
  p.start({15, 15, 10});
  p.rapid({15, 15, 5});
  p.line({15, 15, -12}, MoveRole::kTap);
  p.line({15, 15, 5}, MoveRole::kTap);
  p.rapid({15, 15, 10}, MoveRole::kRetract);
  const auto* drilled = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.step<model::Tapping>("tap", drilled->its_feature, "m10", p, 750, 500);
  return k.plan;
}

/// The drilled hole of the good plan, pecked: the first ends at `first_z`, each further one is `step_mm`.
model::Plan pecked(bool clears, double first_z, double step_mm) {
  auto k = plans::empty_plan();
  k.plan.machine.spindle.spin_up_s = 1.0;
  const double bottom = -20 - plans::point_length();
  model::CutterPath p;
  p.start({15, 15, 10});
  p.rapid({15, 15, 6}, MoveRole::kApproach);
  p.line({15, 15, 2}, MoveRole::kApproach);
  for (double z = first_z;; z -= step_mm) {
    p.line({15, 15, std::max(z, bottom)}, MoveRole::kDrill);
    if (z <= bottom + 0.5e-3) break;
    if (clears) p.rapid({15, 15, 6}, MoveRole::kRetract);
    p.line({15, 15, z + 0.5}, MoveRole::kLink);
  }
  p.rapid({15, 15, 10}, MoveRole::kRetract);
  const std::size_t n = p.size();
  auto& s = k.step<model::Drilling>("drill", k.hole("H", 15, 15, 8, 20), "d8", p, 225, 1500);
  model::FeedSchedule f{std::vector<double>(n, 225.0), std::vector<double>(n, 1500.0),
                        std::vector<double>(n, 0.0)};
  for (std::size_t i = 0; i < n; ++i) {
    if (p.role[i] == MoveRole::kApproach || p.role[i] == MoveRole::kLink) f.feed_mm_min[i] = 3000.0;
  }
  s.path = std::make_shared<const model::CutterPath>(std::move(p));
  s.schedule = std::make_shared<const model::FeedSchedule>(std::move(f));
  return k.plan;
}

/// The drilled hole of the good plan, bored: the bar comes out by rapid with the spindle stopped.
model::Plan bored() {
  auto k = plans::empty_plan();
  k.plan.machine.spindle.spin_up_s = 1.0;
  model::CutterPath p;
  p.start({15, 15, 10});
  p.rapid({15, 15, 2}, MoveRole::kApproach);
  p.line({15, 15, -20 - plans::point_length()}, MoveRole::kDrill);
  p.rapid({15, 15, 10}, MoveRole::kRetract);
  auto& s = k.step<model::Drilling>("drill", k.hole("H", 15, 15, 8, 20), "d8", p, 225, 1500);
  s.path = std::make_shared<const model::CutterPath>(std::move(p));
  s.schedule = std::make_shared<const model::FeedSchedule>(
      model::FeedSchedule{{225.0, 225.0, 225.0, 225.0}, {1500.0, 1500.0, 1500.0, 0.0}, {0.0, 0.0, 0.0, 0.0}});
  return k.plan;
}

/// Two turns and a half of a helix above the work.
model::Plan with_helix(model::Plan plan) {
  verify::testing::edit_path(plan, 0, [](auto& p) {
    const auto at = p.point(p.size() - 1);
    double z = at.z;
    for (int i = 0; i < 5; ++i)
      p.arc({i % 2 == 0 ? at.x - 8.0 : at.x, at.y, z -= 0.4}, {at.x - 4.0, at.y}, true, MoveRole::kLink);
    p.rapid({at.x - 8.0, at.y, at.z}, MoveRole::kRetract);
  });
  extend(plan, 0, 6, 600, 3000, 0.0);
  return plan;
}

model::Plan plate() {
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  const std::string path = capstan::testing::source_dir() + "/examples/plate_bound.p21";
  auto plan = pipeline::read_plan(testing::slurp(path), path, job);
  if (!shop || !plan) throw std::runtime_error("the plate is not read");
  auto bound = pipeline::bind(*std::move(plan), *shop, {}, job);
  if (!bound) throw std::runtime_error(to_text(bound.error()));
  return *std::move(bound);
}

}  // namespace

const std::vector<Emitted>& emitted() {
  static const std::vector<Emitted> kAll = [] {
    std::vector<Emitted> out;
    out.push_back(written("pocket and reamed hole", pocket_and_hole()));
    out.push_back(written("two set-ups", two_setups()));
    // The plan has the hole and no feature for its thread, which is wider.
    out.push_back(written("tapped hole", tapped(), {"CHK-GOUGE", "CHK-GOUGE-WALL"}));
    return out;
  }();
  return kAll;
}

namespace {

model::Plan on_control(model::Plan plan, const std::string& dialect) {
  plan.machine = controls::with_control(std::move(plan.machine), dialect);
  const auto offsets = controls::find_dialect(dialect)->work_offsets;
  for (std::size_t i = 0; i < plan.setups.size(); ++i) plan.setups[i].work_offset = offsets[i];
  return plan;
}

}  // namespace

std::vector<Emitted> emitted_pecked(const std::string& dialect) {
  const auto on = [&](model::Plan plan, std::vector<model::ControlOption> options) {
    plan = on_control(std::move(plan), dialect);
    plan.machine.control_options = model::ControlOptions{std::move(options)};
    return plan;
  };
  std::vector<Emitted> out;
  const double bottom = -20 - plans::point_length();
  if (dialect == "linuxcnc")  // from 6 down by 10
    out.push_back(written("cleared hole", on(pecked(true, -4, 10), {{"cycles", "feature"}})));
  if (dialect == "fanuc") {
    out.push_back(written("cleared hole", on(pecked(true, -4, 10), {{"peck_clearance_mm", "0.2"}})));
    out.push_back(written("chips broken", on(pecked(false, -6, 8), {{"chip_break_mm", "0.5"}})));
  }
  if (dialect == "haas") {
    // Fed again below and above where the plan is.
    for (const char* above : {"0.2", "0.5", "0.8"})
      out.push_back(written(std::string("cleared to ") + above,
                            on(pecked(true, -8, 6), {{"peck_clearance_mm", above}})));
    out.push_back(written("chips broken", on(pecked(false, -8, 6), {{"peck_clearance_mm", "0.5"}})));
  }
  if (dialect == "siemens") {  // two of 8 behind the first
    out.push_back(written("cleared hole", on(pecked(true, bottom + 16, 8), {})));
    out.push_back(written("chips broken", on(pecked(false, bottom + 16, 8), {})));
  }
  if (dialect == "heidenhain") {  // 16 mm first, then 8, and what is left
    for (const char* version : {"tnc430", "itnc530", "tnc640"})
      out.push_back(written(std::string("cleared by ") + version,
                            on(pecked(true, -10, 8), {{"pecking_cycle", version}})));
    out.push_back(written("chips broken", on(pecked(false, -10, 8), {})));
  }
  return out;
}

Emitted emitted_chuck(const std::string& dialect) {
  model::Plan plan = on_control(tapped(), dialect);
  const auto* step = plan.model.get<model::MachiningWorkingstep>(plan.steps[1].step);
  plan.model.get<model::Tapping>(step->its_operation)->compensation_chuck = true;
  return written("tap in a chuck", std::move(plan), {"CHK-GOUGE", "CHK-GOUGE-WALL"});
}

std::vector<Emitted> emitted_bored(const std::string& dialect) {
  model::Plan plan = on_control(bored(), dialect);
  plan.machine.control_options = model::ControlOptions{{{"oriented_stop", "yes"}}};
  std::vector<Emitted> out;
  // A drill is not drawn out so; the text is followed all the same.
  out.push_back(written("bored hole", std::move(plan), {"CHK-SPINDLE-STOPPED"}));
  return out;
}

std::vector<Emitted> emitted_for(const std::string& dialect) {
  const auto on = [&](model::Plan plan) { return on_control(std::move(plan), dialect); };
  std::vector<Emitted> out;
  const bool turns = dialect == "siemens" || dialect == "heidenhain";
  out.push_back(
      written("pocket and reamed hole", on(turns ? with_helix(pocket_and_hole()) : pocket_and_hole())));
  out.push_back(written("two set-ups", on(two_setups())));
  if (dialect == "grbl") {  // which taps nothing
    model::Plan stated = on(pocket_and_hole());
    stated.machine.control_options = model::ControlOptions{{{"tool_length", "g43.1"}}};
    out.push_back(written("stated lengths", std::move(stated)));
    out.push_back(written("one tool in two set-ups", on(one_tool_in_two_setups())));
    return out;
  }
  if (dialect == "mach3") return out;  // nor does it
  out.push_back(written("tapped hole", on(tapped()), {"CHK-GOUGE", "CHK-GOUGE-WALL"}));
  for (Emitted& e : emitted_pecked(dialect)) out.push_back(std::move(e));
  if (dialect == "siemens") out.push_back(emitted_chuck(dialect));
  if (turns) {
    for (Emitted& e : emitted_bored(dialect)) out.push_back(std::move(e));
  }
  return out;
}

const std::vector<Emitted>& emitted_and_planned() {
  static const std::vector<Emitted> kAll = [] {
    std::vector<Emitted> out = emitted();
    out.push_back(written("plate", plate()));
    return out;
  }();
  return kAll;
}

}  // namespace capstan::mutation
