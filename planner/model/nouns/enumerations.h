#pragma once

#include <cstdint>

namespace capstan::model {

// Enumerations of ISO 14649 and ISO 10303; codes follow the EXPRESS order.

enum class AheadOrBehind : std::int8_t { kAhead, kExact, kBehind };
enum class FittingType : std::int8_t { kShaft, kHole };
enum class TrimmingPreference : std::int8_t { kCartesian, kParameter, kUnspecified };
enum class TransitionCode : std::int8_t {
  kDiscontinuous,
  kContinuous,
  kContSameGradient,
  kContSameGradientSameCurvature
};
enum class BSplineCurveForm : std::int8_t {
  kPolylineForm,
  kCircularArc,
  kEllipticArc,
  kParabolicArc,
  kHyperbolicArc,
  kUnspecified
};
enum class BSplineSurfaceForm : std::int8_t {
  kPlaneSurf,
  kCylindricalSurf,
  kConicalSurf,
  kSphericalSurf,
  kToroidalSurf,
  kSurfOfRevolution,
  kRuledSurf,
  kGeneralisedCone,
  kQuadricSurf,
  kSurfOfLinearExtrusion,
  kUnspecified
};
enum class KnotType : std::int8_t { kUniformKnots, kQuasiUniformKnots, kPiecewiseBezierKnots, kUnspecified };
enum class BottomOrSide : std::int8_t { kBottom, kSide, kBottomAndSide };
enum class ToolReferencePoint : std::int8_t { kTcp, kCcp };
enum class PathmodeType : std::int8_t { kForward, kZigzag };
enum class CutmodeType : std::int8_t { kClimb, kConventional };
enum class LeftOrRight : std::int8_t { kLeft, kRight };
enum class StrokeConnectionStrategy : std::int8_t { kStraghtline, kLiftShiftPlunge, kDegouge, kLoopBack };
enum class RotDirection : std::int8_t { kCw, kCcw };
enum class Hand : std::int8_t { kLeft, kRight, kNeutral };
enum class ToolpathType : std::int8_t { kApproach, kLift, kConnect, kNonContact, kContact, kTrajectoryPath };
enum class AreaUnitType : std::int8_t { kSpherical, kCylindrical, kRectangular, kSquare, kCircular };
enum class AngleRelator : std::int8_t { kSmall, kLarge, kEqual };
enum class ContactType : std::int8_t { kSide, kFront };

}  // namespace capstan::model
