#include "planner/making/draft/setup_nouns.h"

#include <string>

#include "planner/model/nouns/all.h"

namespace capstan::draft {

model::Ref<model::Setup> add_setup(model::Model& m, std::size_t number, const geometry::Box3& raw,
                                   const geometry::Placement& p) {
  const auto point = [&](geometry::Vec3 v) {
    model::CartesianPoint q;
    q.name = "";
    q.coordinates = {{v.x, v.y, v.z}, true};
    return m.add(q);
  };
  const auto direction = [&](geometry::Vec3 v) {
    model::Direction q;
    q.name = "";
    q.direction_ratios = {{v.x, v.y, v.z}, true};
    return m.add(q);
  };
  const auto frame = [&](geometry::Placement f) {
    model::Axis2Placement3d q;
    q.name = "";
    q.location = point(f.origin);
    q.axis = direction(f.z);
    q.ref_direction = direction(f.x);
    return m.add(q);
  };
  const double top = transformed(raw, p).hi.z;
  model::Plane plane;
  plane.name = "";
  plane.position = frame({.origin = {0.0, 0.0, top + kSecurityAboveMm}});
  model::WorkpieceSetup ws;
  const auto pieces = m.all(model::TypeId::kWorkpiece);
  if (!pieces.empty()) ws.its_workpiece = model::Ref<model::Workpiece>(pieces.front());
  ws.its_origin = frame(p);
  ws.its_instructions.given = true;
  model::Setup setup;
  setup.its_id = "SETUP" + std::to_string(number);
  setup.its_origin = frame({});
  setup.its_secplane = m.add(plane);
  setup.its_workpiece_setup.push_back(m.add(ws));
  return m.add(setup);
}

}  // namespace capstan::draft
