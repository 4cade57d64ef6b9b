// The order of steps by the number of features, from 2000 to 16000: it stays well below quadratic (see the
// line BigO). Holes on a grid, a third of them pockets, under one face; five sizes of tools.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "planner/making/sequence/order.h"

namespace capstan::sequence {
namespace {

using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;

FeatureShape square(ShapeKind kind, Vec3 origin, double half, double depth) {
  FeatureShape s;
  s.kind = kind;
  s.frame.origin = origin;
  s.depth_mm = depth;
  s.area = s.reach = geometry::rectangle({-half, -half}, {half, half});
  return s;
}

Item step(std::size_t feature, int in_chain, std::string cutter) {
  Item i;
  i.feature = feature;
  i.in_chain = in_chain;
  i.cutter_id = std::move(cutter);
  return i;
}

void order_features(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  std::mt19937 random(7);
  std::vector<FeatureShape> shapes{square(ShapeKind::kFace, {0, 0, 1}, 1e5, 1)};
  std::vector<Item> items{step(0, 0, "face")};
  const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(n))) + 1;
  for (std::size_t i = 1; i < n; ++i) {
    const Vec3 at{30.0 * static_cast<double>(i % columns), 30.0 * static_cast<double>(i / columns), 0.0};
    const std::string size = std::to_string(4 + random() % 5);
    const bool pocket = random() % 3 == 0;
    shapes.push_back(square(pocket ? ShapeKind::kPocket : ShapeKind::kHole, at, pocket ? 10 : 2.5, 5));
    items.push_back(step(i, 0, pocket ? "mill " + size : "spot"));
    items.push_back(step(i, 1, (pocket ? "mill " : "drill ") + size));
  }
  std::size_t setups = 0;
  for (auto _ : state) {
    Job job;
    const auto o = order(shapes, items, {}, job);
    setups = o ? o->setups.size() : 0;
  }
  if (setups == 0) std::abort();
  state.SetComplexityN(state.range(0));
}
BENCHMARK(order_features)
    ->RangeMultiplier(2)
    ->Range(2000, 16000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

}  // namespace
}  // namespace capstan::sequence
