#include <chrono>

#include "rules/rules.h"

namespace capstan::rules {
namespace {

TEST(Propose, TakesTimeInProportionToTheFeatures) {
  Job job;
  const auto base = load_rules("", job);
  ASSERT_TRUE(base);
  const auto seconds = [&](int n) {
    std::vector<model::FeatureShape> shapes;
    for (int i = 0; i < n; ++i) {
      model::FeatureShape s;
      s.kind = i % 2 == 0 ? model::ShapeKind::kPocket : model::ShapeKind::kHole;
      s.name = std::to_string(i);
      s.depth_mm = 5.0;
      s.bottom = model::HoleBottom::kThrough;
      s.diameter.nominal_mm = s.bottom_diameter_mm = 5.0 + 0.01 * i;
      s.area = s.reach = geometry::rounded_rectangle({0, 0}, {40.0 + 0.1 * i, 30.0}, 4.0);
      shapes.push_back(std::move(s));
    }
    const auto start = std::chrono::steady_clock::now();
    for (const auto& s : shapes) {
      const auto p = propose(*base, s, {});
      EXPECT_TRUE(!p.chains.empty() || !p.cannot.empty());
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  seconds(50);
  const double small = std::min(seconds(100), seconds(100));
  const double large = seconds(400);
  RecordProperty("ms_per_feature", std::to_string(1e3 * large / 400));
  EXPECT_LT(large, 10.0 * small + 0.05) << small << " s, " << large << " s";
}

}  // namespace
}  // namespace capstan::rules
