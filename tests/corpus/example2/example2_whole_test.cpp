#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/corpus/session.h"

// The standard's example 2 whole, re-opened: one planning run, shared by all claims.

namespace capstan::corpus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CorpusExample2Whole : public ::testing::Test {
 protected:
  static const Session& session() {
    static const Session made =
        planned(testing::corpus_folder() + "/iso14649/fdis_ex2_mended.p21", Reopen::kAll, 2);
    return made;
  }
};

#define CAPSTAN_EXAMPLE2() CAPSTAN_CORPUS_FILE(corpus_file, "iso14649/fdis_ex2_mended.p21")

TEST_F(CorpusExample2Whole, IsPlannedButForTheGrooveInTheBore) {
  CAPSTAN_EXAMPLE2();
  EXPECT_THAT(reasons_unplanned(session().plan),
              ElementsAre(HasSubstr("a groove in the wall of a bore, 3.5 mm wide")));
  EXPECT_THAT(codes(session().bound, Severity::kError), IsEmpty());
}

TEST_F(CorpusExample2Whole, HasNoFindingAndRunsInTheInterpreter) {
  CAPSTAN_EXAMPLE2();
  EXPECT_THAT(findings_of_plan(session()), IsEmpty()) << all_findings(session());
  EXPECT_THAT(findings_of_program(session()), IsEmpty());
  CAPSTAN_NEEDS_RS274();
  EXPECT_GT(interpreted(session()).moves.size(), 1000U);
}

TEST_F(CorpusExample2Whole, ItsHolesRightThroughComeOutAtTheUnderside) {
  CAPSTAN_EXAMPLE2();
  // Holes 1 and 3 are 40 mm deep and through; the outside beside them is 50 mm deep, and so is the piece.
  for (const std::string hole : {"COMPOUND FEATURE HOLE1[1]", "COMPOUND_FEATURE_HOLE3[2]"}) {
    double low = 0.0;
    for (const auto& s : session().plan.steps) {
      if (!s.path || !model::step_id(session().plan, s).starts_with(hole)) continue;
      low = std::min(low, *std::min_element(s.path->z.begin(), s.path->z.end()));
    }
    EXPECT_LT(low, -50.0) << hole;
  }
  std::string said;
  for (const auto& d : session().bound) said += d.message + "\n";
  EXPECT_THAT(said,
              HasSubstr("COMPOUND FEATURE HOLE1[1]': it goes through, but its depth of 40 mm ends 10 mm "
                        "above the underside of the piece"));
}

}  // namespace
}  // namespace capstan::corpus
