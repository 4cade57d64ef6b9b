#include "planner/making/draft/setup_nouns.h"

#include <string>

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/placed_nouns.h"

namespace capstan::draft {

model::Ref<model::Setup> add_setup(model::Model& m, std::size_t number, const geometry::Box3& raw,
                                   const geometry::Placement& p) {
  const double top = transformed(raw, p).hi.z;
  model::Plane plane;
  plane.name = "";
  plane.position = model::add_placement(m, {.origin = {0.0, 0.0, top + kSecurityAboveMm}});
  model::WorkpieceSetup ws;
  const auto pieces = m.all(model::TypeId::kWorkpiece);
  if (!pieces.empty()) ws.its_workpiece = model::Ref<model::Workpiece>(pieces.front());
  ws.its_origin = model::add_placement(m, p);
  ws.its_instructions.given = true;
  model::Setup setup;
  setup.its_id = "SETUP" + std::to_string(number);
  setup.its_origin = model::add_placement(m, {});
  setup.its_secplane = m.add(plane);
  setup.its_workpiece_setup.push_back(m.add(ws));
  return m.add(setup);
}

}  // namespace capstan::draft
