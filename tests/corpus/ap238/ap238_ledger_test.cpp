#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "planner/files/exchange/ap238/tables/addresses.h"
#include "planner/files/exchange/exchange.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "tests/corpus/session.h"
#include "tests/support/corpus.h"

// Who bound what, and why, in plans that went through AP238.

namespace capstan::corpus {
namespace {

using ::testing::IsEmpty;

/// The ledger by names that do not depend on instance numbers.
std::map<std::string, std::string> ledger(const model::Plan& plan) {
  // What a re-opened decision replaced is no part of the plan any more.
  std::vector<model::AnyRef> roots = {plan.project};
  roots.insert(roots.end(), plan.kept.begin(), plan.kept.end());
  const auto alive = model::reachable(plan.model, roots);
  const std::set<model::AnyRef> there(alive.begin(), alive.end());
  const exchange::ap238::Addresses names(plan, [&](model::AnyRef at) -> std::uint64_t {
    const auto n = plan.model.origin(at).instance;
    return !there.contains(at) ? 0 : n != 0 ? n : 1'000'000 + at.index;
  });
  const auto place = [&](const model::DecisionKey& k) {
    return names.from({}, k.object) + "." + k.attribute;
  };
  std::map<std::string, std::string> out;
  for (const auto& [key, d] : plan.ledger.entries()) {
    if (names.order(key.object) == 0) continue;
    const auto& why = plan.ledger.reason(d.reason);
    std::string text = std::string(d.state == model::DecisionState::kOpen ? "open " : "bound ") +
                       std::string(model::to_text(d.binder)) + (d.pinned ? " pinned " : " ") + why.id + "|" +
                       why.text + "|" + why.source + "|" + d.lexeme + "|";
    std::set<std::string> needs;
    for (const auto& k : d.depends_on) {
      if (names.order(k.object) != 0) needs.insert(place(k));
    }
    for (const auto& n : needs) text += n + " ";
    for (const auto& r : d.rejected) text += "; not " + r.what + ": " + r.why;
    out[place(key)] = text;
  }
  return out;
}

std::string written(const model::Plan& plan) {
  Job job;
  auto out = exchange::write_ap238(plan, job);
  EXPECT_TRUE(out) << to_text(out.error());
  return out ? std::move(out->bytes) : std::string();
}

model::Plan read_again(const std::string& bytes, std::vector<std::string>* said = nullptr) {
  Job job;
  auto plan = exchange::read_bytes(bytes, "plan.stpnc", {}, job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  for (const auto& d : job.diagnostics()) {
    if (said != nullptr) said->push_back(to_text(d));
  }
  return plan ? *std::move(plan) : model::Plan{};
}

/// What differs between two ledgers, a line each.
std::vector<std::string> differences(const std::map<std::string, std::string>& a,
                                     const std::map<std::string, std::string>& b) {
  std::vector<std::string> out;
  for (const auto& [key, what] : a) {
    const auto it = b.find(key);
    if (it == b.end()) {
      out.push_back("lost " + key + ": " + what);
    } else if (it->second != what) {
      out.push_back("was " + key + ": " + what + " is " + it->second);
    }
  }
  for (const auto& [key, what] : b) {
    if (!a.contains(key)) out.push_back("new " + key + ": " + what);
  }
  return out;
}

void expect_kept(const model::Plan& plan) {
  std::vector<std::string> said;
  const auto again = read_again(written(plan), &said);
  const auto before = ledger(plan);
  EXPECT_GT(before.size(), 20U);
  EXPECT_THAT(differences(before, ledger(again)), IsEmpty());
  for (const auto& s : said) EXPECT_EQ(s.find("EXC-RECORD"), std::string::npos) << s;
  EXPECT_EQ(again.machine.id, plan.machine.id);
  EXPECT_EQ(again.material, plan.material);
  EXPECT_EQ(again.cutters, plan.cutters);
  EXPECT_EQ(again.provenance, plan.provenance);
  EXPECT_EQ(again.stock.box, plan.stock.box);
  ASSERT_EQ(again.setups.size(), plan.setups.size());
  for (std::size_t i = 0; i < plan.setups.size(); ++i) {
    EXPECT_EQ(again.setups[i].work_offset, plan.setups[i].work_offset);
    EXPECT_EQ(again.setups[i].security_z_mm, plan.setups[i].security_z_mm);
  }
  ASSERT_EQ(again.steps.size(), plan.steps.size());
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const auto &x = again.steps[i], &y = plan.steps[i];
    EXPECT_EQ(model::step_id(again, x), model::step_id(plan, y));
    EXPECT_EQ(std::tie(x.setup, x.cutter_id, x.axial_depth_mm, x.radial_depth_mm, x.vc_m_min, x.fz_mm,
                       x.spindle_rpm, x.feed_mm_min, x.flood, x.mist, x.cutting_s, x.rapid_s),
              std::tie(y.setup, y.cutter_id, y.axial_depth_mm, y.radial_depth_mm, y.vc_m_min, y.fz_mm,
                       y.spindle_rpm, y.feed_mm_min, y.flood, y.mist, y.cutting_s, y.rapid_s));
  }
}

std::string bracket() { return capstan::testing::source_dir() + "/examples/bracket.p21"; }

TEST(Ap238Ledger, OfTheBracketComesBackEqual) { expect_kept(planned(bracket(), Reopen::kNothing).plan); }

TEST(Ap238Ledger, OfTheFirstExampleComesBackEqual) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1.stp");
  expect_kept(planned(path, Reopen::kAll).plan);
}

TEST(Ap238Ledger, AnEditedFeedIsGivenAgain) {
  const auto plan = planned(bracket(), Reopen::kNothing).plan;
  std::string bytes = written(plan);
  // The first feed that the optimiser bound.
  const std::regex feed("('(?:feedrate|feed speed)',NUMERIC_MEASURE\\()([0-9.E+-]+)\\)");
  std::smatch found;
  // Before it stands the feed that the plan asks of a machine.
  const auto machine = bytes.find("RESOURCE_PROPERTY('feedrate'");
  ASSERT_NE(machine, std::string::npos);
  const std::string rest = bytes.substr(machine);
  ASSERT_TRUE(std::regex_search(rest, found, feed));
  const std::string edited = bytes.substr(0, machine) + std::string(found.prefix()) + found[1].str() +
                             "123.25)" + std::string(found.suffix());
  std::vector<std::string> said;
  const auto again = read_again(edited, &said);
  EXPECT_THAT(said, ::testing::Contains(::testing::HasSubstr(
                        "MILLING_TECHNOLOGY.feedrate was edited since it was bound by")));
  const auto changed = differences(ledger(plan), ledger(again));
  // The feed is given now; what was chosen together with it says that it stays.
  std::size_t feeds = 0;
  for (const std::string& c : changed) {
    const bool feed_itself = c.find("feedrate") != std::string::npos && c.find(" kept|") == std::string::npos;
    feeds += feed_itself ? 1U : 0U;
    EXPECT_TRUE(feed_itself || c.find(" kept|") != std::string::npos) << c;
  }
  EXPECT_EQ(feeds, 1U);
}

}  // namespace
}  // namespace capstan::corpus
