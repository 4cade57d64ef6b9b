#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"

// Parts with pockets, their plans and programs with pockets as cycles, and what the check says of a text.

namespace capstan::service::pocket_parts {

inline std::string with(std::string text, const std::string& own, const std::string& other) {
  const std::size_t at = text.find(own);
  EXPECT_NE(at, std::string::npos) << own;
  return at == std::string::npos ? text : text.replace(at, own.size(), other);
}

inline std::string bracket() { return testing::slurp(testing::source_dir() + "/examples/bracket.p21"); }
/// Its pocket round, of 36 mm.
inline std::string round_pocket() {
  return with(
      with(bracket(), "#60=RECTANGULAR_CLOSED_PROFILE($,#58,#59);", "#60=CIRCULAR_CLOSED_PROFILE($,#58);"),
      "$,#54,$,#56,#60)", "$,#54,$,$,#60)");
}
/// Its pocket turned by 20 degrees about its middle.
inline std::string turned_pocket() {
  return with(bracket(), "#50=AXIS2_PLACEMENT_3D('POCKET',#49,#21,#22);",
              "#50=AXIS2_PLACEMENT_3D('POCKET',#49,#21,#900);\n#900=DIRECTION('',(0.939692620786,"
              "0.342020143326,0.));");
}

/// Its slot closed with round ends: 30 from middle to middle of these.
inline std::string closed_slot(const std::string& width = "14.") {
  std::string text = with(bracket(), "'SLOT',(105.,0.,0.)", "'SLOT',(103.,25.,0.)");
  text = with(text, "#67=TOLERANCED_LENGTH_MEASURE(80.,", "#67=TOLERANCED_LENGTH_MEASURE(30.,");
  text = with(text, "#72=TOLERANCED_LENGTH_MEASURE(10.,", "#72=TOLERANCED_LENGTH_MEASURE(" + width + ",");
  for (int end = 0; end < 2; ++end) text = with(text, "OPEN_SLOT_END_TYPE()", "RADIUSED_SLOT_END_TYPE()");
  return text;
}

/// The part's plan for a control with pockets as cycles.
inline const model::Plan& planned(const std::string& control, const std::string& part) {
  static std::map<std::string, model::Plan> plans;
  const std::string key = control + part;
  if (!plans.contains(key)) {
    Request request;
    EXPECT_TRUE(set(request, "control", control));
    Job job;
    const auto out = plan(request, {.name = "bracket.p21", .bytes = part}, job);
    EXPECT_TRUE(out) << (out ? "" : to_text(out.error().what));
    if (!out) return plans[key];
    plans[key] = out->plan;
    plans[key].machine.control_options = model::ControlOptions{{{"cycles", "pocket"}}};
  }
  return plans[key];
}

inline std::string program_of(const model::Plan& plan) {
  Job job;
  const auto text = controls::write_program(plan, job);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}

/// Code and message of each error; of warnings, too, where they are asked for.
inline std::vector<std::string> against(const std::string& text, const model::Plan& plan,
                                        bool warnings = false) {
  Job job;
  std::vector<std::string> out;
  for (const auto& f : verify::check_program({"program", text, ""}, &plan, plan.machine, plan.cutters, job)) {
    if (f.severity == Severity::kError || (warnings && f.severity == Severity::kWarning))
      out.push_back(f.code + " " + f.step + ": " + f.message);
  }
  return out;
}

/// The line that calls the cycle.
inline std::string call_in(const std::string& text, const std::string& begin) {
  const std::size_t at = text.find(begin);
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

/// The call with parameter `n` (from 0) as `value`.
inline std::string with_parameter(const std::string& call, std::size_t n, const std::string& value) {
  std::size_t begin = call.find('(') + 1;
  for (std::size_t i = 0; i < n; ++i) begin = call.find(',', begin) + 1;
  return call.substr(0, begin) + value + call.substr(call.find_first_of(",)", begin));
}
inline std::string parameter(const std::string& call, std::size_t n) {
  std::size_t begin = call.find('(') + 1;
  for (std::size_t i = 0; i < n; ++i) begin = call.find(',', begin) + 1;
  return call.substr(begin, call.find_first_of(",)", begin) - begin);
}

}  // namespace capstan::service::pocket_parts
