#include "planner/making/piece/corner_rests.h"

#include <algorithm>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/making/piece/raw_piece_limits.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/feature.h"

// What stays in the corners of an area from a mill of radius r is the area without its opening by a disc of
// that radius: offset(offset(area, -r), r) (Serra, Image Analysis and Mathematical Morphology, 1982). Where a
// side is open, the mill runs out there: the opening is that of the reach.

namespace capstan::piece {
namespace {

using model::CornerRest;
using model::FeatureShape;

constexpr double kChordMm = 0.001;
/// A slot may be just as wide as its mill: rounding must not close it.
constexpr double kFreeMm = 0.002;
constexpr double kNothingMm2 = 1e-4;  ///< less is rounding of outlines; default, unsourced

/// What stays in the corners, by pieces, frame XY.
std::vector<geometry::Region> stays_of(const FeatureShape& s, double radius_mm) {
  geometry::Region reach = s.reach.empty() ? s.area : s.reach, area = s.area;
  for (const model::Island& i : s.islands) {
    reach = geometry::subtract(reach, i.area);
    area = geometry::subtract(area, i.area);
  }
  const double r = radius_mm - kFreeMm;
  const auto made = geometry::offset(geometry::offset(reach, -r, kChordMm), r, kChordMm);
  std::vector<geometry::Region> out = geometry::pieces(geometry::subtract(area, made));
  std::erase_if(out, [](const geometry::Region& p) { return geometry::area(p) < kNothingMm2; });
  return out;
}

/// The tolerance of a pocket's corner radius, which what stays does not keep, in words; empty: none is
/// stated.
std::string tolerance_of(const model::Model& m, const FeatureShape& s) {
  const auto* pocket = m.get<model::Pocket>(s.made_of.empty() ? s.feature : s.made_of.back());
  if (pocket == nullptr || !pocket->orthogonal_radius.set()) return {};
  const auto r = model::length(m, pocket->orthogonal_radius);
  if (!r || !r->given) return {};
  return " (its tolerance of " + trimmed(r->lower_mm, 4) + " to +" + trimmed(r->upper_mm, 4) +
         " mm is not kept)";
}

/// What stays of a shape, and where, in words.
std::string words_of(const model::Plan& plan, const FeatureShape& s, const CornerRest& r) {
  const std::string radius =
      "a radius of " + trimmed(r.radius_mm, 4) + " mm stays in place of " + trimmed(r.stated_mm, 4) + " mm";
  if (s.kind == model::ShapeKind::kFreeform) return "in its narrow places " + radius;
  const auto pieces = stays_of(s, r.radius_mm);
  double area = 0.0;
  std::vector<geometry::Vec3> at;
  for (const geometry::Region& p : pieces) {
    area += geometry::area(p);
    const geometry::Box2 box = geometry::bounds(p);
    const geometry::Vec2 middle = 0.5 * (box.lo + box.hi);
    at.push_back(s.frame.to_parent({middle.x, middle.y, 0.0}));
  }
  return std::string(at.size() == 1 ? "in its inside corner" : "in its inside corners") +
         (at.empty() ? "" : " at " + some_places(at)) + " " + radius + tolerance_of(plan.model, s) + ", " +
         trimmed(area, 3) + " mm2 and " + trimmed(area * s.depth_mm, 2) + " mm3 in all";
}

void tell(const model::Plan& plan, const FeatureShape& s, const CornerRest& r, Job& job) {
  job.report({.code = "PIP-CORNER",
              .severity = Severity::kWarning,
              .message = "feature '" + s.name + "': " + words_of(plan, s, r) + ": " + r.why,
              .file = plan.file_name,
              .line = plan.model.origin(s.feature).line,
              .instance = plan.model.origin(s.feature).instance,
              .hint = "give the tool that is needed, if one is named, or broach or erode what must be so"});
}

}  // namespace

std::vector<model::Provenance> kept_corner_rests(const std::vector<CornerRest>& before,
                                                 const std::vector<draft::StepDraft>& steps) {
  std::vector<model::Provenance> out;
  for (const CornerRest& r : before) {
    const bool made = std::any_of(steps.begin(), steps.end(), [&](const draft::StepDraft& step) {
      return std::any_of(step.shapes.begin(), step.shapes.end(),
                         [&](const FeatureShape& s) { return s.name == r.feature; });
    });
    if (made) out.push_back(model::provenance_of(r));
  }
  return out;
}

std::vector<model::Provenance> settled_corner_rests(const Piece& piece,
                                                    const std::vector<draft::StepDraft>& steps, Job& job) {
  constexpr double kSameMm = 1e-4;
  std::vector<model::Provenance> rows;
  for (const model::Provenance& row : piece.plan.provenance) {
    std::optional<CornerRest> r = model::corner_rest(row);
    if (!r) {
      rows.push_back(row);
      continue;
    }
    for (const FeatureShape& s : piece.shapes.all) {
      const double radius = s.name == r->feature ? 0.5 * narrowest_mill_mm(piece, steps, s) : 0.0;
      if (!(radius > r->stated_mm + kSameMm)) continue;
      // A tool wider than what was recorded leaves more, which the check finds.
      r->radius_mm = std::min(r->radius_mm, radius);
      rows.push_back(model::provenance_of(*r));
      tell(piece.plan, s, *r, job);
      break;
    }
  }
  return rows;
}

}  // namespace capstan::piece
