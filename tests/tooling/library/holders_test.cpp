#include "tooling/library/cutters/holders.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tooling/library/cutters/generic.h"

namespace capstan::tooling {
namespace {

constexpr const char* kText =
    "default: [slim, wide]\n"
    "list:\n"
    "  - {id: slim, shank: 7, holder: [{height: 30, lower_diameter: 16, upper_diameter: 20},\n"
    "                                   {height: 20, lower_diameter: 30, upper_diameter: 30}]}\n"
    "  - {id: wide, shank: 20, holder: [{height: 60, lower_diameter: 50, upper_diameter: 50}]}\n";

ShopHolders read(const std::string& text, std::vector<Diagnostic>& faults) {
  const auto root = parse_tree(text, "shop.yaml");
  EXPECT_TRUE(root);
  return root ? read_holders(*root, "shop.yaml", faults) : ShopHolders{};
}

ShopHolders both() {
  std::vector<Diagnostic> faults;
  const ShopHolders out = read(kText, faults);
  EXPECT_TRUE(faults.empty()) << faults.front().message;
  return out;
}

/// A generic mill whose shank is as thick as that.
model::Cutter with_shank(double mm) {
  for (const model::Cutter& c : *shared_generic_library()) {
    if (c.shank_diameter_mm == mm) return c;
  }
  ADD_FAILURE() << mm;
  return {};
}

TEST(Holders, AreGivenByTheFirstDefaultThatTakesTheShank) {
  const ShopHolders holders = both();
  model::Cutter thin = with_shank(6.0), thick = with_shank(10.0), thickest = with_shank(25.0);
  const model::Cutter before = thickest;
  ASSERT_NE(give_holder(thin, holders), nullptr);
  EXPECT_EQ(thin.holder_id, "slim");
  EXPECT_EQ(thin.holder, holders.all[0].segments);
  EXPECT_DOUBLE_EQ(thin.holder_diameter_mm, 30.0);
  EXPECT_DOUBLE_EQ(thin.functional_length_mm, thin.stick_out_mm + 30.0 + 20.0);
  ASSERT_NE(give_holder(thick, holders), nullptr);
  EXPECT_EQ(thick.holder_id, "wide");
  EXPECT_EQ(give_holder(thickest, holders), nullptr);
  EXPECT_EQ(thickest, before);
}

TEST(Holders, ThatAToolHasOfItsOwnStay) {
  const ShopHolders holders = both();
  model::Cutter own = with_shank(6.0);
  own.holder_id = "HSK 1";
  const model::Cutter before = own;
  EXPECT_EQ(give_holder(own, holders), nullptr);
  EXPECT_EQ(own, before);
  // A diameter that its list states is its holder's, too.
  model::Cutter stated;
  stated.shank_diameter_mm = 6.0;
  stated.holder_diameter_mm = 28.0;
  EXPECT_EQ(give_holder(stated, holders), nullptr);
}

TEST(Holders, ThatAToolNamesWithoutAnOutlineAreTakenByTheirNames) {
  const ShopHolders holders = both();
  model::Cutter names;
  names.holder_id = "wide";
  names.shank_diameter_mm = 6.0;
  names.holder_diameter_mm = 40.0;
  names.functional_length_mm = 111.0;
  ASSERT_NE(give_holder(names, holders), nullptr);
  EXPECT_EQ(names.holder, holders.all[1].segments);
  EXPECT_DOUBLE_EQ(names.functional_length_mm, 111.0) << "a stated length stays";
  model::Cutter other;
  other.holder_id = "somebody's";
  EXPECT_EQ(give_holder(other, holders), nullptr);
}

TEST(Holders, OfAToolTheLengthIsKeptWhereTheMachinesTableHasIt) {
  model::Cutter measured = with_shank(6.0);
  measured.table_line = model::ToolTableLine{};
  const double length = measured.functional_length_mm;
  (void)give_holder(measured, both());
  EXPECT_DOUBLE_EQ(measured.functional_length_mm, length);
}

TEST(Holders, WithAFaultAreToldWithTheirLine) {
  const auto first = [](const std::string& text) {
    std::vector<Diagnostic> faults;
    (void)read(text, faults);
    return faults.empty() ? std::string("none")
                          : faults.front().code + ":" + std::to_string(faults.front().line);
  };
  const std::string holder = "holder: [{height: 60, lower_diameter: 50, upper_diameter: 50}]}\n";
  EXPECT_EQ(first("default: ER32\nlist:\n  - {id: ER16, " + holder), "NAME-UNKNOWN:1");
  EXPECT_EQ(first("list:\n  - {id: a, " + holder + "  - {id: a, " + holder), "DATA-DUPLICATE:3");
  EXPECT_EQ(first("list:\n  - {id: a, shank: 51, " + holder), "DATA-VALUE:2");
  EXPECT_EQ(first("list:\n  - {id: a, holder: [{height: 0, lower_diameter: 50, upper_diameter: 50}]}\n"),
            "DATA-VALUE:2");
  EXPECT_EQ(first("list:\n  - {id: a, holder: []}\n"), "DATA-VALUE:2");
  EXPECT_NE(first("list:\n  - {id: a, holder: [{height: 5, lower_diameter: 50}]}\n"), "none");
  EXPECT_EQ(first("list: 3\n"), "DATA-TYPE:1");
  EXPECT_EQ(first("default: {ER32: 1}\nlist:\n  - {id: a, " + holder), "DATA-TYPE:1");
  EXPECT_EQ(first("default: [[a]]\nlist:\n  - {id: a, " + holder), "DATA-TYPE:1");
}

TEST(Holders, OfALibraryAreToldOnce) {
  std::vector<model::Cutter> library = {with_shank(6.0), with_shank(10.0), with_shank(25.0)};
  Job job;
  give_holders(library, both(), job);
  ASSERT_EQ(job.diagnostics().size(), 1U);
  EXPECT_EQ(job.diagnostics().front().code, "SHOP-HOLDER");
  EXPECT_EQ(job.diagnostics().front().message,
            "shop.yaml: holders: tools without a holder of their own, by holder: slim: 1, wide: 1; 1 have a "
            "shank that no default takes, and keep the holder that is assumed for them");
}

}  // namespace
}  // namespace capstan::tooling
