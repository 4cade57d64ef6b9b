#include "planner/making/step/path/stocks.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace capstan::step {
namespace {

/// One try at a raw piece of 100 x 100 x 20 mm with two set-ups, from above and from below, and a step each.
class Try {
  model::Model nouns_;
  model::Ref<model::Setup> above_, below_;

 public:
  model::Stock raw;
  std::vector<draft::SetupDraft> setups;
  std::vector<draft::StepDraft> steps;
  std::set<model::AnyRef> left_out;
  Stocks stocks;
  Try(const SmallestCutters& known, bool from_below_first)
      : setups(two_setups(from_below_first)), stocks(raw, setups, steps, left_out, known, nullptr) {
    raw.box = {{0, 0, -20}, {100, 100, 0}};
    for (draft::SetupDraft& s : setups) s.stock = transformed(raw.box, s.workpiece);
  }
  void step(bool below, double cutter_mm) {
    draft::StepDraft s;
    s.setup = number(below);
    s.cutter.cutting_diameter_mm = cutter_mm;
    steps.push_back(s);
  }
  double cell(bool below) { return stocks.of(number(below)).cell_mm; }

 private:
  std::size_t number(bool below) const { return setups[0].setup == (below ? below_ : above_) ? 0 : 1; }
  /// The noun of a set-up is its own in every try.
  std::vector<draft::SetupDraft> two_setups(bool from_below_first) {
    above_ = nouns_.add(model::Setup{});
    below_ = nouns_.add(model::Setup{});
    std::vector<draft::SetupDraft> out;
    for (const bool below : {from_below_first, !from_below_first}) {
      draft::SetupDraft s;
      s.setup = below ? below_ : above_;
      if (below) s.workpiece = *geometry::make_placement({0, 0, 0}, {0, 0, -1}, {1, 0, 0});
      out.push_back(s);
    }
    return out;
  }
};

TEST(Stocks, CellsFollowTheSetUpWhereAnotherTryOrdersSetUpsAnew) {
  SmallestCutters known;
  double fine = 0.0, coarse = 0.0;
  {
    Try first(known, false);
    first.step(false, 20.0);
    first.step(true, 20.0);
    coarse = first.cell(true);
    (void)first.cell(false);
    // Above, the step ends with another cutter than it began with: the next try's cells are to be finer.
    first.steps[0].cutter.cutting_diameter_mm = 4.0;
    const auto other = first.stocks.other_cells();
    ASSERT_TRUE(other.again);
    known = other.cutters;
  }
  {
    Try same(known, false);
    same.step(false, 20.0);
    same.step(true, 20.0);
    fine = same.cell(false);
    EXPECT_DOUBLE_EQ(same.cell(true), coarse);
  }
  EXPECT_LT(fine, 0.5 * coarse) << "4 mm for 20 mm";
  Try turned(known, true);
  turned.step(false, 20.0);
  turned.step(true, 20.0);
  EXPECT_DOUBLE_EQ(turned.cell(false), fine);
  EXPECT_DOUBLE_EQ(turned.cell(true), coarse);
}

/// A slot of 10 mm along x at this y, 5 mm deep.
model::CutterPath slot(double y) {
  model::CutterPath path;
  path.start({-10, y, -5});
  path.line({110, y, -5}, model::MoveRole::kCut);
  return path;
}

TEST(Stocks, WhatIsTakenOutAndPutInIsAsIfItHadBeenCut) {
  const SmallestCutters known;
  Try once(known, false), again(known, false);
  model::Cutter mill;
  mill.cutting_diameter_mm = 10.0;
  mill.maximum_depth_of_cut_mm = 20.0;
  const auto cut = [&](Try& t, double y) { return t.stocks.measure(0, slot(y), mill)->removed_mm3; };
  for (Try* t : {&once, &again}) {
    t->step(false, 10.0);
    (void)cut(*t, 20.0);
  }
  const auto before = again.stocks.before(0);
  (void)cut(again, 25.0);
  (void)cut(again, 60.0);
  auto undone = again.stocks.take_out(0, before);
  EXPECT_EQ(stock::volume(again.stocks.of(0)), stock::volume(once.stocks.of(0))) << "as before the two";
  EXPECT_GT(cut(again, 24.0), 0.0);  // another try, wound back
  again.stocks.put_back(0, before);
  again.stocks.put_in(0, std::move(undone));
  (void)cut(once, 25.0);
  (void)cut(once, 60.0);
  EXPECT_EQ(again.stocks.of(0).top, once.stocks.of(0).top);
  EXPECT_EQ(cut(again, 22.0), cut(once, 22.0)) << "of the exact stock, too";
  again.stocks.put_back(0, before);
  EXPECT_GT(stock::volume(again.stocks.of(0)), stock::volume(once.stocks.of(0))) << "it can be undone again";
}

}  // namespace
}  // namespace capstan::step
