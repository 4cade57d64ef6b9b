#include "planner/files/exchange/toolpaths/curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/files/exchange/toolpaths/distance_text.h"
#include "planner/files/exchange/toolpaths/schedules.h"
#include "planner/files/exchange/toolpaths/section_points.h"
#include "planner/files/exchange/toolpaths/segments.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using geometry::Placement;
using geometry::Vec3;
using model::AnyRef;
using model::CutterPath;
using model::MoveRole;

namespace {

constexpr double kAlongZ = 1e-9;   // sine of the angle up to which an axis counts as the set-up's z
constexpr double kUpright = 1e-4;  // rad up to which a stated tool axis is: files write four decimals

/// A toolpath as moves, and the parameter of its curve along them.
struct Followed {
  CutterPath path;
  MoveParameters moves;
};

/// Appends one curve to a path.
class Emitter {
 public:
  Emitter(const Placement& frame, const CurveOptions& o, MoveRole role, bool rapid)
      : frame_(frame), o_(o), role_(role), rapid_(rapid) {}

  Status add(const std::vector<curves::Segment>& segments, Followed& out) {
    CutterPath& path = out.path;
    out.moves.first = segments.front().u_from;
    out.moves.last = segments.back().u_to;
    for (const auto& s : segments) {
      if (path.size() == 0) path.start(frame_.to_parent(s.from));
      const std::size_t before = path.size();
      const bool upright = norm(cross(frame_.direction_to_parent(s.axis), Vec3{0, 0, 1})) < kAlongZ;
      if (!s.arc) {
        line(frame_.to_parent(s.to), path);
      } else if (upright && !rapid_) {
        if (!arc(s, path)) return too_many();
      } else if (!chords(s, path)) {
        return too_many();
      }
      out.moves.from.resize(before);
      out.moves.to.resize(before);
      const auto n = static_cast<double>(path.size() - before);
      for (std::size_t i = before; i < path.size(); ++i) {
        const auto k = static_cast<double>(i - before);
        out.moves.from.push_back(s.u_from + (s.u_to - s.u_from) * k / n);
        out.moves.to.push_back(s.u_from + (s.u_to - s.u_from) * (k + 1.0) / n);
      }
      if (path.size() > o_.max_moves) return too_many();
    }
    return {};
  }

 private:
  [[nodiscard]] Status too_many() const {
    return fail("EXC-CURVE", "a path has more than " + std::to_string(o_.max_moves) + " moves");
  }

  // Whether so many more moves still fit; before they are made.
  [[nodiscard]] bool room_for(double moves, const CutterPath& path) const {
    return moves + static_cast<double>(path.size()) <= static_cast<double>(o_.max_moves);
  }

  void line(Vec3 to, CutterPath& path) {
    if (rapid_) return path.rapid(to, role_);
    path.line(to, role_);
  }

  // Turn by turn: a move sweeps at most a full one.
  bool arc(const curves::Segment& s, CutterPath& path) {
    const double turn = 2.0 * std::numbers::pi;
    const double turns = std::max(1.0, std::ceil(std::abs(s.sweep) / turn - 1e-12));
    if (!room_for(turns, path)) return false;
    const auto n = static_cast<std::size_t>(turns);
    const bool up = frame_.direction_to_parent(s.axis).z > 0.0;
    const bool clockwise = (s.sweep < 0.0) == up;
    const geometry::Vec2 centre = xy(frame_.to_parent(s.centre));
    for (std::size_t i = 1; i <= n; ++i) {
      const double t = std::min(1.0, static_cast<double>(i) * turn / std::abs(s.sweep));
      path.arc(frame_.to_parent(i == n ? s.to : curves::at(s, t)), centre, clockwise, role_);
    }
    return true;
  }

  // An arc of radius r and angle w strays r (1 - cos(w / 2)) from its chord.
  bool chords(const curves::Segment& s, CutterPath& path) {
    const Vec3 r = s.from - s.centre;
    const double radius = norm(r - dot(r, s.axis) * s.axis);
    const double c = std::clamp(1.0 - o_.chord_tolerance_mm / std::max(radius, 1e-9), -1.0, 1.0);
    const double step = std::max(2.0 * std::acos(c), 1e-4);
    const double count = std::max(1.0, std::ceil(std::abs(s.sweep) / step));
    if (!room_for(count, path)) return false;
    const auto n = static_cast<std::size_t>(count);
    for (std::size_t i = 1; i <= n; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(n);
      line(frame_.to_parent(i == n ? s.to : curves::at(s, t)), path);
    }
    return true;
  }

  const Placement& frame_;
  const CurveOptions& o_;
  MoveRole role_;
  bool rapid_;
};

bool is_rapid(const model::Toolpath& t) {
  return t.its_speed.text == "RAPID" || (t.its_type == model::ToolpathType::kConnect && !t.its_technology);
}

MoveRole role_of(const model::Toolpath& t) {
  switch (t.its_type.value_or(model::ToolpathType::kTrajectoryPath)) {
    case model::ToolpathType::kApproach:
      return is_rapid(t) ? MoveRole::kApproach : MoveRole::kPlunge;
    case model::ToolpathType::kLift:
      return MoveRole::kRetract;
    case model::ToolpathType::kConnect:
    case model::ToolpathType::kNonContact:
      return MoveRole::kLink;
    case model::ToolpathType::kContact:
    case model::ToolpathType::kTrajectoryPath:
      return is_rapid(t) ? MoveRole::kLink : MoveRole::kCut;
  }
  return MoveRole::kCut;
}

// An approach that does not go straight down is a ramp.
void tell_ramps(CutterPath& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool down =
        path.kind[i] == model::MoveKind::kLine && path.x[i] == path.x[i - 1] && path.y[i] == path.y[i - 1];
    if (path.role[i] == MoveRole::kPlunge && !down) path.role[i] = MoveRole::kRamp;
  }
}

AnyRef curve_of(const model::Model& m, AnyRef toolpath) {
  if (const auto* t = m.get<model::CutterLocationTrajectory>(toolpath)) return t->basiccurve;
  if (const auto* t = m.get<model::CutterContactTrajectory>(toolpath)) {
    if (const auto* c = m.get<model::CurveWithNormalVector>(t->basiccurve)) return c->basiccurve;
  }
  return {};
}

AnyRef axis_of(const model::Model& m, AnyRef toolpath) {
  if (const auto* t = m.get<model::CutterLocationTrajectory>(toolpath)) return t->its_toolaxis;
  if (const auto* t = m.get<model::CutterContactTrajectory>(toolpath)) return t->its_toolaxis;
  return {};
}

Result<Followed> follow(const model::Plan& plan, AnyRef toolpath, const Placement& frame,
                        const CurveOptions& given, Job& job) {
  const auto& m = plan.model;
  const AnyRef curve = curve_of(m, toolpath);
  if (!curve.set()) {
    return fail(
        {.code = "EXC-TOOLPATH",
         .message = std::string(toolpath.set() ? model::noun_type(toolpath.type).keyword : "nothing") +
                    " has no curve to follow",
         .line = toolpath.set() ? m.origin(toolpath).line : 0,
         .instance = toolpath.set() ? m.origin(toolpath).instance : 0});
  }
  CurveOptions options = given;
  if (const AnyRef axis = axis_of(m, toolpath); axis.set()) {
    const auto tilt = largest_tilt(m, axis, frame);
    if (!tilt || *tilt > kUpright) {
      return fail({.code = "EXC-TOOL-AXIS",
                   .message = tilt
                                  ? "the tool axis tilts by " + trimmed(*tilt * 180.0 / std::numbers::pi, 3) +
                                        " degrees: only paths along the set-up's z are followed"
                                  : "the tool axis is a curve that is not followed",
                   .line = m.origin(toolpath).line,
                   .instance = m.origin(toolpath).instance});
    }
    options.helix_axis = frame.direction_to_local({0.0, 0.0, 1.0});
  }
  auto segments = curves::segments_of(m, curve, options, job);
  if (!segments) return fail(segments.error());
  const auto& t = m.at<model::Toolpath>(toolpath);
  const auto* trajectory = m.get<model::Trajectory>(toolpath);
  const bool against = trajectory != nullptr && !trajectory->its_direction.value_or(true);
  if (against) curves::reverse(*segments);
  Followed out;
  if (auto done = Emitter(frame, options, role_of(t), is_rapid(t)).add(*segments, out); !done) {
    return fail(done.error());
  }
  // Values along the curve use the curve's own parameter.
  if (against) {
    for (auto* list : {&out.moves.from, &out.moves.to}) {
      for (double& u : *list) u = out.moves.first + out.moves.last - u;
    }
  }
  tell_ramps(out.path);
  return out;
}

/// Puts the toolpaths of a step one after the other.
class StepBuilder {
 public:
  StepBuilder(const model::Plan& plan, AnyRef step, const CurveOptions& o, Job& job,
              const std::vector<model::StepResult>* recorded)
      : plan_(plan), recorded_(recorded), m_(plan.model), step_(step), o_(o), job_(job) {}

  Result<StepPath> run() {
    AnyRef list;
    if (const auto* w = m_.get<model::MachiningWorkingstep>(step_)) {
      if (const auto* op = m_.get<model::MachiningOperation>(w->its_operation)) {
        list = op->its_toolpath;
        technology_ = op->its_technology;
        if (const auto* tool = m_.get<model::CuttingTool>(op->its_tool)) {
          body_ = m_.get<model::MillingToolBody>(tool->its_tool_body);
        }
      }
    } else if (const auto* r = m_.get<model::RapidMovement>(step_)) {
      list = r->its_toolpath;
      rapid_step_ = true;
    }
    const auto* toolpaths = m_.get<model::ToolpathList>(list);
    if (toolpaths == nullptr) return std::move(out_);
    const auto frame = frame_of_step(plan_, model::Ref<model::Executable>(step_));
    if (!frame) return fail(frame.error());
    for (const AnyRef t : toolpaths->its_list.items) {
      if (auto done = add(t, *frame); !done) return fail(done.error());
    }
    return std::move(out_);
  }

 private:
  Status add(AnyRef at, const Placement& frame) {
    if (m_.holds<model::DisplayMessage>(at)) return {};
    if (m_.holds<model::NcFunction>(at)) {
      return bad(at, "the function " + std::string(model::noun_type(at.type).keyword) +
                         " is among toolpaths, where it is not carried out");
    }
    const auto* t = m_.get<model::Toolpath>(at);
    if (t == nullptr) return bad(at, "a toolpath of an unknown kind");
    if (const auto* stop = m_.get<model::Feedstop>(at)) {
      if (out_.path.size() == 0) return bad(at, "a feedstop comes before the first move");
      out_.path.dwell();
      return settle(at, *t, stop);
    }
    if (m_.holds<model::ConnectDirect>(at)) {
      bridge_ = true;
      return {};
    }
    const auto* trajectory = m_.get<model::Trajectory>(at);
    if (trajectory != nullptr && trajectory->path && !curve_of(m_, at).set()) {
      if (auto joined = join(*trajectory->path, at); !joined) return joined;
      if (auto done = settle(at, *t); !done) return done;
      take_schedule(trajectory->path);
      return {};
    }
    auto followed = follow(plan_, at, frame, o_, job_);
    if (!followed) return fail(followed.error());
    CutterPath* part = &followed->path;
    if (rapid_step_) {
      for (std::size_t i = 1; i < part->size(); ++i) {
        if (part->kind[i] == model::MoveKind::kLine) part->kind[i] = model::MoveKind::kRapid;
        part->role[i] = MoveRole::kLink;
      }
    }
    if (auto joined = join(*part, at); !joined) return joined;
    if (trajectory != nullptr && trajectory->cross_section_area_parameters) {
      if (auto done = add_sections(m_, *trajectory, followed->moves, out_.path, out_.sections); !done)
        warn(done.error());
    }
    if (auto done = settle(at, *t, nullptr, &followed->moves); !done) return done;
    join_at_section_points(m_, curve_of(m_, at), followed->moves, out_);
    return {};
  }

  Status join(const CutterPath& part, AnyRef at) {
    auto& path = out_.path;
    if (part.size() == 0) return {};
    std::size_t from = 1;
    if (path.size() == 0) {
      from = 0;
    } else if (const double gap = norm(part.point(0) - path.point(path.size() - 1)); gap > o_.gap_mm) {
      if (!bridge_)
        return bad(at, "a toolpath begins " + distance_text(gap, 3) + " from where the last one ended",
                   "EXC-GAP");
      path.line(part.point(0), MoveRole::kLink);
    }
    bridge_ = false;
    const auto append = [from](auto& to, const auto& column) {
      to.insert(to.end(), column.begin() + static_cast<std::ptrdiff_t>(from), column.end());
    };
    append(path.x, part.x);
    append(path.y, part.y);
    append(path.z, part.z);
    append(path.cx, part.cx);
    append(path.cy, part.cy);
    append(path.kind, part.kind);
    append(path.role, part.role);
    return {};
  }

  // The path just joined may have feeds and speeds of its own, move by move. If the technology, which
  // `settle` has put there, differs from the one that they were chosen with, it was edited since: it then
  // holds throughout.
  void take_schedule(const model::PathHandle& path) {
    constexpr double kSame = 1e-6;  // of the value, what a file's units round; default, unsourced
    for (const auto& result : recorded_ == nullptr ? plan_.steps : *recorded_) {
      if (result.path != path || !result.schedule) continue;
      const auto copy = [n = path->size(), executes = recorded_ != nullptr](
                            const std::vector<double>& from, std::vector<double>& to, double chosen) {
        if (from.size() != n || n == 0 || to.size() < n) return;
        if (executes && chosen != 0.0 && to.back() != 0.0 &&
            std::abs(to.back() - chosen) > kSame * std::abs(chosen))
          return;
        // Its first point has no move, and may be where the one before ended.
        std::copy(from.begin() + 1, from.end(), to.end() - static_cast<std::ptrdiff_t>(n - 1));
      };
      copy(result.schedule->feed_mm_min, out_.schedule.feed_mm_min, result.feed_mm_min);
      copy(result.schedule->spindle_rpm, out_.schedule.spindle_rpm, result.spindle_rpm);
      copy(result.schedule->dwell_s, out_.schedule.dwell_s, 0.0);
      return;
    }
  }

  // Feed and speed of the moves added since.
  Status settle(AnyRef at, const model::Toolpath& t, const model::Feedstop* stop = nullptr,
                const MoveParameters* moves = nullptr) {
    double feed = 0.0, speed = 0.0;
    for (const AnyRef from : {technology_, AnyRef(t.its_technology)}) {
      if (const auto* tech = m_.get<model::MillingTechnology>(from)) take(*tech, feed, speed);
    }
    std::vector<double> ratio;
    const double stated = feed;
    if (const auto* curve = m_.get<model::ToolpathSpeed>(t.its_speed.ref)) {
      auto found = speed_ratios(m_, curve->speed, moves == nullptr ? MoveParameters{} : *moves, feed, job_);
      if (found) {
        ratio = std::move(*found);
      } else {
        auto why = found.error();
        // Without it, the whole feed would be taken where the file asks for less.
        const auto least = least_speed_ratio(m_, curve->speed, stated, job_);
        if (!least) {
          why.message += "; nor is there a least speed to go by";
          why.severity = Severity::kError;
          return fail(std::move(why));
        }
        feed *= *least;
        why.message += stated > 0.0
                           ? "; its least speed, " + trimmed(feed, 3) + " mm/min, is taken throughout"
                           : "; and the technology states no feed";
        warn(std::move(why));
      }
    }
    if (t.its_speed.real) feed *= *t.its_speed.real;
    auto& s = out_.schedule;
    const std::size_t first = out_.path.size() - std::min(out_.path.size(), ratio.size());
    while (s.feed_mm_min.size() < out_.path.size()) {
      const std::size_t i = s.feed_mm_min.size();
      s.feed_mm_min.push_back(i > first && i - first < ratio.size() ? feed * ratio[i - first] : feed);
      s.spindle_rpm.push_back(speed);
      s.dwell_s.push_back(0.0);
    }
    return stop == nullptr ? Status{} : dwell(at, *stop, speed);
  }

  Status dwell(AnyRef at, const model::Feedstop& stop, double speed) {
    double dwell_s = stop.dwell.value_or(0.0);
    if (!stop.dwell && stop.dwell_revolutions) {
      if (speed == 0.0)
        return bad(at, "a feedstop counts revolutions, and the spindle's speed is not stated");
      dwell_s = 60.0 * *stop.dwell_revolutions / std::abs(speed);
    }
    out_.schedule.dwell_s.back() = std::max(0.0, dwell_s);
    return {};
  }

  void warn(Diagnostic d) const {
    d.severity = Severity::kWarning;
    job_.report(std::move(d));
  }

  // A speed may be stated as cutting speed, a feed per tooth: both need the tool. ISO 14649 counts
  // clockwise negative, a schedule positive.
  void take(const model::MillingTechnology& tech, double& feed, double& speed) const {
    if (tech.spindle) {
      speed = -*tech.spindle + 0.0;
    } else if (const double d = diameter(); tech.cutspeed && d > 0.0) {
      const bool left = body_ != nullptr && body_->hand_of_cut == model::Hand::kLeft;
      speed = (left ? -1.0 : 1.0) * *tech.cutspeed / (std::numbers::pi * d);
    }
    if (tech.feedrate) {
      feed = *tech.feedrate;
    } else if (tech.feedrate_per_tooth && body_ != nullptr && body_->number_of_teeth) {
      feed = *tech.feedrate_per_tooth * static_cast<double>(*body_->number_of_teeth) * std::abs(speed);
    }
  }

  [[nodiscard]] double diameter() const {
    const auto* d = body_ == nullptr ? nullptr : m_.get<model::MillingToolDimension>(body_->dimension);
    return d == nullptr ? 0.0 : d->diameter.value_or(0.0);
  }

  Status bad(AnyRef at, std::string what, std::string code = "EXC-TOOLPATH") {
    return fail({.code = std::move(code),
                 .message = std::move(what),
                 .line = m_.origin(at).line,
                 .instance = m_.origin(at).instance});
  }

  const model::Plan& plan_;
  const std::vector<model::StepResult>* recorded_;
  const model::Model& m_;
  AnyRef step_;
  const CurveOptions& o_;
  Job& job_;
  AnyRef technology_;
  const model::MillingToolBody* body_ = nullptr;
  bool rapid_step_ = false;
  bool bridge_ = false;
  StepPath out_;
};

}  // namespace

Result<StepPath> path_of_step(const model::Plan& plan, model::Ref<model::Executable> step,
                              const CurveOptions& options, Job& job,
                              const std::vector<model::StepResult>* recorded) {
  return StepBuilder(plan, step, options, job, recorded).run();
}

}  // namespace capstan::exchange
