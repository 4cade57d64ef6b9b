#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/files/exchange/records/exact_paths.h"
#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/edited.h"

// Toolpaths are written in the frame of their feature, the header's path in that of the set-up. Where a
// feature was moved in the file its toolpaths go with it. So the two paths of a step are compared up to a
// rigid motion, which three points of the path give: the first, the one farthest from it, and the one
// farthest from the line through both. A point that was edited does not follow the motion of the others, and
// where it is one of the three the others do not follow it.

namespace capstan::exchange {
namespace {

using geometry::Vec3;
using model::CutterPath;

/// Points this near are one: another program may have written them with 4 decimals. Default, unsourced.
constexpr double kSameMm = 2e-4;

/// A rigid motion: `from` goes to `to`, and the axes turn with it.
struct Motion {
  Vec3 from, to;
  std::array<Vec3, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, turned = axes;

  [[nodiscard]] Vec3 operator()(Vec3 p) const {
    const Vec3 d = p - from;
    return to + dot(d, axes[0]) * turned[0] + dot(d, axes[1]) * turned[1] + dot(d, axes[2]) * turned[2];
  }
};

/// Right-handed, the first axis along `along`, the second in the plane of `along` and `beside`.
std::array<Vec3, 3> axes_of(Vec3 along, Vec3 beside) {
  const Vec3 a = normalised(along);
  const Vec3 c = normalised(cross(a, beside));
  return {a, cross(c, a), c};
}

/// The point of the path for which `distance` is greatest.
template <class Distance>
std::size_t farthest(const CutterPath& path, Distance&& distance) {
  std::size_t out = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (const double d = distance(path.point(i)); d > most) {
      most = d;
      out = i;
    }
  }
  return out;
}

/// The motion that takes the one path to the other, where one does. Needs paths of as many points, one at
/// least.
Motion motion_of(const CutterPath& was, const CutterPath& is) {
  Motion out{was.point(0), is.point(0)};
  const std::size_t b = farthest(was, [&](Vec3 p) { return norm(p - was.point(0)); });
  const Vec3 along = was.point(b) - was.point(0), now_along = is.point(b) - is.point(0);
  if (norm(along) < kSameMm || norm(now_along) < kSameMm) return out;
  const auto off_line = [](Vec3 axis, Vec3 d) { return norm(cross(normalised(axis), d)); };
  const std::size_t c = farthest(was, [&](Vec3 p) { return off_line(along, p - was.point(0)); });
  Vec3 beside = was.point(c) - was.point(0), now_beside = is.point(c) - is.point(0);
  if (off_line(along, beside) < kSameMm || off_line(now_along, now_beside) < kSameMm) {
    // All lie on a line: how it is turned about itself is the same to them.
    const auto across = [](Vec3 axis) {
      return std::abs(axis.x) < 0.5 * norm(axis) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    };
    beside = across(along);
    now_beside = across(now_along);
  }
  out.axes = axes_of(along, beside);
  out.turned = axes_of(now_along, now_beside);
  return out;
}

/// Whether two moves are both rapid, both a dwell, or both at feed. Of the last, an arc so short that it is
/// written as a line is the same way.
bool alike(model::MoveKind a, model::MoveKind b) {
  const auto at_feed = [](model::MoveKind k) {
    return k != model::MoveKind::kRapid && k != model::MoveKind::kDwell;
  };
  return a == b || (at_feed(a) && at_feed(b));
}

/// The first move that does not follow the motion, by its end and its middle; nothing where all do.
std::optional<std::size_t> first_off(const CutterPath& was, const CutterPath& is, const Motion& motion) {
  const auto apart = [&](Vec3 then, Vec3 now) { return norm(motion(then) - now) > kSameMm; };
  const std::size_t n = std::min(was.size(), is.size());
  for (std::size_t i = 0; i < n; ++i) {
    tick();
    if (!alike(was.kind[i], is.kind[i]) || apart(was.point(i), is.point(i))) return i;
    const bool curved = i > 0 && (model::is_arc(was.kind[i]) || model::is_arc(is.kind[i]));
    if (curved && apart(model::point_on_move(was, i, 0.5), model::point_on_move(is, i, 0.5))) return i;
  }
  return was.size() == is.size() ? std::nullopt : std::optional(n);
}

/// A step whose path planning computed, and how its two paths differ.
struct Compared {
  const model::StepResult* step = nullptr;
  model::AnyRef operation, feature;
  CutterPath was, is;
  std::optional<std::size_t> off;  ///< where they are not one path, wherever it lies
  Motion motion;
  bool moved = false;
};

std::string words_of(const CutterPath& path, std::size_t i) {
  if (i >= path.size()) return "is not there";
  return "ends at X" + trimmed(path.x[i], 4) + " Y" + trimmed(path.y[i], 4) + " Z" + trimmed(path.z[i], 4);
}

std::string difference(const Compared& c, std::size_t at) {
  return "from move " + std::to_string(at) + " on, which " + words_of(c.is, at) + " in its toolpaths, and " +
         words_of(c.was, at) + " in the header's !CAPSTAN_PATH";
}

std::vector<Compared> compared(const model::Plan& plan, const model::Plan& as_written) {
  std::vector<Compared> out;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const model::StepResult& s = plan.steps[i];
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    const auto path = as_written.steps[i].path;
    if (ws == nullptr || path == nullptr || path->size() == 0) continue;
    const model::Decision* made = plan.ledger.find(ws->its_operation, "its_toolpath");
    if (!model::by_planning(made) || made->pinned || made->state == model::DecisionState::kOpen) continue;
    Job silent;
    auto followed = path_of_step(plan, s.step, {}, silent);
    // What cannot be followed its reader, or planning, tells.
    if (!followed || followed->path.size() == 0) continue;
    Compared c{&s, ws->its_operation, ws->its_feature, *path, std::move(followed->path), {}, {}, false};
    const auto apart = first_off(c.was, c.is, Motion{});
    if (apart) {
      c.motion = motion_of(c.was, c.is);
      c.moved = !first_off(c.was, c.is, c.motion);
      if (!c.moved) c.off = apart;
    }
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace

void refuse_edited_paths(const p21::File& file, model::Plan& plan, Reporter& reporter) {
  bool any = false;
  for (std::size_t i = 0; i < file.header_count() && !any; ++i) any = is_of_paths(file.header(i).keyword());
  if (!any) return;
  model::Plan as_written = plan;
  Job silent;
  Reporter unheard(silent, file.name());
  restore_paths(file, as_written, unheard);
  std::vector<Compared> all = compared(plan, as_written);
  for (Compared& c : all) {
    if (!c.moved) continue;
    const bool alone = std::any_of(all.begin(), all.end(), [&](const Compared& other) {
      return other.feature == c.feature && first_off(c.was, c.is, other.motion);
    });
    if (alone) c.off = first_off(c.was, c.is, Motion{});
  }
  for (const Compared& c : all) {
    const std::string id = model::step_id(plan, *c.step);
    if (c.off) {
      model::refuse_edited_path(plan, c.step->step, "the file: " + difference(c, *c.off));
    } else if (c.moved) {
      reporter.about(
          plan.model, c.operation,
          {.code = std::string(model::kEditedCode),
           .severity = Severity::kWarning,
           .message = "step '" + id + "': " + difference(c, first_off(c.was, c.is, Motion{}).value_or(0)) +
                      "; its toolpaths lie elsewhere as a whole, as if its feature was moved, and "
                      "planning computes them anew from the feature"});
    }
  }
}

}  // namespace capstan::exchange
