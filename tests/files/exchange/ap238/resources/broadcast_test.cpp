// Broadcasts of edition 4, attribute by attribute.

#include "tests/files/exchange/ap238/process/process_support.h"

namespace capstan::exchange::ap238::process {
namespace {

TEST(Broadcast, IsToldByItsDescription) {
  const auto content = [](const char* name, const char* description) {
    return std::vector<std::string>{
        std::string("MACHINING_BROADCAST_CONTENT_RELATIONSHIP('") + name + "','" + description + "',#,#);",
        "MACHINING_BROADCAST_CONTENT('content',$,'','');"};
  };
  const Line lines[] = {
      {"BROADCAST", "its_id", 0, {"MACHINING_BROADCAST_STRATEGY('a text',$,'','');"}},
      {"BROADCAST_POINT",
       "broadcast_points",
       0,
       {"MACHINING_BROADCAST_STRATEGY('','broadcast point','','');",
        "ACTION_PROPERTY('broadcast points','broadcast point',#);", "GEOMETRIC_SET('',(#,#));"}},
      {"BROADCAST_COUNT", "broadcast_count", 0, property("broadcast count", "broadcast count", kCount3)},
      {"BROADCAST_DISTANCE", "broadcast_distance", 0,
       property("broadcast distance", "broadcast distance", length_item())},
      {"BROADCAST_TIME", "broadcast_interval", 0,
       property("broadcast interval", "broadcast time", time_item())},
      {"BROADCAST_COUNT", "start_content", 0, content("start content", "broadcast count")},
      {"BROADCAST_COUNT", "end_content", 0, content("end content", "broadcast count")},
      {"BROADCAST_POINT", "point_content", 0, content("point content", "broadcast point")},
      {"BROADCAST_COUNT", "count_content", 0, content("count content", "broadcast count")},
      {"BROADCAST_DISTANCE", "distance_content", 0, content("distance content", "broadcast distance")},
      {"BROADCAST_TIME", "time_content", 0, content("time content", "broadcast time")},
  };
  for (const Line& line : lines) check(line);
}

TEST(BroadcastContent, SaysWhatIsSent) {
  const auto list = [](const char* name) {
    return std::vector<std::string>{std::string("ACTION_PROPERTY('") + name + "','',#);",
                                    "REPRESENTATION('',(#,#),#);", text_item("first"), text_item("second")};
  };
  const Line lines[] = {
      {"BROADCAST_CONTENT", "its_id", 0, {"MACHINING_BROADCAST_CONTENT('a text',$,'','');"}},
      {"BROADCAST_CONTENT", "message", 0, {"MACHINING_BROADCAST_CONTENT('','a text','','');"}},
      {"BROADCAST_CONTENT", "cbm_measurements", 0, list("cbm measurements")},
      {"BROADCAST_CONTENT", "adf_measurements", 0, list("adf measurements")},
      {"BROADCAST_CONTENT", "pbf_measurements", 0, list("pbf measurements")},
      {"BROADCAST_CONTENT", "acl_measurements", 0, list("acl measurements")},
      {"BROADCAST_CONTENT", "plc_measurements", 0, list("plc measurements")},
      {"BROADCAST_CONTENT", "program_contexts", 0, list("program contexts")},
      {"BROADCAST_CONTENT", "digital_threads", 0, list("digital thread")},
      {"BROADCAST_CONTENT", "export_stream", 0, property("export stream", "", text_item("a text"))},
      {"BROADCAST_CONTENT", "time", 0, property("time", "", text_item("report time"))},
      {"BROADCAST_CONTENT", "time", 1, property("time", "", text_item("do not report time"))},
      {"BROADCAST_CONTENT", "sequence", 0, property("sequence", "", text_item("report sequence"))},
      {"BROADCAST_CONTENT", "sequence", 1, property("sequence", "", text_item("do not report sequence"))},
      {"BROADCAST_CONTENT", "only_if_changed", 0,
       property("only if changed", "", text_item("report only if changed"))},
      {"BROADCAST_CONTENT", "only_if_changed", 1,
       property("only if changed", "", text_item("report always"))},
      {"BROADCAST_CONTENT", "wait_for_reply", 0, property("wait for reply", "", text_item("wait for reply"))},
      {"BROADCAST_CONTENT", "wait_for_reply", 1,
       property("wait for reply", "", text_item("do not wait for reply"))},
  };
  for (const Line& line : lines) check(line);
}

TEST(BroadcastContent, WithoutAnythingIsATimestamp) {
  Bench bench;
  auto& m = bench.plan.model;
  m.at<model::Workplan>(bench.workplan).start_content = m.add<model::BroadcastContent>({});
  const auto back = read_text(written(bench.plan).bytes);
  const auto& content =
      back.model.at<model::BroadcastContent>(back.model.all_below(TypeId::kBroadcastContent).front());
  EXPECT_FALSE(content.message || content.time || content.export_stream || content.cbm_measurements.given);
}

TEST(BroadcastContent, LeadsToMeasuredPropertiesThatAreKept) {
  const auto plan = read_text(file_of(
      "#1=MACHINING_BROADCAST_CONTENT('c',$,'','');\n#2=APPLIED_ACTION_METHOD_ASSIGNMENT(#1,#3,(#4,#5));\n"
      "#3=ACTION_METHOD_ROLE('measured properties',$);\n#4=TWIN_MEASURED_PROPERTY('flatness','',#9);\n"
      "#5=TWIN_MEASURED_PROPERTY('roundness','',#9);\n#6=APPLIED_ACTION_METHOD_ASSIGNMENT(#1,#7,(#4));\n"
      "#7=ACTION_METHOD_ROLE('another role',$);\n#9=SHAPE_ASPECT('','',$,.F.);\n"));
  const auto all = plan.model.all_below(TypeId::kBroadcastContent);
  ASSERT_EQ(all.size(), 1u);
  const auto& found = plan.model.at<model::BroadcastContent>(all.front()).measured_properties;
  ASSERT_EQ(found.size(), 2u);
  ASSERT_EQ(found.items[0].type, TypeId::kKeptInstance);
  const auto lines = shapes(written(plan).bytes);
  EXPECT_THAT(lines, ::testing::Contains("APPLIED_ACTION_METHOD_ASSIGNMENT(#,#,(#,#));"));
  EXPECT_THAT(lines, ::testing::Contains("ACTION_METHOD_ROLE('measured properties',$);"));
  EXPECT_THAT(lines, ::testing::Contains("TWIN_MEASURED_PROPERTY('flatness','',#);"));
  EXPECT_THAT(lines, ::testing::Contains("APPLIED_ACTION_METHOD_ASSIGNMENT(#,#,(#));"));
}

TEST(Broadcast, OfEveryKindComesBackWhole) {
  for (const TypeId t : concrete({TypeId::kBroadcast, TypeId::kBroadcastContent})) check_whole(t);
}

}  // namespace
}  // namespace capstan::exchange::ap238::process
