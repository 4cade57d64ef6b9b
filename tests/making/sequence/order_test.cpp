#include "planner/making/sequence/order.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace capstan::sequence {
namespace {

using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;

FeatureShape block(ShapeKind kind, std::string name, Vec3 origin, double half, double depth) {
  FeatureShape s;
  s.kind = kind;
  s.name = std::move(name);
  s.frame.origin = origin;
  s.depth_mm = depth;
  s.area = s.reach = geometry::rectangle({-half, -half}, {half, half});
  return s;
}
FeatureShape hole(std::string name, Vec3 origin, double diameter, double depth, bool through = false) {
  FeatureShape s = block(ShapeKind::kHole, std::move(name), origin, 0.5 * diameter, depth);
  s.area = s.reach = geometry::disc({0.0, 0.0}, 0.5 * diameter, 0.01);
  s.diameter.nominal_mm = s.bottom_diameter_mm = diameter;
  s.through = through;
  s.bottom = through ? model::HoleBottom::kThrough : model::HoleBottom::kFlat;
  return s;
}
FeatureShape from_below(FeatureShape s) {
  s.frame.z = {0.0, 0.0, -1.0};
  s.frame.y = {0.0, -1.0, 0.0};
  return s;
}
Item step(std::size_t feature, int in_chain, std::string tool) {
  return {feature, in_chain, "f" + std::to_string(feature) + "." + std::to_string(in_chain), std::move(tool),
          model::TypeId::kDrilling};
}

std::vector<std::size_t> executed(const Order& o) {
  std::vector<std::size_t> out;
  for (const auto& setup : o.setups) out.insert(out.end(), setup.steps.begin(), setup.steps.end());
  return out;
}
Order ordered(const std::vector<FeatureShape>& shapes, const std::vector<Item>& items,
              const Options& options = {}) {
  Job job;
  auto o = order(shapes, items, options, job);
  EXPECT_TRUE(o) << (o ? "" : to_text(o.error()));
  return o ? *o : Order{};
}

// A face from 2 to 0, a pocket in it from 0 to -5, a hole in the pocket's floor, another beside the pocket.
struct Plate {
  std::vector<FeatureShape> shapes{hole("in floor", {0, 0, -5}, 6, 8), hole("beside", {40, 40, 0}, 6, 8),
                                   block(ShapeKind::kPocket, "pocket", {0, 0, 0}, 10, 5),
                                   block(ShapeKind::kFace, "top", {0, 0, 2}, 60, 2)};
  std::vector<Item> items{step(0, 0, "spot"), step(0, 1, "drill"), step(1, 0, "spot"),    step(1, 1, "drill"),
                          step(2, 0, "mill"), step(2, 1, "mill"),  step(3, 0, "facemill")};
};

/// Precedences that an order of items breaks.
std::vector<Precedence> broken(const std::vector<Precedence>& precedences,
                               const std::vector<std::size_t>& executed) {
  std::map<std::size_t, std::size_t> position;
  for (std::size_t i = 0; i < executed.size(); ++i) position.emplace(executed[i], i);
  std::vector<Precedence> out;
  for (const Precedence& p : precedences) {
    const auto a = position.find(p.before);
    const auto b = position.find(p.after);
    if (b == position.end()) continue;  // never executed: nothing came too early
    if (a == position.end() || a->second > b->second) out.push_back(p);
  }
  return out;
}

TEST(Order, PutsFacesFirstAndFloorsBeforeWhatBeginsInThem) {
  const Plate p;
  const Order o = ordered(p.shapes, p.items);
  ASSERT_EQ(o.setups.size(), 1U);
  EXPECT_EQ(o.setups[0].steps, (std::vector<std::size_t>{6, 4, 5, 0, 2, 1, 3}))
      << "the pocket before any hole, so that each tool is loaded once";
  EXPECT_EQ(o.tool_changes, 4U);
  const auto has = [&](std::size_t a, std::size_t b, Cause c) {
    return std::any_of(o.precedences.begin(), o.precedences.end(),
                       [&](const Precedence& q) { return q.before == a && q.after == b && q.cause == c; });
  };
  EXPECT_TRUE(has(6, 4, Cause::kFaceFirst));
  EXPECT_TRUE(has(5, 0, Cause::kLiesIn));
  EXPECT_FALSE(has(5, 2, Cause::kLiesIn)) << "the hole beside the pocket does not wait for it";
  EXPECT_TRUE(has(0, 1, Cause::kChain));
}

TEST(Order, SaysWhichPrecedenceForcedWhat) {
  const Plate p;
  const Order o = ordered(p.shapes, p.items);
  const auto it = std::find_if(o.precedences.begin(), o.precedences.end(),
                               [](const Precedence& q) { return q.cause == Cause::kLiesIn; });
  ASSERT_NE(it, o.precedences.end());
  EXPECT_EQ(it->text, std::string(to_text(ShapeKind::kHole)) +
                          " 'in floor' begins within or at the floor of " +
                          std::string(to_text(ShapeKind::kPocket)) + " 'pocket'");
}

TEST(Order, FindsNothingBrokenInItsOwnOrderAndTheSwappedPairInAnother) {
  const Plate p;
  const Order o = ordered(p.shapes, p.items);
  auto steps = executed(o);
  EXPECT_TRUE(broken(o.precedences, steps).empty());
  std::swap(steps[0], steps[1]);  // the pocket's rough cut before the face
  const auto faults = broken(o.precedences, steps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].before, 6U);
  EXPECT_EQ(faults[0].after, 4U);
}

TEST(Order, GroupsBySideAndDrillsAThroughHoleFromTheSideThatIsThere) {
  std::vector<FeatureShape> shapes{block(ShapeKind::kPocket, "a", {0, 0, 0}, 10, 5),
                                   from_below(block(ShapeKind::kPocket, "b", {0, 0, -20}, 10, 5)),
                                   from_below(block(ShapeKind::kPocket, "c", {50, 0, -20}, 10, 5)),
                                   hole("through", {50, 50, 0}, 6, 20, true)};
  const Order o = ordered(shapes, {step(0, 0, "m"), step(1, 0, "m"), step(2, 0, "m"), step(3, 0, "d")});
  ASSERT_EQ(o.setups.size(), 2U);
  EXPECT_EQ(o.setups[0].direction, (Vec3{0, 0, 1})) << "two steps each: the side that was met first";
  // Without the pocket above there is no set-up from above, and the hole is drilled from below.
  shapes.erase(shapes.begin());
  const Order below = ordered(shapes, {step(0, 0, "m"), step(1, 0, "m"), step(2, 0, "d")});
  ASSERT_EQ(below.setups.size(), 1U);
  EXPECT_EQ(below.setups[0].direction, (Vec3{0, 0, -1}));
  EXPECT_EQ(below.setups[0].steps.size(), 3U);
}

TEST(Order, KeepsDirectionsApartThatDifferByMoreThanTheLimit) {
  FeatureShape tilted = block(ShapeKind::kPocket, "t", {0, 0, 0}, 5, 2);
  tilted.frame.z = geometry::normalised({0.0, 3e-6, 1.0});
  const Order o =
      ordered({block(ShapeKind::kPocket, "a", {50, 0, 0}, 5, 2), tilted}, {step(0, 0, "m"), step(1, 0, "m")});
  EXPECT_EQ(o.setups.size(), 2U);
}

TEST(Order, LetsAGivenPrecedenceWinAndReportsWhatItDropped) {
  const Plate p;
  Options options;
  options.given = {{1, 4}};  // the hole in the floor is drilled before the pocket
  const Order o = ordered(p.shapes, p.items, options);
  ASSERT_TRUE(o.cannot.empty()) << o.cannot;
  const auto steps = executed(o);
  EXPECT_LT(std::find(steps.begin(), steps.end(), 1U), std::find(steps.begin(), steps.end(), 4U));
  ASSERT_EQ(o.dropped.size(), 1U);
  EXPECT_EQ(o.dropped[0].cause, Cause::kLiesIn);
}

TEST(Order, NamesTheStepsOfACycle) {
  const Plate p;
  Options options;
  options.given = {{0, 2}, {2, 0}};
  const Order o = ordered(p.shapes, p.items, options);
  EXPECT_TRUE(o.setups.empty());
  EXPECT_EQ(std::set<std::size_t>(o.cycle.begin(), o.cycle.end()), (std::set<std::size_t>{0, 2}));
  EXPECT_NE(o.cannot.find("'f0.0' before 'f1.0'"), std::string::npos) << o.cannot;
}

TEST(Order, VisitsASideTwiceWhenStepsDependOnEachOtherAcrossSides) {
  const std::vector<FeatureShape> shapes{block(ShapeKind::kPocket, "a", {0, 0, 0}, 10, 5),
                                         from_below(block(ShapeKind::kPocket, "b", {0, 0, -20}, 10, 5)),
                                         block(ShapeKind::kPocket, "c", {50, 0, 0}, 10, 5)};
  Options options;
  options.given = {{0, 1}, {1, 2}};
  const Order o = ordered(shapes, {step(0, 0, "m"), step(1, 0, "m"), step(2, 0, "m")}, options);
  EXPECT_EQ(executed(o), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(o.setups.size(), 3U);
}

TEST(Order, RefusesAStepWithoutAFeature) {
  Job job;
  const auto o = order({}, {step(3, 0, "m")}, {}, job);
  ASSERT_FALSE(o);
  EXPECT_EQ(o.error().code, "SEQ-INDEX");
}

// n holes on a grid, some in pockets, under one face; tools by size.
std::pair<std::vector<FeatureShape>, std::vector<Item>> many(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<FeatureShape> shapes{block(ShapeKind::kFace, "top", {0, 0, 1}, 1e5, 1)};
  std::vector<Item> items{step(0, 0, "face")};
  const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(n))) + 1;
  for (std::size_t i = 1; i < n; ++i) {
    const Vec3 at{30.0 * static_cast<double>(i % columns), 30.0 * static_cast<double>(i / columns), 0.0};
    const std::string size = std::to_string(4 + random() % 5);
    if (random() % 3 == 0) {
      shapes.push_back(block(ShapeKind::kPocket, "p", at, 10, 5));
      items.push_back(step(i, 0, "mill " + size));
      items.push_back(step(i, 1, "mill " + size));
    } else {
      shapes.push_back(hole("h", at, 5, 10));
      items.push_back(step(i, 0, "spot"));
      items.push_back(step(i, 1, "drill " + size));
    }
  }
  return {shapes, items};
}

TEST(Order, KeepsEveryPrecedenceOnRandomPartsWithEachToolLoadedOnce) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto [shapes, items] = many(200, seed);
    const Order o = ordered(shapes, items);
    const auto steps = executed(o);
    ASSERT_EQ(std::set<std::size_t>(steps.begin(), steps.end()).size(), items.size());
    EXPECT_TRUE(broken(o.precedences, steps).empty());
    std::set<std::string> tools;
    for (const Item& item : items) tools.insert(item.cutter_id);
    EXPECT_EQ(o.tool_changes, tools.size()) << "no chain forces a second visit here";
    EXPECT_EQ(executed(ordered(shapes, items)), steps);
  }
}

TEST(Datums, ComeFirstWithTheirReason) {
  // Two like holes with one drill: by number the first would come first.
  const std::vector<FeatureShape> shapes{hole("H1", {0, 0, 0}, 6, 8), hole("H2", {40, 0, 0}, 6, 8)};
  const std::vector<Item> items{step(0, 0, "drill"), step(1, 0, "drill")};
  Options options;
  options.wishes.push_back({1, 0, "datum B first"});
  const Order o = ordered(shapes, items, options);
  EXPECT_EQ(executed(o), (std::vector<std::size_t>{1, 0}));
  ASSERT_EQ(o.precedences.size(), 1U);
  EXPECT_EQ(o.precedences[0].cause, Cause::kDatum);
  EXPECT_EQ(o.precedences[0].text, "datum B first");
}

TEST(Datums, GiveWayToWhatMustHold) {
  const Plate p;
  Options options;
  options.wishes.push_back({0, 2, "the hole in the floor before its pocket"});
  options.wishes.push_back({1, 2, "the hole beside it before the pocket"});
  options.wishes.push_back({2, 1, "and the other way round"});
  const Order o = ordered(p.shapes, p.items, options);
  ASSERT_EQ(o.dropped.size(), 2U);
  EXPECT_EQ(o.dropped[0].text, "the hole in the floor before its pocket");
  EXPECT_EQ(o.dropped[1].text, "and the other way round");
  EXPECT_TRUE(broken(o.precedences, executed(o)).empty());
}

TEST(Datums, DecideWhichSideIsFirstButCostNoFurtherClamping) {
  // The datum is cut from below; above there is a hole that refers to it, and one that does not.
  std::vector<FeatureShape> shapes{hole("H1", {0, 0, 0}, 6, 8), hole("H2", {40, 0, 0}, 6, 8),
                                   from_below(block(ShapeKind::kPocket, "datum", {0, 0, -30}, 5, 4))};
  const std::vector<Item> items{step(0, 0, "drill"), step(1, 0, "drill"), step(2, 0, "mill")};
  Options options;
  options.directions = {{0, 0, 1}, {0, 0, -1}};
  options.wishes.push_back({2, 0, "datum first"});
  const Order o = ordered(shapes, items, options);
  ASSERT_EQ(o.setups.size(), 2U);
  EXPECT_EQ(o.setups[0].steps, (std::vector<std::size_t>{2}));
  // A second datum above, for something below: one of the two has to give way, and no side comes twice.
  shapes.push_back(from_below(hole("H3", {60, 0, -30}, 6, 8)));
  std::vector<Item> more = items;
  more.push_back(step(3, 0, "drill"));
  options.wishes.push_back({1, 3, "the other datum first"});
  const Order both = ordered(shapes, more, options);
  EXPECT_EQ(both.setups.size(), 2U);
  EXPECT_EQ(both.dropped.size(), 2U);
}

}  // namespace
}  // namespace capstan::sequence
