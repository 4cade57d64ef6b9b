#include "planner/making/given/ends.h"

#include <memory>
#include <utility>

#include "planner/physics/motion/time.h"

namespace capstan::given {
namespace {

constexpr double kSamePlace = 1e-6;  // mm

bool same_place(geometry::Vec3 a, geometry::Vec3 b) { return norm(a - b) < kSamePlace; }

/// Whether `b` begins, with the same tool in the same clamping, where `a` ends.
bool goes_on(const model::StepResult& a, const model::StepResult& b) {
  return a.cutter_id == b.cutter_id && a.setup == b.setup &&
         same_place(a.path->point(a.path->size() - 1), b.path->point(0));
}

/// A path being given further ends. Its columns are shared and constant: it is made anew.
class Longer {
 public:
  explicit Longer(model::StepResult& step) : step_(step) {}

  void from(double z) {
    const auto& p = *step_.path;
    const auto& s = *step_.schedule;
    model::CutterPath path;
    const std::size_t first = p.size() > 1 ? 1 : 0;
    path.start({p.x[0], p.y[0], z});
    path.rapid(p.point(0), model::MoveRole::kApproach);
    model::FeedSchedule schedule{{0.0, 0.0}, {s.spindle_rpm[first], s.spindle_rpm[first]}, {0.0, 0.0}};
    const auto rest = [](auto& to, const auto& column) {
      to.insert(to.end(), column.begin() + 1, column.end());
    };
    rest(path.x, p.x);
    rest(path.y, p.y);
    rest(path.z, p.z);
    rest(path.cx, p.cx);
    rest(path.cy, p.cy);
    rest(path.kind, p.kind);
    rest(path.role, p.role);
    rest(schedule.feed_mm_min, s.feed_mm_min);
    rest(schedule.spindle_rpm, s.spindle_rpm);
    rest(schedule.dwell_s, s.dwell_s);
    if (step_.sections) {
      auto sections = *step_.sections;
      for (auto& move : sections.move) ++move;
      step_.sections = std::make_shared<const model::SectionSeries>(std::move(sections));
    }
    set(std::move(path), std::move(schedule));
  }

  void to(double z) {
    auto path = *step_.path;
    auto schedule = *step_.schedule;
    path.rapid({path.x.back(), path.y.back(), z}, model::MoveRole::kRetract);
    schedule.feed_mm_min.push_back(0.0);
    schedule.spindle_rpm.push_back(schedule.spindle_rpm.back());
    schedule.dwell_s.push_back(0.0);
    set(std::move(path), std::move(schedule));
  }

 private:
  void set(model::CutterPath path, model::FeedSchedule schedule) {
    step_.path = std::make_shared<const model::CutterPath>(std::move(path));
    step_.schedule = std::make_shared<const model::FeedSchedule>(std::move(schedule));
  }

  model::StepResult& step_;
};

/// A rapid movement says nothing of spindle and coolant: they stay as they are.
void carry_on(const model::Model& m, const model::StepResult* before, model::StepResult& step) {
  if (before == nullptr || !m.holds<model::RapidMovement>(step.step) || before->cutter_id != step.cutter_id) {
    return;
  }
  step.flood = before->flood;
  step.mist = before->mist;
  auto schedule = *step.schedule;
  for (double& rpm : schedule.spindle_rpm) {
    if (rpm == 0.0) rpm = before->schedule->spindle_rpm.back();
  }
  step.spindle_rpm = schedule.spindle_rpm.back();
  step.schedule = std::make_shared<const model::FeedSchedule>(std::move(schedule));
}

}  // namespace

std::vector<draft::StepDraft> carry_tools(const model::Model& m, std::vector<draft::StepDraft> steps) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    draft::StepDraft& step = steps[i];
    if (!m.holds<model::RapidMovement>(step.step) || step.cutter.cutting_diameter_mm > 0.0) continue;
    // The tool in the spindle; before the first, the one that comes next.
    if (i > 0 && steps[i - 1].cutter.cutting_diameter_mm > 0.0) {
      step.cutter = steps[i - 1].cutter;
      continue;
    }
    for (std::size_t k = i + 1; k < steps.size(); ++k) {
      if (steps[k].cutter.cutting_diameter_mm <= 0.0) continue;
      step.cutter = steps[k].cutter;
      break;
    }
  }
  return steps;
}

std::vector<model::StepResult> joined_paths(const model::Plan& plan,
                                            const std::vector<draft::SetupDraft>& setups) {
  std::vector<model::StepResult> steps = plan.steps;
  // By what the file says, before any end is added.
  std::vector<bool> joined(steps.size() + 1, false);  // [i]: step i goes on where step i - 1 ended
  for (std::size_t i = 1; i < steps.size(); ++i) joined[i] = goes_on(steps[i - 1], steps[i]);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    model::StepResult& step = steps[i];
    const auto before = step.path;
    carry_on(plan.model, i > 0 ? &steps[i - 1] : nullptr, step);
    const double security = setups[step.setup].security_z_mm;
    if (!joined[i] && step.path->z.front() < security - kSamePlace) Longer(step).from(security);
    if (!joined[i + 1] && step.path->z.back() < security - kSamePlace) Longer(step).to(security);
    if (step.path == before) continue;
    if (const auto t = motion::time_of(*step.path, *step.schedule, plan.machine)) {
      step.cutting_s = t->cutting_s + t->dwell_s;
      step.rapid_s = t->rapid_s;
    }
  }
  return steps;
}

}  // namespace capstan::given
