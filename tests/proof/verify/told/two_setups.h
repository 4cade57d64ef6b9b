#pragma once

#include <string>

#include "tests/proof/verify/plans.h"

namespace capstan::verify::testing {

/// The pocket in G54, then the drilling in a second set-up in G55, with the piece as it lay.
inline model::Plan two_setups() {
  PlanMaker k = good_plan();
  k.plan.setups.push_back(k.plan.setups[0]);
  k.plan.setups[1].work_offset = "G55";
  k.plan.steps[1].setup = 1;
  return k.plan;
}

/// What its program says of such a set-up, of which the raw piece reaches 100 x 100 from zero, 50 down.
inline std::string lines_of_setup(const std::string& n, const std::string& offset) {
  const std::string name = "(set-up " + n + ": ";
  return name + "the workpiece's +Z up, its +X to the right, its +Y to the back)\n" + name + "zero " +
         offset +
         " on the raw piece as it lies: X0 at its left side, Y0 at its front, Z0 at its top; that is the "
         "point "
         "X0 Y0 Z0 of the part's drawing)\n" +
         name + "the raw piece reaches from X0 Y0 Z-50 to X100 Y100 Z0" +
         (n == "1" ? "" : "; a side that was cut before stands back by what was cut") + ")\n" + name +
         "what holds the piece is not planned: fixtures and clamps are not checked)\n";
}

/// Its program, with the header and the stop as they are written.
inline std::string text_of_two() {
  std::string text = program_of(two_setups());
  text = replaced(text, "(a part)\n",
                  "(CAPSTAN PROGRAM version=1)\n(material: steel)\n(stock: 100 x 100 x 50 mm)\n"
                  "(CAPSTAN SETUP n=1 offset=G54 security=10)\n"
                  "(CAPSTAN SETUP n=2 offset=G55 security=10)\n"
                  "(CAPSTAN TOOL T1 H1 length=100 diameter=10 id=\"em10\" endmill)\n"
                  "(CAPSTAN TOOL T2 H2 length=130 diameter=8 id=\"d8\" twist_drill)\n" +
                      lines_of_setup("1", "G54"));
  text = replaced(text, " n=1)", " n=1 tool=1 setup=1)");
  const auto second = text.find("n=2)");
  const std::string anew =
      "(set-up 2: the workpiece is not turned after set-up 1)\n" + lines_of_setup("2", "G55") +
      "(MSG, set-up 2: clamp the workpiece anew, not turned, its +Z up; set G55: X0 at its left side, Y0 at "
      "its front, Z0 at its top, then continue)\n";
  std::string tail =
      replaced(text.substr(second), "n=2)\n", "n=2 tool=2 setup=2)\n" + anew + "M5\nM9\nG53 G0 Z0\nM0\n");
  return text.substr(0, second) + replaced(tail, "G54", "G55");
}

}  // namespace capstan::verify::testing
