#include "planner/files/exchange/brep/brep.h"

namespace capstan::exchange {

const char* to_text(Carrier carrier) {
  switch (carrier) {
    case Carrier::kPlane:
      return "plane";
    case Carrier::kCylinder:
      return "cylinder";
    case Carrier::kCone:
      return "cone";
    case Carrier::kSphere:
      return "sphere";
    case Carrier::kTorus:
      return "torus";
    case Carrier::kSpline:
      return "B-spline";
    case Carrier::kOther:
      break;
  }
  return "other";
}

}  // namespace capstan::exchange
