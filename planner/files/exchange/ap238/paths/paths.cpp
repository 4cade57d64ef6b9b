#include "planner/files/exchange/ap238/paths/paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/files/exchange/ap238/paths/path_sections.h"
#include "planner/files/exchange/ap238/paths/points_of_numbers.h"
#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/exchange/toolpaths/schedules.h"
#include "planner/files/exchange/toolpaths/section_points.h"
#include "planner/files/exchange/toolpaths/trajectories.h"
#include "planner/files/exchange/toolpaths/via.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/placed_nouns.h"

namespace capstan::exchange::ap238 {

using geometry::Placement;
using geometry::Vec3;
using model::AnyRef;
using model::CutterPath;
using model::MoveKind;

namespace {

constexpr double kCoincidentMm =
    1e-5;                            // what written files state as uncertainty; @uncertainty in 0_macros.map
constexpr double kArcMm = 1e-7;      // how far a written arc may read back from what it was
constexpr double kUpright = 1e-9;    // sine up to which z counts as z
constexpr double kSamePlace = 1e-9;  // mm, and components of directions

/// A point of a basic curve, and where on the path it lies.
struct Place {
  model::Ref<model::CartesianPoint> point;
  std::size_t move = 0;
  double at_mm = 0.0;
  std::optional<SectionNumbers> section = {};  ///< of a point that only the sections need
};

template <class Point = model::CartesianPoint>
model::Ref<model::CartesianPoint> add_point(model::Model& m, std::span<const double> coordinates) {
  const AnyRef at = m.add_object(Point::kType);
  auto& p = *static_cast<Point*>(m.object(at));  // made in its place: there may be millions
  p.name.emplace();
  p.coordinates.items.assign(coordinates.begin(), coordinates.end());
  for (double& c : p.coordinates.items) c += 0.0;  // no -0
  p.coordinates.given = true;
  return model::Ref<model::CartesianPoint>(at);
}

/// Curves of one path in the frame's local coordinates.
class Curves {
 public:
  Curves(model::Model& m, const CutterPath& path, const Placement& frame) : m_(m), p_(path), f_(frame) {}

  /// The basic curve of moves first..last. `jumps(i)`: something jumps between the moves i-1 and i. Lines get
  /// points where `sections` change.
  template <class Jumps>
  std::vector<Place> places(std::size_t first, std::size_t last, const Jumps& jumps,
                            const PathSections& sections) {
    std::vector<Place> out = {{end_of(first - 1), first, 0.0}};
    out.reserve(last - first + 2);
    for (std::size_t i = first; i <= last; ++i) {
      tick();
      if (i > first && jumps(i)) out.push_back({end_of(i - 1), i, 0.0});
      if (is_arc(p_.kind[i])) {
        via(i, out);
      } else if (p_.kind[i] == MoveKind::kLine) {
        between(i, sections, out);
      }
      out.push_back({end_of(i), i, model::move_length(p_, i)});
    }
    return out;
  }

  /// A curve with a point for each place. Points of equal numbers are one.
  template <class Numbers>
  model::Ref<model::BoundedCurve> beside(const std::vector<Place>& places, const Numbers& numbers) {
    model::Polyline c;
    c.name = "";
    using Of = decltype(numbers(places.front()));
    PointsOfNumbers<Of> known(places.size());
    model::Ref<model::CartesianPoint> last;
    Of before{};
    c.points.items.reserve(places.size());
    for (const Place& at : places) {
      const Of v = numbers(at);
      if (!last || v != before) {
        auto& p = known[v];
        if (!p) p = add_point(m_, v);
        last = p;
        before = v;
      }
      c.points.push_back(last);
    }
    return m_.add(std::move(c));
  }

  model::Ref<model::BoundedCurve> basic(const std::vector<Place>& places) {
    model::Polyline c;
    c.name = "";
    c.points.items.reserve(places.size());
    for (const Place& at : places) c.points.push_back(at.point);
    return m_.add(std::move(c));
  }

  std::size_t straightened = 0;  ///< arcs too small to differ from a line

 private:
  // The end of a run is the start of the next.
  model::Ref<model::CartesianPoint> end_of(std::size_t i) {
    if (ends_.empty()) ends_.resize(p_.size());
    auto& p = ends_[i];
    if (!p) p = add_point(m_, numbers(p_.point(i)));
    return p;
  }
  [[nodiscard]] std::array<double, 3> numbers(Vec3 p) const {
    const Vec3 q = f_.to_local(p);
    return {q.x, q.y, q.z};
  }

  void between(std::size_t i, const PathSections& sections, std::vector<Place>& out) {
    const double length = model::move_length(p_, i);
    for (const auto& [at_mm, numbers_there] : sections.inside(i, length)) {
      const auto q = numbers(model::point_on_move(p_, i, at_mm / length));
      const auto point = add_point(m_, q);
      m_.at<model::CartesianPoint>(point).name = kSectionPoint;
      out.push_back({point, i, at_mm, numbers_there});
    }
  }

  void via(std::size_t i, std::vector<Place>& out) {
    const bool helix = p_.z[i] != p_.z[i - 1];
    const double length = model::move_length(p_, i);
    const std::size_t least = curves::via_count(model::arc_sweep(p_, i));
    for (std::size_t n = least; n <= 2; ++n) {
      std::vector<double> at;
      std::vector<Vec3> points;
      for (std::size_t k = 1; k <= n; ++k) {
        at.push_back(static_cast<double>(k) / static_cast<double>(n + 1));
        points.push_back(f_.to_local(model::point_on_move(p_, i, at.back())));
      }
      if (!reads_back(i, points, helix)) continue;
      for (std::size_t k = 0; k < n; ++k) {
        const std::array c = {points[k].x, points[k].y, points[k].z};
        out.push_back({helix ? add_point<model::ViaHelixPoint>(m_, c) : add_point<model::ViaArcPoint>(m_, c),
                       i, at[k] * length});
      }
      return;
    }
    ++straightened;
  }

  // Whether the reader makes the same arc of it.
  [[nodiscard]] bool reads_back(std::size_t i, const std::vector<Vec3>& via, bool helix) const {
    const auto s = curves::arc_through(f_.to_local(p_.point(i - 1)), via, f_.to_local(p_.point(i)),
                                       {.coincident_mm = kCoincidentMm,
                                        .radius_mm = CurveOptions{}.gap_mm,
                                        .helix = helix,
                                        .axis = f_.direction_to_local({0.0, 0.0, 1.0})});
    if (!s || !s->arc) return false;
    if (std::abs(std::abs(s->sweep) - model::arc_sweep(p_, i)) > 1e-6) return false;
    for (const double t : {0.25, 0.5, 0.75}) {
      if (norm(f_.to_parent(curves::at(*s, t)) - model::point_on_move(p_, i, t)) > kArcMm) return false;
    }
    return true;
  }

  model::Model& m_;
  const CutterPath& p_;
  const Placement& f_;
  std::vector<model::Ref<model::CartesianPoint>> ends_;  ///< by move, unset: not made yet
};

// f / base as a number that times base gives f again.
double ratio_of(double f, double base) {
  const double r = f / base;
  double up = r, down = r;
  for (int i = 0; i < 4; ++i) {
    if (base * up == f) return up;
    if (base * down == f) return down;
    up = std::nextafter(up, 2.0 * r);
    down = std::nextafter(down, 0.0);
  }
  return r;
}

/// Replaces trajectories with a path by trajectories with curves.
class Splitter {
 public:
  Splitter(model::Plan& plan, const Placement& frame, AnyRef step, AnyRef technology,
           std::vector<std::string>& losses)
      : plan_(plan), m_(plan.model), frame_(frame), general_(technology), losses_(losses) {
    const auto* e = m_.get<model::Executable>(step);
    name_ = e != nullptr ? e->its_id.value_or("") : "";
  }

  void split(AnyRef at, std::vector<AnyRef>& out) {
    const auto path = m_.at<model::Trajectory>(at).path;
    const model::StepResult* result = nullptr;
    for (const auto& s : plan_.steps) {
      if (s.path == path) result = &s;
    }
    deviation_mm_ = result != nullptr && result->path_deviation_mm > 0.0
                        ? result->path_deviation_mm
                        : plan_.machine.control.path_tolerance_mm;
    schedule_ = result != nullptr && result->schedule && result->schedule->feed_mm_min.size() == path->size()
                    ? result->schedule
                    : nullptr;
    const PathSections sections(result != nullptr ? result->sections.get() : nullptr, path->size());
    Curves curves(m_, *path, frame_);
    bool first = true;
    for (std::size_t i = 1; i < path->size();) {
      std::size_t last = i;
      while (last + 1 < path->size() && same_run(*path, i, last + 1)) ++last;
      // The object that had the path is the first run: what refers to it still does.
      AnyRef target = at;
      if (path->kind[i] == MoveKind::kDwell) {
        target = dwell(i, at);
      } else {
        if (!first) {
          auto copy = m_.at<model::CutterLocationTrajectory>(at);
          copy.its_id.reset();
          target = m_.add(std::move(copy));
        }
        first = false;
        fill(target, *path, i, last, curves, sections);
      }
      auto& id = m_.at<model::Toolpath>(target).its_id;
      if (!id || id->empty()) id = name_ + " TP " + std::to_string(out.size() + 1);
      out.push_back(target);
      i = last + 1;
    }
    if (curves.straightened != 0) {
      losses_.push_back(std::to_string(curves.straightened) +
                        " arcs no longer than their uncertainty are written as lines");
    }
  }

 private:
  [[nodiscard]] double feed(std::size_t i) const { return schedule_ ? schedule_->feed_mm_min[i] : 0.0; }
  [[nodiscard]] double speed(std::size_t i) const { return schedule_ ? schedule_->spindle_rpm[i] : 0.0; }

  [[nodiscard]] bool same_run(const CutterPath& p, std::size_t i, std::size_t j) const {
    if (p.kind[i] == MoveKind::kDwell || p.kind[j] == MoveKind::kDwell) return false;
    const bool rapid = p.kind[i] == MoveKind::kRapid;
    if (rapid != (p.kind[j] == MoveKind::kRapid) || p.role[i] != p.role[j]) return false;
    // Zero is no multiple of any feed: such moves form a run of their own.
    return rapid || (speed(i) == speed(j) && (feed(i) > 0.0) == (feed(j) > 0.0));
  }

  AnyRef dwell(std::size_t i, AnyRef at) {
    model::Feedstop stop;
    stop.its_priority = m_.at<model::Toolpath>(at).its_priority.value_or(true);
    stop.its_type = model::ToolpathType::kTrajectoryPath;
    stop.dwell = schedule_ && i < schedule_->dwell_s.size() ? schedule_->dwell_s[i] : 0.0;
    return m_.add(std::move(stop));
  }

  void fill(AnyRef target, const CutterPath& p, std::size_t first, std::size_t last, Curves& curves,
            const PathSections& sections) {
    const bool rapid = p.kind[first] == MoveKind::kRapid;
    const auto jumps = [&](std::size_t i) { return !rapid && feed(i) != feed(i - 1); };
    const auto places = curves.places(first, last, jumps, sections);
    const auto technology = rapid ? model::Ref<model::Technology>() : technology_for(first, last);
    const model::SelectValue speed =
        rapid ? model::SelectValue{.ref = {}, .type = {}, .real = {}, .text = "RAPID"}
              : speed_for(technology, first, last, places, curves);
    const auto basic = curves.basic(places);
    model::Ref<model::BoundedCurve> cut, axis;
    const double volume = sections.volume(first, last);
    if (volume > 0.0) {
      cut = curves.beside(
          places, [&](const Place& at) { return at.section ? *at.section : sections.at(at.move, at.at_mm); });
    }
    const Vec3 z = frame_.direction_to_local({0.0, 0.0, 1.0});
    if (std::hypot(z.x, z.y) > kUpright || z.z < 0.0) {
      axis = curves.beside(places, [&](const Place&) { return std::array{z.x, z.y, z.z}; });
    }
    auto& t = m_.at<model::CutterLocationTrajectory>(target);
    t.path.reset();
    t.basiccurve = basic;
    t.its_priority = t.its_priority.value_or(true);
    t.its_type = toolpath_type_of(p.role[first], rapid);
    t.its_speed = speed;
    t.its_technology = technology;
    t.cross_section_area_parameters = cut;
    t.its_toolaxis = axis;
    t.its_material_removal_total_volume = volume > 0.0 ? model::Real(volume) : std::nullopt;
    if (!rapid && deviation_mm_ > 0.0) t.path_maximum_deviation = deviation_mm_;
  }

  model::SelectValue speed_for(AnyRef technology, std::size_t first, std::size_t last,
                               const std::vector<Place>& places, Curves& curves) {
    model::SelectValue out;
    const auto* t = m_.get<model::MillingTechnology>(technology);
    if (!schedule_ || t == nullptr || !t->feedrate || !(*t->feedrate > 0.0)) return out;
    const double base = *t->feedrate;
    bool same = true;
    for (std::size_t i = first; i <= last; ++i) same = same && feed(i) == feed(first);
    if (same) {
      if (feed(first) == base) return out;
      out.real = ratio_of(feed(first), base);
      out.type = "POSITIVE_RATIO_MEASURE";
      return out;
    }
    model::ToolpathSpeed speed;
    speed.speed =
        curves.beside(places, [&](const Place& at) { return std::array{ratio_of(feed(at.move), base)}; });
    out.ref = m_.add(std::move(speed));
    return out;
  }

  // The operation's own technology where its spindle turns as fast; else one with the run's greatest feed.
  model::Ref<model::Technology> technology_for(std::size_t first, std::size_t last) {
    const auto* general = m_.get<model::MillingTechnology>(general_);
    if (!schedule_ || general == nullptr) return model::Ref<model::Technology>(general_);
    const double spindle = -speed(first) + 0.0;
    double most = 0.0, least = feed(first);
    for (std::size_t i = first; i <= last; ++i) {
      most = std::max(most, feed(i));
      least = std::min(least, feed(i));
    }
    // If readers would not take the ratios as such, they refer to the run's greatest feed instead.
    const double base = general->feedrate.value_or(0.0);
    const bool near = least > 0.0 && least >= kLeastRatio * base && most <= kMostRatio * base;
    if (general->spindle == spindle && near) return model::Ref<model::Technology>(general_);
    const auto key = std::tuple(most, spindle);
    const auto known = technologies_.find(key);
    if (known != technologies_.end()) return known->second;
    model::MillingTechnology t = *general;
    t.feedrate = most;
    t.spindle = spindle;
    t.cutspeed.reset();
    t.feedrate_per_tooth.reset();
    return technologies_[key] = m_.add(std::move(t));
  }

  model::Plan& plan_;
  model::Model& m_;
  const Placement& frame_;
  AnyRef general_;
  std::vector<std::string>& losses_;
  std::string name_;
  std::shared_ptr<const model::FeedSchedule> schedule_;
  double deviation_mm_ = 0.0;  ///< largest deviation of the path, and of the control that follows it
  std::map<std::tuple<double, double>, model::Ref<model::Technology>> technologies_;
};

Result<Placement> feature_frame(const model::Model& m, AnyRef step) {
  const auto* w = m.get<model::MachiningWorkingstep>(step);
  if (w == nullptr) return Placement{};
  return toolpath_frame(m, w->its_feature);
}

bool has_curves(const model::Model& m, AnyRef step) {
  const auto* list = m.get<model::ToolpathList>(toolpath_list_of(m, step));
  if (list == nullptr) return false;
  const auto& items = list->its_list.items;
  return std::any_of(items.begin(), items.end(), [&](AnyRef t) {
    const auto* cl = m.get<model::CutterLocationTrajectory>(t);
    const auto* cc = m.get<model::CutterContactTrajectory>(t);
    return (cl != nullptr && cl->basiccurve) || (cc != nullptr && cc->basiccurve.set()) ||
           m.holds<model::ApproachLiftPath>(t);
  });
}

bool same_place(const Placement& a, const Placement& b) {
  return norm(a.origin - b.origin) <= kSamePlace && norm(a.x - b.x) <= kSamePlace &&
         norm(a.z - b.z) <= kSamePlace;
}

}  // namespace

namespace {

bool cuts(const model::SectionSeries& s) {
  return std::any_of(s.csa_mm2.begin(), s.csa_mm2.end(), [](double a) { return a > 0.0; });
}

/// Curves that a file brought stay as they are, and have no points for sections that were measured since.
void tell_sections_not_written(const model::Plan& plan, std::vector<std::string>& losses) {
  const auto& m = plan.model;
  std::size_t count = 0;
  for (const auto& s : plan.steps) {
    if (!s.sections || !cuts(*s.sections)) continue;
    const auto* list = m.get<model::ToolpathList>(toolpath_list_of(m, s.step));
    const bool stated = list != nullptr &&
                        std::any_of(list->its_list.items.begin(), list->its_list.items.end(), [&](AnyRef t) {
                          const auto* trajectory = m.get<model::Trajectory>(t);
                          return trajectory != nullptr && trajectory->cross_section_area_parameters.set();
                        });
    if (!stated) ++count;
  }
  if (count != 0) {
    losses.push_back("the cross sections of " + std::to_string(count) +
                     " steps with curves as given are not written: the curves stay as they are");
  }
}

}  // namespace

Status write_paths(model::Plan& plan, std::vector<std::string>& losses) {
  adopt_paths(plan);
  auto& m = plan.model;
  const auto bare = [&](AnyRef t) { return has_bare_path(m, t); };
  for (const AnyRef step : m.all_below(model::TypeId::kWorkingstep)) {
    const AnyRef list = toolpath_list_of(m, step);
    const auto* toolpaths = m.get<model::ToolpathList>(list);
    if (toolpaths == nullptr) continue;
    const std::vector<AnyRef> items = toolpaths->its_list.items;
    if (std::none_of(items.begin(), items.end(), bare)) continue;
    const auto frame = frame_of_step(plan, model::Ref<model::Executable>(step));
    if (!frame) return fail(frame.error());
    const auto* w = m.get<model::MachiningWorkingstep>(step);
    const auto* op = w == nullptr ? nullptr : m.get<model::MachiningOperation>(w->its_operation);
    Splitter splitter(plan, *frame, step, op == nullptr ? AnyRef{} : AnyRef(op->its_technology), losses);
    std::vector<AnyRef> next;
    for (const AnyRef t : items) {
      if (bare(t)) {
        splitter.split(t, next);
      } else {
        next.push_back(t);
      }
    }
    m.at<model::ToolpathList>(list).its_list.items = std::move(next);
  }
  tell_sections_not_written(plan, losses);
  return {};
}

void state_frames(model::Plan& plan) {
  auto& m = plan.model;
  for (const AnyRef step : m.all(model::TypeId::kMachiningWorkingstep)) {
    if (m.at<model::Workingstep>(step).toolpath_orientation || !has_curves(m, step)) continue;
    const auto at = feature_frame(m, step);
    if (!at || same_place(*at, Placement{})) continue;
    const auto stated = model::add_placement(m, *at);
    m.at<model::Workingstep>(step).toolpath_orientation = stated;
  }
}

void adopt_frames(model::Plan& plan) { state_frames(plan); }

void drop_stated_frames(model::Plan& plan) {
  auto& m = plan.model;
  for (const AnyRef step : m.all(model::TypeId::kMachiningWorkingstep)) {
    auto& w = m.at<model::MachiningWorkingstep>(step);
    if (!w.toolpath_orientation) continue;
    const auto stated = model::placement_or_identity(m, w.toolpath_orientation);
    const auto own = feature_frame(m, step);
    if (stated && own && same_place(*stated, *own)) w.toolpath_orientation = {};
  }
}

}  // namespace capstan::exchange::ap238
