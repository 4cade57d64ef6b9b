#include <random>

#include "rules/facts/facts.h"
#include "rules/facts/it_grade.h"
#include "rules/rules.h"
#include "tests/rules/shop.h"

// Proofs by `check` against what happens when features are drawn at random.

namespace capstan::rules {
namespace {

using model::FeatureShape;
using model::HoleBottom;
using model::ShapeKind;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> findings(const RuleBase& base) {
  std::vector<std::string> out;
  for (const auto& f : check(base)) out.push_back(f.text());
  return out;
}

// The shipped tables with a text changed: what a faulty edit of them would be.
RuleBase edited(const std::string& file, const std::string& from, const std::string& to) {
  auto texts = shipped_texts();
  bool done = false;
  for (auto& [name, text] : texts) {
    if (name.substr(name.rfind('/') + 1) != file + ".yaml") continue;
    const std::size_t at = text.find(from);
    if (at == std::string::npos) continue;
    text.replace(at, from.size(), to);
    done = true;
  }
  EXPECT_TRUE(done) << from << " does not stand in " << file;
  auto base = rules_from_texts(texts);
  EXPECT_TRUE(base) << to_text(base.error());
  return base ? *std::move(base) : RuleBase{};
}

TEST(ShippedTables, SpeakOfEveryKindOfFeature) {
  std::vector<std::string_view> shapes;
  for (const ShapeTable& pair : shape_tables()) {
    shapes.push_back(pair.shape);
    EXPECT_NE(shipped().table(pair.table), nullptr) << pair.table;
  }
  for (int k = 0; k <= static_cast<int>(ShapeKind::kToolpath); ++k) {
    FeatureShape s;
    s.kind = static_cast<ShapeKind>(k);
    s.depth_mm = 5.0;
    const std::string_view symbol = facts_of(s, {}).facts.symbol("shape");
    EXPECT_THAT(shapes, Contains(symbol)) << to_text(s.kind);
  }
  const auto& all = fact_types()[*find_fact("shape")].symbols;
  EXPECT_EQ(shapes.size(), all.size()) << "and of every symbol of fact shape";
}

TEST(Check, NamesAKindOfFeatureWithoutATable) {
  RuleBase base = shipped();
  std::erase_if(base.tables, [](const Table& t) { return t.name == "slot"; });
  EXPECT_THAT(findings(base), ElementsAre("slot: no table: nothing speaks of shape in {slot}"));
}

TEST(Check, NamesAGapThatAnEditOfTheShippedTablesLeaves) {
  EXPECT_THAT(findings(edited("demand", "shape: [hole], ra_um: {from: 0.8, below: 1.6}",
                              "shape: [hole], ra_um: {from: 1, below: 1.6}")),
              ElementsAre("texture: gap: no row for shape in {hole}, ra_um in [0.8, 1)"));
  EXPECT_THAT(findings(edited("thread", "hardness_hb: {from: 420}", "hardness_hb: {from: 430}")),
              testing::IsEmpty())
      << "rows below decide what was too hard; nothing is undecided";
}

TEST(Check, NamesAContradictionThatAnEditOfTheShippedTablesMakes) {
  EXPECT_THAT(findings(edited("thread", "{from: 0.5, below: 3}", "{from: 0.5, below: 4}")),
              Contains(HasSubstr("contradiction")));
  EXPECT_THAT(
      findings(edited("thread", "{from: 0, below: 0.5}", "{from: 0, below: 0.75}")),
      ElementsAre("thread: contradiction: thread.mill.short and thread.no_room conclude differently for "
                  "thread_major_mm in [1, 2000), thread_runout_pitches in [0.5, "
                  "0.75)"));
}

TEST(Check, NamesARowThatAnEditOfTheShippedTablesKills) {
  EXPECT_THAT(
      findings(edited("thread", "{thread_runout_pitches: {from: 3}, hardness_hb: {from: 420}}",
                      "{thread_major_mm: {from: 0, below: 1}}")),
      Contains(
          "thread: dead row: thread.mill.hard never decides: better rows cover thread_major_mm in [0, 1)"));
}

TEST(Check, CountsACatchAllInTheShippedTablesAsAGap) {
  const auto base = edited("face", "rows:\n", "rows:\n  - {id: all, priority: 999, cannot: x, source: x}\n");
  EXPECT_THAT(findings(base), ElementsAre("face: dead row: all never decides: better rows cover everything"));
  const auto alone = rules_from_texts(
      {{"f.yaml", "table: face\nfacts: [depth_mm]\nrows:\n  - {id: all, cannot: x, source: x}\n"}});
  EXPECT_EQ(check_tables(*alone).front().text(), "face: gap: no row for everything");
}

TEST(Check, NamesAChainThatDoesNotLeaveTheTextureItsRowsAccept) {
  EXPECT_THAT(
      findings(edited("capability", "{action: ream, finest_grade: 7, finest_ra_um: 0.8",
                      "{action: ream, finest_grade: 7, finest_ra_um: 1.2")),
      Contains(HasSubstr("hole.ream.it7 has a chain that does not hold shape in {hole}, ra_um in [0.8, 1.2) "
                         "(accepted by texture.hole.bored)")));
}

TEST(Check, NamesAChainThatDoesNotKeepThePositionItsRowsAccept) {
  EXPECT_THAT(
      findings(edited("demand", "values: {as_grade: 9, machined: 1}", "values: {as_grade: 9}")),
      Contains(HasSubstr("hole.ream.it9 has a chain that does not hold shape in {hole}, position_mm in "
                         "[0.05, 0.2) (accepted by position.hole.milled)")));
}

TEST(ShippedTables, DecideEveryDrawnCombinationOfFactsOnce) {
  std::mt19937 random(7);
  for (const Table& table : shipped().tables) {
    for (int round = 0; round < 2000; ++round) {
      Facts facts;
      for (std::size_t i = 0; i < table.facts.size(); ++i) {
        const FactType& type = fact_types()[table.facts[i]];
        if (type.kind == FactKind::kSymbol) {
          facts.set(type.name, type.symbols[random() % type.symbols.size()]);
          continue;
        }
        // Ends of intervals of the rows themselves, or anything between.
        const Side& side = table.rows[random() % table.rows.size()].when[i];
        const double value = random() % 2 == 0
                                 ? side.from
                                 : std::uniform_real_distribution<double>(type.from, type.below)(random);
        facts.set(type.name, type.kind == FactKind::kInteger ? std::floor(value) : value);
      }
      const Row* row = decide(table, facts);
      ASSERT_NE(row, nullptr) << table.name;
      EXPECT_TRUE(row->conditional) << row->id;
    }
  }
}

std::optional<double> best(const std::vector<model::ProposedStep>& chain,
                           std::optional<double> (*claim)(const Capability&)) {
  std::optional<double> out;
  for (const auto& step : chain) {
    const Capability* c = shipped().capability(step.name.substr(step.name.rfind(' ') + 1));
    const auto v = c == nullptr ? std::nullopt : claim(*c);
    if (v) out = std::min(out.value_or(1e9), *v);
  }
  return out;
}

FeatureShape drawn(std::mt19937& random) {
  const auto any = [&](auto... v) {
    const double all[] = {static_cast<double>(v)...};
    return all[random() % std::size(all)];
  };
  FeatureShape s;
  s.kind = static_cast<ShapeKind>(random() % (static_cast<unsigned>(ShapeKind::kToolpath) + 1));
  s.name = "F";
  s.depth_mm = any(0.2, 3, 12, 40, 200);
  s.diameter.nominal_mm = s.bottom_diameter_mm = any(0.4, 1, 2.5, 6, 12, 24.9, 40);
  s.bottom = static_cast<HoleBottom>(random() % 5);
  s.bottom_angle_rad = any(0.54, 0.6, 0.785);
  s.bottom_hole_radius_mm = s.bottom == HoleBottom::kSpherical ? 0.5 * s.diameter.nominal_mm : 0.3;
  s.through = s.bottom == HoleBottom::kThrough;
  s.area = s.reach = geometry::rounded_rectangle({0, 0}, {80, 40}, any(2, 8));
  s.open = random() % 2 == 0;
  s.width.nominal_mm = 40.0;
  s.slope_rad = any(0, 0, 0.1);
  s.thread_major_mm = any(2, 10, 30);
  s.thread_pitch_mm = 1.5;
  s.thread_depth_mm = 0.5 * s.depth_mm;
  s.chamfer_width_mm = 1.0;
  s.chamfer_angle_rad = any(0.1, 0.785, 1.5);
  s.round_radius_mm = any(0.1, 2, 50);
  const int grade = static_cast<int>(any(0, 5, 7, 9, 11, 14));
  for (model::Toleranced* t : {&s.diameter, &s.width}) {
    if (grade == 0) continue;
    t->upper_mm = standard_tolerance_mm(grade, t->nominal_mm);
    t->given = true;
  }
  return s;
}

// An oracle of its own for the chains: whatever is proposed holds, by capability.yaml, what was asked.
TEST(Proposals, OfFeaturesDrawnAtRandomHoldWhatIsAskedOrSayWhyNot) {
  std::mt19937 random(2024);
  int planned = 0, refused = 0;
  for (int round = 0; round < 1500; ++round) {
    const FeatureShape s = drawn(random);
    Context c;
    static constexpr const char* kGroups[] = {"P", "M", "K", "N", "S", "H", ""};
    c.material.iso_group = kGroups[random() % 7];
    const double zones[] = {0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 5.0};
    const double textures[] = {0.4, 0.8, 1.6, 3.2, 6.3, 12.5};
    if (random() % 3 == 0) c.quality.ra_um = textures[random() % 6];
    if (random() % 3 == 0) c.quality.location_mm = zones[random() % 7];
    if (random() % 3 == 0) c.quality.form_mm = zones[random() % 7];
    c.abilities.probe = random() % 2 == 0;
    c.abilities.rigid_tapping = random() % 2 == 0;
    c.has_through_coolant = random() % 2 == 0;
    c.batch = random() % 2 == 0 ? 1 : 1000;
    if (random() % 3 == 0) c.wall_thickness_mm = 0.5;
    if (random() % 3 == 0) c.floor_thickness_mm = 0.5;
    const auto p = propose(shipped(), s, c);
    ASSERT_NE(p.chains.empty(), p.cannot.empty()) << to_text(s.kind);
    ++(p.chains.empty() ? refused : planned);
    for (const auto& chain : p.chains) {
      const auto ra = best(chain, [](const Capability& k) { return k.finest_ra_um; });
      if (ra && c.quality.ra_um) {
        EXPECT_LE(*ra, *c.quality.ra_um) << chain.front().why.id;
      }
      const auto form = best(chain, [](const Capability& k) { return k.form_mm; });
      if (form && c.quality.form_mm) {
        EXPECT_LE(*form, *c.quality.form_mm) << chain.front().why.id;
      }
      const auto zone = best(chain, [](const Capability& k) { return k.position_mm; });
      if (zone && c.quality.location_mm && s.kind != ShapeKind::kThread) {
        EXPECT_LE(*zone, *c.quality.location_mm) << chain.front().why.id;
      }
      const auto grade = best(chain, [](const Capability& k) -> std::optional<double> {
        return k.finest_grade ? std::optional<double>(*k.finest_grade) : std::nullopt;
      });
      const int asked = grade_of_width(s.diameter.nominal_mm, s.diameter.width());
      if (grade && s.kind == ShapeKind::kHole && s.diameter.given) {
        EXPECT_LE(*grade, asked) << chain.front().why.id;
      }
    }
  }
  EXPECT_GT(planned, 200);
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace capstan::rules
