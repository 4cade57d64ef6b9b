#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "planner/files/exchange/conformance/check.h"
#include "planner/files/exchange/exchange.h"
#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/p21/read/parse.h"
#include "tests/corpus/session.h"
#include "tests/support/corpus.h"
#include "tests/support/rows.h"
#include "tests/support/seal.h"

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

/// Planned once for all the tests of this file.
const Session& planned_once(const std::string& path, Reopen reopen) {
  static std::map<std::pair<std::string, Reopen>, Session> sessions;
  const auto key = std::pair(path, reopen);
  const auto it = sessions.find(key);
  return it != sessions.end() ? it->second : sessions.emplace(key, planned(path, reopen)).first->second;
}

/// What a step's toolpaths state of cross sections: how many points, all of seven numbers.
std::size_t section_points(const model::Model& m, model::AnyRef step) {
  std::size_t out = 0;
  const auto* ws = m.get<model::MachiningWorkingstep>(step);
  const auto* operation = ws == nullptr ? nullptr : m.get<model::Operation>(ws->its_operation);
  const auto* list = operation == nullptr ? nullptr : m.get<model::ToolpathList>(operation->its_toolpath);
  if (list == nullptr) return 0;
  for (const auto at : list->its_list.items) {
    const auto* trajectory = m.get<model::Trajectory>(at);
    if (trajectory == nullptr) continue;
    const auto* curve = m.get<model::Polyline>(trajectory->cross_section_area_parameters);
    if (curve == nullptr) continue;
    for (const auto point : curve->points.items) {
      EXPECT_EQ(m.at<model::CartesianPoint>(point).coordinates.items.size(), 7U);
      ++out;
    }
  }
  return out;
}

/// The volume that a step's trajectories say they remove.
double stated_volume(const model::Model& m, model::AnyRef step) {
  double out = 0.0;
  const auto* ws = m.get<model::MachiningWorkingstep>(step);
  const auto* operation = ws == nullptr ? nullptr : m.get<model::Operation>(ws->its_operation);
  const auto* list = operation == nullptr ? nullptr : m.get<model::ToolpathList>(operation->its_toolpath);
  if (list == nullptr) return 0.0;
  for (const auto at : list->its_list.items) {
    if (const auto* trajectory = m.get<model::Trajectory>(at))
      out += trajectory->its_material_removal_total_volume.value_or(0.0);
  }
  return out;
}

class Ap238Plan : public ::testing::TestWithParam<Case> {
 protected:
  static std::string path() {
    if (GetParam().example) return capstan::testing::source_dir() + "/examples/" + GetParam().file;
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
constexpr double kVolume = 1e-9;  // of the whole
constexpr double kPointMm = 1e-9, kCentreMm = 1e-7, kFeed = 1e-9;

/// What other steps have and a step has not: "step: what".
using Lacks = std::set<std::string>;
Lacks known_lacks(const std::string& plan) {
  Lacks out;
  for (testing::DataRow& row : testing::data_rows("tests/corpus/ap238/plan_lacks.csv")) {
    if (row["plan"] != plan) continue;
    EXPECT_TRUE(out.insert(row["step"] + ": " + row["lacks"]).second) << row["step"];
  }
  return out;
}

TEST_P(Ap238Plan, HoldsEveryPathAndSchedule) {
  CAPSTAN_PLAN_FILE();
  const Session& first = planned_once(path(), GetParam().reopen);
  Job job;
  // Without its seal the file's toolpaths count, which is what other readers have.
  auto again = exchange::read_bytes(testing::without_seal(as_ap238(first.plan)), "plan.stpnc", {}, job);
  ASSERT_TRUE(again) << to_text(again.error());
  std::map<std::string, std::vector<model::AnyRef>> by_id;
  for (const auto at : again->model.all_below(model::TypeId::kWorkingstep)) {
    by_id[again->model.at<model::Executable>(at).its_id.value_or("")].push_back(at);
  }
  ASSERT_FALSE(first.plan.steps.empty());
  EXPECT_THAT(reasons_unplanned(first.plan), ::testing::IsEmpty());
  std::map<std::string, std::size_t> seen;
  std::size_t compared = 0;
  double removed = 0.0;
  bool cut = false;
  Lacks lacks;
  for (const auto& step : first.plan.steps) {
    const std::string id = first.plan.model.at<model::Executable>(step.step).its_id.value_or("");
    SCOPED_TRACE(id);
    ASSERT_TRUE(by_id.contains(id));
    if (by_id[id].size() > 1 && !first.plan.model.holds<model::MachiningWorkingstep>(step.step)) {
      continue;  // two rapid movements of one name
    }
    const model::AnyRef twin = by_id[id].size() > 1 ? by_id[id][seen[id]++] : by_id[id].front();
    const auto got = exchange::path_of_step(*again, model::Ref<model::Executable>(twin), {}, job);
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
      ASSERT_GT(got->schedule.feed_mm_min[i], 0.0) << i;
      if (got->schedule.spindle_rpm[i] == 0.0) lacks.insert(id + ": a turning spindle");
      ASSERT_NEAR(got->schedule.feed_mm_min[i], schedule.feed_mm_min[i], kFeed) << i;
      ASSERT_EQ(got->schedule.spindle_rpm[i], schedule.spindle_rpm[i]) << i;
    }
    ++compared;
    const auto at_feed = [](model::MoveKind k) {
      return k != model::MoveKind::kRapid && k != model::MoveKind::kDwell;
    };
    if (!computed || std::none_of(p.kind.begin() + 1, p.kind.end(), at_feed)) continue;
    if (step.sections == nullptr || step.sections->size() == 0) {
      lacks.insert(id + ": cross sections");
      continue;
    }
    cut = true;
    double before = 0.0, after = 0.0;
    for (const double v : step.sections->removed_mm3) before += v;
    for (const double v : got->sections.removed_mm3) after += v;
    // The file states the volume of each trajectory, and sections at the points of its basic curve only: a
    // cut that begins and ends in the air between two of them has none there, and no volume after reading.
    ASSERT_GT(before, 0.0);
    EXPECT_NEAR(stated_volume(again->model, twin), before, kVolume * before);
    EXPECT_LE(after, before * (1.0 + kVolume));
    removed += after;
    EXPECT_GT(section_points(again->model, twin), 0U);
    EXPECT_GT(got->sections.size(), 0U);
  }
  EXPECT_GT(compared, 0U);
  if (cut) {
    EXPECT_GT(removed, 0.0);
  }
  EXPECT_EQ(lacks, known_lacks(GetParam().name)) << "plan_lacks.csv";
}

TEST_P(Ap238Plan, ExecutedGivesTheSameProgram) {
  CAPSTAN_PLAN_FILE();
  const Session& first = planned_once(path(), GetParam().reopen);
  const Session again = planned_bytes(as_ap238(first.plan), first.plan.file_name, Reopen::kNothing);
  EXPECT_FALSE(first.program.empty());
  EXPECT_EQ(first.program, again.program);
  EXPECT_EQ(first.table, again.table);
}

TEST_P(Ap238Plan, KeepsToTheSchema) {
  CAPSTAN_PLAN_FILE();
  const Session& first = planned_once(path(), GetParam().reopen);
  Job job;
  const auto file = p21::parse(as_ap238(first.plan), "plan.stpnc", {}, job);
  ASSERT_TRUE(file) << to_text(file.error());
  EXPECT_EQ(exchange::check_schema(*file, job), 0U);
  for (const auto& d : job.diagnostics()) {
    if (d.severity == Severity::kError) ADD_FAILURE() << to_text(d);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, Ap238Plan,
    ::testing::Values(Case{"Bracket", "bracket.p21", Reopen::kNothing, true},
                      Case{"BracketAll", "bracket.p21", Reopen::kAll, true},
                      Case{"Example1AsGiven", "nist_ex1.stp", Reopen::kNothing},
                      Case{"Example1All", "nist_ex1.stp", Reopen::kAll},
                      Case{"ExplicitAsGiven", "nist_ex1E.stp", Reopen::kNothing},
                      Case{"PlateAsGiven", "meduag_peca_defesa.p21", Reopen::kNothing},
                      Case{"PlateAll", "meduag_peca_defesa.p21", Reopen::kAll},
                      Case{"FlatHoleAsGiven", "meduag_furo.p21", Reopen::kNothing},
                      Case{"HoleAsGiven", "ufsc_FuroBaseEsferica.p21", Reopen::kNothing},
                      Case{"HoleAll", "meduag_furo.p21", Reopen::kAll},
                      Case{"ConicalHoleAsGiven", "ufsc_FuroConico.p21", Reopen::kNothing},
                      Case{"PocketAsGiven", "ufsc_Cavidade.p21", Reopen::kNothing},
                      Case{"SlotAsGiven", "ufsc_Ranhura.p21", Reopen::kNothing},
                      Case{"RoundedSlotAsGiven", "ufsc_RanhuraPerfilRoundedU.p21", Reopen::kNothing},
                      Case{"VeeSlotAsGiven", "ufsc_RanhuraPerfilVee.p21", Reopen::kNothing}),
    [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace capstan::corpus
