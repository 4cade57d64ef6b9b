#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/index/index.h"
#include "casebase/retain/join/steps.h"

/// What the case base is measured with: a hundred thousand points, cases, and rows of times.
namespace capstan::casebase {

inline constexpr std::size_t kPoints = 100'000, kDims = 16;

/// Points all over a cube, or around 500 centres, as the parts of a shop are.
inline const Points& points(bool clustered) {
  static const auto kMake = [](bool around) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-5.0, 5.0);
    std::normal_distribution<double> near(0.0, 0.1);
    std::vector<double> centres(500 * kDims);
    for (double& v : centres) v = any(random);
    Points out{kDims, {}};
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double* c = centres.data() + (random() % 500) * kDims;
      for (std::size_t d = 0; d < kDims; ++d)
        out.values.push_back(around ? c[d] + near(random) : any(random));
    }
    return out;
  };
  static const Points kUniform = kMake(false), kClustered = kMake(true);
  return clustered ? kClustered : kUniform;
}

/// Cases of some dozen categories, each with some twenty numbers.
inline Case made(std::uint64_t n) {
  std::mt19937_64 random(n);
  const auto pick = [&](std::uint64_t below) { return static_cast<double>(random() % below); };
  constexpr std::string_view kOperations[] = {"DRILLING", "REAMING", "SIDE_ROUGH_MILLING",
                                              "PLANE_FINISH_MILLING"};
  constexpr std::string_view kMaterials[] = {"P/c45", "N/6061", "M/304"};
  Case c;
  c.origin = Origin::kMeasured;
  c.asked.operation = kOperations[random() % 4];
  c.asked.material_group = kMaterials[random() % 3];
  c.asked.tool_class = "carbide/endmill";
  c.asked.machine_class = "generic_vmc";
  c.asked.diameter_mm = 3.0 + 0.1 * pick(300);
  c.asked.depth_mm = 5.0 + pick(40);
  c.asked.cutter_diameter_mm = 3.0 + pick(20);
  c.asked.teeth = static_cast<int>(2 + random() % 4);
  c.asked.stick_out_mm = 20.0 + pick(60);
  c.asked.hardness_hb = 100.0 + pick(150);
  c.asked.coolant = Coolant::kFlood;
  c.bound.vc_m_min = 50.0 + pick(200);
  c.bound.fz_mm = 0.01 + 0.001 * pick(100);
  c.bound.ap_mm = 1.0 + pick(5);
  c.observed.time_s = Figure{10.0 + pick(100), 0.1, Origin::kMeasured};
  c.observed.peak_force_n = Figure{100.0 + pick(900), 20.0, Origin::kMeasured};
  c.observed.verdict = random() % 10 == 0 ? Verdict::kBad : Verdict::kGood;
  c.from.part = "part " + std::to_string(n);
  c.from.source = "lot " + std::to_string(n / 1000);
  return c;
}

inline std::vector<Case> many(std::size_t n) {
  std::vector<Case> out;
  out.reserve(n);
  for (std::size_t i = 0; i < n; ++i) out.push_back(made(i));
  return out;
}

inline constexpr int kToolsOfTimes = 10;
/// The sheet of the table below.
inline std::vector<retain::Step> steps_of_times() {
  std::string sheet =
      "tool,workingstep,operation,material_group,tool_class,machine_class,cutter_diameter_mm,teeth,vc_m_min,"
      "fz_mm\n";
  for (int tool = 1; tool <= kToolsOfTimes; ++tool) {
    const std::string n = std::to_string(tool);
    sheet += n + ",STEP " + n + ",DRILLING,N/6061,carbide/twist_drill,generic_vmc," + n + ",2,100,0.1\n";
  }
  return retain::read_sheet(sheet, "sheet.csv").value();
}
/// Times of so many parts, a row a tool, as `retain::read_times` takes them.
inline std::string table_of_times(int parts) {
  std::string out = "part,tool,active_s,moving_s\n";
  for (int part = 1; part <= parts; ++part) {
    for (int tool = 1; tool <= kToolsOfTimes; ++tool)
      out += std::to_string(part) + ',' + std::to_string(tool) + ',' + std::to_string(12 + tool) + ',' +
             std::to_string(10 + tool) + '.' + std::to_string(100 + part % 900) + '\n';
  }
  return out;
}

}  // namespace capstan::casebase
