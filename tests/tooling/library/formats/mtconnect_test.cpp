#include "tooling/library/formats/mtconnect/mtconnect.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tooling/library/formats/values.h"
#include "tooling/library/formats/xml.h"

namespace capstan::tooling {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;

CatalogueItem end_mill() {
  CatalogueItem i;
  i.id = "EM 10/4";
  i.description = "end mill <10 mm>";
  i.manufacturer = "Own & Co";
  i.cutter_class = model::CutterClass::kEndmill;
  i.properties = {number_property("DC", 10.0, "mm", ValueState::kStated, ""),
                  number_property("APMX", 22.0, "mm", ValueState::kStated, ""),
                  number_property("RE", 0.5, "mm", ValueState::kStated, ""),
                  number_property("SIG", std::numbers::pi, "deg", ValueState::kStated, ""),
                  number_property("FHA", 0.6, "deg", ValueState::kStated, ""),
                  number_property("ZEFF", 4.0, "", ValueState::kStated, ""),
                  number_property("WT", 0.25, "", ValueState::kStated, ""),
                  number_property("RPMX", 12000.0, "", ValueState::kStated, "")};
  return i;
}

ToolLibrary shop() {
  ToolLibrary l;
  l.items.push_back(end_mill());
  ToolInstance piece{.id = "piece 1",
                     .item = "EM 10/4",
                     .group = "g",
                     .in_stock = {},
                     .price = {},
                     .life_min = 60.0,
                     .life_used_min = 15.0,
                     .measured = {}};
  piece.measured.push_back(number_property("DC", 9.98, "mm", ValueState::kStated, "presetter"));
  l.instances.push_back(piece);
  piece.id = "piece 2";
  piece.life_used_min = 60.0;
  piece.measured.clear();
  l.instances.push_back(piece);
  Holder h;
  h.id = "h";
  h.connection = "BT40";
  l.holders.push_back(h);
  l.assemblies.push_back({"a1", "EM 10/4", "piece 1", "h", 35.0, 120.5});
  l.entries.push_back({7, 3, {}, "a1", {}, {}});
  return l;
}

XmlNode document(const ToolLibrary& l, LossReport* report = nullptr) {
  Job job;
  auto out = write_mtconnect(l, {}, job);
  EXPECT_TRUE(out);
  if (report != nullptr) *report = out->report;
  auto root = parse_xml(out->bytes, "out.xml");
  EXPECT_TRUE(root) << to_text(root.error());
  return *std::move(root);
}

std::vector<std::string> names(const XmlNode& n) {
  std::vector<std::string> out;
  for (const XmlNode& c : n.children) out.push_back(c.name);
  return out;
}

TEST(MtConnect, WritesAnAssetPerAssemblyAndPiece) {
  const XmlNode root = document(shop());
  EXPECT_EQ(root.name, "MTConnectAssets");
  EXPECT_EQ(root.attribute("xmlns"), "urn:mtconnect.org:MTConnectAssets:1.6");
  EXPECT_THAT(names(root), ElementsAre("Header", "Assets"));
  const XmlNode& assets = root.children[1];
  ASSERT_EQ(assets.children.size(), 2U);
  const XmlNode& a = assets.children[0];
  EXPECT_EQ(a.attribute("assetId"), "a1");
  EXPECT_EQ(a.attribute("serialNumber"), "piece 1");
  EXPECT_EQ(a.attribute("toolId"), "EM_10_4");  // a name token
  EXPECT_EQ(a.attribute("manufacturers"), "Own & Co");
  EXPECT_EQ(a.text_of("Description"), "end mill <10 mm>");
}

TEST(MtConnect, TheLifeCycleIsInTheOrderOfTheSchema) {
  const XmlNode root = document(shop());
  const XmlNode* life = root.children[1].children[0].find("CuttingToolLifeCycle");
  ASSERT_NE(life, nullptr);
  EXPECT_THAT(names(*life), ElementsAre("CutterStatus", "ToolLife", "ProgramToolGroup", "ProgramToolNumber",
                                        "Location", "ProcessSpindleSpeed", "ConnectionCodeMachineSide",
                                        "Measurements", "CuttingItems"));
  const XmlNode* used = life->find("ToolLife");
  EXPECT_EQ(used->attribute("type"), "MINUTES");
  EXPECT_EQ(used->attribute("limit"), "60");
  EXPECT_EQ(used->text, "15");
  EXPECT_EQ(life->text_of("ProgramToolNumber"), "7");
  EXPECT_EQ(life->find("Location")->attribute("type"), "POT");
  EXPECT_EQ(life->text_of("Location"), "3");
  EXPECT_EQ(life->find("ProcessSpindleSpeed")->attribute("maximum"), "12000");
  EXPECT_EQ(life->text_of("ConnectionCodeMachineSide"), "BT40");
  std::vector<std::string> status;
  for (const XmlNode& s : life->find("CutterStatus")->children) status.push_back(s.text);
  EXPECT_THAT(status, ElementsAre("AVAILABLE", "MEASURED", "USED"));
}

TEST(MtConnect, NominalIsTheCatalogueValueAndContentWhatWasMeasured) {
  const XmlNode root = document(shop());
  const XmlNode* m = root.children[1].children[0].find("CuttingToolLifeCycle")->find("Measurements");
  const XmlNode* dc = m->find("CuttingDiameterMax");
  EXPECT_EQ(dc->attribute("code"), "DC");
  EXPECT_EQ(dc->attribute("nominal"), "10");
  EXPECT_EQ(dc->text, "9.98");
  EXPECT_EQ(m->find("DepthOfCutMax")->attribute("nominal"), "22");
  EXPECT_EQ(m->find("DepthOfCutMax")->text, "");
  EXPECT_EQ(m->find("FunctionalLength")->attribute("nominal"), "120.5");
  EXPECT_EQ(m->find("ProtrudingLength")->attribute("nominal"), "35");
  EXPECT_EQ(m->find("Weight")->attribute("nominal"), "250");  // grams
  const XmlNode* edges = root.children[1].children[0].find("CuttingToolLifeCycle")->find("CuttingItems");
  EXPECT_EQ(edges->attribute("count"), "4");
  EXPECT_EQ(edges->children.front().attribute("indices"), "1-4");
  const XmlNode* edge = edges->children.front().find("Measurements");
  EXPECT_EQ(edge->find("CornerRadius")->attribute("nominal"), "0.5");
  EXPECT_EQ(edge->find("PointAngle")->attribute("nominal"), "180");
}

TEST(MtConnect, TellsWhatHasNoPlaceAndAWornPieceIsExpired) {
  LossReport report;
  const XmlNode root = document(shop(), &report);
  EXPECT_THAT(report.dropped, Contains(Field(&LossReport::Line::field, "FHA")));
  EXPECT_THAT(report.derived, Contains(Field(&LossReport::Line::field, "timestamp")));
  std::vector<std::string> status;
  for (const XmlNode& s :
       root.children[1].children[1].find("CuttingToolLifeCycle")->find("CutterStatus")->children)
    status.push_back(s.text);
  EXPECT_THAT(status, ElementsAre("USED", "EXPIRED"));
}

TEST(MtConnect, TheSameLibraryGivesTheSameBytes) {
  Job job;
  EXPECT_EQ(write_mtconnect(shop(), {}, job)->bytes, write_mtconnect(shop(), {}, job)->bytes);
  EXPECT_FALSE(write_mtconnect({}, {}, job));
}

TEST(MtConnect, InchToolsSayTheirNativeUnit) {
  ToolLibrary l;
  l.items.push_back(end_mill());
  l.items.front().inches = true;
  const XmlNode root = document(l);
  const XmlNode* dc = root.children[1]
                          .children[0]
                          .find("CuttingToolLifeCycle")
                          ->find("Measurements")
                          ->find("CuttingDiameterMax");
  EXPECT_EQ(dc->attribute("units"), "MILLIMETER");
  EXPECT_EQ(dc->attribute("nativeUnits"), "INCH");
}

}  // namespace
}  // namespace capstan::tooling
