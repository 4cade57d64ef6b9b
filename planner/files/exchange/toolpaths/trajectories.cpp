#include "planner/files/exchange/toolpaths/trajectories.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/exchange/toolpaths/left_helix.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/nouns/placed_nouns.h"

namespace capstan::exchange {

using geometry::Placement;
using geometry::Vec3;
using model::AnyRef;
using model::CutterPath;
using model::MoveKind;
using model::MoveRole;

namespace {

/// Curves for moves first..last of a path, in the frame's local coordinates.
class CurveWriter {
 public:
  CurveWriter(model::Model& m, const CutterPath& path, const Placement& frame) : m_(m), p_(path), f_(frame) {}

  model::Ref<model::BoundedCurve> run(std::size_t first, std::size_t last) {
    std::vector<model::Ref<model::BoundedCurve>> parts;
    for (std::size_t i = first; i <= last;) {
      if (is_arc(i)) {
        parts.push_back(left_handed(i) ? left_helix(i) : arc(i));
        ++i;
        continue;
      }
      std::vector<Vec3> points = {f_.to_local(p_.point(i - 1))};
      for (; i <= last && !is_arc(i); ++i) points.push_back(f_.to_local(p_.point(i)));
      parts.push_back(polyline(points));
    }
    if (parts.size() == 1) return parts.front();
    model::CompositeCurve c;
    c.name = "";
    c.self_intersect = model::Logical3::kUnknown;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      model::CompositeCurveSegment s;
      s.transition =
          i + 1 == parts.size() ? model::TransitionCode::kDiscontinuous : model::TransitionCode::kContinuous;
      s.same_sense = true;
      s.parent_curve = parts[i];
      c.segments.push_back(m_.add(std::move(s)));
    }
    return m_.add(std::move(c));
  }

  std::size_t sampled_helices = 0;

 private:
  [[nodiscard]] bool is_arc(std::size_t i) const {
    return p_.kind[i] == MoveKind::kArcCw || p_.kind[i] == MoveKind::kArcCcw;
  }
  // A HELIX rises counter-clockwise: right-handed.
  [[nodiscard]] bool left_handed(std::size_t i) const {
    const double rise = p_.z[i] - p_.z[i - 1];
    return rise != 0.0 && (rise > 0.0) != (p_.kind[i] == MoveKind::kArcCcw);
  }

  model::Ref<model::BoundedCurve> left_helix(std::size_t i) {
    ++sampled_helices;
    const double r = std::hypot(p_.x[i] - p_.cx[i], p_.y[i] - p_.cy[i]);
    const double step = 2.0 * std::acos(std::clamp(1.0 - kHelixChordMm / std::max(r, 1e-6), -1.0, 1.0));
    const auto n = static_cast<std::size_t>(std::max(2.0, std::ceil(arc_sweep(p_, i) / step)));
    std::vector<Vec3> points;
    for (std::size_t k = 0; k <= n; ++k) {
      const Vec3 p = k == 0   ? p_.point(i - 1)
                     : k == n ? p_.point(i)
                              : point_on_move(p_, i, static_cast<double>(k) / static_cast<double>(n));
      points.push_back(f_.to_local(p));
    }
    const double sweep = arc_sweep(p_, i);
    return polyline(points,
                    curves::left_helix_name({.from = points.front(),
                                             .to = points.back(),
                                             .arc = true,
                                             .centre = f_.to_local({p_.cx[i], p_.cy[i], p_.z[i]}),
                                             .axis = f_.direction_to_local({0.0, 0.0, 1.0}),
                                             .sweep = p_.kind[i] == MoveKind::kArcCcw ? sweep : -sweep}));
  }

  model::Ref<model::BoundedCurve> polyline(const std::vector<Vec3>& points, std::string name = "") {
    model::Polyline c;
    c.name = std::move(name);
    for (const Vec3 p : points) {
      tick();
      c.points.push_back(model::add_point(m_, p));
    }
    return m_.add(std::move(c));
  }

  model::Ref<model::BoundedCurve> arc(std::size_t i) {
    const Vec3 a = p_.point(i - 1), b = p_.point(i);
    Placement centre;
    centre.origin = f_.to_local({p_.cx[i], p_.cy[i], b.z});
    centre.z = f_.direction_to_local({0.0, 0.0, 1.0});
    centre.x = f_.direction_to_local({1.0, 0.0, 0.0});
    const auto position = model::add_placement(m_, centre);
    const double radius = std::hypot(b.x - p_.cx[i], b.y - p_.cy[i]);
    model::TrimmedCurve c;
    c.name = "";
    if (a.z == b.z) {
      model::Circle circle;
      circle.name = "";
      circle.position = position;
      circle.radius = radius;
      c.basis_curve = m_.add(std::move(circle));
    } else {
      model::Helix helix;
      helix.name = "";
      helix.position = position;
      helix.radius = radius;
      helix.pitch = std::abs(b.z - a.z) * kRadPerTurn / arc_sweep(p_, i);
      c.basis_curve = m_.add(std::move(helix));
    }
    c.trim_1 = trim(a);
    c.trim_2 = trim(b);
    c.sense_agreement = p_.kind[i] == MoveKind::kArcCcw;
    c.master_representation = model::TrimmingPreference::kCartesian;
    return m_.add(std::move(c));
  }

  model::SelectList trim(Vec3 p) {
    model::SelectList out;
    out.given = true;
    out.items.push_back({.ref = model::add_point(m_, f_.to_local(p)), .type = {}, .real = {}, .text = {}});
    return out;
  }

  model::Model& m_;
  const CutterPath& p_;
  const Placement& f_;
};

/// Of paths that no result has.
using Schedules = std::map<const CutterPath*, std::shared_ptr<const model::FeedSchedule>>;

/// Replaces one trajectory with a path by trajectories with curves.
class Splitter {
 public:
  Splitter(model::Plan& plan, const Schedules& schedules, const Placement& frame, AnyRef technology,
           std::vector<std::string>& losses)
      : plan_(plan),
        schedules_(schedules),
        m_(plan.model),
        frame_(frame),
        general_(technology),
        losses_(losses) {}

  void split(AnyRef at, model::RefList<model::Toolpath>& out) {
    const auto path = m_.at<model::Trajectory>(at).path;
    schedule_ = schedule_for(path);
    bool first = true;
    for (std::size_t i = 1; i < path->size();) {
      std::size_t last = i;
      while (last + 1 < path->size() && same_run(*path, i, last + 1)) ++last;
      // The object that had the path is the first run: what refers to it still does.
      AnyRef target = at;
      if (path->kind[i] == MoveKind::kDwell) {
        target = dwell(*path, i, at);
        out.push_back(model::Ref<model::Toolpath>(target));
      } else {
        if (!first)
          target = m_.add(model::CutterLocationTrajectory{m_.at<model::CutterLocationTrajectory>(at)});
        first = false;
        fill(target, *path, i, last);
        out.push_back(model::Ref<model::Toolpath>(target));
      }
      i = last + 1;
    }
  }

 private:
  std::shared_ptr<const model::FeedSchedule> schedule_for(const model::PathHandle& path) const {
    for (const auto& s : plan_.steps) {
      if (s.path == path && s.schedule && s.schedule->feed_mm_min.size() == path->size()) return s.schedule;
    }
    const auto it = schedules_.find(path.get());
    return it == schedules_.end() ? nullptr : it->second;
  }

  [[nodiscard]] double feed(std::size_t i) const { return schedule_ ? schedule_->feed_mm_min[i] : 0.0; }
  [[nodiscard]] double speed(std::size_t i) const { return schedule_ ? schedule_->spindle_rpm[i] : 0.0; }

  [[nodiscard]] bool same_run(const CutterPath& p, std::size_t i, std::size_t j) const {
    if (p.kind[i] == MoveKind::kDwell || p.kind[j] == MoveKind::kDwell) return false;
    const bool rapid = p.kind[i] == MoveKind::kRapid;
    if (rapid != (p.kind[j] == MoveKind::kRapid) || p.role[i] != p.role[j]) return false;
    return rapid || (feed(i) == feed(j) && speed(i) == speed(j));
  }

  AnyRef dwell(const CutterPath&, std::size_t i, AnyRef at) {
    model::Feedstop stop;
    stop.its_priority = m_.at<model::Toolpath>(at).its_priority.value_or(true);
    stop.its_type = model::ToolpathType::kTrajectoryPath;
    stop.dwell = schedule_ && i < schedule_->dwell_s.size() ? schedule_->dwell_s[i] : 0.0;
    return m_.add(std::move(stop));
  }

  void fill(AnyRef target, const CutterPath& p, std::size_t first, std::size_t last) {
    const bool rapid = p.kind[first] == MoveKind::kRapid;
    CurveWriter writer(m_, p, frame_);
    const auto curve = writer.run(first, last);
    if (writer.sampled_helices != 0) {
      losses_.push_back("a left-handed helix is written as a polyline within " + std::string("0.001 mm") +
                        ": HELIX is right-handed");
    }
    const auto technology = rapid ? model::Ref<model::Technology>() : technology_for(first);
    auto& t = m_.at<model::CutterLocationTrajectory>(target);
    t.path.reset();
    t.basiccurve = curve;
    t.its_priority = t.its_priority.value_or(true);
    t.its_type = toolpath_type_of(p.role[first], rapid);
    t.its_speed = {};
    if (rapid) t.its_speed.text = "RAPID";
    t.its_technology = technology;
  }

  // The operation's own technology if it has the same values. A link always gets one of its own, which
  // distinguishes it from a rapid connection.
  model::Ref<model::Technology> technology_for(std::size_t i) {
    const auto* general = m_.get<model::MillingTechnology>(general_);
    if (!schedule_ || general == nullptr) return model::Ref<model::Technology>(general_);
    const double spindle = -speed(i) + 0.0;
    if (general->feedrate == feed(i) && general->spindle == spindle)
      return model::Ref<model::Technology>(general_);
    const auto key = std::tuple(general_, feed(i), spindle);
    const auto known = technologies_.find(key);
    if (known != technologies_.end()) return known->second;
    model::MillingTechnology t = *general;
    t.feedrate = feed(i);
    t.spindle = spindle;
    t.cutspeed.reset();
    t.feedrate_per_tooth.reset();
    return technologies_[key] = m_.add(std::move(t));
  }

  model::Plan& plan_;
  const Schedules& schedules_;
  model::Model& m_;
  const Placement& frame_;
  AnyRef general_;
  std::vector<std::string>& losses_;
  std::shared_ptr<const model::FeedSchedule> schedule_;
  std::map<std::tuple<AnyRef, double, double>, model::Ref<model::Technology>> technologies_;
};

}  // namespace

bool has_bare_path(const model::Model& m, AnyRef at) {
  const auto* t = m.get<model::CutterLocationTrajectory>(at);
  return t != nullptr && t->path && t->path->size() > 1 && !t->basiccurve;
}

namespace {

// The list of toolpaths that a step carries, by address; null for other executables.
model::Ref<model::ToolpathList>* toolpaths_of(model::Model& m, AnyRef step) {
  if (const auto* w = m.get<model::MachiningWorkingstep>(step)) {
    auto* op = m.get<model::MachiningOperation>(w->its_operation);
    return op == nullptr ? nullptr : &op->its_toolpath;
  }
  auto* rapid = m.get<model::RapidMovement>(step);
  return rapid == nullptr ? nullptr : &rapid->its_toolpath;
}

}  // namespace

void adopt_paths(model::Plan& plan) {
  for (const auto& s : plan.steps) {
    auto* list = toolpaths_of(plan.model, s.step);
    if (list == nullptr || list->set() || !s.path || s.path->size() < 2) continue;
    model::CutterLocationTrajectory t;
    t.its_priority = true;
    t.its_type = model::ToolpathType::kTrajectoryPath;
    t.path = s.path;
    model::ToolpathList paths;
    paths.its_list.push_back(plan.model.add(std::move(t)));
    *list = plan.model.add(std::move(paths));
  }
}

model::ToolpathType toolpath_type_of(MoveRole role, bool rapid) {
  switch (role) {
    case MoveRole::kApproach:
    case MoveRole::kPlunge:
    case MoveRole::kRamp:
      return model::ToolpathType::kApproach;
    case MoveRole::kRetract:
      return model::ToolpathType::kLift;
    case MoveRole::kLink:
      return rapid ? model::ToolpathType::kNonContact : model::ToolpathType::kConnect;
    case MoveRole::kCut:
    case MoveRole::kDrill:
    case MoveRole::kTap:
      return model::ToolpathType::kTrajectoryPath;
  }
  return model::ToolpathType::kTrajectoryPath;
}

AnyRef toolpath_list_of(const model::Model& m, AnyRef step) {
  if (const auto* w = m.get<model::MachiningWorkingstep>(step)) {
    const auto* op = m.get<model::Operation>(w->its_operation);
    return op == nullptr ? AnyRef{} : AnyRef(op->its_toolpath);
  }
  const auto* rapid = m.get<model::RapidMovement>(step);
  return rapid == nullptr ? AnyRef{} : AnyRef(rapid->its_toolpath);
}

namespace {

bool has_via_points(const model::Model& m, AnyRef list) {
  const auto* paths = m.get<model::ToolpathList>(list);
  if (paths == nullptr) return false;
  for (const AnyRef t : paths->its_list.items) {
    const auto* trajectory = m.get<model::CutterLocationTrajectory>(t);
    if (trajectory == nullptr || !trajectory->basiccurve) continue;
    const AnyRef roots[] = {trajectory->basiccurve};
    const auto all = model::reachable(m, roots);
    const auto via = [&](AnyRef p) {
      return p.type == model::TypeId::kViaArcPoint || p.type == model::TypeId::kViaHelixPoint;
    };
    if (std::any_of(all.begin(), all.end(), via)) return true;
  }
  return false;
}

bool same_place(const Placement& a, const Placement& b) {
  constexpr double kSame = 1e-9;
  return norm(a.origin - b.origin) <= kSame && norm(a.x - b.x) <= kSame && norm(a.z - b.z) <= kSame;
}

// Makes paths of toolpaths whose place or form this standard cannot state: their curves are made anew.
Status unfold(model::Plan& plan, Schedules& schedules, std::vector<std::string>& losses) {
  auto& m = plan.model;
  struct Step {
    AnyRef at;
    bool via = false;
    Placement frame;
    StepPath path;
  };
  const auto turned = [&](AnyRef at) {
    const auto* w = m.get<model::Workingstep>(at);
    const auto* p = m.get<model::Workplan>(at);
    return (w != nullptr && w->toolpath_orientation) || (p != nullptr && p->toolpath_orientation);
  };
  const auto executables = m.all_below(model::TypeId::kExecutable);
  const bool any = std::any_of(executables.begin(), executables.end(), turned);
  const bool via = m.count(model::TypeId::kViaArcPoint) + m.count(model::TypeId::kViaHelixPoint) != 0;
  if (!any && !via) return {};
  std::vector<Step> steps;
  for (const AnyRef at : m.all_below(model::TypeId::kWorkingstep)) {
    const AnyRef list = toolpath_list_of(m, at);
    if (!list.set()) continue;
    Step s{at, has_via_points(m, list), {}, {}};
    if (!any && !s.via) continue;
    const model::Ref<model::Executable> step(at);
    auto frame = frame_of_step(plan, step);
    if (!frame) return fail(frame.error());
    Job quiet;
    auto path = path_of_step(plan, step, {}, quiet);
    if (!path) return fail(path.error());
    s.frame = *frame;
    s.path = std::move(*path);
    steps.push_back(std::move(s));
  }
  for (const AnyRef at : executables) {
    if (model::is_a(at.type, model::TypeId::kWorkingstep))
      m.at<model::Workingstep>(at).toolpath_orientation = {};
    if (at.type == model::TypeId::kWorkplan) m.at<model::Workplan>(at).toolpath_orientation = {};
  }
  std::size_t count = 0;
  for (Step& s : steps) {
    const auto frame = frame_of_step(plan, model::Ref<model::Executable>(s.at));
    if (!frame) return fail(frame.error());
    if ((!s.via && same_place(*frame, s.frame)) || s.path.path.size() < 2) continue;
    model::CutterLocationTrajectory t;
    t.its_priority = true;
    t.its_type = model::ToolpathType::kTrajectoryPath;
    t.path = std::make_shared<const CutterPath>(std::move(s.path.path));
    schedules[t.path.get()] = std::make_shared<const model::FeedSchedule>(std::move(s.path.schedule));
    model::ToolpathList list;
    list.its_list.push_back(m.add(std::move(t)));
    const auto fresh = m.add(std::move(list));
    if (auto* own = toolpaths_of(m, s.at)) *own = fresh;
    ++count;
  }
  losses.push_back("toolpaths of " + std::to_string(count) +
                   " steps are written anew: ISO 14649 has no via points and no toolpath_orientation");
  return {};
}

}  // namespace

Status write_curves(model::Plan& plan, std::vector<std::string>& losses) {
  adopt_paths(plan);
  Schedules schedules;
  if (auto done = unfold(plan, schedules, losses); !done) return done;
  auto& m = plan.model;
  for (const AnyRef step : m.all_below(model::TypeId::kWorkingstep)) {
    AnyRef list, technology;
    if (const auto* w = m.get<model::MachiningWorkingstep>(step)) {
      if (const auto* op = m.get<model::MachiningOperation>(w->its_operation)) {
        list = op->its_toolpath;
        technology = op->its_technology;
      }
    } else if (const auto* r = m.get<model::RapidMovement>(step)) {
      list = r->its_toolpath;
    }
    const auto* toolpaths = m.get<model::ToolpathList>(list);
    if (toolpaths == nullptr) continue;
    const auto& items = toolpaths->its_list.items;
    if (std::none_of(items.begin(), items.end(), [&](AnyRef t) { return has_bare_path(m, t); })) continue;
    const auto frame = frame_of_step(plan, model::Ref<model::Executable>(step));
    if (!frame) return fail(frame.error());
    Splitter splitter(plan, schedules, *frame, technology, losses);
    model::RefList<model::Toolpath> next;
    next.given = true;
    for (const AnyRef t : std::vector<AnyRef>(items)) {
      if (has_bare_path(m, t)) {
        splitter.split(t, next);
      } else {
        next.push_back(model::Ref<model::Toolpath>(t));
      }
    }
    m.at<model::ToolpathList>(list).its_list = next;
  }
  return {};
}

}  // namespace capstan::exchange
