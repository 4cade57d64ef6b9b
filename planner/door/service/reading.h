#pragma once

#include <memory>
#include <optional>
#include <string>

#include "planner/files/exchange/exchange.h"
#include "planner/files/from_cad/from_cad.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/shape/finished.h"

namespace capstan::service {

enum class Content : std::uint8_t { kPlanJson, kPart, kProgram, kToolTable };

/// The kind of the bytes: JSON by its first character, Part 21 and STL as `exchange` recognises them, a
/// LinuxCNC tool table by its lines (`T1 P1 ...`), anything else a program.
[[nodiscard]] Content content_of(std::string_view bytes);

/// Reads a part or a plan, whose content decides the format: ISO 14649, AP238, STL or plan JSON, with or
/// without a byte order mark. `name` is the file's name in diagnostics.
///
/// strict  one wrong reference keeps the whole file from being read; otherwise only what needs it is left
/// out. Fails   as json::read_json and exchange::read; faults went to the job before.
[[nodiscard]] Result<model::Plan> read_plan(std::string bytes, const std::string& name, Job& job,
                                            bool strict = false);
/// The same from a file. `unit` is that of a mesh, where the caller states it. Fails  FILE-READ, and as
/// above; READ-UNIT for the unit of a file that is no mesh.
[[nodiscard]] Result<model::Plan> load_plan(const std::string& path, Job& job, bool strict = false,
                                            const std::optional<exchange::MeshUnit>& unit = {});
/// The unit that a request states, as text ("mm", "inch"); `source` says who states it.
[[nodiscard]] std::optional<exchange::MeshUnit> mesh_unit(const std::optional<std::string>& stated,
                                                          const std::string& source);

/// A part to be planned, and the shape that a CAD model says it is to have.
struct PartRead {
  model::Plan plan;
  std::shared_ptr<const verify::AskedShape> shape;  ///< null: the file is no CAD model
  std::string unit = {};                            ///< of a CAD model's lengths, as Brep::unit
  geometry::Vec3 raw_mm = {};                       ///< size of a CAD model's raw piece, as it is drawn
};
/// As read_plan, of a part to be planned, which may be a CAD model, too (ISO 10303-203, -214, -242): its
/// features are recognised, and made with what the caller states. `unit` is that of a mesh, where the
/// caller states it; `body` says which one of a CAD file is the part. Fails  as read_plan,
/// exchange::read_brep, exchange::one_body and from_cad::plan_of_part; READ-UNIT for the unit of a file that
/// is no mesh, READ-BODY and READ-TAPPED for the body and the threads of one that is no CAD model.
[[nodiscard]] Result<PartRead> read_part(std::string bytes, const std::string& name,
                                         const from_cad::Stated& stated, Job& job, bool strict = false,
                                         const std::optional<exchange::MeshUnit>& unit = {},
                                         const std::optional<std::string>& body = {});

/// Whether the bytes are a CAD model in STEP (ISO 10303-203, -214, -242): read_brep reads such, read_plan
/// does not.
[[nodiscard]] bool is_cad_model(std::string_view bytes);

}  // namespace capstan::service
