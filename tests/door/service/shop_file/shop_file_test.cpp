#include "planner/door/service/shop_file/shop_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "planner/door/service/options.h"
#include "planner/door/service/shop.h"
#include "planner/model/plan/resources/shop_texts.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

Request asking(const std::string& shop) {
  Request r;
  r.shop = shop;
  return r;
}

TEST(ShopFile, StandsForWhatTheCallerLeavesOut) {
  Job job;
  Request caller = asking("shop.yaml");
  ASSERT_TRUE(set(caller, "material", "AlCu4Mg1"));
  const auto r =
      with_shop_text(caller, "capstan_shop: 1\nmachine: small_router\nmaterial: C45\nmargin: careful\n", job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->machine, "small_router");
  EXPECT_EQ(r->material, "AlCu4Mg1") << "an option of the call wins";
  EXPECT_EQ(r->margin, "careful");
  EXPECT_EQ(r->from_shop.size(), 2U);
  EXPECT_EQ(r->from_shop.at("machine"), "shop.yaml");
}

TEST(ShopFile, IsNamedInThePlansProvenance) {
  Job job;
  const auto r =
      with_shop_text(asking("shop.yaml"), "capstan_shop: 1\nmachine: small_router\nmaterial: C45\n", job);
  ASSERT_TRUE(r) << to_text(r.error());
  const auto in = gather(*r, model::Plan{}, job);
  ASSERT_TRUE(in) << to_text(in.error());
  std::string machine, material, tools;
  for (const auto& p : in->provenance) {
    if (p.what == "machine") machine = p.source;
    if (p.what == "material") material = p.source;
    if (p.what == "tools") tools = p.source;
  }
  EXPECT_EQ(machine, "shop.yaml: machine small_router");
  EXPECT_EQ(material.substr(0, 10), "shop.yaml:") << material;
  EXPECT_EQ(tools, "built-in default");
}

TEST(ShopFile, GivesItsHoldersToToolsWithoutTheirOwn) {
  Job job;
  const auto r = with_shop_text(asking("shop.yaml"),
                                "capstan_shop: 1\nholders: {default: ER32, list: [{id: ER32, shank: 12, "
                                "holder: [{height: 60, lower_diameter: 50, upper_diameter: 50}]}]}\n",
                                job);
  ASSERT_TRUE(r) << to_text(r.error());
  const auto in = gather(*r, model::Plan{}, job);
  ASSERT_TRUE(in) << to_text(in.error());
  for (const model::Cutter& c : in->library) {
    EXPECT_EQ(c.holder_id == "ER32", c.shank_diameter_mm <= 12.0) << c.id;
    EXPECT_TRUE(c.holder_id != "ER32" || c.holder_diameter_mm == 50.0) << c.id;
  }
  std::string source;
  for (const auto& p : in->provenance) {
    if (p.what == "holders") source = p.source;
  }
  EXPECT_EQ(source, "shop.yaml: holders");
}

TEST(ShopFile, LeavesItsControlOutForAnotherMachine) {
  Job job;
  Request caller = asking("shop.yaml");
  ASSERT_TRUE(set(caller, "machine", "generic_vmc"));
  const auto r = with_shop_text(caller, "capstan_shop: 1\nmachine: small_router\ncontrol: fanuc\n", job);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->machine, "generic_vmc");
  EXPECT_EQ(r->control, std::nullopt);
  ASSERT_EQ(job.diagnostics().size(), 1U);
  EXPECT_EQ(job.diagnostics().front().code, "SHOP-CONTROL");
}

TEST(ShopFile, CountsPathsFromItsFolder) {
  const capstan::testing::ScratchFolder scratch;
  std::ofstream(scratch.file("tool.tbl")) << "T1 P1 D10 Z50\n";
  Job job;
  const auto r = with_shop_text(asking(scratch.file("shop.yaml")),
                                "capstan_shop: 1\ntools: tool.tbl\nmachine: generic_vmc\ncache: kept\n", job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->tools, scratch.file("tool.tbl"));
  EXPECT_EQ(r->machine, "generic_vmc") << "no file there: a name";
  EXPECT_EQ(r->cache, scratch.file("kept")) << "made where it is not";
}

TEST(ShopFile, WithFaultsReportsEachWithItsLine) {
  Job job;
  const auto r = with_shop_text(
      asking("shop.yaml"),
      "capstan_shop: 1\nmachin: small_router\nmargin: brave\nedges: wide\ndeadline: 2s\n", job);
  ASSERT_FALSE(r);
  auto said = job.diagnostics();
  said.push_back(r.error());  // the last is what ends it
  ASSERT_EQ(said.size(), 4U);
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_EQ(said[i].line, i + 2) << to_text(said[i]);
  EXPECT_EQ(said[0].code, "NAME-UNKNOWN");
  EXPECT_NE(said[0].message.find("'machine'"), std::string::npos) << said[0].message;
  EXPECT_EQ(said[1].code, "OPTION-VALUE");
  EXPECT_EQ(said[3].code, "NAME-UNKNOWN") << "an option of a call is none of the shop";
}

TEST(ShopFile, TextsAreRowsOfThePlansProvenance) {
  Job job;
  const auto r = with_shop_text(
      asking("shop.yaml"),
      "capstan_shop: 1\ntexts:\n  title: ACME\n  header: [one, two]\n  footer: [three]\n", job);
  ASSERT_TRUE(r) << to_text(r.error());
  const auto in = gather(*r, model::Plan{}, job);
  ASSERT_TRUE(in) << to_text(in.error());
  model::Plan plan;
  plan.provenance = in->provenance;
  EXPECT_EQ(model::shop_texts(plan, model::kSheetTitle), std::vector<std::string>{"ACME"});
  EXPECT_EQ(model::shop_texts(plan, model::kProgramHeader), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(model::shop_texts(plan, model::kProgramFooter), std::vector<std::string>{"three"});
  // Planned again without a shop they stay; with other ones these hold.
  const auto again = gather(Request{}, plan, job);
  ASSERT_TRUE(again) << to_text(again.error());
  plan.provenance = again->provenance;
  EXPECT_EQ(model::shop_texts(plan, model::kProgramFooter), std::vector<std::string>{"three"});
  const auto other = with_shop_text(asking("shop.yaml"), "capstan_shop: 1\ntexts: {title: Other}\n", job);
  ASSERT_TRUE(other);
  const auto changed = gather(*other, plan, job);
  ASSERT_TRUE(changed);
  plan.provenance = changed->provenance;
  EXPECT_EQ(model::shop_texts(plan, model::kSheetTitle), std::vector<std::string>{"Other"});
  EXPECT_TRUE(model::shop_texts(plan, model::kProgramFooter).empty());
}

TEST(ShopFile, TextsThatNoCommentHoldsAreRefusedWithTheirLine) {
  for (const char* bad :
       {"CAPSTAN STEP x", "capstan", "machine: mine", "MSG, hello", "LOGOPEN,/tmp/x", "probeclose",
        "PROBEOPEN x", "set-up 1: zero", "Stock: ours", "a (b)", "a; b", "50 %", "", " blank first",
        "gr\\u00fcn", "a line of more than the sixty characters that no control has to break"}) {
    Job job;
    const auto r = with_shop_text(
        asking("shop.yaml"),
        "capstan_shop: 1\ntexts:\n  header:\n    - fine\n    - \"" + std::string(bad) + "\"\n", job);
    ASSERT_FALSE(r) << bad;
    EXPECT_EQ(r.error().line, 5U) << bad;
  }
  for (const char* bad :
       {"texts: ACME", "texts: {title: [a]}", "texts: {header: one}", "texts: {heder: [one]}"}) {
    Job job;
    EXPECT_FALSE(with_shop_text(asking("shop.yaml"), std::string("capstan_shop: 1\n") + bad + "\n", job))
        << bad;
  }
}

TEST(ShopFile, OfAnotherShapeOrVersionIsRefused) {
  for (const char* bad : {"", "7", "machine: m.yaml", "capstan_shop: 2", "capstan_shop: 1\nmachine: [a]",
                          "capstan_shop: 1\nobjective: profit\n"}) {
    Job job;
    EXPECT_FALSE(with_shop_text(asking("shop.yaml"), bad, job)) << bad;
  }
}

// As it is written it changes nothing; with the # of each entry off, each is one that is taken.
TEST(ShopFile, TemplateHoldsNothingUntilItsCommentsAreTakenOff) {
  Job job;
  const auto written = shop_template({}, kShopFile, job);
  ASSERT_TRUE(written);
  const std::string& text = *written;
  const auto as_written = with_shop_text(asking("shop.yaml"), text, job);
  ASSERT_TRUE(as_written) << to_text(as_written.error());
  EXPECT_TRUE(as_written->from_shop.empty());
  std::size_t entries = 0;
  for (const Option& o : options()) {
    if (!o.of_shop) continue;
    ++entries;
    EXPECT_NE(text.find("\n# " + std::string(o.name) + ": "), std::string::npos) << o.name;
    EXPECT_EQ(text.find("# " + std::string(o.name) + ": ..."), std::string::npos)
        << o.name << " has no example";
  }
  EXPECT_GE(entries, 16U);
}

TEST(ShopFile, TemplateHoldsTheEntriesThatAreGiven) {
  Job job;
  const auto text = shop_template({"machine=small_router", "general-tolerance=ISO 2768-m"}, kShopFile, job);
  ASSERT_TRUE(text) << to_text(text.error());
  const auto r = with_shop_text(asking("shop.yaml"), *text, job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->machine, "small_router");
  EXPECT_EQ(r->general_tolerance, "ISO 2768-m");
  EXPECT_EQ(r->from_shop.size(), 2U);
  EXPECT_EQ(shop_template({"machin=x"}, kShopFile, job).error().code, "NAME-UNKNOWN");
  EXPECT_EQ(shop_template({"margin=brave"}, kShopFile, job).error().code, "OPTION-VALUE");
  EXPECT_EQ(shop_template({"machine"}, kShopFile, job).error().code, "OPTION-VALUE");
}

TEST(ShopFile, TemplateIsRefusedWhereNoPlanTakesWhatItNames) {
  const capstan::testing::ScratchFolder scratch;
  const std::string shop = scratch.file("shop.yaml");
  std::ofstream(scratch.file("broken.yaml")) << "machine: [\n";
  std::ofstream(scratch.file("tool.tbl")) << "T1 P1 D10 Z50 ;carbide end mill\n";
  for (const char* bad : {"machine=small_rooter", "machine=broken.yaml", "tools=nowhere.tbl",
                          "material=steeel", "workholding=no_such_vice", "edges=77", "cases=nowhere.db"}) {
    Job job;
    const auto text = shop_template({bad}, shop, job);
    ASSERT_FALSE(text) << bad;
    EXPECT_NE(text.error().message.size(), 0U) << bad;
  }
  Job job;
  const auto text = shop_template({"tools=tool.tbl", "cache=kept"}, shop, job);
  ASSERT_TRUE(text) << to_text(text.error()) << ": paths count from the folder of the file";
  EXPECT_FALSE(std::filesystem::exists(scratch.file("kept"))) << "trying them out makes nothing";
}

/// The folder that the process works in, for as long as it lives.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;
  ~WorkingFolder() { std::filesystem::current_path(before_); }

 private:
  std::filesystem::path before_;
};

TEST(ShopFile, ThatIsThereAndCannotBeReadIsAnErrorThatNamesIt) {
  const capstan::testing::ScratchFolder scratch;
  const WorkingFolder here(scratch.path());
  const auto found = [&](const std::string& text) {
    std::ofstream(scratch.file("shop.yaml"), std::ios::trunc) << text;
    return found_shop();
  };
  for (const char* form : {"capstan_shop: 1\nmachine: small_router\n", "{\"capstan_shop\": 1}",
                           "# ours\n\"capstan_shop\": 1\n"}) {
    const auto shop = found(form);
    ASSERT_TRUE(shop) << form;
    EXPECT_EQ(shop->value_or(""), "shop.yaml") << form;
  }
  for (const char* broken : {"capstan_shop: 1\nmachine: [\n", "machine: {a\n"}) {
    const auto shop = found(broken);
    ASSERT_FALSE(shop) << broken;
    EXPECT_EQ(shop.error().file, "shop.yaml");
    EXPECT_NE(shop.error().hint.find("--shop none"), std::string::npos) << shop.error().hint;
  }
  std::filesystem::remove(scratch.file("shop.yaml"));
  std::filesystem::create_symlink("nowhere.yaml", scratch.file("shop.yaml"));
  EXPECT_FALSE(found_shop()) << "a link that leads nowhere is no absence";
  std::filesystem::remove(scratch.file("shop.yaml"));
  std::filesystem::create_symlink("shop.yaml", scratch.file("shop.yaml"));
  EXPECT_FALSE(found_shop());
  std::filesystem::remove(scratch.file("shop.yaml"));
  const auto other = found("table: hole\nrows: []\n");
  ASSERT_TRUE(other);
  EXPECT_NE(other->value_or(""), "shop.yaml") << "rules may have that name";
}

}  // namespace
}  // namespace capstan::service
