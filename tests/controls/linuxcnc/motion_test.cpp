#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "planner/ground/base/number.h"
#include "tests/controls/linuxcnc/written.h"

// A written program moves as its plan, by the control's own interpreter and by a reader of arcs.

namespace capstan::controls::linuxcnc {
namespace {

using model::MoveKind;
using std::numbers::pi;
using testing::CanonCall;

// What the plan asks for, as the interpreter should name it: at most half a turn per arc.
struct Expected {
  bool rapid, arc;
  double x, y, z, cx, cy;
};
std::vector<Expected> expected_moves(const CutterPath& p) {
  std::vector<Expected> out;
  for (std::size_t i = 1; i < p.size(); ++i) {
    const bool arc = p.kind[i] == MoveKind::kArcCw || p.kind[i] == MoveKind::kArcCcw;
    const int n = arc && model::arc_sweep(p, i) > pi + 1e-6 ? 2 : 1;
    for (int k = 1; k <= n; ++k) {
      const auto to = model::point_on_move(p, i, double(k) / n);
      out.push_back({p.kind[i] == MoveKind::kRapid, arc, to.x, to.y, to.z, p.cx[i], p.cy[i]});
    }
  }
  return out;
}

void expect_same_motion(const std::vector<CanonCall>& got, std::size_t skip,
                        const std::vector<Expected>& want) {
  ASSERT_EQ(got.size(), want.size() + skip);
  for (std::size_t i = 0; i < want.size(); ++i) {
    const CanonCall& c = got[i + skip];
    const Expected& w = want[i];
    SCOPED_TRACE(std::to_string(i) + ": " + c.name + "(" + c.text + ")");
    ASSERT_EQ(c.name, w.arc ? "ARC_FEED" : w.rapid ? "STRAIGHT_TRAVERSE" : "STRAIGHT_FEED");
    EXPECT_NEAR(c.numbers[0], w.x, 1.01 * kCanonUnit);
    EXPECT_NEAR(c.numbers[1], w.y, 1.01 * kCanonUnit);
    EXPECT_NEAR(c.numbers[w.arc ? 5 : 2], w.z, 1.01 * kCanonUnit);
    if (!w.arc) continue;
    EXPECT_NEAR(c.numbers[2], w.cx, 3.0 * kCanonUnit);
    EXPECT_NEAR(c.numbers[3], w.cy, 3.0 * kCanonUnit);
  }
}

const std::vector<std::string> kMotion = {"STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"};

TEST(LinuxCncInterpreter, MovesAsThePlanSays) {
  CAPSTAN_NEEDS_RS274();
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  const Rs274Run r = run(plan);
  EXPECT_EQ(r.status, 0) << r.output;
  auto motion = r.only(kMotion);
  motion.pop_back();                                         // the retract at the end
  expect_same_motion(motion, 3, expected_moves(contour()));  // retract, X Y, Z
  const auto spindle =
      r.only({"CHANGE_TOOL", "SET_SPINDLE_SPEED", "START_SPINDLE_CLOCKWISE", "FLOOD_ON", "STRAIGHT_FEED"});
  ASSERT_GE(spindle.size(), 5U);
  EXPECT_EQ(spindle[0].name, "CHANGE_TOOL");
  EXPECT_EQ(spindle[1].numbers[1], 3000.0);
  EXPECT_EQ(spindle[2].name, "START_SPINDLE_CLOCKWISE");
  EXPECT_EQ(spindle[3].name, "FLOOD_ON");
}

TEST(LinuxCncInterpreter, AgreesOnRandomPathsWhateverTheDecimals) {
  CAPSTAN_NEEDS_RS274();
  std::mt19937 random(14649);
  std::uniform_real_distribution<double> at(-80.0, 80.0), angle(0.02, 2.0 * pi), size(0.5, 60.0);
  Plan plan = testing::empty_plan();
  CutterPath p;
  p.start({at(random), at(random), 10.0});
  for (int i = 0; i < 400; ++i) {
    const auto here = p.point(p.size() - 1);
    if (random() % 3 == 0) {
      p.line({at(random), at(random), -0.1 * at(random)}, MoveRole::kCut);
      continue;
    }
    const double from = angle(random);
    const double radius = size(random);
    const bool clockwise = random() % 2 == 0;
    const double to = from + (clockwise ? -1.0 : 1.0) * (random() % 5 == 0 ? 2.0 * pi : angle(random));
    const geometry::Vec2 c{here.x - radius * std::cos(from), here.y - radius * std::sin(from)};
    const double z = here.z + (random() % 2 == 0 ? 0.0 : 0.01 * at(random));
    p.arc({c.x + radius * std::cos(to), c.y + radius * std::sin(to), z}, c, clockwise, MoveRole::kCut);
  }
  testing::add_step(plan, "a", "em18", p);
  for (const int decimals : {4, 6}) {
    plan.machine.control.decimals = decimals;
    const Rs274Run r = run(plan);
    EXPECT_EQ(r.status, 0) << r.output;
    auto motion = r.only(kMotion);
    motion.pop_back();
    ASSERT_EQ(motion.size(), expected_moves(p).size() + 3);
    const auto want = expected_moves(p);
    for (std::size_t i = 0; i < want.size(); ++i) {
      const bool arc = motion[i + 3].name == "ARC_FEED";
      EXPECT_NEAR(motion[i + 3].numbers[0], want[i].x, 1.01 * kCanonUnit);
      EXPECT_NEAR(motion[i + 3].numbers[1], want[i].y, 1.01 * kCanonUnit);
      EXPECT_NEAR(motion[i + 3].numbers[arc ? 5 : 2], want[i].z, 1.01 * kCanonUnit);
    }
  }
}

// The written arcs, read back by a reader of its own: radii agree, direction and sweep are the plan's.
TEST(LinuxCncProperty, ArcsAgreeWithThePlanAfterRounding) {
  std::mt19937 random(238);
  std::uniform_real_distribution<double> at(-80.0, 80.0), angle(0.001, 2.0 * pi), exponent(-3.0, 3.0);
  for (const int decimals : {3, 4}) {
    const double unit = std::pow(10.0, -decimals);
    for (int round = 0; round < 2000; ++round) {
      const double radius = std::pow(10.0, exponent(random));
      const double from = angle(random), swept = round % 7 == 0 ? 2.0 * pi : angle(random);
      const bool clockwise = random() % 2 == 0;
      const geometry::Vec2 c{at(random), at(random)};
      const double to = clockwise ? from - swept : from + swept;
      CutterPath p;
      p.start({c.x + radius * std::cos(from), c.y + radius * std::sin(from), 0});
      p.arc({c.x + radius * std::cos(to), c.y + radius * std::sin(to), 0}, c, clockwise, MoveRole::kCut);
      Plan plan = testing::empty_plan();
      plan.machine.control.decimals = decimals;
      testing::add_step(plan, "a", "em18", p);
      std::istringstream text(program_of(plan));
      geometry::Vec2 here{rounded(p.x[0], decimals), rounded(p.y[0], decimals)};
      double total = 0.0;
      bool lines = false;
      for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string g;
        words >> g;
        if (g == "G1") lines = true;
        if (g != "G2" && g != "G3") continue;
        EXPECT_EQ(g, clockwise ? "G2" : "G3");
        geometry::Vec2 next = here, i;
        for (std::string w; words >> w;) {
          const double v = *parse_double(w.substr(1));
          if (w[0] == 'X') next.x = v;
          if (w[0] == 'Y') next.y = v;
          if (w[0] == 'I') i.x = v;
          if (w[0] == 'J') i.y = v;
        }
        EXPECT_NEAR(norm(i), norm(here + i - next), unit);
        EXPECT_NEAR(norm(i), radius, 3.0 * unit + 1e-3 * radius);
        CutterPath piece;
        piece.start({here.x, here.y, 0});
        piece.arc({next.x, next.y, 0}, here + i, clockwise, MoveRole::kCut);
        const double sweep = model::arc_sweep(piece, 1);
        EXPECT_LT(sweep, 1.1 * pi);  // never an accidental full turn
        total += sweep;
        // Half way round, the written arc is where the plan's is.
        const auto middle = model::point_on_move(piece, 1, 0.5);
        EXPECT_NEAR(std::hypot(middle.x - c.x, middle.y - c.y), radius, 3.0 * unit);
        here = next;
      }
      if (!lines && total > 0.0) {
        EXPECT_NEAR(total * radius, swept * radius, 8.0 * unit);
      }
    }
  }
}

}  // namespace
}  // namespace capstan::controls::linuxcnc
