#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/proof/verify/verify.h"
#include "tests/mutation/lines.h"
#include "tests/support/corpus.h"

// Pockets, slots and faces that a control's cycle mills, planned, written, and spoilt: one figure after the
// other, by amounts that the seed draws, each of which is found.

namespace capstan::mutation {
namespace {

constexpr int kSeeds = 4;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.find(from) == std::string::npos ? text : text.replace(text.find(from), from.size(), to);
}

/// The bracket, its slot closed, in a vise, for a control with such cycles.
const model::Plan& milled(const std::string& control) {
  static std::map<std::string, model::Plan> plans;
  if (plans.contains(control)) return plans[control];
  std::string part = capstan::testing::slurp(capstan::testing::source_dir() + "/examples/bracket.p21");
  part = replaced(part, "'SLOT',(105.,0.,0.)", "'SLOT',(103.,25.,0.)");
  part = replaced(part, "#67=TOLERANCED_LENGTH_MEASURE(80.,", "#67=TOLERANCED_LENGTH_MEASURE(30.,");
  part = replaced(part, "#72=TOLERANCED_LENGTH_MEASURE(10.,", "#72=TOLERANCED_LENGTH_MEASURE(14.,");
  for (int end = 0; end < 2; ++end) part = replaced(part, "OPEN_SLOT_END_TYPE()", "RADIUSED_SLOT_END_TYPE()");
  service::Request request;
  EXPECT_TRUE(service::set(request, "control", control));
  EXPECT_TRUE(service::set(request, "workholding", "vise_125"));
  Job job;
  const auto out = service::plan(request, {.name = "bracket.p21", .bytes = part}, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error().what));
  if (!out) return plans[control];
  plans[control] = out->plan;
  plans[control].machine.control_options = model::ControlOptions{{{"cycles", "pocket"}}};
  return plans[control];
}

std::string program_of(const model::Plan& plan) {
  Job job;
  const auto text = controls::write_program(plan, job);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}

std::vector<std::string> errors(const model::Plan& plan, const std::string& text) {
  Job job;
  std::vector<std::string> out;
  for (const auto& f : verify::check_program({"program", text, ""}, &plan, plan.machine, plan.cutters, job)) {
    if (f.severity == Severity::kError) out.push_back(f.code + " " + f.message);
  }
  return out;
}

/// A figure, and between which amounts it is made larger or smaller.
struct Spoilt {
  int figure;
  double least, most;
};

/// Every figure of a call in parentheses, changed both ways where `both`, else one of them.
void finds_all(const model::Plan& plan, const std::string& text, const std::string& begin,
               const std::vector<Spoilt>& figures) {
  const std::size_t at = text.find("\n" + begin);
  ASSERT_NE(at, std::string::npos) << begin;
  const std::string call = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Random r(seed);
    for (const Spoilt& s : figures) {
      std::size_t from = call.find('(') + 1;
      for (int i = 0; i < s.figure; ++i) from = call.find(',', from) + 1;
      const std::size_t end = call.find_first_of(",)", from);
      const double now = parse_double(call.substr(from, end - from)).value_or(0.0);
      const std::string then = n(now + r.between(s.least, s.most));
      const std::string spoilt = call.substr(0, from) + then + call.substr(end);
      EXPECT_FALSE(errors(plan, replaced(text, call, spoilt)).empty())
          << begin << " figure " << s.figure << ": " << n(now) << " as " << then;
    }
  }
}

TEST(MilledProgram, ACycleOfSiemensWithAnotherFigureIsFound) {
  const model::Plan& plan = milled("siemens");
  const std::string text = program_of(plan);
  EXPECT_THAT(errors(plan, text), ::testing::IsEmpty());
  // RTP, RFP, SDIS, DP, PA, PO (the rectangle is 10 over the edge there), LENG, WID, MID, MIDA, FDP, FALD,
  // FFP1
  finds_all(plan, text, "CYCLE71(",
            {{0, -15, -0.05},
             {0, 0.05, 50},
             {1, -0.9, -0.02},
             {2, -4, -0.02},
             {2, 0.02, 9},
             {3, -9, -0.02},
             {3, 0.02, 0.9},
             {4, 0.02, 90},
             {5, 10.02, 90},
             {6, -90, -0.02},
             {7, -90, -0.02},
             {9, 0.05, 9},
             {10, 20.1, 90},
             {11, -0.9, -0.02},
             {12, 0.02, 0.8},
             {13, 3000, 9000}});
  // RTP, RFP, SDIS, DP, LENG, WID, CRAD, PA, PO, MID, FAL, FALD, FFP1, FFD
  finds_all(plan, text, "POCKET3(",
            {{0, -15, -0.05},
             {1, -9, -0.02},
             {2, 0.02, 9},
             {3, -9, -0.02},
             {3, 0.02, 9},
             {4, 0.02, 9},
             {4, -9, -0.02},
             {5, 0.02, 9},
             {6, 0.02, 9},
             {7, -9, -0.02},
             {8, 0.02, 9},
             {10, 7, 20},
             {11, 0.02, 2},
             {12, 0.02, 2},
             {13, 3000, 9000},
             {14, 600, 6000}});
}

TEST(MilledProgram, ASlotOfHeidenhainWithAnotherFigureIsFound) {
  const model::Plan& plan = milled("heidenhain");
  const std::string text = program_of(plan);
  EXPECT_THAT(errors(plan, text), ::testing::IsEmpty());
  const std::size_t slot = text.find("CYCL DEF 253");
  ASSERT_NE(slot, std::string::npos);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Random r(seed);
    for (const Spoilt& s : std::vector<Spoilt>{{218, 0.02, 9},
                                               {218, -40, -0.02},
                                               {219, 0.02, 9},
                                               {219, -9, -0.02},
                                               {368, 0.02, 2},
                                               {374, 0.1, 80},
                                               {201, -9, -0.02},
                                               {201, 0.02, 8},
                                               {202, 6, 20},
                                               {369, 0.02, 2},
                                               {206, 600, 6000},
                                               {207, 3000, 9000},
                                               {200, 0.02, 9},
                                               {203, -9, -0.02},
                                               {204, -19, -0.05},
                                               {366, 1.1, 9},
                                               {367, 1, 4},
                                               {215, 1, 2}}) {
      const std::size_t at = text.find("Q" + std::to_string(s.figure) + "=", slot) + 5;
      const std::size_t end = text.find(' ', at);
      std::string shown = text.substr(at, end - at);
      if (shown.front() == '+') shown.erase(0, 1);
      const double now = parse_double(shown).value_or(0.0), then = now + r.between(s.least, s.most);
      const std::string figure = (then < 0.0 ? "" : "+") + n(then);
      EXPECT_FALSE(errors(plan, text.substr(0, at) + figure + text.substr(end)).empty())
          << "Q" << s.figure << ": " << n(now) << " as " << figure;
    }
  }
}

}  // namespace
}  // namespace capstan::mutation
