#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/proof/verify/following/following.h"
#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

namespace {

/// Corners, those of rapids too, are rounded by what the step says, else by what the machine does.
void check_tolerance(const ProgramCase& c, const model::StepResult& step,
                     const std::vector<const Block*>& text, const Findings::Where& at, Findings& findings) {
  const model::Control& control = c.machine.control;
  const double unit = std::pow(10.0, -control.decimals);
  const double own = control.path_tolerance_mm;
  const bool of_step = own > 0.0 && step.contour_tolerance_mm > 0.0 && c.reader.states_tolerance &&
                       model::control_option(c.machine, "smoothness") != "no";
  const double exact = of_step ? step.contour_tolerance_mm : own;
  const double wanted = std::max(0.0, rounded(exact, control.decimals));
  for (const Block* b : text) {
    if (b->kind != Block::Kind::kMove || b->in_machine) continue;
    const double p = b->tolerance_mm, q = b->naive_mm;
    const auto agrees = [&](double v) { return std::abs(v - wanted) <= 0.51 * unit; };
    if (agrees(p) && agrees(q) && !b->exact_stop) continue;
    std::string stated = p >= kNoTolerance ? "no path tolerance" : "a path tolerance of " + mm(p);
    if (p <= 0.0)
      stated = b->exact_stop ? "exact stops (G61.1)"
                             : "the exact path (" + std::string(c.reader.words.exact) + ")";
    if (agrees(p) && !agrees(q)) stated = "points left out that lie within " + mm(q) + " (G64 Q)";
    findings.error(
        33, "CHK-TEXT-TOLERANCE", {at.order, at.step, b->line},
        "the text moves with " + stated + "; the step has " +
            (wanted > 0.0 ? mm(wanted) : "the exact path (" + std::string(c.reader.words.exact) + ")"));
    return;
  }
}

}  // namespace

void compare(const ProgramCase& c, Findings& findings) {
  if (c.plan == nullptr) return;
  std::vector<std::vector<const Block*>> text(c.program.markers.size());
  std::vector<bool> high(c.program.markers.size(), false);
  const Block* before = nullptr;
  int marker = -1;
  for (const Block& b : c.program.blocks) {
    const bool counts = b.kind == Block::Kind::kMove || b.kind == Block::Kind::kDwell;
    if (b.marker != marker) {
      for (int m = marker + 1; m <= b.marker; ++m)
        high[static_cast<std::size_t>(m)] = before != nullptr && at_top(*before, c.machine);
      marker = b.marker;
    }
    if (counts && b.marker >= 0) text[static_cast<std::size_t>(b.marker)].push_back(&b);
    before = &b;
  }
  std::vector<bool> written(c.plan->steps.size(), false);
  long last = -1;
  for (std::size_t m = 0; m < text.size(); ++m) {
    const long step = c.step_of_marker[m];
    const Findings::Where at{m + 2, c.program.markers[m].id, c.program.markers[m].line};
    if (step < 0) {
      findings.error(33, "CHK-TEXT-STEP", at,
                     "the step \"" + c.program.markers[m].id + "\" is not in the plan");
      continue;
    }
    if (step <= last)
      findings.error(33, "CHK-TEXT-ORDER", at,
                     step == last ? "the step occurs twice in the text"
                                  : "the step comes later in the text than in the plan");
    last = std::max(last, step);
    const auto i = static_cast<std::size_t>(step);
    written[i] = true;
    check_tolerance(c, c.plan->steps[i], text[m], at, findings);
    if (c.plan->steps[i].path && c.plan->steps[i].path->size() > 0)
      Following(c, m, i, std::move(text[m]), high[m], findings).run();
  }
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i] || !c.plan->steps[i].path || c.plan->steps[i].path->size() < 2) continue;
    const std::string id = model::step_id(*c.plan, c.plan->steps[i]);
    findings.error(33, "CHK-TEXT-MISSING", {text.size() + 2, id, -1},
                   "the step is in the plan, but not in the text");
  }
}

}  // namespace capstan::verify
