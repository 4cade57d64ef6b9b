#include "planner/door/late/record.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "planner/door/late/tools/tool_state.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/memo/remembered.h"
#include "planner/model/plan/cutter/table_offsets.h"

namespace capstan::late {
namespace {

constexpr std::string_view kWhat = "late binding ";

template <class... Parts>
std::string hash_of(const Parts&... parts) {
  return hex64(memo::key_of(memo::Stage::kSweep, parts...).high);
}

std::string tools_hash(const std::vector<model::Cutter>& library) {
  std::vector<std::string> lines;
  for (const model::Cutter& c : library) {
    if (!c.loaded) continue;
    lines.push_back("T" + std::to_string(c.pocket) + " P" + std::to_string(model::magazine_pocket(c)) + " Z" +
                    shortest(c.functional_length_mm) + " D" + shortest(c.cutting_diameter_mm));
  }
  std::sort(lines.begin(), lines.end());
  return hash_of(lines);
}

}  // namespace

void record(model::Plan& plan, const model::Plan& brought, const pipeline::Inputs& inputs, const Told& told) {
  std::erase_if(plan.provenance, [](const auto& p) { return p.what.starts_with(kWhat) || is_tool_state(p); });
  const std::vector<model::Provenance> known = wear_known(brought, told.of_tools);
  plan.provenance.insert(plan.provenance.end(), known.begin(), known.end());
  plan.provenance.insert(plan.provenance.end(), told.of_tools.begin(), told.of_tools.end());
  std::size_t n = 1;
  for (const model::Provenance& p : brought.provenance) {
    if (!p.what.starts_with(kWhat)) continue;
    plan.provenance.push_back(p);
    ++n;
  }
  std::string why;
  for (const std::string& r : told.reopened) why += (why.empty() ? "; re-opened: " : "; ") + r;
  plan.provenance.push_back(
      {std::string(kWhat) + std::to_string(n), told.time.empty() ? "no time was given" : told.time,
       "machine " + plan.machine.id + " " + hash_of(plan.machine) + ", tools " + tools_hash(inputs.library) +
           (why.empty() ? "; nothing was re-opened" : why)});
}

}  // namespace capstan::late
