#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/arena/walk.h"
#include "tests/corpus/session.h"

// What a plan remembers of itself in a file: who bound what, and why.

namespace capstan::corpus {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kName = "plan.p21";

/// The ledger by instance numbers: both plans stand in the same file.
std::map<std::string, std::string> ledger(const model::Plan& plan) {
  const auto place = [&](const model::DecisionKey& k) {
    return "#" + std::to_string(plan.model.origin(k.object).instance) + "." + k.attribute;
  };
  std::map<std::string, std::string> out;
  for (const auto& [key, d] : plan.ledger.entries()) {
    const auto& why = plan.ledger.reason(d.reason);
    std::string text = std::string(d.state == model::DecisionState::kOpen ? "open " : "bound ") +
                       std::string(model::to_text(d.binder)) + (d.pinned ? " pinned " : " ") + why.id + "|" +
                       why.text + "|" + why.source + "|" + d.lexeme + "|";
    for (const auto& k : d.depends_on) text += place(k) + " ";
    for (const auto& r : d.rejected) text += "; not " + r.what + ": " + r.why;
    out[place(key)] = text;
  }
  return out;
}

model::Plan read_again(const std::string& bytes, std::vector<Diagnostic>* said = nullptr) {
  Job job;
  auto plan = pipeline::read_plan(bytes, kName, job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  if (said != nullptr) *said = job.take_diagnostics();
  return plan ? *std::move(plan) : model::Plan{};
}

std::string written(const model::Plan& plan, Format format) {
  Job job;
  auto bytes = pipeline::write_plan(plan, format, job);
  EXPECT_TRUE(bytes) << to_text(bytes.error());
  return bytes ? *std::move(bytes) : std::string();
}

struct Case {
  const char* name;
  const char* file;
  Reopen reopen;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class CorpusRoundTrip : public ::testing::TestWithParam<Case> {
 protected:
  static std::string path() { return testing::corpus_folder() + "/iso14649/" + GetParam().file; }
};

#define CAPSTAN_ROUND_TRIP_FILE()          \
  CAPSTAN_CORPUS_FILE(unused, "iso14649"); \
  (void)unused

TEST_P(CorpusRoundTrip, TheFileKeepsWhoBoundWhatAndWhy) {
  CAPSTAN_ROUND_TRIP_FILE();
  // Written and read once, every object stands at a number; from then on nothing may move.
  const auto first = read_again(written(planned(path(), GetParam().reopen).plan, Format::kIso14649));
  const auto second = read_again(written(first, Format::kIso14649));
  EXPECT_EQ(ledger(first), ledger(second));
}

TEST_P(CorpusRoundTrip, TheFileKeepsEveryDecisionOfThePlan) {
  CAPSTAN_ROUND_TRIP_FILE();
  const auto plan = planned(path(), GetParam().reopen).plan;
  const auto again = read_again(written(plan, Format::kIso14649));
  // By binder, reason and attribute: objects made by planning have no number before they are written.
  const auto picture = [](const model::Plan& p) {
    // What a re-opened decision replaced is no longer part of the plan, and is not written.
    std::vector<model::AnyRef> roots = {p.project};
    roots.insert(roots.end(), p.kept.begin(), p.kept.end());
    const auto alive = model::reachable(p.model, roots);
    const std::set<model::AnyRef> written_ones(alive.begin(), alive.end());
    std::multiset<std::string> out;
    for (const auto& [key, d] : p.ledger.entries()) {
      if (!written_ones.contains(key.object)) continue;
      // ISO 14649 has no place for what a machine must have at least; writing says so.
      if (key.attribute == "its_minimum_machine_params") continue;
      const auto& why = p.ledger.reason(d.reason);
      out.insert(key.attribute + " " + std::string(model::noun_type(key.object.type).keyword) + " " +
                 std::string(d.state == model::DecisionState::kOpen ? "open " : "bound ") +
                 std::string(model::to_text(d.binder)) + " " + why.id + "|" + why.text + "|" + why.source +
                 "|" + std::to_string(d.depends_on.size()) + "|" + std::to_string(d.rejected.size()));
    }
    return out;
  };
  const auto before = picture(plan);
  const auto after = picture(again);
  std::vector<std::string> lost, gained;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(lost));
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(gained));
  EXPECT_THAT(lost, IsEmpty());
  EXPECT_THAT(gained, IsEmpty());
}

TEST_P(CorpusRoundTrip, ExecutingTheWrittenFileGivesTheSameProgram) {
  CAPSTAN_ROUND_TRIP_FILE();
  const Session first = planned(path(), GetParam().reopen);
  const Session again =
      planned_bytes(written(first.plan, Format::kIso14649), first.plan.file_name, Reopen::kNothing);
  EXPECT_EQ(first.program, again.program);
  EXPECT_EQ(first.table, again.table);
}

TEST_P(CorpusRoundTrip, JsonReadsBackToTheSamePlan) {
  CAPSTAN_ROUND_TRIP_FILE();
  const Session session = planned(path(), GetParam().reopen);
  const std::string json = written(session.plan, Format::kJson);
  const auto again = read_again(json);
  EXPECT_TRUE(json == written(again, Format::kJson));
  EXPECT_EQ(ledger(session.plan), ledger(again));
  EXPECT_EQ(session.program, written(again, Format::kLinuxCnc));
  EXPECT_EQ(session.table, written(again, Format::kToolTable));
  EXPECT_TRUE(written(session.plan, Format::kIso14649) == written(again, Format::kIso14649));
}

TEST_P(CorpusRoundTrip, ThreadsDoNotMatter) {
  CAPSTAN_ROUND_TRIP_FILE();
  const Session one = planned(path(), GetParam().reopen, 1);
  const Session two = planned(path(), GetParam().reopen, 2);
  EXPECT_EQ(one.program, two.program);
  EXPECT_EQ(one.table, two.table);
  EXPECT_TRUE(written(one.plan, Format::kIso14649) == written(two.plan, Format::kIso14649));
  EXPECT_TRUE(written(one.plan, Format::kJson) == written(two.plan, Format::kJson));
}

INSTANTIATE_TEST_SUITE_P(Files, CorpusRoundTrip,
                         ::testing::Values(Case{"Example1AsGiven", "nist_ex1.stp", Reopen::kNothing},
                                           Case{"Example1All", "nist_ex1.stp", Reopen::kAll},
                                           Case{"Example1Tools", "nist_ex1.stp", Reopen::kTools},
                                           Case{"Example1Technology", "nist_ex1.stp", Reopen::kTechnology},
                                           Case{"ExplicitAsGiven", "nist_ex1E.stp", Reopen::kNothing},
                                           Case{"PlateAll", "meduag_peca_defesa.p21", Reopen::kAll},
                                           Case{"HoleAll", "meduag_furo.p21", Reopen::kAll}),
                         [](const auto& given) { return std::string(given.param.name); });

/// Replaces the feed of a technology's instance in the text by `factor` times it.
std::string edit_feed(const std::string& text, std::uint64_t instance, double factor) {
  const std::regex feed("(\n#" + std::to_string(instance) + "=MILLING_TECHNOLOGY\\()([^,]*),");
  std::smatch found;
  if (!std::regex_search(text, found, feed)) return {};
  const double old = *parse_double(found[2].str());
  return std::string(found.prefix()) + found[1].str() + shortest(old * factor) + "," +
         std::string(found.suffix());
}

TEST(CorpusEditedFile, AnEditedFeedIsGivenAgainAndKept) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1.stp");
  const Session first = planned(path, Reopen::kAll);
  const std::string text = written(first.plan, Format::kIso14649);
  const auto plan = read_again(text);
  // The technology of the pocket's roughing step, whose feed the optimiser bound.
  model::Ref<model::MillingTechnology> technology;
  double feed = 0.0;
  for (const auto& step : first.plan.steps) {
    if (model::step_id(first.plan, step).find("area_rough") != std::string::npos) feed = step.feed_mm_min;
  }
  ASSERT_GT(feed, 0.0);
  for (const auto at : plan.model.all(model::TypeId::kMachiningWorkingstep)) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(at);
    const auto* op = plan.model.get<model::MachiningOperation>(ws->its_operation);
    if (op != nullptr && plan.model.holds<model::BottomAndSideRoughMilling>(ws->its_operation) &&
        ws->its_id.value_or("").find("area_rough") != std::string::npos) {
      technology = model::Ref<model::MillingTechnology>(op->its_technology);
    }
  }
  ASSERT_TRUE(technology.set());
  const auto* bound = plan.ledger.find(technology, "feedrate");
  ASSERT_NE(bound, nullptr);
  EXPECT_NE(bound->binder, model::Binder::kGiven);

  constexpr double kFactor = 0.5;
  const std::string edited = edit_feed(text, plan.model.origin(technology).instance, kFactor);
  ASSERT_FALSE(edited.empty());
  std::vector<Diagnostic> said;
  const auto again = read_again(edited, &said);
  EXPECT_THAT(codes(said, Severity::kNote), ::testing::Contains("EXC-EDITED"));
  const auto* now = again.ledger.find(technology, "feedrate");
  EXPECT_TRUE(now == nullptr || now->binder == model::Binder::kGiven);
  // The others are who they were; what was chosen with it says that it stays, and no limit that held before.
  const auto who = [](const std::string& what) { return what.substr(0, what.find(' ', what.find(' ') + 1)); };
  std::size_t changed = 0;
  const auto before = ledger(plan);
  const auto after = ledger(again);
  for (const auto& [key, what] : before) {
    const auto it = after.find(key);
    changed += it == after.end() || who(it->second) != who(what);
    if (it == after.end() || it->second == what || who(it->second) != who(what)) continue;
    EXPECT_THAT(it->second, ::testing::StartsWith(who(what) + " kept|")) << key;
  }
  EXPECT_EQ(changed, 1U);

  const Session kept = planned_bytes(edited, first.plan.file_name, Reopen::kNothing);
  for (const auto& step : kept.plan.steps) {
    if (model::step_id(kept.plan, step).find("area_rough") == std::string::npos) continue;
    EXPECT_NEAR(step.feed_mm_min, kFactor * feed, 1e-9 * feed);
  }
}

}  // namespace
}  // namespace capstan::corpus
