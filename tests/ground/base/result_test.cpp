#include "planner/ground/base/result.h"

#include <gtest/gtest.h>

namespace capstan {
namespace {

TEST(Diagnostic, IsPrintedAsACompilerPrintsIt) {
  EXPECT_EQ(to_text(Diagnostic{.code = "P21-MANDATORY",
                               .severity = Severity::kWarning,
                               .message = "is missing",
                               .file = "part.p21",
                               .line = 412,
                               .instance = 77,
                               .path = "its_boss",
                               .expected = "a list",
                               .hint = "write ()"}),
            "part.p21:412: warning: #77 its_boss: is missing; expected a list; write () [P21-MANDATORY]");
}

TEST(Diagnostic, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_text(Diagnostic{.code = {}, .message = "no tool"}), "error: no tool");
  EXPECT_EQ(to_text(Diagnostic{.code = "X", .severity = Severity::kNote, .message = "m", .file = "f"}),
            "f: note: m [X]");
  EXPECT_EQ(to_text(Diagnostic{.code = "X", .message = "m", .line = 3}), "error: m [X]")
      << "a line of no file";
  EXPECT_EQ(to_text(Diagnostic{.code = {}, .message = "m", .path = "a.b"}), "error: a.b: m");
}

TEST(Fail, IsAnErrorUnlessItSaysOtherwise) {
  const Result<int> r = fail("CODE", "what is the matter");
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error(), (Diagnostic{.code = "CODE", .message = "what is the matter"}));
  EXPECT_EQ(r.error().severity, Severity::kError);
}

}  // namespace
}  // namespace capstan
