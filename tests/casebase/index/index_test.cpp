#include "casebase/index/index.h"
#include "tests/support/soak.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

namespace capstan::casebase {
namespace {

using Row = std::array<double, 4>;
using Make = std::unique_ptr<Index> (*)(Points);
constexpr Row kAlike = {1.0, 1.0, 1.0, 1.0};

/// An index over rows of four, each dimension counting alike unless a weight is said.
class Of4 {
 public:
  Of4(Make make, const std::vector<Row>& rows) {
    Points points;
    points.dimensions = 4;
    for (const Row& r : rows) points.values.insert(points.values.end(), r.begin(), r.end());
    index_ = make(std::move(points));
  }
  const Of4* operator->() const { return this; }
  [[nodiscard]] std::vector<Hit> nearest(const Row& q, std::size_t k, const Row& weight = kAlike) const {
    return index_->nearest({q, weight}, k);
  }
  [[nodiscard]] std::vector<Hit> within(const Row& q, double limit2, const Row& weight = kAlike) const {
    return index_->within({q, weight}, limit2);
  }

 private:
  std::unique_ptr<Index> index_;
};

std::vector<Row> random_points(std::size_t n, unsigned seed, bool on_grid) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-8.0, 8.0);
  std::vector<Row> out(n);
  for (Row& p : out) {
    for (double& v : p) v = on_grid ? std::floor(any(random) / 4.0) : any(random);
  }
  return out;
}

/// What every index promises, whatever it is made of.
class IndexContract : public testing::TestWithParam<Make> {
 protected:
  void SetUp() override {
    if (GetParam() == &make_index && !built_with_flann())
      GTEST_SKIP()
          << "this build is without FLANN: it searches with the built-in tree, which is tested as `tree`";
  }
};

TEST_P(IndexContract, HoldsNoPointAndFindsNone) {
  const auto index = Of4(GetParam(), {});
  EXPECT_TRUE(index->nearest({}, 3).empty());
  EXPECT_TRUE(index->within({}, 1e9).empty());
}

TEST_P(IndexContract, OrdersEqualDistancesByRow) {
  const auto index = Of4(GetParam(), std::vector<Row>(100, Row{1, 2, 3, 4}));
  const auto hits = index->nearest({1, 2, 3, 4}, 5);
  ASSERT_EQ(hits.size(), 5u);
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i], (Hit{i, 0.0}));
}

TEST_P(IndexContract, TakesItsLimitAsWithin) {
  const auto index = Of4(GetParam(), {Row{3, 4, 0, 0}, Row{0, 0, 5.0000001, 0}, Row{0, 0, 0, -5}});
  const auto hits = index->within({}, 25.0);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].row, 0u);
  EXPECT_EQ(hits[1].row, 2u);
}

TEST_P(IndexContract, RejectsWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)Of4(GetParam(), {Row{0, nan, 0, 0}}), std::logic_error);
  EXPECT_THROW((void)Of4(GetParam(), {Row{0, 0, inf, 0}}), std::logic_error);
  const auto index = Of4(GetParam(), {Row{}});
  EXPECT_THROW((void)index->nearest({nan, 0, 0, 0}, 1), std::logic_error);
  EXPECT_THROW((void)index->within({0, 0, 0, -inf}, 1.0), std::logic_error);
}

TEST_P(IndexContract, GivesTheSameRowsAndBitsAsTheReferee) {
  unsigned seed = 1;
  for (const std::size_t n : {1u, 2u, 9u, 10u, 11u, 100u, 3000u}) {
    for (const bool on_grid : {false, true}) {
      const std::vector<Row> points = random_points(n, ++seed, on_grid);
      const auto index = Of4(GetParam(), points);
      const auto referee = Of4(&make_linear_index, points);
      for (const bool grid_question : {false, true}) {
        for (const Row& q : random_points(20, ++seed, grid_question)) {
          for (const std::size_t k : {0u, 1u, 3u, 64u, 5000u})
            ASSERT_EQ(index->nearest(q, k), referee->nearest(q, k));
          for (const double limit : {-1.0, 0.0, 0.25, 16.0, 1e6})
            ASSERT_EQ(index->within(q, limit), referee->within(q, limit));
        }
      }
    }
  }
}

TEST_P(IndexContract, AnswersManyThreadsAlike) {
  const std::vector<Row> points = random_points(2000, 5, false);
  const std::vector<Row> questions = random_points(200, 6, false);
  const auto index = Of4(GetParam(), points);
  std::vector<std::vector<std::vector<Hit>>> answers(4);
  std::vector<std::thread> threads;
  for (auto& mine : answers) {
    threads.emplace_back([&] {
      for (const Row& q : questions) mine.push_back(index->nearest(q, 7));
    });
  }
  for (std::thread& t : threads) t.join();
  for (const auto& other : answers) EXPECT_EQ(other, answers.front());
}

TEST_P(IndexContract, KeepsItsLimitToTheLastBit) {
  // Multiples of 0.1 are no binary fractions: differences, squares and sums all round.
  std::mt19937 random(11);
  std::uniform_int_distribution<int> tenths(-40, 40);
  std::vector<Row> points(500);
  for (Row& p : points) {
    for (double& v : p) v = 0.1 * tenths(random);
  }
  const auto index = Of4(GetParam(), points);
  for (const Row& q : random_points(10, 12, false)) {
    for (std::size_t row = 0; row < points.size(); row += 7) {
      const double exactly = distance2(q.data(), points[row].data(), kAlike.data(), 4);
      const auto holds = [&](double limit) {
        const auto hits = index->within(q, limit);
        return std::any_of(hits.begin(), hits.end(), [&](const Hit& h) { return h.row == row; });
      };
      ASSERT_TRUE(holds(exactly));
      ASSERT_FALSE(holds(std::nextafter(exactly, 0.0)));
    }
  }
}

TEST_P(IndexContract, FindsAmongPointsOnALine) {
  // One side of every box has no width, and half of the points are one point.
  std::vector<Row> points(64);
  for (std::size_t i = 0; i < 32; ++i) points[i] = {double(i), 2.0, 2.0, 2.0};
  for (std::size_t i = 32; i < 64; ++i) points[i] = {7.0, 2.0, 2.0, 2.0};
  const auto hits = Of4(GetParam(), points)->nearest({7.0, 2.0, 2.0, 2.0}, 35);
  ASSERT_EQ(hits.size(), 35u);
  EXPECT_EQ(hits[0], (Hit{7, 0.0}));
  for (std::size_t i = 1; i <= 32; ++i) EXPECT_EQ(hits[i], (Hit{31 + i, 0.0}));
  EXPECT_EQ(hits[33], (Hit{6, 1.0}));
  EXPECT_EQ(hits[34], (Hit{8, 1.0}));
}

TEST_P(IndexContract, CountsEachDimensionByItsWeight) {
  const std::vector<Row> points = random_points(2000, 21, true);
  const Of4 index(GetParam(), points), referee(&make_linear_index, points);
  for (const Row& weight : {Row{1, 0, 2, 0.5}, Row{0, 0, 0, 1}, Row{0, 0, 0, 0}, Row{3, 1, 1, 0}}) {
    for (const Row& q : random_points(20, 22, false)) {
      ASSERT_EQ(index.nearest(q, 9, weight), referee.nearest(q, 9, weight));
      ASSERT_EQ(index.within(q, 2.0, weight), referee.within(q, 2.0, weight));
    }
  }
  EXPECT_EQ(index.within({100, 0, 0, 0}, 0.0, {0, 0, 0, 0}).size(), points.size());
}

TEST_P(IndexContract, RefusesAPlaceThatIsNone) {
  const Of4 index(GetParam(), {Row{}});
  EXPECT_THROW((void)index.nearest({}, 1, {1, -1, 1, 1}), std::logic_error);
  EXPECT_THROW((void)index.nearest({}, 1, {1, std::numeric_limits<double>::infinity(), 1, 1}),
               std::logic_error);
}

/// Points of 16 dimensions: all over a cube, or around 200 centres with some of them equal.
Points many(std::size_t n, unsigned seed, bool clustered) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(-5.0, 5.0);
  std::normal_distribution<double> near(0.0, 0.1);
  Points centres{16, {}}, out{16, {}};
  for (int i = 0; i < 200 * 16; ++i) centres.values.push_back(any(random));
  for (std::size_t i = 0; i < n; ++i) {
    if (clustered && i % 50 == 49) {  // a copy of one before
      const std::vector<double> copy(out.row(i / 2), out.row(i / 2) + 16);
      out.values.insert(out.values.end(), copy.begin(), copy.end());
      continue;
    }
    const double* c = centres.row(random() % 200);
    for (int d = 0; d < 16; ++d) out.values.push_back(clustered ? c[d] + near(random) : any(random));
  }
  return out;
}

/// 20,000 cases; a million where CAPSTAN_SOAK is set.
TEST_P(IndexContract, GivesTheSameRowsAndBitsAsTheRefereeAmongMany) {
  const bool soak = soaking();
  const std::size_t n = soak ? 1'000'000 : 20'000;
  const auto seed = static_cast<unsigned>(soak ? testing::UnitTest::GetInstance()->random_seed() : 1);
  const std::vector<double> weight(16, 1.0);
  for (const bool clustered : {false, true}) {
    const Points points = many(n, seed, clustered);
    const auto index = GetParam()(points);
    const auto referee = make_linear_index(points);
    for (std::size_t i = 0; i < 20; ++i) {
      std::vector<double> q(points.row(i * n / 20), points.row(i * n / 20) + 16);
      if (i % 2 == 0) q[i % 16] += 0.05;
      const Place place{q, weight};
      ASSERT_EQ(index->nearest(place, 20), referee->nearest(place, 20)) << "seed " << seed;
      ASSERT_EQ(index->within(place, 0.25), referee->within(place, 0.25)) << "seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, IndexContract, testing::Values(&make_linear_index, &make_tree_index, &make_index),
    [](const auto& made) {
      return std::string(made.index == 0 ? "linear" : made.index == 1 ? "tree" : "flann");
    });

}  // namespace
}  // namespace capstan::casebase
