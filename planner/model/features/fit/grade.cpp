#include "planner/model/features/fit/grade.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace capstan::model {
namespace {

constexpr double kSubtracted = 1e-9;  // mm; a width is a difference of decimals
constexpr double kSame = 5e-5;        // mm; half the last digit that the table has

struct SizeRange {
  double upto_mm;  // included
  std::array<double, 20> um;
};

// ISO 286-1:2010, table 1: IT01, IT0, IT1 .. IT18 in micrometres (the standard prints IT12 and coarser in
// mm). 0: none.
// clang-format off
constexpr std::array<SizeRange, 21> kRanges = {{
    {3,    {0.3, 0.5, 0.8, 1.2, 2, 3, 4, 6, 10, 14, 25, 40, 60, 100, 140, 250, 400, 600, 1000, 1400}},
    {6,    {0.4, 0.6, 1, 1.5, 2.5, 4, 5, 8, 12, 18, 30, 48, 75, 120, 180, 300, 480, 750, 1200, 1800}},
    {10,   {0.4, 0.6, 1, 1.5, 2.5, 4, 6, 9, 15, 22, 36, 58, 90, 150, 220, 360, 580, 900, 1500, 2200}},
    {18,   {0.5, 0.8, 1.2, 2, 3, 5, 8, 11, 18, 27, 43, 70, 110, 180, 270, 430, 700, 1100, 1800, 2700}},
    {30,   {0.6, 1, 1.5, 2.5, 4, 6, 9, 13, 21, 33, 52, 84, 130, 210, 330, 520, 840, 1300, 2100, 3300}},
    {50,   {0.6, 1, 1.5, 2.5, 4, 7, 11, 16, 25, 39, 62, 100, 160, 250, 390, 620, 1000, 1600, 2500, 3900}},
    {80,   {0.8, 1.2, 2, 3, 5, 8, 13, 19, 30, 46, 74, 120, 190, 300, 460, 740, 1200, 1900, 3000, 4600}},
    {120,  {1, 1.5, 2.5, 4, 6, 10, 15, 22, 35, 54, 87, 140, 220, 350, 540, 870, 1400, 2200, 3500, 5400}},
    {180,  {1.2, 2, 3.5, 5, 8, 12, 18, 25, 40, 63, 100, 160, 250, 400, 630, 1000, 1600, 2500, 4000, 6300}},
    {250,  {2, 3, 4.5, 7, 10, 14, 20, 29, 46, 72, 115, 185, 290, 460, 720, 1150, 1850, 2900, 4600, 7200}},
    {315,  {2.5, 4, 6, 8, 12, 16, 23, 32, 52, 81, 130, 210, 320, 520, 810, 1300, 2100, 3200, 5200, 8100}},
    {400,  {3, 5, 7, 9, 13, 18, 25, 36, 57, 89, 140, 230, 360, 570, 890, 1400, 2300, 3600, 5700, 8900}},
    {500,  {4, 6, 8, 10, 15, 20, 27, 40, 63, 97, 155, 250, 400, 630, 970, 1550, 2500, 4000, 6300, 9700}},
    {630,  {0, 0, 9, 11, 16, 22, 32, 44, 70, 110, 175, 280, 440, 700, 1100, 1750, 2800, 4400, 7000, 11000}},
    {800,  {0, 0, 10, 13, 18, 25, 36, 50, 80, 125, 200, 320, 500, 800, 1250, 2000, 3200, 5000, 8000, 12500}},
    {1000, {0, 0, 11, 15, 21, 28, 40, 56, 90, 140, 230, 360, 560, 900, 1400, 2300, 3600, 5600, 9000, 14000}},
    {1250, {0, 0, 13, 18, 24, 33, 47, 66, 105, 165, 260, 420, 660, 1050, 1650, 2600, 4200, 6600, 10500, 16500}},
    {1600, {0, 0, 15, 21, 29, 39, 55, 78, 125, 195, 310, 500, 780, 1250, 1950, 3100, 5000, 7800, 12500, 19500}},
    {2000, {0, 0, 18, 25, 35, 46, 65, 92, 150, 230, 370, 600, 920, 1500, 2300, 3700, 6000, 9200, 15000, 23000}},
    {2500, {0, 0, 22, 30, 41, 55, 78, 110, 175, 280, 440, 700, 1100, 1750, 2800, 4400, 7000, 11000, 17500, 28000}},
    {3150, {0, 0, 26, 36, 50, 68, 96, 135, 210, 330, 540, 860, 1350, 2100, 3300, 5400, 8600, 13500, 21000, 33000}},
}};
// clang-format on

}  // namespace

double from_micrometres(double um) { return std::round(20.0 * um) / 20000.0; }

std::optional<double> tolerance_grade(double nominal_mm, int grade) {
  if (grade < kFinestGrade || grade > kCoarsestGrade || !(nominal_mm > 0.0)) return std::nullopt;
  const auto it = std::find_if(kRanges.begin(), kRanges.end(),
                               [&](const SizeRange& r) { return nominal_mm <= r.upto_mm; });
  if (it == kRanges.end()) return std::nullopt;
  const double um = it->um[static_cast<std::size_t>(grade - kFinestGrade)];
  if (um == 0.0) return std::nullopt;
  return from_micrometres(um);
}

std::optional<int> grade_of(double nominal_mm, double width_mm) {
  for (int grade = kCoarsestGrade; grade >= kFinestGrade; --grade) {
    const auto t = tolerance_grade(nominal_mm, grade);
    if (t && *t <= width_mm + kSubtracted) return grade;
  }
  return std::nullopt;
}

std::optional<int> grade_of_exact(double nominal_mm, double width_mm) {
  for (int grade = kFinestGrade; grade <= kCoarsestGrade; ++grade) {
    const auto t = tolerance_grade(nominal_mm, grade);
    if (t && std::abs(*t - width_mm) <= kSame) return grade;
  }
  return std::nullopt;
}

std::string grade_name(int grade) { return grade == kIt01 ? "IT01" : "IT" + std::to_string(grade); }

}  // namespace capstan::model
