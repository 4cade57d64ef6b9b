#pragma once

#include <sqlite3.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "casebase/casebase.h"

namespace capstan::casebase {

/// A drilled hole of 10 mm in mild steel, 20 mm deep: 30 m/min, 0.1 mm per tooth.
inline Case sample(double diameter_mm = 10.0, double vc_m_min = 30.0, const std::string& source = "part 1") {
  Case c;
  c.asked = {.operation = "DRILLING",
             .material_group = "P/mild_steel",
             .tool_class = "hss/twist_drill",
             .machine_class = "generic_vmc",
             .diameter_mm = diameter_mm,
             .depth_mm = 20.0,
             .cutter_diameter_mm = diameter_mm,
             .teeth = 2,
             .coolant = Coolant::kFlood};
  c.origin = Origin::kMeasured;
  c.bound.vc_m_min = vc_m_min;
  c.bound.fz_mm = 0.1;
  c.observed.time_s = Figure{6.5};
  c.observed.verdict = Verdict::kGood;
  c.from.source = source;
  c.id = id_of(c);
  return c;
}

/// Random cases over a few categories, with many equal sizes among them.
inline std::vector<Case> random_cases(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  const auto pick = [&](unsigned below) { return static_cast<int>(random() % below); };
  std::vector<Case> out;
  for (std::size_t i = 0; i < n; ++i) {
    Case c =
        sample(1.0 + pick(20), 20.0 + pick(20), "lot " + std::to_string(seed) + " part " + std::to_string(i));
    c.asked.operation = pick(2) == 0 ? "DRILLING" : "REAMING";
    c.asked.depth_mm = 5.0 * (1 + pick(10));
    c.asked.tolerance_mm = pick(3) == 0 ? 0.0 : 0.01 * (1 + pick(5));
    c.id = id_of(c);
    out.push_back(c);
  }
  return out;
}

/// A folder of its own, gone when the test is over.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "capstan-cases-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string file(const std::string& name = "cases.db") const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Makes a base with these cases.
inline void fill(const std::string& path, const std::vector<Case>& cases) {
  Job job;
  auto base = CaseBase::open_or_create(path, job);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  const Status added = base->add(cases);
  ASSERT_TRUE(added.has_value()) << to_text(added.error());
}

/// Does to a file what the store never would.
inline void tamper(const std::string& path, const std::string& sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  char* why = nullptr;
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &why), SQLITE_OK) << (why != nullptr ? why : "");
  sqlite3_close(db);
}

}  // namespace capstan::casebase
