#include "planner/files/exchange/brep/helper/findings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "planner/ground/base/number.h"

namespace capstan::exchange {
namespace {

bool finite(const geometry::Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
bool finite(const Body& b) { return std::isfinite(b.volume) && std::isfinite(b.area); }
bool finite(const Face& f) {
  return finite(f.point) && finite(f.axis) && std::isfinite(f.radius) && std::isfinite(f.minor_radius) &&
         std::isfinite(f.half_angle) && std::isfinite(f.area);
}
bool finite(const Edge& e) {
  return finite(e.start) && finite(e.end) && finite(e.middle) && finite(e.centre) && finite(e.axis) &&
         std::isfinite(e.radius) && std::isfinite(e.minor_radius) && std::isfinite(e.length) &&
         std::isfinite(e.dihedral);
}

template <class T>
bool all_finite(const std::vector<T>& list) {
  return std::all_of(list.begin(), list.end(), [](const T& item) { return finite(item); });
}

void add(BrepMessage& message, Diagnostic d, std::int64_t instance) {
  d.instance = static_cast<std::uint64_t>(instance);
  message.remarks.push_back(std::move(d));
}

}  // namespace

void Findings::add(Severity severity, const char* code, const char* what, const char* hint,
                   std::int64_t instance) {
  const std::string_view kind = code;
  const auto known =
      std::find_if(found_.begin(), found_.end(), [&](const Finding& f) { return f.code == kind; });
  if (known != found_.end()) {
    ++known->count;
  } else {
    found_.push_back({severity, code, what, hint, instance, 1});
  }
}

void Findings::tell(BrepMessage& message) const {
  for (const Finding& f : found_) {
    exchange::add(message, remark(f.severity, f.code, std::to_string(f.count) + " " + f.what, f.hint),
                  f.instance);
    if (f.severity == Severity::kError) message.brep.reset();
  }
}

Diagnostic remark(Severity severity, const char* code, std::string text, const char* hint) {
  return {.code = code, .severity = severity, .message = std::move(text), .hint = hint};
}

void tell_bodies(BrepMessage& message) {
  std::map<std::int64_t, std::size_t> placed;
  for (const Body& body : message.brep->bodies) {
    if (body.id != 0) ++placed[body.id];
    if (body.solid) continue;
    add(message,
        remark(
            Severity::kWarning, "BREP-SHEET",
            "a sheet body has no inside (faces: " + std::to_string(body.face_count) + "); it is not a part",
            "delete it in the CAD system, or close it to a solid"),
        body.id);
  }
  for (const auto& [id, times] : placed) {
    if (times == 1) continue;
    add(message,
        remark(Severity::kNote, "BREP-PLACED",
               "the body is placed " + std::to_string(times) + " times; each counts as a body of its own",
               ""),
        id);
  }
}

void judge_volumes(BrepMessage& message) {
  const Brep& brep = *message.brep;
  const auto refuse = [&message](const Body& body, const char* code, std::string text) {
    add(message, remark(Severity::kError, code, std::move(text), "export the part again from the CAD system"),
        body.id);
    message.brep.reset();
  };
  for (const Body& body : brep.bodies) {
    if (!body.solid) continue;
    const std::uint32_t last_face = body.first_face + body.face_count;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sides, turned;
    double six_volumes = 0.0;
    for (std::uint32_t f = body.first_face; f < last_face; ++f) {
      const Face& face = brep.faces[f];
      for (std::uint32_t i = face.first_triangle; i < face.first_triangle + face.triangle_count; ++i) {
        const auto& t = brep.triangles[i];
        // From the box's corner: far from the origin the products would cancel.
        const Point3 a = brep.points[t[0]] - brep.box.lo, b = brep.points[t[1]] - brep.box.lo,
                     c = brep.points[t[2]] - brep.box.lo;
        six_volumes += dot(a, cross(b, c));
        for (std::size_t k = 0; k < 3; ++k) {
          sides.emplace_back(t[k], t[(k + 1) % 3]);
          turned.emplace_back(t[(k + 1) % 3], t[k]);
        }
      }
    }
    std::sort(sides.begin(), sides.end());
    std::sort(turned.begin(), turned.end());
    if (sides != turned) return refuse(body, "BREP-MESH", "the tessellation of the solid is not closed");
    // No point of the tessellation is further from its face than the chord, twice for faces that bend both
    // ways.
    const double volume = six_volumes / 6.0;
    if (std::abs(volume - body.volume) > 2.0 * brep.chord * body.area)
      return refuse(body, "BREP-VOLUME",
                    "the faces of the solid hold " + trimmed(body.volume, 3) + " mm3, its tessellation " +
                        trimmed(volume, 3) + " mm3: one of the two is wrong");
  }
}

bool finite(const Brep& brep) {
  return finite(brep.box.lo) && finite(brep.box.hi) && all_finite(brep.points) && all_finite(brep.bodies) &&
         all_finite(brep.faces) && all_finite(brep.edges);
}

}  // namespace capstan::exchange
