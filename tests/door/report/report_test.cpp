#include "planner/door/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/report/loads_along.h"
#include "planner/model/plan/edit/provenance.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::report {
namespace {

model::Plan planned(const std::string& part) {
  Job job;
  auto in = pipeline::load_shop({}, job);
  auto read = pipeline::read_plan(testing::slurp(part), "part.p21", job);
  EXPECT_TRUE(in && read);
  auto plan = pipeline::bind(*std::move(read), *in, {}, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan();
}
const model::Plan& pocket() {
  static const model::Plan kPlan = planned(testing::source_dir() + "/examples/reference_pocket.p21");
  return kPlan;
}

nlohmann::json data_in(const std::string& page) {
  const std::string open = "id=\"data\">";
  const std::size_t from = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(Report, IsOnePageThatNamesNoOther) {
  const std::string page = html(pocket(), {});
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  for (const char* from : {"src=\"", "href=\"http", "@import", "url(http"})
    EXPECT_EQ(page.find(from), std::string::npos) << from;
  for (const char* place :
       {"{{title}}", "{{verdict}}", "{{data}}", "{{scripts}}", "{{library}}", "{{style}}"})
    EXPECT_EQ(page.find(place), std::string::npos) << place;
}

TEST(Report, HoldsEachStepToolAndSetupOfThePlan) {
  const auto data = data_in(html(pocket(), {}));
  EXPECT_EQ(data["steps"].size(), pocket().steps.size());
  EXPECT_EQ(data["tools"].size(), pocket().cutters.size());
  EXPECT_EQ(data["setups"].size(), pocket().setups.size());
  for (std::size_t i = 0; i < pocket().steps.size(); ++i) {
    const auto& path = *pocket().steps[i].path;
    ASSERT_EQ(data["steps"][i]["path"]["x"].size(), path.size());
    EXPECT_EQ(data["steps"][i]["path"]["x"].back().get<double>(), std::round(1000.0 * path.x.back()));
  }
}

TEST(Report, SaysTheVerdictAndTheFindingsItWasGiven) {
  About about;
  about.judged = Judged::kNotSafe;
  about.verdict = "NOT SAFE: a < b & \"c\"";
  about.findings = {
      {"part.p21", false, {.code = "CHK-X", .step = "1", .message = "</script><script>alert(1)"}}};
  const std::string page = html(pocket(), about);
  EXPECT_NE(page.find("class=\"unsafe\">NOT SAFE: a &lt; b &amp; &quot;c&quot;<"), std::string::npos);
  EXPECT_EQ(page.find("<script>alert(1)"), std::string::npos);
  EXPECT_EQ(data_in(page)["findings"][0]["text"], "</script><script>alert(1)");
}

TEST(Report, SaysWhatPlanningWarnedOf) {
  About about;
  about.told = {{.code = "PIP-STOCK", .severity = Severity::kWarning, .message = "no raw piece is given"}};
  const auto told = data_in(html(pocket(), about))["told"];
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0]["severity"], "warning");
  EXPECT_EQ(told[0]["code"], "PIP-STOCK");
  EXPECT_EQ(told[0]["text"], "no raw piece is given");
}

TEST(Report, TakesAProgramLineByLine) {
  About about;
  about.program = "one\n\nthree\n";
  EXPECT_EQ(data_in(html(pocket(), about))["program"]["lines"], (nlohmann::json{"one", "", "three"}));
}

TEST(Report, NamesThePartAndTheHashesOfFilesAmongWhatItWasMadeFrom) {
  About about;
  about.hashes = {{kPart, "12ab"}, {"machine", "34cd"}};
  const auto inputs = data_in(html(pocket(), about))["inputs"];
  EXPECT_EQ(inputs[0]["what"], "part");
  EXPECT_EQ(inputs[0]["value"], "part.p21");
  EXPECT_EQ(inputs[0]["sha256"], "12ab");
  for (const auto& row : inputs) {
    const std::string expected = row["what"] == "part" ? "12ab" : row["what"] == "machine" ? "34cd" : "";
    EXPECT_EQ(row["sha256"], expected) << row["what"];
  }
  EXPECT_EQ(inputs.size(), 1 + pocket().provenance.size());
}

TEST(Report, SharesOfTheStepsAddUpToTheTimeOfThePlan) {
  const auto data = data_in(html(pocket(), {}));
  double sum = 0.0;
  for (const auto& s : data["steps"]) {
    for (const char* of : {"cutting_s", "rapid_s", "tool_change_s", "link_s", "spindle_s"})
      sum += s[of].get<double>();
  }
  EXPECT_GT(data["time"]["spindle_s"].get<double>(), 0.0);
  EXPECT_NEAR(sum, data["time"]["total_s"].get<double>(), 0.01);
}

TEST(Report, OfNoStepsIsAPageToo) {
  const auto data = data_in(html(model::Plan(), {}));
  EXPECT_TRUE(data["steps"].empty());
}

TEST(LoadsAlong, ReachThePeaksOfThePlanAndNoMoreThanItsLimits) {
  for (const model::StepResult& step : pocket().steps) {
    const LoadsAlong l = loads_along(pocket(), step);
    ASSERT_FALSE(l.move.empty());
    const double torque = *std::max_element(l.torque_nm.begin(), l.torque_nm.end()) * l.margin;
    const double power = *std::max_element(l.power_w.begin(), l.power_w.end()) * l.margin;
    // Digits that a plan keeps of its sections.
    EXPECT_NEAR(torque / step.loads.torque_nm, 1.0, 0.05);
    EXPECT_NEAR(power / step.loads.power_w, 1.0, 0.05);
    for (std::size_t i = 0; i < l.move.size(); ++i) {
      EXPECT_LE(l.torque_nm[i] * l.margin, 1.01 * l.torque_limit_nm[i]);
      EXPECT_LE(l.power_w[i] * l.margin, 1.01 * l.power_limit_w[i]);
    }
  }
}

TEST(LoadsAlong, FeedStaysBelowWhatAxesAndOperatorAllow) {
  for (const model::StepResult& step : pocket().steps) {
    const LoadsAlong l = loads_along(pocket(), step);
    ASSERT_EQ(l.feed_limit_mm_min.size(), l.feed_mm_min.size());
    for (std::size_t i = 0; i < l.move.size(); ++i) {
      EXPECT_GT(l.feed_limit_mm_min[i], 0.0);
      EXPECT_LE(l.feed_mm_min[i], 1.001 * l.feed_limit_mm_min[i]);
    }
  }
  model::Plan limited = pocket();
  limited.provenance.push_back(
      model::provenance_of(*model::parse_edit(model::EditKind::kLimit, "feed<=77", "--limit")));
  const LoadsAlong l = loads_along(limited, limited.steps[0]);
  EXPECT_EQ(*std::max_element(l.feed_limit_mm_min.begin(), l.feed_limit_mm_min.end()), 77.0);
}

TEST(LoadsAlong, KeepTheLargestOfEachPieceWhenTheyAreThinned) {
  model::StepResult step = pocket().steps[0];
  auto many = std::make_shared<model::SectionSeries>(*step.sections);
  const std::size_t n = many->size();
  ASSERT_GT(n, 0u);
  for (std::size_t turn = 0; many->size() <= 3 * kMostPlaces; ++turn) {
    for (std::size_t i = 0; i < n; ++i) {
      many->move.push_back(step.sections->move[i]);
      for (auto* c :
           {&many->at_mm, &many->ad_max_mm, &many->rd_max_mm, &many->x_max_ofs_mm, &many->y_max_ofs_mm,
            &many->csa_mm2, &many->x_cg_ofs_mm, &many->y_cg_ofs_mm, &many->removed_mm3})
        c->push_back((*c)[i]);
    }
  }
  const LoadsAlong few = loads_along(pocket(), step);
  step.sections = many;
  const LoadsAlong thin = loads_along(pocket(), step);
  EXPECT_LE(thin.move.size(), kMostPlaces);
  EXPECT_EQ(*std::max_element(thin.power_w.begin(), thin.power_w.end()),
            *std::max_element(few.power_w.begin(), few.power_w.end()));
}

}  // namespace
}  // namespace capstan::report
