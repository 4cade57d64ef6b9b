#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "planner/files/json/tree/columns.h"
#include "planner/files/json/tree/tree.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/stopping.h"

namespace capstan::json {
namespace {

TEST(JsonTree, AsksWhetherToStopAsItIsMade) {
  constexpr int kValues = 1000;  // one look comes at every 64th
  std::string text = "[0";
  for (int i = 1; i < kValues; ++i) text += ",{}";
  text += "]";
  nlohmann::json tree;
  TreeFault fault;
  ASSERT_TRUE(make_tree(take_columns(text), tree, fault));
  EXPECT_EQ(tree.size(), static_cast<std::size_t>(kValues));
  Columns taken = take_columns(text);
  Job job;
  job.request_stop();
  const StopScope scope(job);
  EXPECT_THROW((void)make_tree(std::move(taken), tree, fault), Stopped);
}

}  // namespace
}  // namespace capstan::json
