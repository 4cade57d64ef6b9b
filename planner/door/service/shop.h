#pragma once

#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/service/request.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"
#include "tooling/shop/fixtures/fixtures.h"

namespace capstan::service {

/// Opens a shop: machine, tool library, materials, rules, fixtures' files and cases as the request names
/// them; else the machine of the plan; else the built-in ones. Each stands in Inputs::provenance, a default
/// as "built-in default", with the reason where the part is why. A session that binds many plans opens its
/// shop once. `shipped`: the rules without a shop's own, where the caller has read them; null: they are read.
///
/// Warns  of what a shop's own rule tables lack or say twice: planning goes on, for the rows that do decide
///        are sound.
/// Fails  as the rooms that read these.
[[nodiscard]] Result<pipeline::Inputs> open_shop(const Request& request, const model::Plan& plan, Job& job,
                                                 const rules::RuleBase* shipped = nullptr);

/// Adds to an open shop what the request chooses for this plan (material, stock, objective, tolerances,
/// workholding, ...); what the plan itself was made with stays, unless another is named.
/// Fails  NAME-UNKNOWN and as tooling::load_material; APP-EDGES for a width of edges that no rule breaks.
[[nodiscard]] Status take_choices(const Request& request, const model::Plan& plan, pipeline::Inputs& shop,
                                  Job& job);

/// Both.
[[nodiscard]] Result<pipeline::Inputs> gather(const Request& request, const model::Plan& plan, Job& job);

/// Takes the magazine's tools if no list names them: those of the plan, in its own tool numbers.
void take_tools_of_plan(const Request& request, const model::Plan& plan, pipeline::Inputs& shop, Job& job);

/// The material by the caller's choice: a name, `like:NAME`, or a file with a material of the shop's own,
/// which joins `in.materials` and gets start values in `in.library`; both are loaded before. Fails  as
/// tooling::load_material.
[[nodiscard]] Status name_material(pipeline::Inputs& in, const std::string& given, Job& job);

/// The fixtures of files of the shop's own, in the order of the files.
/// Fails  as tooling::load_fixtures; HOLD-TWICE for an id of two files.
[[nodiscard]] Result<std::vector<tooling::Fixture>> own_fixtures(const std::vector<std::string>& files,
                                                                 Job& job);

/// Whether the machine's data are there, and not only its name (all that an ISO 14649 file holds).
[[nodiscard]] bool has_data(const model::Machine& machine);

}  // namespace capstan::service
