#pragma once

#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/plan/cutter/cutter.h"

// What kind of tool a cutter is within its class, by the angles of its edges.

namespace capstan::tooling {

/// Twist drills are ground to 150 degrees at most (cutting-tool-supply.com, high performance drill point
/// angles), inserts lie within some degrees of level: between the two. Default, unsourced.
inline constexpr double kFlatPointRad = 160.0 * kRadPerDegree;

/// A drill with an insert at the centre and one at the circumference (ISO 13399: SIG near 180 degrees, ZEFF
/// 1): it begins in a level face without a mark, is never pecked, and widens no hole.
[[nodiscard]] bool drills_with_inserts(const model::Cutter& c);

/// A high-feed mill (ISO 13399: KAPR of some 10 to 20 degrees, PSIR its complement): it takes shallow layers
/// at several times the feed of an upright edge, and roughs only.
[[nodiscard]] bool feeds_high(const model::Cutter& c);

/// The widest circle that cuts at a depth, mm: a face mill's diameter is that at its tip, and edges that lean
/// are wider above it (ISO 13399: DCX = DC + 2 APMX tan PSIR). Of other cutters the diameter.
[[nodiscard]] double widest_circle_mm(const model::Cutter& c, double depth_mm);

/// Whether the edges of both lean alike, so that one's lengths and feeds may stand for the other's.
[[nodiscard]] bool edges_lean_alike(const model::Cutter& a, const model::Cutter& b);

}  // namespace capstan::tooling
