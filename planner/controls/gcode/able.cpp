#include "planner/controls/gcode/able.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "planner/controls/gcode/options.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/control_options.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::controls::gcode {
namespace {

constexpr std::size_t kMostTold = 20;

std::string listed(const std::vector<std::string>& faults) {
  std::string out;
  for (std::size_t i = 0; i < std::min(kMostTold, faults.size()); ++i)
    out += (i == 0 ? "" : "; ") + faults[i];
  if (faults.size() > kMostTold) out += "; and " + std::to_string(faults.size() - kMostTold) + " more";
  return out;
}

/// Why the control does not take this move; empty: it does.
std::string fault_of(const model::CutterPath& path, std::size_t i, const Words& words) {
  if (!model::is_arc(path.kind[i])) return {};
  const double radius = std::hypot(path.x[i] - path.cx[i], path.y[i] - path.cy[i]);
  if (words.largest_radius_mm > 0.0 && radius > words.largest_radius_mm)
    return "an arc of radius " + trimmed(radius, 3) + " mm, more than " + trimmed(words.largest_radius_mm, 3);
  if (!words.helices && path.z[i] != path.z[i - 1]) return "an arc that goes up or down";
  return {};
}

/// Codes of one block: G and M with their numbers, "G54.1".
std::vector<std::string> codes_in(std::string_view block) {
  std::vector<std::string> out;
  bool comment = false;
  for (std::size_t i = 0; i < block.size(); ++i) {
    comment = block[i] == '(' || (comment && block[i] != ')');
    if (comment || (block[i] != 'G' && block[i] != 'M')) continue;
    std::size_t end = i + 1;
    while (end < block.size() && ((block[end] >= '0' && block[end] <= '9') || block[end] == '.')) ++end;
    out.emplace_back(block.substr(i, end - i));
    i = end - 1;
  }
  return out;
}

}  // namespace

Status able(const model::Plan& plan, const Words& words) {
  const std::vector<std::string> ids = model::step_ids(plan);
  std::vector<std::string> faults;
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    const auto& path = plan.steps[s].path;
    if (!path) continue;
    if (plan.steps[s].through && !through_codes_of(plan.machine))
      faults.push_back("step '" + ids[s] +
                       "': coolant through the spindle, whose codes the machine's file does not state "
                       "(through_coolant: M88/M89 under its control)");
    for (std::size_t i = 1; i < path->size(); ++i) {
      const std::string fault = fault_of(*path, i, words);
      if (fault.empty()) continue;
      faults.push_back("step '" + ids[s] + "', move " + std::to_string(i) + ": " + fault);
      break;
    }
  }
  if (faults.empty()) return {};
  return fail({.code = "OUT-CONTROL",
               .message = "the control of machine '" + plan.machine.id + "' does not take " + listed(faults),
               .expected = "moves that it takes",
               .hint =
                   "choose another strategy for these steps, or state under the machine's control what it "
                   "takes"});
}

Status codes_known(std::string_view program, const std::string& codes) {
  if (codes.empty()) return {};
  std::vector<std::string> faults;
  std::set<std::string> said;
  std::string step = "before the first step";
  for (std::size_t at = 0; at < program.size();) {
    const std::size_t end = std::min(program.find('\n', at), program.size());
    const std::string_view block = program.substr(at, end - at);
    at = end + 1;
    constexpr std::string_view kMarker = "(CAPSTAN STEP ";
    if (block.starts_with(kMarker)) {
      step = "step " + std::string(block.substr(kMarker.size(), block.size() - kMarker.size() - 1));
      said.clear();
    }
    for (const std::string& code : codes_in(block)) {
      if (!model::has_word(codes, code) && said.insert(code).second)
        faults.push_back(std::string(code) + " in " + step);
    }
  }
  if (faults.empty()) return {};
  return fail({.code = "OUT-CODE",
               .message = "the machine's list of codes has no " + listed(faults),
               .expected = codes,
               .hint =
                   "add them to 'codes' under the machine's control if it has them, or state options that do "
                   "without (cycles: explicit, retract, tap)"});
}

}  // namespace capstan::controls::gcode
