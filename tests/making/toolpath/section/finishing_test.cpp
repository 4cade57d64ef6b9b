#include <gtest/gtest.h>

#include "planner/ground/base/job.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/toolpath/section/section.h"

namespace capstan::toolpath {
namespace {

TEST(SectionFinishing, AsksWhetherToStop) {
  const Section tapered{{{5.0, 0.0}, {10.0, 10.0}}, 10.0};
  const Tip bull{3.0, 1.0};
  EXPECT_FALSE(finishing(tapered, bull, 0.01, 0.0).passes.empty());
  Job job;
  job.request_stop();
  const StopScope scope(job);
  EXPECT_THROW((void)finishing(tapered, bull, 0.01, 0.0), Stopped);
}

}  // namespace
}  // namespace capstan::toolpath
