#include "casebase/index/index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "casebase/normalisation.h"

namespace capstan::casebase {
namespace {

std::vector<Point> random_points(std::size_t n, unsigned seed, bool on_grid) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-8.0, 8.0);
  std::vector<Point> out(n);
  for (Point& p : out) {
    for (double& v : p) v = on_grid ? std::floor(any(random) / 4.0) : any(random);
  }
  return out;
}

/// What every index promises, whatever it is made of.
class IndexContract : public testing::TestWithParam<std::unique_ptr<Index> (*)(std::vector<Point>)> {};

TEST_P(IndexContract, HoldsNoPointAndFindsNone) {
  const auto index = GetParam()({});
  EXPECT_TRUE(index->nearest({}, 3).empty());
  EXPECT_TRUE(index->within({}, 1e9).empty());
}

TEST_P(IndexContract, OrdersEqualDistancesByRow) {
  const auto index = GetParam()(std::vector<Point>(100, Point{1, 2, 3, 4}));
  const auto hits = index->nearest({1, 2, 3, 4}, 5);
  ASSERT_EQ(hits.size(), 5u);
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i], (Hit{i, 0.0}));
}

TEST_P(IndexContract, TakesItsLimitAsWithin) {
  const auto index = GetParam()({Point{3, 4, 0, 0}, Point{0, 0, 5.0000001, 0}, Point{0, 0, 0, -5}});
  const auto hits = index->within({}, 25.0);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].row, 0u);
  EXPECT_EQ(hits[1].row, 2u);
}

TEST_P(IndexContract, RejectsWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)GetParam()({Point{0, nan, 0, 0}}), std::logic_error);
  EXPECT_THROW((void)GetParam()({Point{0, 0, inf, 0}}), std::logic_error);
  const auto index = GetParam()({Point{}});
  EXPECT_THROW((void)index->nearest({nan, 0, 0, 0}, 1), std::logic_error);
  EXPECT_THROW((void)index->within({0, 0, 0, -inf}, 1.0), std::logic_error);
}

TEST_P(IndexContract, GivesTheSameRowsAndBitsAsTheReferee) {
  unsigned seed = 1;
  for (const std::size_t n : {1u, 2u, 9u, 10u, 11u, 100u, 3000u}) {
    for (const bool on_grid : {false, true}) {
      const std::vector<Point> points = random_points(n, ++seed, on_grid);
      const auto index = GetParam()(points);
      const auto referee = make_linear_index(points);
      for (const bool grid_question : {false, true}) {
        for (const Point& q : random_points(20, ++seed, grid_question)) {
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
  const std::vector<Point> points = random_points(2000, 5, false);
  const std::vector<Point> questions = random_points(200, 6, false);
  const auto index = GetParam()(points);
  std::vector<std::vector<std::vector<Hit>>> answers(4);
  std::vector<std::thread> threads;
  for (auto& mine : answers) {
    threads.emplace_back([&] {
      for (const Point& q : questions) mine.push_back(index->nearest(q, 7));
    });
  }
  for (std::thread& t : threads) t.join();
  for (const auto& other : answers) EXPECT_EQ(other, answers.front());
}

TEST_P(IndexContract, KeepsItsLimitToTheLastBit) {
  // Multiples of 0.1 are no binary fractions: differences, squares and sums all round.
  std::mt19937 random(11);
  std::uniform_int_distribution<int> tenths(-40, 40);
  std::vector<Point> points(500);
  for (Point& p : points) {
    for (double& v : p) v = 0.1 * tenths(random);
  }
  const auto index = GetParam()(points);
  for (const Point& q : random_points(10, 12, false)) {
    for (std::size_t row = 0; row < points.size(); row += 7) {
      const double exactly = distance2(q, points[row]);
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
  std::vector<Point> points(64);
  for (std::size_t i = 0; i < 32; ++i) points[i] = {double(i), 2.0, 2.0, 2.0};
  for (std::size_t i = 32; i < 64; ++i) points[i] = {7.0, 2.0, 2.0, 2.0};
  const auto hits = GetParam()(points)->nearest({7.0, 2.0, 2.0, 2.0}, 35);
  ASSERT_EQ(hits.size(), 35u);
  EXPECT_EQ(hits[0], (Hit{7, 0.0}));
  for (std::size_t i = 1; i <= 32; ++i) EXPECT_EQ(hits[i], (Hit{31 + i, 0.0}));
  EXPECT_EQ(hits[33], (Hit{6, 1.0}));
  EXPECT_EQ(hits[34], (Hit{8, 1.0}));
}

// `built` is FLANN's where it is found.
INSTANTIATE_TEST_SUITE_P(
    All, IndexContract, testing::Values(&make_linear_index, &make_tree_index, &make_index),
    [](const auto& made) {
      return std::string(made.index == 0 ? "linear" : made.index == 1 ? "tree" : "built");
    });

TEST(Normalisation, MeasuresSizesByTheirRatio) {
  const Question q{.operation = "A",
                   .material_group = "B",
                   .tool_class = "C",
                   .machine_class = "D",
                   .diameter_mm = 10.0,
                   .depth_mm = 20.0,
                   .tolerance_mm = 0.02};
  Question twice = q;
  twice.diameter_mm = 20.0;
  EXPECT_NEAR(distance2(point_of(q), point_of(twice)), 1.0, 1e-12);  // ln 2 / ln 2
  Question wider = q;
  wider.tolerance_mm = 0.08;
  EXPECT_NEAR(distance2(point_of(q), point_of(wider)), 1.0, 1e-12);  // ln 4 / (2 ln 2)
}

TEST(Normalisation, NeverMatchesASizeThatDoesNotApply) {
  Question q{
      .operation = "A", .material_group = "B", .tool_class = "C", .machine_class = "D", .diameter_mm = 10.0};
  const std::string with = bucket_of(q);
  q.diameter_mm = 0.0;
  EXPECT_NE(bucket_of(q), with);
}

}  // namespace
}  // namespace capstan::casebase
