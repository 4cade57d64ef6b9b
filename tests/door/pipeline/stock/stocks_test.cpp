#include "planner/door/pipeline/paths/stocks.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace capstan::pipeline {
namespace {

/// One try at a raw piece of 100 x 100 x 20 mm with two set-ups, from above and from below, and a step each.
struct Try {
  Inputs inputs;
  Policy policy;
  Job job;
  Work w;
  Try(Tries& tries, bool from_below_first) : w{{}, inputs, policy, job, tries, {}, {}, {}, {}} {
    w.plan.stock.box = {{0, 0, -20}, {100, 100, 0}};
    for (const bool below : {from_below_first, !from_below_first}) {
      SetupDraft s;
      s.setup = below ? below_ : above_;
      if (below) s.workpiece = *geometry::make_placement({0, 0, 0}, {0, 0, -1}, {1, 0, 0});
      s.stock = transformed(w.plan.stock.box, s.workpiece);
      w.setups.push_back(s);
    }
  }
  /// The noun of a set-up is its own in every try.
  void step(bool below, double cutter_mm) {
    StepDraft s;
    s.setup = w.setups[0].setup == (below ? below_ : above_) ? 0 : 1;
    s.cutter.cutting_diameter_mm = cutter_mm;
    w.steps.push_back(s);
  }
  double cell(bool below, Stocks& stocks) {
    return stocks.of(w.setups[0].setup == (below ? below_ : above_) ? 0 : 1).cell_mm;
  }

 private:
  model::Model nouns_;
  model::Ref<model::Setup> above_ = nouns_.add(model::Setup{}), below_ = nouns_.add(model::Setup{});
};

TEST(Stocks, CellsFollowTheSetUpWhereAnotherTryOrdersSetUpsAnew) {
  Tries tries;
  double fine = 0.0, coarse = 0.0;
  {
    Try first(tries, false);
    first.step(false, 20.0);
    first.step(true, 20.0);
    Stocks stocks(first.w);
    coarse = first.cell(true, stocks);
    (void)first.cell(false, stocks);
    // Above, the step ends with another cutter than it began with: the next try's cells are to be finer.
    first.w.steps[0].cutter.cutting_diameter_mm = 4.0;
    ASSERT_TRUE(stocks.other_cells_asked_for(tries));
  }
  {
    Try same(tries, false);
    same.step(false, 20.0);
    same.step(true, 20.0);
    Stocks stocks(same.w);
    fine = same.cell(false, stocks);
    EXPECT_DOUBLE_EQ(same.cell(true, stocks), coarse);
  }
  EXPECT_LT(fine, 0.5 * coarse) << "4 mm for 20 mm";
  Try turned(tries, true);
  turned.step(false, 20.0);
  turned.step(true, 20.0);
  Stocks stocks(turned.w);
  EXPECT_DOUBLE_EQ(turned.cell(false, stocks), fine);
  EXPECT_DOUBLE_EQ(turned.cell(true, stocks), coarse);
}

}  // namespace
}  // namespace capstan::pipeline
