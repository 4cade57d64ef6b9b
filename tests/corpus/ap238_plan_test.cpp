#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/exchange/conformance/check.h"
#include "planner/exchange/exchange.h"
#include "planner/exchange/iso14649/curves.h"
#include "planner/p21/parse.h"
#include "tests/corpus/session.h"

// Plans as AP238 files: complete, and carried out as they were planned.

namespace capstan::corpus {
namespace {

struct Case {
  const char* name;
  const char* file;  ///< in the corpus; or an example of the project's own
  Reopen reopen;
  bool example = false;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::string as_ap238(const model::Plan& plan) {
  Job job;
  auto out = exchange::write_ap238(plan, job);
  EXPECT_TRUE(out) << to_text(out.error());
  return out ? std::move(out->bytes) : std::string();
}

class Ap238Plan : public ::testing::TestWithParam<Case> {
 protected:
  static std::string path() {
    if (GetParam().example) return std::string(CAPSTAN_SOURCE_DIR) + "/examples/" + GetParam().file;
    return testing::corpus_folder() + "/iso14649/" + GetParam().file;
  }
};

#define CAPSTAN_PLAN_FILE()                  \
  if (!GetParam().example) {                 \
    CAPSTAN_CORPUS_FILE(unused, "iso14649"); \
    (void)unused;                            \
  }                                          \
  static_assert(true)

// Points come back through two changes of frame; feeds through a ratio that was chosen to give them exactly.
constexpr double kPointMm = 1e-9, kCentreMm = 1e-7, kFeed = 1e-9;

TEST_P(Ap238Plan, HoldsEveryPathAndSchedule) {
  CAPSTAN_PLAN_FILE();
  const Session first = planned(path(), GetParam().reopen);
  Job job;
  auto again = exchange::read_bytes(as_ap238(first.plan), "plan.stpnc", {}, job);
  ASSERT_TRUE(again) << to_text(again.error());
  std::map<std::string, std::vector<model::AnyRef>> by_id;
  for (const auto at : again->model.all_below(model::TypeId::kWorkingstep)) {
    by_id[again->model.at<model::Executable>(at).its_id.value_or("")].push_back(at);
  }
  std::size_t compared = 0;
  for (const auto& step : first.plan.steps) {
    const std::string id = first.plan.model.at<model::Executable>(step.step).its_id.value_or("");
    SCOPED_TRACE(id);
    ASSERT_TRUE(by_id.contains(id));
    if (by_id[id].size() > 1) continue;  // two rapid movements of one name
    const auto got =
        exchange::path_of_step(*again, model::Ref<model::Executable>(by_id[id].front()), {}, job);
    ASSERT_TRUE(got) << to_text(got.error());
    // Toolpaths that the file gave stay as they are; the program adds to them what it needs.
    const auto given = exchange::path_of_step(first.plan, step.step, {}, job);
    ASSERT_TRUE(given) << to_text(given.error());
    const bool computed = given->path == *step.path && given->schedule != *step.schedule;
    const auto& p = computed ? *step.path : given->path;
    const auto& schedule = computed ? *step.schedule : given->schedule;
    ASSERT_EQ(got->path.size(), p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      ASSERT_LT(norm(got->path.point(i) - p.point(i)), kPointMm) << i;
      if (i == 0) continue;
      ASSERT_EQ(got->path.kind[i], p.kind[i]) << i;
      if (p.kind[i] == model::MoveKind::kDwell) {
        ASSERT_EQ(got->schedule.dwell_s[i], schedule.dwell_s[i]) << i;
        continue;
      }
      ASSERT_NEAR(got->path.cx[i], p.cx[i], kCentreMm) << i;
      ASSERT_NEAR(got->path.cy[i], p.cy[i], kCentreMm) << i;
      if (p.kind[i] == model::MoveKind::kRapid) continue;
      ASSERT_NEAR(got->schedule.feed_mm_min[i], schedule.feed_mm_min[i], kFeed) << i;
      ASSERT_EQ(got->schedule.spindle_rpm[i], schedule.spindle_rpm[i]) << i;
    }
    ++compared;
    if (!computed || !step.sections || step.sections->size() == 0) continue;
    double before = 0.0, after = 0.0;
    for (const double v : step.sections->removed_mm3) before += v;
    for (const double v : got->sections.removed_mm3) after += v;
    EXPECT_GE(before * (1.0 + 1e-9), after);
    EXPECT_GT(got->sections.size(), 0U);
  }
  EXPECT_GT(compared, 0U);
}

TEST_P(Ap238Plan, ExecutedGivesTheSameProgram) {
  CAPSTAN_PLAN_FILE();
  const Session first = planned(path(), GetParam().reopen);
  const Session again = planned_bytes(as_ap238(first.plan), first.plan.file_name, Reopen::kNothing);
  EXPECT_FALSE(first.program.empty());
  EXPECT_EQ(first.program, again.program);
  EXPECT_EQ(first.table, again.table);
}

TEST_P(Ap238Plan, KeepsToTheSchema) {
  CAPSTAN_PLAN_FILE();
  const Session first = planned(path(), GetParam().reopen);
  Job job;
  const auto file = p21::parse(as_ap238(first.plan), "plan.stpnc", {}, job);
  ASSERT_TRUE(file) << to_text(file.error());
  EXPECT_EQ(exchange::check_schema(*file, job), 0U);
  for (const auto& d : job.diagnostics()) {
    if (d.severity == Severity::kError) ADD_FAILURE() << to_text(d);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Ap238Plan,
                         ::testing::Values(Case{"Bracket", "bracket.p21", Reopen::kNothing, true},
                                           Case{"BracketAll", "bracket.p21", Reopen::kAll, true},
                                           Case{"Example1AsGiven", "nist_ex1.stp", Reopen::kNothing},
                                           Case{"Example1All", "nist_ex1.stp", Reopen::kAll},
                                           Case{"ExplicitAsGiven", "nist_ex1E.stp", Reopen::kNothing},
                                           Case{"PlateAll", "meduag_peca_defesa.p21", Reopen::kAll},
                                           Case{"HoleAll", "ufsc_FuroBaseEsferica.p21", Reopen::kAll}),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace capstan::corpus
