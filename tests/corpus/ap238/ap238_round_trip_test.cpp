#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "planner/files/exchange/common/text.h"
#include "planner/files/exchange/exchange.h"
#include "planner/files/p21/read/parse.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/differences/model_difference.h"

// ISO 14649 to AP238 and back, and AP238 to AP238: the model stays what it was.

namespace capstan::corpus {
namespace {

using ::testing::IsEmpty;

model::Plan read_file(const std::string& path) {
  Job job;
  auto plan = exchange::read(path, job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  return plan ? *std::move(plan) : model::Plan{};
}
model::Plan read_text(const std::string& bytes, const std::string& name) {
  Job job;
  auto plan = exchange::read_bytes(bytes, name, {}, job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  return plan ? *std::move(plan) : model::Plan{};
}
exchange::Written ap238_of(const model::Plan& plan) {
  Job job;
  auto out = exchange::write_ap238(plan, job);
  EXPECT_TRUE(out) << to_text(out.error());
  return out ? *std::move(out) : exchange::Written{};
}
std::string iso14649_of(const model::Plan& plan) {
  Job job;
  auto out = exchange::write_iso14649(plan, job);
  EXPECT_TRUE(out) << to_text(out.error());
  return out ? std::move(out->bytes) : std::string();
}

/// Compares two ISO 14649 files instance by instance from the project, whatever their numbers; then what it
/// does not reach, by what it says. Names of geometry are left out: AP238 fixes some by role.
class FileDifference {
 public:
  FileDifference(const std::string& a, const std::string& b) {
    Job job;
    const auto first = p21::parse(a, "first", {}, job), second = p21::parse(b, "second", {}, job);
    EXPECT_TRUE(first && second);
    if (!first || !second) return;
    a_ = &*first;
    b_ = &*second;
    for (const p21::Instance x : *first) {
      for (const p21::Instance y : *second) {
        if (x.keyword() == "PROJECT" && y.keyword() == "PROJECT") refer(x.id(), y.id());
      }
    }
    while (!pending_.empty()) {
      const auto [x, y] = pending_.back();
      pending_.pop_back();
      compare(*first->find(x), *second->find(y));
    }
    const auto left = rest(*first, true), right = rest(*second, false);
    std::set_difference(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(found_));
    for (const auto& line : right) {
      if (!left.contains(line)) found_.push_back("only in the second: " + line);
    }
  }
  [[nodiscard]] const std::vector<std::string>& found() const { return found_; }

 private:
  static bool is_named(const p21::Instance& i) {
    const auto kind = model::find_noun(i.keyword());
    return kind && model::is_a(*kind, model::TypeId::kRepresentationItem);
  }

  void refer(std::uint64_t x, std::uint64_t y) {
    reached_[0].insert(x);
    reached_[1].insert(y);
    if (seen_.emplace(x, y).second) pending_.emplace_back(x, y);
  }

  void compare(const p21::Instance& x, const p21::Instance& y) {
    if (x.keyword() != y.keyword() || x.part_count() != y.part_count()) {
      found_.push_back(std::string(x.keyword()) + " and " + std::string(y.keyword()));
      return;
    }
    for (std::size_t k = 0; k < x.part_count(); ++k) {
      const auto p = x.part(k).parameters, q = y.part(k).parameters;
      for (std::size_t i = 0; i < std::max(p.size(), q.size()); ++i) {
        if (i == 0 && is_named(x)) continue;
        if (i >= p.size() || i >= q.size() || !same(p[i], q[i])) {
          found_.push_back(std::string(x.keyword()) + " parameter " + std::to_string(i + 1) + ": " +
                           (i < p.size() ? exchange::spelling(p[i]) : "nothing") + " and " +
                           (i < q.size() ? exchange::spelling(q[i]) : "nothing"));
        }
      }
    }
  }

  bool same(const p21::Value& x, const p21::Value& y) {
    if (x.is(p21::Kind::kReference) && y.is(p21::Kind::kReference)) {
      if (!a_->find(x.reference()) || !b_->find(y.reference())) return false;
      refer(x.reference(), y.reference());
      return true;
    }
    if (x.is(p21::Kind::kList) && y.is(p21::Kind::kList)) {
      if (x.size() != y.size()) return false;
      bool out = true;
      for (std::size_t i = 0; i < x.size(); ++i) out = same(x[i], y[i]) && out;
      return out;
    }
    // AP238 does not tell an empty list from none, and a text that must be there from an empty one.
    const auto nothing = [](const p21::Value& v) {
      return v.is(p21::Kind::kOmitted) || (v.is(p21::Kind::kList) && v.empty()) ||
             (v.is(p21::Kind::kString) && v.as_text().empty());
    };
    if (nothing(x) && nothing(y)) return true;
    return p21::same_content(x, y);
  }

  // What the project does not reach, each with all that it refers to.
  [[nodiscard]] std::multiset<std::string> rest(const p21::File& file, bool first) const {
    std::multiset<std::string> out;
    for (const p21::Instance i : file) {
      if (!reached_[first ? 0 : 1].contains(i.id())) out.insert(unfolded(file, i, 0));
    }
    return out;
  }
  [[nodiscard]] std::string unfolded(const p21::File& file, const p21::Instance& i, int depth) const {
    std::string out(i.keyword());
    for (std::size_t k = 0; k < i.part_count(); ++k) {
      const p21::Value list = i.part(k).parameters;
      for (std::size_t p = 0; p < list.size(); ++p) {
        out += p == 0 ? "(" : ",";
        if (p != 0 || !is_named(i)) out += unfolded(file, list[p], depth);
      }
      out += ")";
    }
    return out;
  }
  [[nodiscard]] std::string unfolded(const p21::File& file, const p21::Value& v, int depth) const {
    if (v.is(p21::Kind::kReference)) {
      const auto i = file.find(v.reference());
      return i && depth < 3 ? unfolded(file, *i, depth + 1) : "#";
    }
    if (v.is(p21::Kind::kString) && v.as_text().empty()) return "$";
    if (v.is(p21::Kind::kList) && v.empty()) return "$";
    if (!v.is(p21::Kind::kList) && !v.is(p21::Kind::kTyped)) return exchange::spelling(v);
    std::string out = v.is(p21::Kind::kTyped) ? std::string(v.keyword()) + "(" : "(";
    for (std::size_t k = 0; k < v.size(); ++k) out += (k == 0 ? "" : ",") + unfolded(file, v[k], depth);
    return out + ")";
  }

  const p21::File* a_ = nullptr;
  const p21::File* b_ = nullptr;
  std::set<std::pair<std::uint64_t, std::uint64_t>> seen_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pending_;
  std::set<std::uint64_t> reached_[2];
  std::vector<std::string> found_;
};

class Iso14649File : public ::testing::TestWithParam<const char*> {
 protected:
  static std::string path() { return testing::corpus_folder() + "/iso14649/" + GetParam(); }
};

#define CAPSTAN_ISO14649_FILES()           \
  CAPSTAN_CORPUS_FILE(unused, "iso14649"); \
  (void)unused

TEST_P(Iso14649File, ComesBackFromAp238AsTheSameModel) {
  CAPSTAN_ISO14649_FILES();
  const model::Plan plan = read_file(path());
  const auto written = ap238_of(plan);
  EXPECT_THAT(written.losses, IsEmpty());
  const model::Plan back = read_text(written.bytes, "back.stpnc");
  EXPECT_EQ(testing::ModelDifference(plan, back, {.item_names = false, .left_out = {}}).text(), "");
}

TEST_P(Iso14649File, IsWrittenFromItsAp238FormAsFromItself) {
  CAPSTAN_ISO14649_FILES();
  const model::Plan plan = read_file(path());
  const model::Plan back = read_text(ap238_of(plan).bytes, "back.stpnc");
  EXPECT_THAT(FileDifference(iso14649_of(plan), iso14649_of(back)).found(), IsEmpty());
}

TEST_P(Iso14649File, IsExplainedByTheTablesOnceItIsAp238) {
  CAPSTAN_ISO14649_FILES();
  Job job;
  const auto bytes = ap238_of(read_file(path())).bytes;
  const auto back = exchange::read_bytes(bytes, "back.stpnc", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  for (const auto& d : job.diagnostics()) EXPECT_NE(d.code, "EXC-KEPT") << to_text(d);
}

TEST_P(Iso14649File, IsWrittenTheSameASecondTime) {
  CAPSTAN_ISO14649_FILES();
  const auto first = ap238_of(read_file(path())).bytes;
  const auto second = ap238_of(read_text(first, GetParam())).bytes;
  const auto third = ap238_of(read_text(second, GetParam())).bytes;
  EXPECT_TRUE(second == third);
}

INSTANTIATE_TEST_SUITE_P(Files, Iso14649File,
                         ::testing::Values("nist_ex1.stp", "nist_ex1E.stp", "nist_tiny.stp",
                                           "meduag_furo.p21", "meduag_peca_defesa.p21", "ufsc_Cavidade.p21",
                                           "ufsc_FuroBaseEsferica.p21", "ufsc_FuroConico.p21",
                                           "ufsc_Ranhura.p21", "ufsc_RanhuraPerfilRoundedU.p21",
                                           "ufsc_RanhuraPerfilVee.p21"),
                         [](const auto& given) {
                           std::string name = given.param;
                           return name.substr(0, name.find('.'));
                         });

/// Who had a part in the revisions of the workpieces.
std::multiset<std::string> people(const model::Plan& plan) {
  const model::Model& m = plan.model;
  std::multiset<std::string> out;
  for (const auto at : m.all(model::TypeId::kWorkpiece)) {
    const auto& w = m.at<model::Workpiece>(at);
    for (const auto person : w.revision_people.items) {
      out.insert(w.its_id.value_or("") + ": " +
                 m.at<model::PersonOrganizationAssignment>(person).role.value_or(""));
    }
  }
  return out;
}

class Ap238File : public ::testing::TestWithParam<const char*> {
 protected:
  static std::string path() { return testing::corpus_folder() + "/ap238/" + GetParam(); }
};

#define CAPSTAN_AP238_FILES()           \
  CAPSTAN_CORPUS_FILE(unused, "ap238"); \
  (void)unused

TEST_P(Ap238File, ComesBackAsTheSameModel) {
  CAPSTAN_AP238_FILES();
  const model::Plan plan = read_file(path());
  const auto written = ap238_of(plan);
  EXPECT_THAT(written.losses, IsEmpty());
  const model::Plan back = read_text(written.bytes, GetParam());
  // A set, in the order of the file: compared as one below.
  const std::vector<std::string> sets = {"WORKPIECE.revision_people"};
  EXPECT_EQ(testing::ModelDifference(plan, back, {.item_names = false, .left_out = sets}).text(), "");
  EXPECT_EQ(people(plan), people(back));
}

TEST_P(Ap238File, IsWrittenTheSameASecondTime) {
  CAPSTAN_AP238_FILES();
  const auto first = ap238_of(read_file(path())).bytes;
  const auto second = ap238_of(read_text(first, GetParam())).bytes;
  EXPECT_TRUE(first == second);
}

INSTANTIATE_TEST_SUITE_P(Files, Ap238File,
                         ::testing::Values("ap238e4dis_annexJ_cc1.stp", "ap238e4dis_annexJ_cc2.stp",
                                           "ap238e4dis_annexJ_cc3.stp",
                                           "exp2_stepnc_maker3_empty_ed3anchors.stpnc"),
                         [](const auto& given) {
                           const std::string name = given.param;
                           return name.starts_with("exp2") ? "exp2" : name.substr(18, 3);
                         });

// Its workpiece and its main workplan are not in the file.
TEST(Ap238Exp2, IsReadWithTheNameOfItsProjectAndBothReferencesToNothingAreTold) {
  CAPSTAN_CORPUS_FILE(path, "ap238/exp2_stepnc_maker3_empty_ed3anchors.stpnc");
  Job job;
  const auto file = p21::parse(testing::slurp(path), "exp2.stpnc", {}, job);
  ASSERT_TRUE(file) << to_text(file.error());
  const auto plan = exchange::read_ap238(*file, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  ASSERT_TRUE(plan->project.set());
  const auto& project = plan->model.at<model::Project>(plan->project);
  EXPECT_EQ(project.its_id, "exp2");
  EXPECT_FALSE(project.main_workplan.set());
  EXPECT_TRUE(project.its_workpieces.empty());
  std::vector<std::string> dangling;
  for (const auto& d : job.diagnostics()) {
    if (d.code == "P21-DANGLING") dangling.push_back(to_text(d));
  }
  EXPECT_THAT(dangling,
              ::testing::ElementsAre(::testing::HasSubstr("exp2.stpnc:45: warning: #11 refers to #20"),
                                     ::testing::HasSubstr("exp2.stpnc:47: warning: #13 refers to #18")));
}

}  // namespace
}  // namespace capstan::corpus
