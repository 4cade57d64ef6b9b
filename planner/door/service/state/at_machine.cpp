#include "planner/door/service/state/at_machine.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/controls/profile/profile.h"
#include "planner/controls/specification.h"
#include "planner/controls/suitability.h"
#include "planner/door/late/kept/no_longer.h"
#include "planner/door/service/planning.h"
#include "planner/door/service/shop.h"
#include "planner/ground/base/nearest_names.h"

namespace capstan::service {

Result<controls::Conformance> control_of(const Request& request, const model::Machine& machine, Job& job) {
  if (request.profile) {
    auto read = controls::load_profile(*request.profile, job);
    if (!read) return tl::unexpected(read.error());
    return std::move(read->can);
  }
  if (const controls::Dialect* own = controls::find_dialect(machine.control.dialect)) return own->conformance;
  Diagnostic d =
      unknown_name("control", machine.control.dialect, controls::profile_ids(), "capstan controls list");
  d.code = "CONTROL-UNKNOWN";
  d.hint =
      "correct `dialect` in the machine's file, or name a control's profile with " + request.sign + "profile";
  return fail(std::move(d));
}

std::vector<model::Finding> unsuited(const controls::Conformance& control, const model::Plan& plan,
                                     bool part) {
  auto out = controls::specification(plan, control, part);
  auto cannot = controls::suitability(plan, control);
  std::move(cannot.begin(), cannot.end(), std::back_inserter(out));
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.severity > b.severity; });
  return out;
}

Outcome<std::vector<std::string>> no_longer_valid(const pipeline::Inputs& shop, const Request& request,
                                                  const model::Plan& plan, Job& job) {
  pipeline::Inputs inputs = shop;
  if (auto ok = take_choices(request, plan, inputs, job); !ok)
    return failed(ok.error(), code_of(ok.error(), Code::kUnreadable));
  if (!request.tools) take_tools_of_plan(request, plan, inputs, job);
  auto out = late::no_longer_valid(plan, std::move(inputs), request.state.tools, job);
  if (!out) return failed(out.error(), code_of(out.error(), Code::kImpossible));
  return *std::move(out);
}

}  // namespace capstan::service
