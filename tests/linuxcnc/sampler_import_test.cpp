#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "casebase/retain/join/import.h"
#include "casebase/retain/join/steps.h"
#include "casebase/retain/program_marks.h"
#include "tests/door/app/plans.h"
#include "tests/linuxcnc/planned.h"
#include "tests/linuxcnc/simulator.h"
#include "tests/linuxcnc/times.h"
#include "tests/support/corpus.h"

// What LinuxCNC's sampler writes becomes cases as it stands: no script between.

namespace capstan::linuxcnc {
namespace {

TEST(SamplerImport, MakesACaseOfAStepWithTheTimeThatTheMachineTook) {
  const testing::ScratchFolder folder;
  std::ofstream(folder.file("plate.p21")) << app::testing::drilled_plate();
  const Planned p = plan(
      {folder.file("plate.p21"), "--material", "C45", "--reopen", "all", "--machine", "linuxcnc_axis_mm"});
  ASSERT_EQ(p.failed, "");
  const Record r =
      run({.program = p.program, .tools = p.tools, .offsets = offsets_for(p.plan), .keep_samples = true});
  if (!r.absent.empty()) GTEST_SKIP() << r.absent;
  ASSERT_EQ(r.failed, "");
  Job job;
  namespace retain = casebase::retain;
  const retain::ProgramMarks marks = retain::program_marks(p.program);
  const auto steps = retain::steps_of(p.plan, job);
  std::istringstream log(r.samples);
  const auto cases =
      retain::import_log(log, retain::LogFormat::kLinuxcnc, steps,
                         {.part = "1", .machine = "M1", .file = "samples.txt"}, {.marks = &marks}, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  EXPECT_EQ(job.count(Severity::kWarning), 0U);
  ASSERT_EQ(cases->size(), 1U);
  const casebase::Case& c = cases->front();
  // From the marker of the step on, to the end of the program.
  const std::size_t marker = p.program.find("(CAPSTAN STEP");
  ASSERT_NE(marker, std::string::npos);
  const auto first =
      1 + std::count(p.program.begin(), p.program.begin() + static_cast<std::ptrdiff_t>(marker), '\n');
  double moved_s = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i)
    moved_s += r.line[i] >= first && r.speed_mm_s[i] > 0.0 ? kServoPeriod : 0.0;
  ASSERT_TRUE(c.observed.time_s && c.observed.executed_vc_m_min && c.observed.executed_fz_mm);
  // Each of some twenty moves ends within a servo period.
  EXPECT_NEAR(c.observed.time_s->value, moved_s, 20 * kServoPeriod);
  // The program's own S and F, which the machine kept: the simulated spindle turns as it is told.
  EXPECT_NEAR(c.observed.executed_vc_m_min->value, c.bound.vc_m_min, 1e-3 * c.bound.vc_m_min);
  EXPECT_NEAR(c.observed.executed_fz_mm->value, c.bound.fz_mm, 1e-3 * c.bound.fz_mm);
}

}  // namespace
}  // namespace capstan::linuxcnc
