#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/corpus/session.h"

// Example 1 planned anew, wholly or in part: full plans that the checker has nothing against.

namespace capstan::corpus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Case {
  const char* name;
  const char* file;
  Reopen reopen;
  std::vector<std::string> told;  ///< of the plan, that is so
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class CorpusNistReopened : public ::testing::TestWithParam<Case> {};

TEST_P(CorpusNistReopened, GivesAFullPlanThatNothingIsFoundAgainst) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  CAPSTAN_NEEDS_RS274();
  const Session session = planned(path, GetParam().reopen);
  EXPECT_THAT(reasons_unplanned(session.plan), IsEmpty());
  EXPECT_THAT(codes(session.bound, Severity::kError), IsEmpty());
  EXPECT_EQ(findings_of_plan(session), GetParam().told) << all_findings(session);
  EXPECT_THAT(findings_of_program(session), IsEmpty()) << all_findings(session);
  EXPECT_THAT(session.plan.steps, SizeIs(::testing::Ge(5U)));
  for (const auto& step : session.plan.steps) {
    const std::string id = model::step_id(session.plan, step);
    const auto* cutter = model::find_cutter(session.plan, step.cutter_id);
    ASSERT_NE(cutter, nullptr) << id;
    EXPECT_GT(cutter->pocket, 0) << id;
    EXPECT_GT(cutter->cutting_diameter_mm, 0.0) << id;
    EXPECT_GT(step.spindle_rpm, 0.0) << id;
    EXPECT_GT(step.feed_mm_min, 0.0) << id;
    EXPECT_GT(step.cutting_s, 0.0) << id;
    ASSERT_NE(step.path, nullptr) << id;
    EXPECT_GT(step.path->size(), 2U) << id;
    ASSERT_NE(step.schedule, nullptr) << id;
    EXPECT_EQ(step.schedule->feed_mm_min.size(), step.path->size()) << id;
  }
  const auto motion = interpreted(session);
  EXPECT_GT(motion.moves.size(), 50U);
}

TEST_P(CorpusNistReopened, SpinsEveryToolTheWayItCutsAndNeverStopsItInTheWork) {
  CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + GetParam().file);
  CAPSTAN_NEEDS_RS274();
  const Session session = planned(path, GetParam().reopen);
  for (const auto& m : interpreted(session).moves) {
    if (m.kind == testing::CanonMove::Kind::kTraverse) continue;
    EXPECT_GT(m.rpm, 0.0) << m.step << ", line " << m.line;
    EXPECT_GT(m.feed_mm_min, 0.0) << m.step << ", line " << m.line;
  }
}

INSTANTIATE_TEST_SUITE_P(Example1, CorpusNistReopened,
                         ::testing::Values(Case{"All", "nist_ex1.stp", Reopen::kAll, {}},
                                           Case{"Operations", "nist_ex1.stp", Reopen::kOperations, {}},
                                           Case{"Tools", "nist_ex1.stp", Reopen::kTools, {}},
                                           // One mill of 18 mm, which nobody says is of carbide, clears the
                                           // pocket in tool steel for three hours: edges last 15 min.
                                           Case{"Technology",
                                                "nist_ex1.stp",
                                                Reopen::kTechnology,
                                                {"16 CHK-TOOL-MATERIAL "}},
                                           Case{"ExplicitAll", "nist_ex1E.stp", Reopen::kAll, {}}),
                         [](const auto& given) { return std::string(given.param.name); });

TEST(CorpusNistReopenedInPart, KeepsTheStepsAndOverrulesAStoppedReamer) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1.stp");
  for (const Reopen reopen : {Reopen::kTools, Reopen::kTechnology}) {
    const Session session = planned(path, reopen);
    EXPECT_THAT(step_ids(session.plan),
                ElementsAre("WS FINISH PLANAR FACE1", "WS DRILL HOLE1", "WS REAM HOLE1", "WS ROUGH POCKET1",
                            "WS FINISH POCKET1"));
    // The file stops the spindle in the hole: kept as long as everything given is, else changed and said.
    EXPECT_THAT(codes(session.bound, Severity::kWarning), ::testing::Contains("PIP-CHANGED"));
  }
}

TEST(CorpusNistReopenedInPart, KeepsTheFilesToolsWhereOnlyTechnologyIsOpen) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1.stp");
  const auto tools = [](const Session& s) {
    std::vector<std::string> out;
    for (const auto& step : s.plan.steps) out.push_back(step.cutter_id);
    return out;
  };
  EXPECT_THAT(tools(planned(path, Reopen::kTechnology)),
              ElementsAre("MILL 18MM", "SPIRAL_DRILL_20MM", "REAMER_22MM", "MILL 18MM", "MILL 18MM"));
}

/// The reason a decision of the plan names, after it was looked at whether it is one.
const model::Reason* reason_for(const model::Plan& plan, model::AnyRef object, const char* attribute) {
  const model::Decision* d = plan.ledger.find(object, attribute);
  if (d == nullptr || d->state != model::DecisionState::kBound || d->reason == 0) return nullptr;
  return &plan.ledger.reason(d->reason);
}

TEST(CorpusNistExplained, ToolDepthAndFeedEachNameTheirReasonAndItsSource) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1.stp");
  const Session session = planned(path, Reopen::kAll);
  const auto& m = session.plan.model;
  int milled = 0;
  for (const auto& step : session.plan.steps) {
    const std::string id = model::step_id(session.plan, step);
    const auto* ws = m.get<model::MachiningWorkingstep>(step.step);
    ASSERT_NE(ws, nullptr) << id;
    const auto* op = m.get<model::MachiningOperation>(ws->its_operation);
    ASSERT_NE(op, nullptr) << id;
    std::vector<std::pair<model::AnyRef, const char*>> asked = {
        {ws->its_operation, "its_tool"}, {op->its_technology, "feedrate"}, {op->its_technology, "spindle"}};
    if (m.holds<model::Two5dMillingOperation>(ws->its_operation)) {
      ++milled;
      asked.emplace_back(ws->its_operation, "axial_cutting_depth");
    }
    for (const auto& [object, attribute] : asked) {
      const model::Reason* why = reason_for(session.plan, object, attribute);
      ASSERT_NE(why, nullptr) << id << " " << attribute;
      EXPECT_FALSE(why->id.empty()) << id << " " << attribute;
      EXPECT_FALSE(why->text.empty()) << id << " " << attribute;
      EXPECT_FALSE(why->source.empty()) << id << " " << attribute << ": " << why->id;
    }
    // A feed stops somewhere: at a limit that is named with its value, or at the start value.
    for (const auto& a : step.active) {
      EXPECT_FALSE(a.name.empty()) << id;
      EXPECT_LE(a.value, a.limit * (1.0 + 1e-3)) << id << " " << a.name;
    }
  }
  EXPECT_GE(milled, 4);
}

}  // namespace
}  // namespace capstan::corpus
