#include "planner/model/features/fit/deviation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "planner/model/features/fit/grade.h"

namespace capstan::model {
namespace {

constexpr std::int16_t o = std::numeric_limits<std::int16_t>::min();  // none

// Columns of kRows, in order; js and h are not stored.
constexpr std::array<std::string_view, 25> kColumns = {"a", "b", "c", "cd", "d",  "e",  "ef", "f", "fg",
                                                       "g", "k", "m", "n",  "p",  "r",  "s",  "t", "u",
                                                       "v", "x", "y", "z",  "za", "zb", "zc"};

struct Row {
  std::int16_t upto_mm;  // included
  std::array<std::int16_t, 25> um;
};

// ISO 286-1:2010, tables 4 and 5 (shafts): es of a .. g, ei of k (IT4 to IT7) .. zc, all grades, micrometres.
// Those of holes (tables 2 and 3, delta left out) are the same with the other sign. cd, ef, fg above 10 mm
// are new in that edition; ef of 18 to 30 mm as its Cor.1:2013 has it (first printed -25).
// clang-format off
constexpr std::array<Row, 41> kRows = {{
    //         a      b     c    cd    d    e   ef    f   fg   g  k   m   n   p    r    s    t    u    v    x    y    z    za    zb    zc
    {3,    { -270, -140,  -60,  -34, -20, -14, -10,  -6,  -4, -2, 0,  2,  4,  6,  10,  14,   o,  18,   o,  20,   o,   26,   32,   40,   60}},
    {6,    { -270, -140,  -70,  -46, -30, -20, -14, -10,  -6, -4, 1,  4,  8, 12,  15,  19,   o,  23,   o,  28,   o,   35,   42,   50,   80}},
    {10,   { -280, -150,  -80,  -56, -40, -25, -18, -13,  -8, -5, 1,  6, 10, 15,  19,  23,   o,  28,   o,  34,   o,   42,   52,   67,   97}},
    {14,   { -290, -150,  -95,  -70, -50, -32, -23, -16, -10, -6, 1,  7, 12, 18,  23,  28,   o,  33,   o,  40,   o,   50,   64,   90,  130}},
    {18,   { -290, -150,  -95,  -70, -50, -32, -23, -16, -10, -6, 1,  7, 12, 18,  23,  28,   o,  33,  39,  45,   o,   60,   77,  108,  150}},
    {24,   { -300, -160, -110,  -85, -65, -40, -28, -20, -12, -7, 2,  8, 15, 22,  28,  35,   o,  41,  47,  54,  63,   73,   98,  136,  188}},
    {30,   { -300, -160, -110,  -85, -65, -40, -28, -20, -12, -7, 2,  8, 15, 22,  28,  35,  41,  48,  55,  64,  75,   88,  118,  160,  218}},
    {40,   { -310, -170, -120, -100, -80, -50, -35, -25, -15, -9, 2,  9, 17, 26,  34,  43,  48,  60,  68,  80,  94,  112,  148,  200,  274}},
    {50,   { -320, -180, -130, -100, -80, -50, -35, -25, -15, -9, 2,  9, 17, 26,  34,  43,  54,  70,  81,  97, 114,  136,  180,  242,  325}},
    {65,   { -340, -190, -140,    o,-100, -60,   o, -30,   o,-10, 2, 11, 20, 32,  41,  53,  66,  87, 102, 122, 144,  172,  226,  300,  405}},
    {80,   { -360, -200, -150,    o,-100, -60,   o, -30,   o,-10, 2, 11, 20, 32,  43,  59,  75, 102, 120, 146, 174,  210,  274,  360,  480}},
    {100,  { -380, -220, -170,    o,-120, -72,   o, -36,   o,-12, 3, 13, 23, 37,  51,  71,  91, 124, 146, 178, 214,  258,  335,  445,  585}},
    {120,  { -410, -240, -180,    o,-120, -72,   o, -36,   o,-12, 3, 13, 23, 37,  54,  79, 104, 144, 172, 210, 254,  310,  400,  525,  690}},
    {140,  { -460, -260, -200,    o,-145, -85,   o, -43,   o,-14, 3, 15, 27, 43,  63,  92, 122, 170, 202, 248, 300,  365,  470,  620,  800}},
    {160,  { -520, -280, -210,    o,-145, -85,   o, -43,   o,-14, 3, 15, 27, 43,  65, 100, 134, 190, 228, 280, 340,  415,  535,  700,  900}},
    {180,  { -580, -310, -230,    o,-145, -85,   o, -43,   o,-14, 3, 15, 27, 43,  68, 108, 146, 210, 252, 310, 380,  465,  600,  780, 1000}},
    {200,  { -660, -340, -240,    o,-170,-100,   o, -50,   o,-15, 4, 17, 31, 50,  77, 122, 166, 236, 284, 350, 425,  520,  670,  880, 1150}},
    {225,  { -740, -380, -260,    o,-170,-100,   o, -50,   o,-15, 4, 17, 31, 50,  80, 130, 180, 258, 310, 385, 470,  575,  740,  960, 1250}},
    {250,  { -820, -420, -280,    o,-170,-100,   o, -50,   o,-15, 4, 17, 31, 50,  84, 140, 196, 284, 340, 425, 520,  640,  820, 1050, 1350}},
    {280,  { -920, -480, -300,    o,-190,-110,   o, -56,   o,-17, 4, 20, 34, 56,  94, 158, 218, 315, 385, 475, 580,  710,  920, 1200, 1550}},
    {315,  {-1050, -540, -330,    o,-190,-110,   o, -56,   o,-17, 4, 20, 34, 56,  98, 170, 240, 350, 425, 525, 650,  790, 1000, 1300, 1700}},
    {355,  {-1200, -600, -360,    o,-210,-125,   o, -62,   o,-18, 4, 21, 37, 62, 108, 190, 268, 390, 475, 590, 730,  900, 1150, 1500, 1900}},
    {400,  {-1350, -680, -400,    o,-210,-125,   o, -62,   o,-18, 4, 21, 37, 62, 114, 208, 294, 435, 530, 660, 820, 1000, 1300, 1650, 2100}},
    {450,  {-1500, -760, -440,    o,-230,-135,   o, -68,   o,-20, 5, 23, 40, 68, 126, 232, 330, 490, 595, 740, 920, 1100, 1450, 1850, 2400}},
    {500,  {-1650, -840, -480,    o,-230,-135,   o, -68,   o,-20, 5, 23, 40, 68, 132, 252, 360, 540, 660, 820,1000, 1250, 1600, 2100, 2600}},
    {560,  {o, o, o, o, -260, -145, o,  -76, o, -22, 0, 26,  44,  78, 150,  280,  400,  600, o, o, o, o, o, o, o}},
    {630,  {o, o, o, o, -260, -145, o,  -76, o, -22, 0, 26,  44,  78, 155,  310,  450,  660, o, o, o, o, o, o, o}},
    {710,  {o, o, o, o, -290, -160, o,  -80, o, -24, 0, 30,  50,  88, 175,  340,  500,  740, o, o, o, o, o, o, o}},
    {800,  {o, o, o, o, -290, -160, o,  -80, o, -24, 0, 30,  50,  88, 185,  380,  560,  840, o, o, o, o, o, o, o}},
    {900,  {o, o, o, o, -320, -170, o,  -86, o, -26, 0, 34,  56, 100, 210,  430,  620,  940, o, o, o, o, o, o, o}},
    {1000, {o, o, o, o, -320, -170, o,  -86, o, -26, 0, 34,  56, 100, 220,  470,  680, 1050, o, o, o, o, o, o, o}},
    {1120, {o, o, o, o, -350, -195, o,  -98, o, -28, 0, 40,  66, 120, 250,  520,  780, 1150, o, o, o, o, o, o, o}},
    {1250, {o, o, o, o, -350, -195, o,  -98, o, -28, 0, 40,  66, 120, 260,  580,  840, 1300, o, o, o, o, o, o, o}},
    {1400, {o, o, o, o, -390, -220, o, -110, o, -30, 0, 48,  78, 140, 300,  640,  960, 1450, o, o, o, o, o, o, o}},
    {1600, {o, o, o, o, -390, -220, o, -110, o, -30, 0, 48,  78, 140, 330,  720, 1050, 1600, o, o, o, o, o, o, o}},
    {1800, {o, o, o, o, -430, -240, o, -120, o, -32, 0, 58,  92, 170, 370,  820, 1200, 1850, o, o, o, o, o, o, o}},
    {2000, {o, o, o, o, -430, -240, o, -120, o, -32, 0, 58,  92, 170, 400,  920, 1350, 2000, o, o, o, o, o, o, o}},
    {2240, {o, o, o, o, -480, -260, o, -130, o, -34, 0, 68, 110, 195, 440, 1000, 1500, 2300, o, o, o, o, o, o, o}},
    {2500, {o, o, o, o, -480, -260, o, -130, o, -34, 0, 68, 110, 195, 460, 1100, 1650, 2500, o, o, o, o, o, o, o}},
    {2800, {o, o, o, o, -520, -290, o, -145, o, -38, 0, 76, 135, 240, 550, 1250, 1900, 2900, o, o, o, o, o, o, o}},
    {3150, {o, o, o, o, -520, -290, o, -145, o, -38, 0, 76, 135, 240, 580, 1400, 2100, 3200, o, o, o, o, o, o, o}},
}};

struct Main {
  std::int16_t upto_mm;                // included
  std::array<std::int16_t, 3> j;       // ei of j5 and j6, j7, j8: ISO 286-1:2010, table 4
  std::array<std::int16_t, 3> j_hole;  // ES of J6, J7, J8: table 2
  std::array<double, 6> delta;         // of IT3 .. IT8: table 3
};
constexpr std::array<Main, 13> kMain = {{
    {3,   { -2,  -4, -6}, { 2,  4,  6}, {0, 0, 0, 0, 0, 0}},
    {6,   { -2,  -4,  o}, { 5,  6, 10}, {1, 1.5, 1, 3, 4, 6}},
    {10,  { -2,  -5,  o}, { 5,  8, 12}, {1, 1.5, 2, 3, 6, 7}},
    {18,  { -3,  -6,  o}, { 6, 10, 15}, {1, 2, 3, 3, 7, 9}},
    {30,  { -4,  -8,  o}, { 8, 12, 20}, {1.5, 2, 3, 4, 8, 12}},
    {50,  { -5, -10,  o}, {10, 14, 24}, {1.5, 3, 4, 5, 9, 14}},
    {80,  { -7, -12,  o}, {13, 18, 28}, {2, 3, 5, 6, 11, 16}},
    {120, { -9, -15,  o}, {16, 22, 34}, {2, 4, 5, 7, 13, 19}},
    {180, {-11, -18,  o}, {18, 26, 41}, {3, 4, 6, 7, 15, 23}},
    {250, {-13, -21,  o}, {22, 30, 47}, {3, 4, 6, 9, 17, 26}},
    {315, {-16, -26,  o}, {25, 36, 55}, {4, 4, 7, 9, 20, 29}},
    {400, {-18, -28,  o}, {29, 39, 60}, {4, 5, 7, 11, 21, 32}},
    {500, {-20, -32,  o}, {33, 43, 66}, {5, 5, 7, 13, 23, 34}},
}};
// clang-format on

template <class Table>
auto row_of(const Table& table, double nominal_mm) {
  return std::find_if(table.begin(), table.end(),
                      [&](const auto& r) { return nominal_mm <= static_cast<double>(r.upto_mm); });
}

std::optional<double> value(std::int16_t um) {
  if (um == o) return std::nullopt;
  return static_cast<double>(um);
}

std::optional<double> column(double nominal_mm, std::string_view letter) {
  const auto row = row_of(kRows, nominal_mm);
  const auto at = std::find(kColumns.begin(), kColumns.end(), letter);
  if (!(nominal_mm > 0.0) || row == kRows.end() || at == kColumns.end()) return std::nullopt;
  if ((letter == "a" || letter == "b") && nominal_mm <= 1.0) return std::nullopt;
  return value(row->um[static_cast<std::size_t>(at - kColumns.begin())]);
}

std::optional<double> j_of(double nominal_mm, int grade, bool hole) {
  const auto row = row_of(kMain, nominal_mm);
  if (!(nominal_mm > 0.0) || row == kMain.end() || grade < (hole ? 6 : 5) || grade > 8) return std::nullopt;
  const auto k = static_cast<std::size_t>(std::max(grade - 6, 0));
  return value(hole ? row->j_hole[k] : row->j[k]);
}

bool before_h(std::string_view letter) { return letter[0] < 'h'; }  // a .. g with cd, ef, fg

}  // namespace

const std::vector<std::string_view>& fit_letters() {
  static const std::vector<std::string_view> kLetters = {
      "a", "b", "c", "cd", "d", "e", "ef", "f", "fg", "g", "h", "js", "j",  "k",
      "m", "n", "p", "r",  "s", "t", "u",  "v", "x",  "y", "z", "za", "zb", "zc"};
  return kLetters;
}

std::optional<double> shaft_deviation_um(double nominal_mm, std::string_view letter, int grade) {
  if (letter == "h") return 0.0;
  if (letter == "j") return j_of(nominal_mm, grade, false);
  if (letter == "k" && (grade < 4 || grade > 7)) return 0.0;
  return column(nominal_mm, letter);
}

std::optional<double> hole_deviation_um(double nominal_mm, std::string_view letter, int grade) {
  if (letter == "h") return 0.0;
  if (letter == "j") return j_of(nominal_mm, grade, true);
  const auto base = column(nominal_mm, letter);
  if (!base) return std::nullopt;
  if (before_h(letter)) return 0.0 - *base;
  if (letter == "k" && grade > 8 && nominal_mm > 3.0) return std::nullopt;
  if (letter == "n" && grade > 8 && nominal_mm <= kLargestCommonSize) {
    if (nominal_mm <= 1.0) return std::nullopt;
    if (nominal_mm > 3.0) return 0.0;
  }
  if (nominal_mm > kLargestCommonSize) return 0.0 - *base;  // no delta there
  if (grade < 3) return std::nullopt;
  if (letter == "m" && grade == 6 && nominal_mm > 250.0 && nominal_mm <= 315.0) return -9.0;
  const bool raised = grade <= (letter == "k" || letter == "m" || letter == "n" ? 8 : 7);
  const double delta = raised ? row_of(kMain, nominal_mm)->delta[static_cast<std::size_t>(grade - 3)] : 0.0;
  return delta - *base;
}

SizeSpan sizes_of(std::string_view letter) {
  if (letter == "h" || letter == "js") return {0.0, kLargestSize};
  if (letter == "j") return {0.0, kLargestCommonSize};
  SizeSpan out;
  double over = letter == "a" || letter == "b" ? 1.0 : 0.0;
  for (const Row& row : kRows) {
    const double upto = static_cast<double>(row.upto_mm);
    if (column(upto, letter)) {
      if (out.upto_mm == 0.0) out.over_mm = over;
      out.upto_mm = upto;
    }
    over = upto;
  }
  return out;
}

}  // namespace capstan::model
