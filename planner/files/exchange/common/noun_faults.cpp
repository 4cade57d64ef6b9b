#include "planner/files/exchange/common/noun_faults.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include "planner/ground/base/number.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/unreadable.h"

namespace capstan::exchange {

using model::AnyRef;
using model::TypeId;

namespace {

constexpr std::uint64_t kMaxSteps = 1'000'000;  // default, unsourced: executions of one workplan

struct Check {
  const model::Model& m;
  std::vector<Doubt>& doubts;
  std::vector<AnyRef> objects;

  void doubt(AnyRef at, Diagnostic d) { doubts.push_back({at, std::move(d)}); }
};

// Calls `visit` for what an object is made of. Not for what only looks back at it: a workpiece lists the
// requirements and properties that each name the workpiece.
void for_each_part(const model::Model& m, AnyRef at, const std::function<void(AnyRef)>& visit) {
  const auto* w = m.get<model::Workpiece>(at);
  if (w == nullptr) return model::for_each_reference(m, at, visit);
  std::set<AnyRef> back(w->its_requirements.items.begin(), w->its_requirements.items.end());
  back.insert(w->its_properties.items.begin(), w->its_properties.items.end());
  model::for_each_reference(m, at, [&](AnyRef to) {
    if (!back.contains(to)) visit(to);
  });
}

// A depth-first walk over everything that finds references running in a circle. No noun may reach itself by
// its attributes; through a kept instance, whose meaning is unknown, it may.
class CycleFinder {
 public:
  explicit CycleFinder(Check& r) : r_(r), m_(r.m) {
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      state_[t].resize(m_.count(static_cast<TypeId>(t)), kNew);
    }
  }

  void run() {
    for (const AnyRef root : r_.objects) {
      if (state(root) == kNew) walk(root);
    }
  }

 private:
  enum State : std::uint8_t { kNew, kOnPath, kDone };
  struct Frame {
    AnyRef at;
    std::vector<AnyRef> next;
    std::size_t i = 0;
  };
  std::uint8_t& state(AnyRef a) { return state_[static_cast<std::size_t>(a.type)][a.index]; }

  void walk(AnyRef root) {
    std::vector<Frame> path;
    enter(path, root);
    while (!path.empty()) {
      Frame& f = path.back();
      if (f.i == f.next.size()) {
        state(f.at) = kDone;
        path.pop_back();
        continue;
      }
      const AnyRef to = f.next[f.i++];
      if (to.type == TypeId::kKeptInstance || !refers(to.type)) continue;
      if (state(to) == kOnPath) {
        circle(path.back().at, to);
      } else if (state(to) == kNew) {
        enter(path, to);
      }
    }
  }

  /// Whether objects of that kind can have parts.
  static bool refers(TypeId type) {
    const auto& attributes = model::noun_type(type).attributes;
    return std::any_of(attributes.begin(), attributes.end(), [](const model::Attribute& a) {
      return a.storage == model::Storage::kRef || a.storage == model::Storage::kRefList ||
             a.storage == model::Storage::kRefTable || a.storage == model::Storage::kSelect ||
             a.storage == model::Storage::kSelectList;
    });
  }

  void enter(std::vector<Frame>& path, AnyRef at) {
    state(at) = kOnPath;
    Frame f{at, {}, 0};
    if (at.type != TypeId::kKeptInstance) {
      for_each_part(m_, at, [&](AnyRef to) { f.next.push_back(to); });
    }
    path.push_back(std::move(f));
  }

  void circle(AnyRef from, AnyRef to) {
    const std::string what = std::string(model::noun_type(to.type).keyword);
    r_.doubt(from, {.code = "EXC-CYCLE",
                    .message = from == to ? what + " refers to itself"
                                          : std::string(model::noun_type(from.type).keyword) +
                                                " leads back to #" + std::to_string(m_.origin(to).instance) +
                                                " " + what + ", which it is part of"});
    found = true;
  }

  Check& r_;
  const model::Model& m_;
  std::array<std::vector<std::uint8_t>, model::kTypeCount> state_;

 public:
  bool found = false;
};

void fault(Check& r, AnyRef at, std::string message, std::string code = "EXC-GEOMETRY") {
  r.doubt(at, {.code = std::move(code), .message = std::move(message)});
}

void warn(Check& r, AnyRef at, std::string code, std::string message) {
  r.doubt(at, {.code = std::move(code), .severity = Severity::kWarning, .message = std::move(message)});
}

// multiplicities[i] of knots[i]: as many, each in 1..degree+1, together degree + points + 1, knots rising.
void check_knots(Check& r, AnyRef at, const std::string& name, std::optional<std::int64_t> degree,
                 std::size_t points, const model::IntegerList& multiplicities, const model::RealList& knots) {
  if (!degree || *degree < 1 || *degree > 100) return fault(r, at, name + " has an impossible degree");
  if (multiplicities.items.size() != knots.items.size()) {
    return fault(r, at,
                 name + " has " + std::to_string(multiplicities.items.size()) + " multiplicities for " +
                     std::to_string(knots.items.size()) + " knots");
  }
  std::uint64_t sum = 0;
  for (const std::int64_t m : multiplicities.items) {
    if (m < 1 || m > *degree + 1) {
      return fault(r, at,
                   name + " has the knot multiplicity " + std::to_string(m) + ", outside 1.." +
                       std::to_string(*degree + 1));
    }
    sum += static_cast<std::uint64_t>(m);
  }
  const std::uint64_t want = static_cast<std::uint64_t>(*degree) + points + 1;
  if (sum != want) {
    return fault(r, at,
                 name + "'s multiplicities add up to " + std::to_string(sum) + ", not to " +
                     std::to_string(want) + " (degree + points + 1)");
  }
  for (std::size_t i = 1; i < knots.items.size(); ++i) {
    if (!(knots.items[i - 1] < knots.items[i])) return fault(r, at, name + "'s knots do not rise");
  }
}

void check_splines(Check& r) {
  const auto& m = r.m;
  for (const AnyRef at : m.all(TypeId::kBSplineCurveWithKnots)) {
    const auto& c = m.at<model::BSplineCurveWithKnots>(at);
    check_knots(r, at, "B_SPLINE_CURVE_WITH_KNOTS", c.degree, c.control_points_list.size(),
                c.knot_multiplicities, c.knots);
  }
  for (const AnyRef at : m.all(TypeId::kRationalBSplineCurve)) {
    const auto& c = m.at<model::RationalBSplineCurve>(at);
    if (c.weights_data.items.size() != c.control_points_list.size()) {
      fault(r, at, "RATIONAL_B_SPLINE_CURVE has not one weight for each point");
    }
  }
  for (const AnyRef at : m.all(TypeId::kBSplineSurfaceWithKnots)) {
    const auto& s = m.at<model::BSplineSurfaceWithKnots>(at);
    const auto& rows = s.control_points_list.items;
    const std::size_t columns = rows.empty() ? 0 : rows.front().size();
    const bool even =
        std::all_of(rows.begin(), rows.end(), [&](const auto& x) { return x.size() == columns; });
    if (!even) fault(r, at, "B_SPLINE_SURFACE_WITH_KNOTS has rows of unequal length");
    check_knots(r, at, "B_SPLINE_SURFACE_WITH_KNOTS (u)", s.u_degree, rows.size(), s.u_multiplicities,
                s.u_knots);
    check_knots(r, at, "B_SPLINE_SURFACE_WITH_KNOTS (v)", s.v_degree, columns, s.v_multiplicities, s.v_knots);
  }
}

void check_directions_and_points(Check& r) {
  const auto& m = r.m;
  for (const AnyRef at : m.all(TypeId::kDirection)) {
    const auto& d = m.at<model::Direction>(at).direction_ratios.items;
    if (d.size() != 2 && d.size() != 3) {
      fault(r, at, "DIRECTION needs two or three ratios");
    } else if (std::all_of(d.begin(), d.end(), [](double x) { return x == 0.0; })) {
      fault(r, at, "DIRECTION has no length: all ratios are 0");
    }
  }
  for (const AnyRef at : m.all(TypeId::kCartesianPoint)) {
    const std::size_t n = m.at<model::CartesianPoint>(at).coordinates.items.size();
    if ((n < 1 || n > 3) && n != 7)  // seven: a point of cross-section parameters (ISO 10303-238)
      warn(r, at, "EXC-GEOMETRY",
           "CARTESIAN_POINT has " + std::to_string(n) + " coordinates; a point has 1 to 3");
  }
}

// Sizes that cannot be negative, whatever noun they belong to.
bool is_size(std::string_view name) {
  return name.find("radius") != std::string_view::npos || name.find("diameter") != std::string_view::npos ||
         name == "theoretical_size" || name == "semi_axis_1" || name == "semi_axis_2" || name == "height" ||
         name == "cutting_edge_length" || name == "expected_tool_life" || name == "dwell" || name == "pitch";
}

/// Lengths that only say how far straight paths go. A negative one leaves its feature without a shape;
/// model::length reports that, and the rest of the file is read.
std::set<AnyRef> only_distances(const Check& r) {
  std::set<AnyRef> out, others;
  for (const AnyRef at : r.objects) {
    const auto* path = r.m.get<model::LinearPath>(at);
    model::for_each_reference(r.m, at, [&](AnyRef to) {
      if (to.type != TypeId::kTolerancedLengthMeasure) return;
      (path != nullptr && AnyRef(path->distance) == to ? out : others).insert(to);
    });
  }
  std::erase_if(out, [&](AnyRef at) { return others.contains(at); });
  return out;
}

void check_sizes(Check& r) {
  const auto& m = r.m;
  std::optional<std::set<AnyRef>> distances;
  for (const AnyRef at : r.objects) {
    if (at.type == TypeId::kKeptInstance) continue;
    const bool solid = at.type == TypeId::kBlock || at.type == TypeId::kCircle || at.type == TypeId::kHelix;
    for (const model::Attribute& a : model::noun_type(at.type).attributes) {
      if (a.storage != model::Storage::kReal) continue;
      const auto& v = model::value_of<model::Real>(a, m.object(at));
      const bool axis = at.type == TypeId::kBlock && a.name.size() == 1;
      if (!v || (!is_size(a.name) && !axis)) continue;
      if (*v < 0.0 && at.type == TypeId::kTolerancedLengthMeasure) {
        if (!distances) distances = only_distances(r);
        if (distances->contains(at)) {
          warn(r, at, "EXC-SIZE",
               attribute_name(at, a.name) + " is " + shortest(*v) +
                   ", not how far a path goes; what needs it has no shape");
          continue;
        }
      }
      if (*v < 0.0 || (*v == 0.0 && solid)) {
        fault(r, at, attribute_name(at, a.name) + " is " + shortest(*v) + ", not a size", "EXC-SIZE");
      }
    }
  }
  for (const AnyRef at : m.all(TypeId::kWorkpiece)) {
    const auto& t = m.at<model::Workpiece>(at).global_tolerance;
    if (t && *t > model::kLargestGlobalTolerance) {
      warn(r, at, "EXC-TOLERANCE",
           "WORKPIECE.global_tolerance is " + shortest(*t) +
               " mm; kept, and hardly meant: checks and allowances do without it");
    } else if (t && *t > model::kWidestJudged) {
      warn(r, at, "EXC-TOLERANCE",
           "WORKPIECE.global_tolerance is " + shortest(*t) + " mm; kept, but the check judges by " +
               shortest(model::kWidestJudged) + " mm, the widest that it knows");
    }
  }
}

void check_sets(Check& r) {
  const auto& m = r.m;
  const auto at_least = [&](AnyRef at, std::string_view what, const model::AnyRefList& list, std::size_t n) {
    if (!list.given || list.size() >= n) return;
    warn(r, at, "EXC-EMPTY",
         attribute_name(at, what) + " has " + std::to_string(list.size()) + " elements, " +
             std::to_string(n) + " are the least");
  };
  for (const AnyRef at : m.all(TypeId::kPolyline))
    at_least(at, "points", m.at<model::Polyline>(at).points, 2);
  for (const AnyRef at : m.all(TypeId::kCompositeCurve)) {
    at_least(at, "segments", m.at<model::CompositeCurve>(at).segments, 1);
  }
  for (const AnyRef at : m.all(TypeId::kToolpathList)) {
    at_least(at, "its_list", m.at<model::ToolpathList>(at).its_list, 1);
  }
}

// Number of steps that a workplan runs if shared parts run at each of their places: a graph of depth 39 whose
// levels each use the next one twice has 2^39. Needs a model without circles.
void check_expansion(Check& r) {
  const auto& m = r.m;
  std::array<std::vector<std::uint64_t>, model::kTypeCount> runs;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) runs[t].resize(m.count(static_cast<TypeId>(t)), 0);
  const auto count = [&](AnyRef a) -> std::uint64_t& {
    return runs[static_cast<std::size_t>(a.type)][a.index];
  };
  for (const AnyRef root : m.all_below(TypeId::kProgramStructure)) {
    std::vector<AnyRef> stack = {root};
    while (!stack.empty()) {
      const AnyRef at = stack.back();
      if (count(at) != 0) {
        stack.pop_back();
        continue;
      }
      std::uint64_t sum = 1;
      bool ready = true;
      model::for_each_reference(m, at, [&](AnyRef to) {
        if (!m.holds<model::Executable>(to)) return;
        if (count(to) == 0) {
          stack.push_back(to);
          ready = false;
        }
        sum = std::min(kMaxSteps + 1, sum + count(to));
      });
      if (!ready) continue;
      count(at) = sum;
      stack.pop_back();
    }
    if (count(root) > kMaxSteps) {
      fault(r, root, "the workplan expands to more than " + std::to_string(kMaxSteps) + " steps",
            "EXC-LIMIT");
    }
  }
}

}  // namespace

Marks::Marks(const model::Model& m) {
  for (std::size_t t = 1; t < model::kTypeCount; ++t)
    marks_[t].resize(m.count(static_cast<TypeId>(t)), false);
}

void Marks::set_from(const model::Model& m, AnyRef root) {
  std::vector<AnyRef> pending = {root};
  while (!pending.empty()) {
    const AnyRef at = pending.back();
    pending.pop_back();
    if (has(at)) continue;
    set(at);
    model::for_each_reference(m, at, [&](AnyRef to) { pending.push_back(to); });
  }
}

std::vector<AnyRef> objects_in_file_order(const model::Model& m, const std::function<bool(TypeId)>& of_kind) {
  struct Placed {
    std::uint64_t line, instance;
    AnyRef at;
    auto operator<=>(const Placed&) const = default;
  };
  // Points and the like are many, and mostly in order: what is in order is merged, the rest is sorted.
  constexpr std::size_t kMany = 10000;
  std::vector<Placed> out;
  std::vector<std::vector<Placed>> runs;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<TypeId>(t);
    if (m.count(type) == 0 || (of_kind && !of_kind(type))) continue;
    std::vector<Placed> run;
    for (std::uint32_t i = 0; i < m.count(type); ++i) {
      const model::Origin& o = m.origin({type, i});
      if (o.instance != 0) run.push_back({o.line, o.instance, {type, i}});
    }
    if (run.size() >= kMany && std::is_sorted(run.begin(), run.end())) {
      runs.push_back(std::move(run));
    } else {
      out.insert(out.end(), run.begin(), run.end());
    }
  }
  std::sort(out.begin(), out.end());
  for (const auto& run : runs) {
    const auto middle = static_cast<std::ptrdiff_t>(out.size());
    out.insert(out.end(), run.begin(), run.end());
    std::inplace_merge(out.begin(), out.begin() + middle, out.end());
  }
  std::vector<AnyRef> objects;
  objects.reserve(out.size());
  for (const Placed& p : out) objects.push_back(p.at);
  return objects;
}

void check_nouns(const model::Model& m, std::vector<Doubt>& doubts) {
  Check r{m, doubts, objects_in_file_order(m)};
  CycleFinder cycles(r);
  cycles.run();
  if (!cycles.found) check_expansion(r);
  check_splines(r);
  check_directions_and_points(r);
  check_sizes(r);
  check_sets(r);
}

namespace {

/// Largest number of wrong references: a file with more was not written by hand, and is refused.
constexpr std::size_t kMostUnset = 100;  // default, unsourced

/// Whether the plan can be read around the fault: it takes from some features or steps, or from the list of
/// what is carried out. Where it is of the whole plan, no program is made of what was read.
bool belongs_to_some(const model::Plan& plan, std::optional<model::Leads>& leads, const Doubt& doubt) {
  if (doubt.attribute.empty()) return false;
  if (model::of_whole_plan({doubt.object, doubt.attribute})) return true;
  if (plan.model.holds<model::ProgramStructure>(doubt.object)) return doubt.attribute == "its_elements";
  if (!leads) leads.emplace(plan.model);
  const auto touched = leads->touched_by(doubt.object);
  return !touched.features.empty() || !touched.steps.empty();
}

}  // namespace

void settle_doubts(model::Plan& plan, std::vector<Doubt>& doubts, const Marks& reached, bool strict,
                   Reporter& reporter) {
  const model::Model& m = plan.model;
  std::optional<model::Leads> leads;
  std::stable_sort(doubts.begin(), doubts.end(), [&](const auto& a, const auto& b) {
    return m.origin(a.object).instance < m.origin(b.object).instance;
  });
  // Features are planned, too, where no workingstep of the file makes them: an attribute of theirs counts.
  Marks of_features = reached;
  for (const AnyRef f : m.all_below(TypeId::kManufacturingFeature)) {
    if (plan.project) of_features.set_from(m, f);
  }
  const auto matters = [&](const Doubt& d) {
    return reached.has(d.object) || (!d.attribute.empty() && of_features.has(d.object));
  };
  std::size_t unset = 0;
  for (auto& doubt : doubts) {
    if (!matters(doubt)) {
      if (doubt.diagnostic.severity == Severity::kError)
        doubt.diagnostic.hint = "what does not fit is left out; the project does not need it";
      doubt.diagnostic.severity = Severity::kWarning;
    } else if (strict && belongs_to_some(plan, leads, doubt)) {
      doubt.diagnostic.severity = Severity::kError;
    } else if (!strict && unset < kMostUnset && belongs_to_some(plan, leads, doubt)) {
      ++unset;
      Diagnostic d = std::move(doubt.diagnostic);
      d.severity = Severity::kError;
      d.instance = m.origin(doubt.object).instance;
      d.line = m.origin(doubt.object).line;
      model::set_unreadable(plan, doubt.object, doubt.attribute,
                            "line " + std::to_string(d.line) + ", #" + std::to_string(d.instance) + ": " +
                                d.message + (d.expected.empty() ? "" : "; expected " + d.expected));
      d.hint = model::of_whole_plan({doubt.object, doubt.attribute}) ? "no program is made of the plan"
                                                                     : "what needs it is not planned";
      reporter.tell(std::move(d));
      continue;
    }
    reporter.about(m, doubt.object, std::move(doubt.diagnostic));
  }
  doubts.clear();
}

}  // namespace capstan::exchange
