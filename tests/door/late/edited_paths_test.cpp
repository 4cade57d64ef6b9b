#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "planner/door/late/late.h"
#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/model/plan/decision/contradicted.h"
#include "tests/door/late/brought.h"

// A path that somebody edited in a written plan. Planning computes it, and would drop the edit: nothing is
// cut.

namespace capstan::late {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";
const LatePolicy kInTime = {.deadline = std::nullopt};
constexpr double kByMm = 0.01;

const model::Plan& bracket() {
  static const model::Plan kPlan = brought(kBracket, pipeline::Format::kJson).plan;
  return kPlan;
}

std::string text_of(pipeline::Format format) {
  Job job;
  auto text = pipeline::write_plan(bracket(), format, job);
  EXPECT_TRUE(text);
  return text ? *text : std::string();
}

model::Plan read(const std::string& text) {
  Job job;
  auto plan = pipeline::read_plan(text, "e.stp", job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  return plan ? *std::move(plan) : model::Plan{};
}

/// A line of the file, "#12=CARTESIAN_POINT('',(1.,2.,3.));": where its numbers stand.
struct Point {
  std::size_t at = 0, length = 0;
  double x = 0.0;
};
std::vector<Point> points_of_longest_polyline(const std::string& text) {
  std::string longest;
  for (auto at = text.find("=POLYLINE("); at != std::string::npos; at = text.find("=POLYLINE(", at + 1)) {
    const std::string line = text.substr(at, text.find(");", at) - at);
    const std::string first =
        line.substr(line.find('#'), line.find_first_of(",)", line.find('#')) - line.find('#'));
    const auto point = text.find("\n" + first + "=CARTESIAN_POINT(");
    if (point == std::string::npos) continue;
    const std::string numbers = text.substr(point, text.find(");", point) - point);
    // Of three coordinates: those of two bound features.
    if (std::count(numbers.begin(), numbers.end(), ',') != 3) continue;
    if (line.size() > longest.size()) longest = line;
  }
  std::vector<Point> out;
  for (auto at = longest.find('#'); at != std::string::npos; at = longest.find('#', at + 1)) {
    const std::string number = longest.substr(at, longest.find_first_of(",)", at) - at);
    const auto line = text.find("\n" + number + "=CARTESIAN_POINT(");
    if (line == std::string::npos) continue;
    const auto from = text.find('(', text.find('(', line) + 1) + 1;
    out.push_back({from, text.find(',', from) - from, std::stod(text.substr(from, 40))});
  }
  return out;
}

/// The text with the x of one point moved.
std::string with_moved(std::string text, const Point& p, double by) {
  return text.replace(p.at, p.length, std::to_string(p.x + by));
}

/// The steps whose toolpaths, followed, are not the paths that were planned.
std::vector<std::string> steps_off(const model::Plan& edited) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < edited.steps.size(); ++i) {
    Job job;
    const auto now = exchange::path_of_step(edited, edited.steps[i].step, {}, job);
    EXPECT_TRUE(now);
    const model::CutterPath& was = *bracket().steps[i].path;
    double most = now->path.size() == was.size() ? 0.0 : 1.0;
    for (std::size_t k = 0; most < 1.0 && k < was.size(); ++k)
      most = std::max(most, geometry::norm(now->path.point(k) - was.point(k)));
    if (most > 0.1 * kByMm) out.push_back(model::step_id(edited, edited.steps[i]));
  }
  return out;
}

void expect_refused(const model::Plan& edited, const std::string& step) {
  const auto why = model::contradictions(edited);
  ASSERT_EQ(why.size(), 1U);
  EXPECT_THAT(why.front().why, HasSubstr("the path of step '" + step + "' was edited"));
  for (const bool next : {false, true}) {
    Job job;
    LatePolicy policy = kInTime;
    if (next) policy.next = Next{.count = 2, .from = std::nullopt};
    const auto bound = bind(edited, shop_of(controls::linuxcnc::write_tool_table(bracket())), policy, job);
    ASSERT_FALSE(bound) << "a program, and the edit is lost";
    EXPECT_THAT(to_text(bound.error()), AllOf(HasSubstr("LATE-UNSAFE"), HasSubstr("'" + step + "'")));
  }
}

TEST(LateEditedPaths, APointThatWasMovedInAPart21FileIsNotDropped) {
  for (const auto format : {pipeline::Format::kIso14649, pipeline::Format::kAp238}) {
    const std::string text = text_of(format);
    const auto points = points_of_longest_polyline(text);
    ASSERT_GT(points.size(), 3U);
    for (const Point& p : {points.front(), points[points.size() / 2], points.back()}) {
      const model::Plan edited = read(with_moved(text, p, kByMm));
      const auto off = steps_off(edited);
      ASSERT_EQ(off.size(), 1U);
      const auto why = model::contradictions(edited);
      ASSERT_EQ(why.size(), 1U);
      EXPECT_THAT(why.front().why, HasSubstr("the path of step '" + off.front() + "' was edited"));
    }
    const model::Plan edited = read(with_moved(text, points[points.size() / 2], kByMm));
    expect_refused(edited, steps_off(edited).front());
  }
}

TEST(LateEditedPaths, OfAJsonPlanAreNamedWithTheirStep) {
  auto tree = nlohmann::json::parse(text_of(pipeline::Format::kJson));
  auto& step = tree["steps"][6];
  const std::string path = step["path"];
  auto& x = tree["paths"][std::stoul(path.substr(path.find(':') + 1)) - 1]["x"];
  x[x.size() / 2] = x[x.size() / 2].get<double>() + kByMm;
  expect_refused(read(tree.dump()), step["id"]);
}

TEST(LateEditedPaths, OfTheHeaderAreNotDroppedEither) {
  std::string text = text_of(pipeline::Format::kAp238);
  const auto at = text.find(",(", text.find("\n!CAPSTAN_PATH(1,")) + 2;
  const auto end = text.find(',', at);
  text.replace(at, end - at, std::to_string(std::stod(text.substr(at, end - at)) + kByMm));
  const auto why = model::contradictions(read(text));
  ASSERT_EQ(why.size(), 1U);
  EXPECT_THAT(why.front().why, AllOf(HasSubstr("the path of step '"), HasSubstr("from move ")));
}

// A feature takes its toolpaths along: that is an edit of the feature, which planning follows.
TEST(LateEditedPaths, AreNotThoseOfAFeatureThatWasMoved) {
  for (const auto format : {pipeline::Format::kIso14649, pipeline::Format::kAp238}) {
    std::string text = text_of(format);
    const model::Plan plan = read(text);
    const auto pockets = plan.model.all(model::TypeId::kClosedPocket);
    ASSERT_FALSE(pockets.empty());
    const auto placement = plan.model.at<model::ClosedPocket>(pockets.front()).feature_placement;
    const auto location = plan.model.at<model::Axis2Placement3d>(placement).location;
    const std::string line =
        "\n#" + std::to_string(plan.model.origin(location).instance) + "=CARTESIAN_POINT(";
    ASSERT_NE(text.find(line), std::string::npos);
    const auto from = text.find('(', text.find('(', text.find(line)) + 1) + 1;
    const Point p{from, text.find(',', from) - from, std::stod(text.substr(from, 40))};
    Job job;
    const auto edited = pipeline::read_plan(with_moved(text, p, 0.5), "e.stp", job);
    ASSERT_TRUE(edited) << to_text(edited.error());
    EXPECT_TRUE(model::contradictions(*edited).empty()) << model::contradictions(*edited).front().why;
    std::string said;
    for (const Diagnostic& d : job.diagnostics()) said += to_text(d) + "\n";
    // The toolpaths of AP238 have a frame of their own.
    if (format == pipeline::Format::kIso14649) {
      EXPECT_THAT(said, HasSubstr("as if its feature was moved"));
    }
  }
}

// A seal that does not hold for another reason says nothing of the paths.
TEST(LateEditedPaths, AreNotThoseOfAFileWhoseNameWasEdited) {
  for (const auto format : {pipeline::Format::kIso14649, pipeline::Format::kAp238}) {
    std::string text = text_of(format);
    const std::string name = "'POCKET";
    ASSERT_NE(text.find(name), std::string::npos);
    for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
      text.replace(at, name.size(), "'PUCKET");
    Job job;
    const auto edited = pipeline::read_plan(text, "e.stp", job);
    ASSERT_TRUE(edited) << to_text(edited.error());
    ASSERT_FALSE(job.diagnostics().empty());
    EXPECT_EQ(job.diagnostics().front().code, "EXC-EDITED");
    for (const auto& c : model::contradictions(*edited))
      EXPECT_THAT(c.why, ::testing::Not(HasSubstr("the path of")));
  }
}

}  // namespace
}  // namespace capstan::late
