#include "casebase/record/case.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "casebase/record/encoding.h"
#include "casebase/record/fields.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

/// A case in which every field has a value of its own.
Case full() {
  Case c = sample();
  c.origin = Origin::kEntered;
  double next = 0.0;
  for (const Field& f : fields()) {
    next += 0.001;
    if (const auto* t = std::get_if<TextAt>(&f.at)) (*t)(c) = std::string(f.name);
    if (const auto* n = std::get_if<NumberAt>(&f.at)) (*n)(c) = f.low + next;
    if (const auto* n = std::get_if<CountAt>(&f.at)) (*n)(c) = 3;
    if (const auto* g = std::get_if<FigureAt>(&f.at))
      (*g)(c) = Figure{f.low + next, 0.5 * next, Origin::kSimulated};
    if (const auto* s = std::get_if<SeriesAt>(&f.at))
      (*s)(c) = {{{0.0, 0.1}, {60.0, 0.2 + next}}, Origin::kEntered};
  }
  c.from.time_utc = "2016-06-28T17:32:31Z";
  c.asked.cutter_diameter_mm = 12.0;
  c.bound.vc_m_min = 30.0;
  c.observed.verdict = Verdict::kBad;
  c.id = id_of(c);
  return c;
}

TEST(CaseFields, HaveRisingTagsAndNamesOfTheirOwn) {
  std::set<std::string_view> names;
  int before = 0;
  for (const Field& f : fields()) {
    EXPECT_GT(f.tag, before) << f.name;
    before = f.tag;
    EXPECT_TRUE(names.insert(f.name).second) << f.name;
  }
  EXPECT_EQ(question_fields().back().name, "coolant");
}

TEST(CaseFields, WearTheirUnitInTheirNames) {
  for (const Field& f : fields()) {
    if (f.unit.empty() || f.unit == "1") continue;
    std::string end = "_" + std::string(f.unit == "%" ? "percent" : f.unit);
    std::replace(end.begin(), end.end(), '/', '_');
    std::transform(end.begin(), end.end(), end.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    EXPECT_TRUE(f.name.ends_with(end)) << f.name;
  }
}

TEST(CaseEncoding, ReadsBackToTheSameCase) {
  Case c = full();
  ASSERT_EQ(fault_of(c), std::nullopt);
  auto back = decoded(encoded(c));
  ASSERT_TRUE(back.has_value());
  back->id = c.id;
  EXPECT_EQ(*back, c);
}

TEST(CaseEncoding, RefusesEveryOtherLength) {
  const std::string bytes = encoded(full());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    // A record that ends between two fields is one of fewer fields.
    const auto back = decoded(bytes.substr(0, n));
    if (back) {
      EXPECT_EQ(encoded(*back), bytes.substr(0, n));
    }
  }
  EXPECT_FALSE(decoded(bytes + '\0').has_value());
}

TEST(CaseEncoding, ReadsAnyBytesOrNone) {
  const std::string bytes = encoded(full());
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    std::string broken = bytes;
    for (int n = 0; n <= i % 3; ++n) broken[random() % broken.size()] = static_cast<char>(random());
    const auto back = decoded(broken);
    if (back && !fault_of(*back)) {
      EXPECT_EQ(decoded(encoded(*back)), back);
    }
  }
}

TEST(CaseFault, IsFoundInWrongUnitsAndImpossibleNumbers) {
  EXPECT_EQ(fault_of(sample()), std::nullopt);
  const auto broken = [](auto change) {
    Case c = sample();
    change(c);
    return fault_of(c).has_value();
  };
  EXPECT_TRUE(broken([](Case& c) { c.bound.vc_m_min = 12000.0; }));  // 1/min: 382,000 1/min on 10 mm
  EXPECT_TRUE(broken([](Case& c) { c.bound.fz_mm = 200.0; }));       // mm/min
  EXPECT_TRUE(broken([](Case& c) { c.bound.fz_mm = 0.0; }));
  EXPECT_TRUE(broken([](Case& c) { c.bound.ae_mm = 10.1; }));  // wider than the cutter
  EXPECT_TRUE(broken([](Case& c) { c.observed.time_s = Figure{std::numeric_limits<double>::infinity()}; }));
  EXPECT_TRUE(broken([](Case& c) { c.observed.wear_mm = Figure{std::numeric_limits<double>::quiet_NaN()}; }));
  EXPECT_TRUE(broken([](Case& c) { c.observed.wear_mm = Figure{0.1, -0.01}; }));
  EXPECT_TRUE(broken([](Case& c) { c.asked.teeth = 0; }));
  EXPECT_TRUE(broken([](Case& c) { c.asked.cutter_diameter_mm = 0.0; }));
  EXPECT_TRUE(broken([](Case& c) { c.asked.hardness_hrc = 300.0; }));  // Brinell
  EXPECT_TRUE(broken([](Case& c) { c.from.source = "a\nb"; }));
  EXPECT_TRUE(broken([](Case& c) { c.from.source.clear(); }));
  EXPECT_TRUE(broken([](Case& c) { c.from.time_utc = "28.6.2016"; }));
  EXPECT_TRUE(broken([](Case& c) { c.from.time_utc = "2016-13-28T17:32:31Z"; }));
  EXPECT_TRUE(broken([](Case& c) { c.asked.operation = "DRILLING'; --"; }));
  EXPECT_TRUE(broken([](Case& c) { c.observed.wear_series_mm.samples = {{60.0, 0.1}, {0.0, 0.2}}; }));
  EXPECT_TRUE(broken([](Case& c) { c.observed.wear_series_mm.samples.resize(kMaxSamples + 1); }));
}

TEST(CaseFault, IsFoundInASimulationThatSaysItWasMeasured) {
  Case c = sample();
  c.origin = Origin::kSimulated;
  EXPECT_TRUE(fault_of(c).has_value());  // its time is measured
  c.observed.time_s->origin = Origin::kSimulated;
  EXPECT_EQ(fault_of(c), std::nullopt);
}

TEST(CaseId, DependsOnEverythingButItselfAndTheVerdict) {
  const Case c = sample();
  Case same = c;
  same.id = "other";
  same.bound.allowance_side_mm = -0.0;
  same.observed.verdict = Verdict::kBad;
  EXPECT_EQ(id_of(same), c.id);
  for (auto change : std::vector<void (*)(Case&)>{
           [](Case& x) { x.asked.tolerance_mm = 0.01; },
           [](Case& x) { x.bound.vc_m_min = std::nextafter(30.0, 31.0); }, [](Case& x) { x.asked.teeth = 3; },
           [](Case& x) { x.asked.coolant = Coolant::kDry; }, [](Case& x) { x.from.source = "part 2"; },
           [](Case& x) { x.observed.time_s->std_dev = 0.1; }, [](Case& x) { x.origin = Origin::kEntered; }}) {
    Case other = c;
    change(other);
    EXPECT_NE(id_of(other), c.id);
  }
}

TEST(CaseId, OfASimulationIsThatOfItsPlanStepAndQuestion) {
  Case c = sample();
  c.origin = Origin::kSimulated;
  c.from.plan_hash = "0123456789abcdef0123456789abcdef";
  c.from.workingstep = "WS 1";
  Case again = c;
  again.from.source = "plan other.p21 step WS 1";
  again.observed.time_s->value = 6.5000001;
  EXPECT_EQ(id_of(again), id_of(c));
  Case other = c;
  other.from.workingstep = "WS 2";
  EXPECT_NE(id_of(other), id_of(c));
  other = c;
  other.asked.depth_mm = 21.0;
  EXPECT_NE(id_of(other), id_of(c));
}

TEST(CaseCsv, HoldsEveryField) {
  const auto back = from_csv(to_csv(std::vector{full(), sample()}), "cases.csv");
  ASSERT_TRUE(back.has_value()) << to_text(back.error());
  EXPECT_EQ(*back, (std::vector{full(), sample()}));
}

TEST(CaseCsv, RefusesTextThatIsNotUtf8) {
  Case c = sample(10.0, 30.0, "Bohrung \xC3\x98");
  c.id.clear();
  const std::string text = to_csv(std::vector{c});
  EXPECT_TRUE(from_csv(text, "cases.csv"));
  std::string latin = text;
  latin.replace(latin.find("\xC3\x98"), 2, "\xD8");
  const auto read = from_csv(latin, "cases.csv");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, "CASE-CSV");
  EXPECT_EQ(read.error().line, 2U);
  EXPECT_THAT(read.error().message, ::testing::HasSubstr("source: the text is not UTF-8"));
}

TEST(CaseCsv, RefusesADayThatIsNone) {
  for (const auto& [time, taken] : {std::pair("2024-02-29T08:00:00Z", true),
                                    {"2026-02-30T08:00:00Z", false},
                                    {"2025-02-29T08:00:00Z", false},
                                    {"2026-04-31T08:00:00Z", false}}) {
    Case c = sample();
    c.from.time_utc = time;
    c.id.clear();
    EXPECT_FALSE(fault_of(c)) << time;  // what earlier versions kept is read
    EXPECT_EQ(from_csv(to_csv(std::vector{c}), "cases.csv").has_value(), taken) << time;
    c.id = id_of(c);  // as a base of an earlier version exports it
    const auto kept = from_csv(to_csv(std::vector{c}), "cases.csv");
    EXPECT_TRUE(kept) << time << (kept ? "" : kept.error().message);
    EXPECT_EQ(fault_of(Remark{"Smith", time, "chatter"}).has_value(), !taken) << time;
  }
}

TEST(CaseRemark, IsUtf8) {
  EXPECT_FALSE(fault_of(Remark{"M\xC3\xBCller", "2016-06-29T08:00:00Z", "chatter"}));
  EXPECT_TRUE(fault_of(Remark{"\xFF\xFE", "2016-06-29T08:00:00Z", "chatter"}));
  EXPECT_TRUE(fault_of(Remark{"Smith", "2016-06-29T08:00:00Z", "Maschine l\xE4uft"}));
}

}  // namespace
}  // namespace capstan::casebase
