#include "planner/ground/base/result.h"

#include <gtest/gtest.h>

namespace capstan {
namespace {

TEST(DiagnosticText, HasEveryPartInTheOrderOfACompilersLine) {
  const Diagnostic d{.code = "X-CODE",
                     .severity = Severity::kWarning,
                     .message = "the depth is negative",
                     .file = "a.p21",
                     .line = 12,
                     .instance = 45,
                     .path = "its_depth",
                     .expected = "0 or more",
                     .hint = "state it downwards"};
  EXPECT_EQ(to_text(d),
            "a.p21:12: warning: #45 its_depth: the depth is negative; expected 0 or more; state it downwards "
            "[X-CODE]");
}

TEST(DiagnosticText, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_text(Diagnostic{.code = "", .message = "no"}), "error: no");
  EXPECT_EQ(to_text(Diagnostic{.code = "", .severity = Severity::kNote, .message = "no", .line = 3}),
            "note: no")
      << "a line without a file is no place";
  EXPECT_EQ(to_text(Diagnostic{.code = "", .message = "no", .file = "a.p21"}), "a.p21: error: no");
}

TEST(Fail, MakesAResultWithoutAValue) {
  const Result<int> r = fail("X-CODE", "no such thing");
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().severity, Severity::kError);
  EXPECT_EQ(r.error().code, "X-CODE");
  EXPECT_EQ(r.error().message, "no such thing");
}

}  // namespace
}  // namespace capstan
