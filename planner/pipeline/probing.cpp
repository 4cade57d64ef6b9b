#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/pipeline/work.h"
#include "tooling/nouns/nouns.h"

// Measuring in the process: a workpiece_probing between the steps of a feature.

namespace capstan::pipeline {
namespace {

using geometry::Vec3;
using model::Binder;
using model::FeatureShape;
using model::Model;
using model::ShapeKind;

constexpr double kClear =
    10.0;  // mm above the floor's top where a measurement downwards begins; default, unsourced

/// One measuring move: from where, which way, how far until it touches, and what that distance may be.
struct Measure {
  Vec3 start, direction, reference;
  double distance_mm = 0.0;
  std::optional<double> lower_mm, upper_mm;
  std::string what;  ///< "radius"
};

/// The deviations of a size: its own, else the general ones.
std::optional<model::Deviations> deviations(const Work& w, const model::Toleranced& t) {
  if (t.given) return model::Deviations{t.lower_mm, t.upper_mm};
  const auto half = w.general ? model::general_size(*w.general, t.nominal_mm) : std::nullopt;
  if (!half) return std::nullopt;
  return model::Deviations{-*half, *half};
}

/// What the last step will still take off the wall and the floor: what the one before it leaves.
struct Left {
  double side_mm = 0.0, bottom_mm = 0.0;
};
Left left_at(const std::vector<model::ProposedStep>& chain, std::size_t at, const FeatureShape& s) {
  Left out;
  if (at > 0 && model::is_a(chain[at - 1].operation, model::TypeId::kMillingTypeOperation)) {
    out.side_mm = chain[at - 1].allowance_side_mm;
    out.bottom_mm = chain[at - 1].allowance_bottom_mm;
  }
  if (s.kind == ShapeKind::kHole && at + 1 < chain.size() && chain[at + 1].start_diameter_mm > 0.0)
    out.side_mm = std::max(0.0, 0.5 * (s.diameter.middle() - chain[at + 1].start_diameter_mm));
  return out;
}

/// Holes: from the axis, half way down, to the wall. Pockets and slots that state a width: from the middle to
/// the wall. All else: from above down to the floor.
Measure measure_of(const Work& w, const FeatureShape& s, Left left) {
  Measure out;
  const auto half = [&](const model::Toleranced& t, const char* what) {
    out.distance_mm = 0.5 * t.middle() - left.side_mm;
    if (const auto d = deviations(w, t)) {
      out.lower_mm = 0.5 * (d->lower_mm - d->middle());
      out.upper_mm = 0.5 * (d->upper_mm - d->middle());
    }
    out.what = what;
  };
  out.reference = s.frame.z;
  if (s.kind == ShapeKind::kHole) {
    out.start = s.frame.origin - 0.5 * s.depth_mm * s.frame.z;
    out.direction = s.frame.x;
    half(s.diameter, "radius");
    return out;
  }
  const auto box = geometry::bounds(s.area);
  const geometry::Vec2 middle = 0.5 * (box.lo + box.hi);
  const auto size = box.hi - box.lo;
  constexpr double kSame = 1e-3;
  const bool across_y = std::abs(size.y - s.width.nominal_mm) < kSame;
  const bool across_x = std::abs(size.x - s.width.nominal_mm) < kSame;
  if (s.kind == ShapeKind::kPocket && s.width.given && s.islands.empty() && (across_x || across_y)) {
    out.start = s.frame.to_parent({middle.x, middle.y, -0.5 * s.depth_mm});
    out.direction = across_y ? s.frame.y : s.frame.x;
    half(s.width, "half width");
    return out;
  }
  out.start = s.frame.to_parent({middle.x, middle.y, kClear});
  out.direction = -1.0 * s.frame.z;
  out.reference = s.frame.x;
  model::Toleranced depth = s.depth_tolerance;
  depth.nominal_mm = s.depth_mm;
  out.distance_mm = kClear + depth.middle() - left.bottom_mm;
  if (const auto d = deviations(w, depth)) {
    out.lower_mm = d->lower_mm - d->middle();
    out.upper_mm = d->upper_mm - d->middle();
  }
  out.what = "floor, from " + trimmed(kClear, 3) + " mm above";
  return out;
}

Ref<model::TouchProbe> probe_noun(Model& m, const model::Cutter* c) {
  const std::string id = c == nullptr ? "by hand" : c->id;
  for (const AnyRef r : m.all(model::TypeId::kTouchProbe)) {
    if (m.origin(r).instance == 0 && m.at<model::TouchProbe>(r).its_id == id)
      return Ref<model::TouchProbe>(r);
  }
  if (c != nullptr) return Ref<model::TouchProbe>(AnyRef(tooling::nouns_from_cutter(m, *c)));
  model::TouchProbe probe;
  probe.its_id = id;
  return m.add(probe);
}

Ref<model::Direction> direction(Model& m, Vec3 v) {
  model::Direction d;
  d.name = "";
  d.direction_ratios = {{v.x, v.y, v.z}, true};
  return m.add(d);
}

}  // namespace

Ref<model::Executable> add_probing(Work& w, const std::vector<model::ProposedStep>& chain, std::size_t at,
                                   const model::Candidate* probe, const FeatureShape& shape) {
  Model& m = w.plan.model;
  const model::ProposedStep& step = chain[at];
  const Measure what = measure_of(w, shape, left_at(chain, at, shape));

  model::CartesianPoint point;
  point.name = "";
  point.coordinates = {{what.start.x, what.start.y, what.start.z}, true};
  model::Axis2Placement3d start;
  start.name = "";
  start.location = m.add(point);
  start.axis = direction(m, what.reference);
  start.ref_direction = direction(m, what.direction);

  model::TolerancedLengthMeasure expected;
  expected.theoretical_size = what.distance_mm;
  if (what.lower_mm && what.upper_mm) {
    model::PlusMinusValue t;
    t.upper_limit = *what.upper_mm;
    t.lower_limit = -*what.lower_mm;  // what is subtracted, as ISO 14649-10 has it
    t.significant_digits = 4;
    expected.implicit_tolerance = m.add(t);
  }
  model::NcVariable result;
  result.its_name = "probed_" + std::to_string(m.all(model::TypeId::kWorkpieceProbing).size() + 1);

  model::WorkpieceProbing p;
  p.its_id = step.name;
  p.measured_offset = m.add(result);
  p.start_position = m.add(start);
  if (const auto* f = m.get<model::ManufacturingFeature>(step.feature)) p.its_workpiece = f->its_workpiece;
  p.direction = direction(m, what.direction);
  p.expected_value = m.add(expected);
  p.its_probe = probe_noun(m, probe == nullptr ? nullptr : &probe->cutter);
  const auto made = m.add(p);

  model::Reason why = step.why;
  why.text +=
      (why.text.empty() ? "" : "; ") + what.what + " expected at " + trimmed(what.distance_mm, 4) + " mm";
  if (what.lower_mm && what.upper_mm)
    why.text += " (" + trimmed(*what.lower_mm, 4) + " to +" + trimmed(*what.upper_mm, 4) + ")";
  w.plan.ledger.bind(made, "expected_value", Binder::kRule, why);
  if (probe != nullptr) {
    w.plan.ledger.bind(made, "its_probe", Binder::kToolSelection, probe->why, {{made, "expected_value"}});
  } else {
    w.job.warn("PIP-PROBE",
               "'" + step.name +
                   "': machine or library has no touch probe; the program stops, and it is measured by "
                   "other means");
  }
  return made;
}

}  // namespace capstan::pipeline
