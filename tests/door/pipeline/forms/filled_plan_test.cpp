#include <gtest/gtest.h>

#include <random>
#include <string>

#include "planner/files/json/fields.h"
#include "tests/support/corpus.h"
#include "tests/support/differences/plan_difference.h"
#include "tests/support/shop.h"
#include "tests/support/soak.h"

// A plan whose every field has a value of its own comes back from each form.

namespace capstan::pipeline {
namespace {

using json::fields;

/// Gives every field of a plain struct of the plan a value; references and shared columns stay.
class Noise {
 public:
  explicit Noise(unsigned seed) : random_(seed) {}

  template <class T>
  void operator()(const char*, T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      x = random_() % 2 == 0;
    } else if constexpr (std::is_integral_v<T>) {
      x = static_cast<T>(1 + random_() % 1000);
    } else if constexpr (std::is_floating_point_v<T>) {
      x = number();
    } else if constexpr (IsText<T>) {
      x = text();
    } else if constexpr (std::is_enum_v<T>) {
      x = static_cast<T>(random_() % json::spellings<T>().size());
    } else if constexpr (json::kIsOptional<T>) {
      if (random_() % 4 != 0) (*this)("", x.emplace());
    } else if constexpr (std::is_base_of_v<model::AnyRef, T> || json::kIsShared<T>) {
    } else if constexpr (json::kIsArray<T>) {
      for (auto& item : x) (*this)("", item);
    } else if constexpr (json::kIsVector<T>) {
      x.clear();
      x.resize(1 + random_() % 3);
      for (auto& item : x) (*this)("", item);
    } else {
      fields(*this, x);
    }
  }

  double number() {
    const double v = std::uniform_real_distribution<double>(0.001, 1000.0)(random_);
    return random_() % 3 == 0 ? std::round(v) : v;
  }
  std::string text() {
    static const std::vector<std::string> kPieces = {"a", "'",  "\\", "Bohrung \xC3\xBC",
                                                     "/", "\"", ";",  "#12"};
    std::string out = "t";
    for (auto n = random_() % 4; n > 0; --n) out += kPieces[random_() % kPieces.size()];
    return out;
  }

 private:
  std::mt19937 random_;
};

/// What planning computed, replaced by noise; the nouns, and what belongs to which of them, stay.
model::Plan filled(model::Plan plan, unsigned seed) {
  Noise noise(seed);
  noise("", plan.machine);
  noise("", plan.material);
  for (auto& c : plan.cutters) {
    const std::string id = c.id;
    noise("", c);
    c.id = id;
  }
  noise("", plan.stock.source);
  noise("", plan.stock.cylinder_radius_mm);
  for (auto& s : plan.setups) {
    noise("", s.work_offset);
    noise("", s.security_z_mm);
    noise("", s.holding);
  }
  for (auto& s : plan.steps) {
    const auto setup = s.setup;
    noise("", s);
    s.setup = setup;
  }
  noise("", plan.provenance);
  for (auto& entry : std::map(plan.ledger.entries())) {
    model::Decision d = entry.second;
    model::Reason why;
    noise("", why);
    noise("", d.binder);
    noise("", d.pinned);
    noise("", d.lexeme);
    noise("", d.rejected);
    d.reason = plan.ledger.reason(why);
    plan.ledger.set(entry.first, d);
  }
  return plan;
}

TEST(WrittenPlanProperty, ReadsBackWithEveryFieldFilledInEachForm) {
  Job job;
  auto in = load_shop({}, job);
  ASSERT_TRUE(in);
  const std::string source = capstan::testing::source_dir();
  auto read = read_plan(testing::slurp(source + "/examples/plate_bound.p21"), "plate_bound.p21", job);
  ASSERT_TRUE(read);
  const auto plan = bind(*std::move(read), *in, {}, job);
  ASSERT_TRUE(plan);
  const bool soak = soaking();
  constexpr unsigned kCount = 10;  // each of the 50 repetitions of a soak takes as many of its own: 500
  const unsigned first =
      soak ? 1 + kCount * static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()) : 1;
  for (unsigned seed = first; seed < first + kCount; ++seed) {
    SCOPED_TRACE(seed);
    const model::Plan full = filled(*plan, seed);
    for (const Format form : {Format::kJson, Format::kIso14649, Format::kAp238}) {
      SCOPED_TRACE(static_cast<int>(form));
      Job quiet, again;
      const auto text = write_plan(full, form, quiet);
      ASSERT_TRUE(text) << to_text(text.error());
      const auto back = read_plan(*text, "plan", again);
      ASSERT_TRUE(back) << to_text(back.error());
      for (const Diagnostic& d : again.diagnostics()) EXPECT_NE(d.code, "EXC-RECORD") << to_text(d);
      testing::DifferenceOptions options;
      options.item_names = form != Format::kAp238;
      ASSERT_EQ(testing::PlanDifference(full, *back, options).text(), "");
    }
  }
}

// A hole's depth as a length below its top, which files have where a plane is due.
TEST(WrittenPlan, WhoseHoleHasALengthForItsDepthReadsBackFromJson) {
  const std::string source = capstan::testing::source_dir();
  std::string text = testing::slurp(source + "/examples/plate_bound.p21");
  const auto hole = text.find("=ROUND_HOLE(");
  ASSERT_NE(hole, std::string::npos);
  // its_id, workpiece, operations (a list), placement, depth
  const auto list = text.find("),", hole);
  const auto placement = text.find(',', list + 2);
  const auto depth = placement + 1, end = text.find(',', depth);
  const auto any = text.find("=TOLERANCED_LENGTH_MEASURE(");
  ASSERT_NE(any, std::string::npos);
  const auto number = text.rfind('#', any);
  text.replace(depth, end - depth, text.substr(number, any - number));
  Job job;
  const auto plan = read_plan(text, "part.p21", job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  const auto depths =
      std::count_if(job.diagnostics().begin(), job.diagnostics().end(), [](const Diagnostic& d) {
        return d.message.find("ROUND_HOLE.depth is a TOLERANCED_LENGTH_MEASURE") != std::string::npos;
      });
  ASSERT_EQ(depths, 1);
  const auto written = write_plan(*plan, Format::kJson, job);
  ASSERT_TRUE(written);
  const auto back = read_plan(*written, "plan.json", job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(testing::PlanDifference(*plan, *back).text(), "");
}

}  // namespace
}  // namespace capstan::pipeline
