#include "tooling/library/store/store.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "planner/ground/base/file.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/format.h"
#include "tooling/library/library.h"
#include "tooling/selection/select.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::ToolRequirement;

const std::vector<Cutter>& cutters() {
  static const std::vector<Cutter> kCutters = generic_library().value();
  return kCutters;
}

/// A library with something in every record.
ToolLibrary records() {
  ToolLibrary l;
  l.name = "shop";
  l.source = "crib.json";
  l.kept = {{"version", "7"}};
  CatalogueItem item;
  item.id = "em10";
  item.cutter_class = CutterClass::kEndmill;
  item.properties = {{"DC", 10.0, "10", "mm", ValueState::kStated, "label"},
                     {"X", std::nullopt, "", "", ValueState::kDefault, ""}};
  Preset steel;
  steel.name = "steel";
  steel.material = "P";
  steel.vc_m_min = 120.0;
  item.presets = {steel};
  item.inches = true;
  l.items = {item};
  ToolInstance piece;
  piece.id = "em10#1";
  piece.item = "em10";
  piece.group = "g";
  piece.in_stock = 2;
  piece.price = 31.5;
  l.instances = {piece};
  Holder h;
  h.id = "er32";
  h.segments = {{70, 50, 50}};
  l.holders = {h};
  l.assemblies = {{"a", "em10", "em10#1", "er32", 33.0, std::nullopt}};
  MachineEntry entry;
  entry.number = 3;
  entry.pocket = 3;
  entry.assembly = "a";
  entry.offsets = {{'Z', 102.5}};
  entry.comment = "10 mm";
  l.entries = {entry};
  return l;
}

const std::string& bytes() {
  static const std::string kBytes = store_of(records(), cutters()).value();
  return kBytes;
}

/// The bytes after a statement by somebody else.
std::string altered(const std::string& sql) {
  std::string copy = bytes();
  sqlite3* db = nullptr;
  sqlite3_open_v2(":memory:", &db, SQLITE_OPEN_READWRITE, nullptr);
  auto* owned = static_cast<unsigned char*>(sqlite3_malloc64(copy.size()));
  std::copy(copy.begin(), copy.end(), owned);
  sqlite3_deserialize(db, "main", owned, static_cast<sqlite3_int64>(copy.size()),
                      static_cast<sqlite3_int64>(copy.size()),
                      SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
  sqlite3_int64 size = 0;
  unsigned char* out = sqlite3_serialize(db, "main", &size, 0);
  std::string result(reinterpret_cast<const char*>(out), static_cast<std::size_t>(size));
  sqlite3_free(out);
  sqlite3_close(db);
  return result;
}

std::string code_of(std::string stored) {
  auto s = ToolStore::from_bytes(std::move(stored), "shop.sqlite");
  if (!s) return s.error().code;
  if (const auto all = s->all_cutters(); !all) return all.error().code;
  if (const auto l = s->library(); !l) return l.error().code;
  return "ok";
}

TEST(ToolStore, GivesBackRecordsAndCuttersAsTheyWere) {
  const auto s = ToolStore::from_bytes(bytes(), "shop.sqlite");
  ASSERT_TRUE(s) << to_text(s.error());
  EXPECT_EQ(s->size(), cutters().size());
  EXPECT_EQ(s->library().value(), records());
  EXPECT_EQ(s->all_cutters().value(), cutters());
}

TEST(ToolStore, IsReadFromAFileToo) {
  const auto path = std::filesystem::temp_directory_path() / "capstan_store_test.sqlite";
  ASSERT_TRUE(write_file(path.string(), bytes()));
  const auto s = ToolStore::open(path.string());
  ASSERT_TRUE(s) << to_text(s.error());
  EXPECT_EQ(s->all_cutters().value(), cutters());
  std::filesystem::remove(path);
  EXPECT_EQ(ToolStore::open(path.string()).error().code, "TOOLSTORE-OPEN");
}

TEST(ToolStore, IsTheSameBytesEachTime) { EXPECT_EQ(store_of(records(), cutters()).value(), bytes()); }

TEST(ToolStore, FindsEveryCutterThatSelectionAccepts) {
  const auto s = ToolStore::from_bytes(bytes(), "shop.sqlite").value();
  Job job;
  const auto machine = load_machine("generic_vmc", job).value();
  const auto material = find_material("mild_steel", shipped_materials().value(), job).value();
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> size(1.0, 40.0), unit(0.0, 1.0);
  std::uniform_int_distribution<int> cls(0, static_cast<int>(model::kLastCutterClass));
  std::size_t accepted = 0;
  for (int i = 0; i < 400; ++i) {
    ToolRequirement r;
    r.classes = {static_cast<CutterClass>(cls(rng)), static_cast<CutterClass>(cls(rng))};
    if (unit(rng) < 0.4) {
      r.diameter_exact_mm = std::round(size(rng) * 2.0) / 2.0;
      r.diameter_tolerance_mm = unit(rng);
    } else {
      r.diameter_max_mm = size(rng);
      if (unit(rng) < 0.3) r.diameter_min_mm = 0.5 * r.diameter_max_mm;
    }
    r.reach_mm = unit(rng) * 50.0;
    r.depth_of_cut_mm = unit(rng) < 0.5 ? unit(rng) * 20.0 : 0.0;
    r.corner_radius_limited = unit(rng) < 0.3;
    r.corner_radius_max_mm = unit(rng) * 2.0;
    Preferences p;
    p.most = 1000;
    const auto found = s.cutters(s.find(r)).value();
    const auto all = select(r, cutters(), material, machine, p);
    const auto some = select(r, found, material, machine, p);
    ASSERT_EQ(all.ranked.size(), some.ranked.size()) << words_of(r);
    for (std::size_t k = 0; k < all.ranked.size(); ++k)
      EXPECT_EQ(all.ranked[k].cutter, some.ranked[k].cutter) << words_of(r);
    accepted += all.ranked.size();
  }
  EXPECT_GT(accepted, 500u);
}

TEST(ToolStore, ASingleFlippedBitNeverChangesWhatIsRead) {
  // A small store, so that most of its bytes matter.
  const std::vector<Cutter> few(cutters().begin(), cutters().begin() + 6);
  const std::string good = store_of(records(), few).value();
  std::mt19937 rng(5);
  std::uniform_int_distribution<std::size_t> at(0, good.size() - 1);
  int refused = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string bad = good;
    bad[at(rng)] ^= static_cast<char>(1 << (i % 8));
    auto s = ToolStore::from_bytes(bad, "bad.sqlite");
    if (!s) {
      ++refused;
      continue;
    }
    const auto all = s->all_cutters();
    const auto l = s->library();
    if (!all || !l) {
      ++refused;
      continue;
    }
    EXPECT_EQ(*all, few);
    EXPECT_EQ(*l, records());
  }
  EXPECT_GT(refused, 300);
}

TEST(ToolStore, OfAnEarlierVersionSaysHowToImportItAgain) {
  const auto store = ToolStore::from_bytes(altered("PRAGMA user_version = 1"), "old.sqlite");
  ASSERT_FALSE(store);
  EXPECT_NE(to_text(store.error()).find("capstan tools import"), std::string::npos) << to_text(store.error());
}

TEST(ToolStore, RefusesWhatSomebodyElsePutIn) {
  EXPECT_EQ(code_of(bytes()), "ok");
  EXPECT_EQ(code_of(altered("CREATE VIEW v AS SELECT 1")), "TOOLSTORE-SCHEMA");
  EXPECT_EQ(code_of(altered("CREATE TRIGGER t AFTER INSERT ON capstan_cutter BEGIN SELECT 1; END")),
            "TOOLSTORE-SCHEMA");
  EXPECT_EQ(code_of(altered("CREATE TABLE other(x)")), "TOOLSTORE-SCHEMA");
  EXPECT_EQ(code_of(altered("DROP TABLE capstan_index")), "TOOLSTORE-SCHEMA");
  EXPECT_EQ(code_of(altered("PRAGMA user_version = 3")), "TOOLSTORE-SCHEMA");
  EXPECT_EQ(code_of(altered("PRAGMA application_id = 1")), "TOOLSTORE-SCHEMA");
  EXPECT_EQ(code_of(altered("UPDATE capstan_index SET diameter = 6 WHERE place = 3")), "TOOLSTORE-DAMAGED");
  EXPECT_EQ(code_of(altered("DELETE FROM capstan_index WHERE place = 3")), "TOOLSTORE-DAMAGED");
  EXPECT_EQ(code_of(altered("DELETE FROM capstan_cutter WHERE place = 3")), "TOOLSTORE-DAMAGED");
  EXPECT_EQ(code_of(altered("DELETE FROM capstan_record WHERE kind = 'item'")), "TOOLSTORE-DAMAGED");
  EXPECT_EQ(code_of(altered("DELETE FROM capstan_record WHERE kind = 'library'")), "TOOLSTORE-DAMAGED");
  EXPECT_EQ(
      code_of(altered("UPDATE capstan_cutter SET body = (SELECT body FROM capstan_cutter WHERE place = 1), "
                      "hash = (SELECT hash FROM capstan_cutter WHERE place = 1) WHERE place = 2")),
      "TOOLSTORE-DAMAGED");
}

TEST(ToolStore, RefusesACutterThatCannotBeThoughItsHashFits) {
  std::vector<Cutter> bad(cutters().begin(), cutters().begin() + 3);
  bad[1].teeth = -4;
  EXPECT_EQ(code_of(store_of({}, bad).value()), "TOOLSTORE-DAMAGED");
}

TEST(StoreFormat, IsALibraryLikeAnyOther) {
  const Format* format = find_format("store");
  ASSERT_NE(format, nullptr);
  const ToolLibrary l = library_of({cutters().begin(), cutters().begin() + 40}, "forty");
  Job job;
  const auto written = format->write(l, {}, job);
  ASSERT_TRUE(written) << to_text(written.error());
  EXPECT_TRUE(format->recognises(written->bytes, "tools"));
  const auto back = format->read(written->bytes, "tools.sqlite", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(back->library, l);
  LossReport report;
  EXPECT_EQ(ToolStore::from_bytes(written->bytes, "").value().all_cutters().value(),
            cutters_of(l, report, job).value());
  EXPECT_EQ(read_library(written->bytes, "tools.sqlite", job).value(), cutters_of(l, report, job).value());
}

TEST(ToolStore, IsNoneOfTheOtherFiles) {
  EXPECT_EQ(code_of("T1 P1 D6 ;end mill"), "TOOLSTORE-SCHEMA");
  EXPECT_EQ(code_of(bytes().substr(0, bytes().size() / 2)), "TOOLSTORE-DAMAGED");
  EXPECT_TRUE(looks_like_store(bytes()));
  EXPECT_FALSE(looks_like_store("SQLite"));
}

}  // namespace
}  // namespace capstan::tooling
