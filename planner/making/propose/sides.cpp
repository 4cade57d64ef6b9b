#include "planner/making/propose/sides.h"

#include <cmath>
#include <numbers>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/making/draft/setup_nouns.h"
#include "planner/model/nouns/all.h"

namespace capstan::propose {
namespace {

using draft::SetupDraft;
using model::AnyRef;
using model::FeatureShape;

bool plain_through(const FeatureShape& s) {
  return s.kind == model::ShapeKind::kHole && s.through && s.bottom_diameter_mm == s.diameter.nominal_mm;
}

/// From which side the features are cut that tolerances tie to this one, directly or through others.
struct Sides {
  bool same = false, opposite = false;
};
Sides sides_tied_to(const piece::Piece& piece, const piece::Demands& demands, AnyRef f, geometry::Vec3 z) {
  std::set<AnyRef> joined{f};
  for (bool grown = true; grown;) {
    grown = false;
    for (const model::Tie& t : demands.ties) {
      if (joined.contains(t.first) == joined.contains(t.second)) continue;
      joined.insert(t.first);
      joined.insert(t.second);
      grown = true;
    }
  }
  Sides out;
  if (joined.size() == 1) return out;
  for (const FeatureShape& s : piece.shapes.all) {
    if (s.feature == f || !joined.contains(s.feature) || plain_through(s)) continue;
    out.same = out.same || std::abs(dot(s.frame.z, z) - 1.0) < kSameAxis;
    out.opposite = out.opposite || std::abs(dot(s.frame.z, z) + 1.0) < kSameAxis;
  }
  return out;
}

}  // namespace

std::size_t setup_up(const std::vector<SetupDraft>& setups, geometry::Vec3 z) {
  for (std::size_t i = 0; i < setups.size(); ++i) {
    if (std::abs(setups[i].workpiece.direction_to_parent(z).z - 1.0) < kSameAxis) return i;
  }
  return setups.size();
}

std::size_t setup_for(model::Plan& plan, std::vector<SetupDraft>& setups, const FeatureShape& s, Job& job) {
  constexpr double kLeastMeantDeg = 0.5;
  std::size_t nearest = 0;
  double tilt_deg = kLeastMeantDeg;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const auto up = setups[i].workpiece.direction_to_parent(s.frame.z);
    const double sine = std::hypot(up.x, up.y);
    if (sine < kSameAxis && up.z > 0.0) return i;
    const double deg = std::atan2(sine, up.z) * 180.0 / std::numbers::pi;
    if (deg >= tilt_deg) continue;
    nearest = i;
    tilt_deg = deg;
  }
  if (tilt_deg < kLeastMeantDeg) {
    const auto* from = plan.model.get<model::Setup>(setups[nearest].setup);
    job.report(
        {.code = "PIP-TILT",
         .severity = Severity::kWarning,
         .message = "feature '" + s.name + "': its axis is tilted by " + trimmed(tilt_deg, 4) +
                    " degrees against set-up '" + (from == nullptr ? "" : from->its_id.value_or("")) +
                    "', and a set-up of its own is made for it; a tilt below " + trimmed(kLeastMeantDeg, 4) +
                    " degrees is hardly meant",
         .file = plan.file_name,
         .line = plan.model.origin(s.feature).line,
         .instance = plan.model.origin(s.feature).instance,
         .hint = "correct the axis of its feature_placement; if it is meant, clamp the piece anew for it"});
  }
  const auto seen = geometry::make_placement({}, s.frame.z, s.frame.x);
  geometry::Placement turned = inverse(*seen);
  // The work offset lies at the raw piece's lower corner, as it is clamped.
  const auto box = transformed(plan.stock.box, turned);
  turned.origin = turned.origin - box.lo;
  SetupDraft work;
  work.workpiece = turned;
  work.setup = draft::add_setup(plan.model, setups.size() + 1, plan.stock.box, turned);
  work.stock = transformed(plan.stock.box, turned);
  work.security_z_mm = work.stock.hi.z + draft::kSecurityAboveMm;
  setups.push_back(work);
  plan.ledger.bind(
      work.setup, "its_origin", model::Binder::kRule,
      {"setup.access", "made because no set-up of the file reaches feature '" + s.name + "' along its axis",
       "derived from the feature's placement"});
  return setups.size() - 1;
}

FeatureShape reachable_side(const piece::Piece& piece, const piece::Demands& demands,
                            const std::vector<SetupDraft>& setups, AnyRef f, const FeatureShape& s) {
  if (!plain_through(s)) return s;
  const Sides tied = sides_tied_to(piece, demands, f, s.frame.z);
  if (tied.same) return s;
  bool below = tied.opposite;
  for (const SetupDraft& setup : setups) {
    const auto up = setup.workpiece.direction_to_parent(s.frame.z);
    if (!tied.opposite && std::abs(up.z - 1.0) < kSameAxis) return s;
    below = below || std::abs(up.z + 1.0) < kSameAxis;
  }
  // Only from where it comes out: a hole that ends inside the piece has no other side.
  constexpr double kOut = 0.5;  // mm
  const double under = -transformed(piece.plan.stock.box, inverse(s.frame)).lo.z;
  if (!below || under > s.depth_mm + kOut) return s;
  FeatureShape turned = s;
  turned.frame.origin = s.frame.origin - s.depth_mm * s.frame.z;
  turned.frame.z = -1.0 * s.frame.z;
  turned.frame.y = -1.0 * s.frame.y;
  return turned;
}

}  // namespace capstan::propose
