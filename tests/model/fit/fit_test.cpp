#include "planner/model/features/fit/fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "planner/model/features/fit/deviation.h"

namespace capstan::model {
namespace {

constexpr std::array<double, 25> kEnds = {3,   6,   10,  14,  18,  24,  30,  40,  50,  65,  80,  100, 120,
                                          140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500};

std::string upper(std::string_view letter) {
  std::string out(letter);
  for (char& c : out) c = static_cast<char>(c - 'a' + 'A');
  return out;
}

void expect_fit(double nominal_mm, const std::string& name, double upper_um, double lower_um) {
  const auto d = fit(nominal_mm, name);
  ASSERT_TRUE(d) << to_text(d.error());
  EXPECT_NEAR(1000.0 * d->upper_mm, upper_um, 1e-9) << nominal_mm << " " << name;
  EXPECT_NEAR(1000.0 * d->lower_mm, lower_um, 1e-9) << nominal_mm << " " << name;
}

// The limit that the letter fixes.
void expect_fixed(double nominal_mm, const std::string& name, double um) {
  const auto c = parse_fit(name);
  ASSERT_TRUE(c) << name;
  const auto d = fit(nominal_mm, *c);
  ASSERT_TRUE(d) << to_text(d.error());
  const bool lower = c->hole == (c->letter[0] <= 'h');
  EXPECT_NEAR(1000.0 * (lower ? d->lower_mm : d->upper_mm), um, 1e-9) << nominal_mm << " " << name;
}

struct Limits {
  double upper_um, lower_um;
};
struct PrintedClass {
  const char* name;
  std::array<Limits, 11> limits;
};
constexpr std::array<double, 11> kPrintedEnds = {6, 10, 18, 30, 40, 65, 100, 140, 200, 280, 355};

// github.com/parkergreene/isofits, iso_shafts.csv: limits in micrometres for the ranges ending at
// kPrintedEnds. Its f6 of 120 to 180 mm is printed -43/-48, an interval of 5 where IT6 is 25: left out here,
// tested below.
// clang-format off
constexpr std::array<PrintedClass, 34> kShafts = {{
    {"d6", {{{-30, -38}, {-40, -49}, {-50, -61}, {-65, -78}, {-80, -96}, {-100, -119}, {-120, -142}, {-145, -170}, {-170, -199}, {-190, -222}, {-210, -246}}}},
    {"e6", {{{-20, -28}, {-25, -34}, {-32, -43}, {-40, -53}, {-50, -66}, {-60, -79}, {-72, -94}, {-85, -110}, {-100, -129}, {-110, -142}, {-125, -161}}}},
    {"e13", {{{-20, -200}, {-25, -245}, {-32, -302}, {-40, -370}, {-50, -440}, {-60, -520}, {-72, -612}, {-85, -715}, {-100, -820}, {-110, -920}, {-125, -1015}}}},
    {"f5", {{{-10, -15}, {-13, -19}, {-16, -24}, {-20, -29}, {-25, -36}, {-30, -43}, {-36, -51}, {-43, -61}, {-50, -70}, {-56, -79}, {-62, -87}}}},
    {"f7", {{{-10, -22}, {-13, -28}, {-16, -34}, {-20, -41}, {-25, -50}, {-30, -60}, {-36, -71}, {-43, -83}, {-50, -96}, {-56, -108}, {-62, -119}}}},
    {"g5", {{{-4, -9}, {-5, -11}, {-6, -14}, {-7, -16}, {-9, -20}, {-10, -23}, {-12, -27}, {-14, -32}, {-15, -35}, {-17, -40}, {-18, -43}}}},
    {"g6", {{{-4, -12}, {-5, -14}, {-6, -17}, {-7, -20}, {-9, -25}, {-10, -29}, {-12, -34}, {-14, -39}, {-15, -44}, {-17, -49}, {-18, -54}}}},
    {"g7", {{{-4, -16}, {-5, -20}, {-6, -24}, {-7, -28}, {-9, -34}, {-10, -40}, {-12, -47}, {-14, -54}, {-15, -61}, {-17, -69}, {-18, -75}}}},
    {"h4", {{{0, -4}, {0, -4}, {0, -5}, {0, -6}, {0, -7}, {0, -8}, {0, -10}, {0, -12}, {0, -14}, {0, -16}, {0, -18}}}},
    {"h6", {{{0, -8}, {0, -9}, {0, -11}, {0, -13}, {0, -16}, {0, -19}, {0, -22}, {0, -25}, {0, -29}, {0, -32}, {0, -36}}}},
    {"h9", {{{0, -30}, {0, -36}, {0, -43}, {0, -52}, {0, -62}, {0, -74}, {0, -87}, {0, -100}, {0, -115}, {0, -130}, {0, -140}}}},
    {"h11", {{{0, -75}, {0, -90}, {0, -110}, {0, -130}, {0, -160}, {0, -190}, {0, -220}, {0, -250}, {0, -290}, {0, -320}, {0, -360}}}},
    {"h12", {{{0, -120}, {0, -150}, {0, -180}, {0, -210}, {0, -250}, {0, -300}, {0, -350}, {0, -400}, {0, -460}, {0, -520}, {0, -570}}}},
    {"j5", {{{3, -2}, {4, -2}, {5, -3}, {5, -4}, {6, -5}, {6, -7}, {6, -9}, {7, -11}, {7, -13}, {7, -16}, {7, -18}}}},
    {"j6", {{{6, -2}, {7, -2}, {8, -3}, {9, -4}, {11, -5}, {12, -7}, {13, -9}, {14, -11}, {16, -13}, {16, -16}, {18, -18}}}},
    {"j7", {{{8, -4}, {10, -5}, {12, -6}, {13, -8}, {15, -10}, {18, -12}, {20, -15}, {22, -18}, {25, -21}, {26, -26}, {29, -28}}}},
    {"js5", {{{2.5, -2.5}, {3, -3}, {4, -4}, {4.5, -4.5}, {5.5, -5.5}, {6.5, -6.5}, {7.5, -7.5}, {9, -9}, {10, -10}, {11.5, -11.5}, {12.5, -12.5}}}},
    {"js6", {{{4, -4}, {4.5, -4.5}, {5.5, -5.5}, {6.5, -6.5}, {8, -8}, {9.5, -9.5}, {11, -11}, {12.5, -12.5}, {14.5, -14.5}, {16, -16}, {18, -18}}}},
    {"js7", {{{6, -6}, {7.5, -7.5}, {9, -9}, {10.5, -10.5}, {12.5, -12.5}, {15, -15}, {17.5, -17.5}, {20, -20}, {23, -23}, {26, -26}, {28.5, -28.5}}}},
    {"k5", {{{6, 1}, {7, 1}, {9, 1}, {11, 2}, {13, 2}, {15, 2}, {18, 3}, {21, 3}, {24, 4}, {27, 4}, {29, 4}}}},
    {"k6", {{{9, 1}, {10, 1}, {12, 1}, {15, 2}, {18, 2}, {21, 2}, {25, 3}, {28, 3}, {33, 4}, {36, 4}, {40, 4}}}},
    {"k7", {{{13, 1}, {16, 1}, {19, 1}, {23, 2}, {27, 2}, {32, 2}, {38, 3}, {43, 3}, {50, 4}, {56, 4}, {61, 4}}}},
    {"m5", {{{9, 4}, {12, 6}, {15, 7}, {17, 8}, {20, 9}, {24, 11}, {28, 13}, {33, 15}, {37, 17}, {43, 20}, {46, 21}}}},
    {"m6", {{{12, 4}, {15, 6}, {18, 7}, {21, 8}, {25, 9}, {30, 11}, {35, 13}, {40, 15}, {46, 17}, {52, 20}, {57, 21}}}},
    {"m7", {{{16, 4}, {21, 6}, {25, 7}, {29, 8}, {34, 9}, {41, 11}, {48, 13}, {55, 15}, {63, 17}, {72, 20}, {78, 21}}}},
    {"n5", {{{13, 8}, {16, 10}, {20, 12}, {24, 15}, {28, 17}, {33, 20}, {38, 23}, {45, 27}, {51, 31}, {57, 34}, {62, 37}}}},
    {"n6", {{{16, 8}, {19, 10}, {23, 12}, {28, 15}, {33, 17}, {39, 20}, {45, 23}, {52, 27}, {60, 31}, {66, 34}, {73, 37}}}},
    {"n7", {{{20, 8}, {25, 10}, {30, 12}, {36, 15}, {42, 17}, {50, 20}, {58, 23}, {67, 27}, {77, 31}, {86, 34}, {94, 37}}}},
    {"p5", {{{17, 12}, {21, 15}, {26, 18}, {31, 22}, {37, 26}, {45, 32}, {52, 37}, {61, 43}, {70, 50}, {79, 56}, {87, 62}}}},
    {"p6", {{{20, 12}, {24, 15}, {29, 18}, {35, 22}, {42, 26}, {51, 32}, {59, 37}, {68, 43}, {79, 50}, {88, 56}, {98, 62}}}},
    {"r6", {{{23, 15}, {28, 19}, {34, 23}, {41, 28}, {50, 34}, {60, 41}, {73, 51}, {88, 63}, {106, 77}, {126, 94}, {144, 108}}}},
    {"a12", {{{-270, -390}, {-280, -430}, {-290, -470}, {-300, -510}, {-310, -560}, {-340, -640}, {-380, -730}, {-460, -860}, {-660, -1120}, {-920, -1440}, {-1200, -1770}}}},
    {"h8", {{{0, -18}, {0, -22}, {0, -27}, {0, -33}, {0, -39}, {0, -46}, {0, -54}, {0, -63}, {0, -72}, {0, -81}, {0, -89}}}},
    {"h10", {{{0, -48}, {0, -58}, {0, -70}, {0, -84}, {0, -100}, {0, -120}, {0, -140}, {0, -160}, {0, -185}, {0, -210}, {0, -230}}}},
}};

// The same, iso_holes.csv. Its K6 of 6 to 10 mm is printed +2/-6 (8 wide, IT6 is 9) and its E7 of 315 to 355 mm
// +185/+125 (60 wide, IT7 is 57): both left out here, tested below.
constexpr std::array<PrintedClass, 25> kHoles = {{
    {"E6", {{{28, 20}, {34, 25}, {43, 32}, {53, 40}, {66, 50}, {79, 60}, {94, 72}, {110, 85}, {129, 100}, {142, 110}, {161, 125}}}},
    {"E11", {{{95, 20}, {115, 25}, {142, 32}, {170, 40}, {210, 50}, {250, 60}, {292, 72}, {335, 85}, {390, 100}, {430, 110}, {485, 125}}}},
    {"E12", {{{140, 20}, {175, 25}, {212, 32}, {250, 40}, {300, 50}, {360, 60}, {422, 72}, {485, 85}, {560, 100}, {630, 110}, {695, 125}}}},
    {"F7", {{{22, 10}, {28, 13}, {34, 16}, {41, 20}, {50, 25}, {60, 30}, {71, 36}, {83, 43}, {96, 50}, {108, 56}, {119, 62}}}},
    {"F8", {{{28, 10}, {35, 13}, {43, 16}, {53, 20}, {64, 25}, {76, 30}, {90, 36}, {106, 43}, {122, 50}, {137, 56}, {151, 62}}}},
    {"G6", {{{12, 4}, {14, 5}, {17, 6}, {20, 7}, {25, 9}, {29, 10}, {34, 12}, {39, 14}, {44, 15}, {49, 17}, {54, 18}}}},
    {"G7", {{{16, 4}, {20, 5}, {24, 6}, {28, 7}, {34, 9}, {40, 10}, {47, 12}, {54, 14}, {61, 15}, {69, 17}, {75, 18}}}},
    {"H6", {{{8, 0}, {9, 0}, {11, 0}, {13, 0}, {16, 0}, {19, 0}, {22, 0}, {25, 0}, {29, 0}, {32, 0}, {36, 0}}}},
    {"H7", {{{12, 0}, {15, 0}, {18, 0}, {21, 0}, {25, 0}, {30, 0}, {35, 0}, {40, 0}, {46, 0}, {52, 0}, {57, 0}}}},
    {"H8", {{{18, 0}, {22, 0}, {27, 0}, {33, 0}, {39, 0}, {46, 0}, {54, 0}, {63, 0}, {72, 0}, {81, 0}, {89, 0}}}},
    {"H11", {{{75, 0}, {90, 0}, {110, 0}, {130, 0}, {160, 0}, {190, 0}, {220, 0}, {250, 0}, {290, 0}, {320, 0}, {360, 0}}}},
    {"J6", {{{5, -3}, {5, -4}, {6, -5}, {8, -5}, {10, -6}, {13, -6}, {16, -6}, {18, -7}, {22, -7}, {25, -7}, {29, -7}}}},
    {"J7", {{{6, -6}, {8, -7}, {10, -8}, {12, -9}, {14, -11}, {18, -12}, {22, -13}, {26, -14}, {30, -16}, {36, -16}, {39, -18}}}},
    {"J8", {{{10, -8}, {12, -10}, {15, -12}, {20, -13}, {24, -15}, {28, -18}, {34, -20}, {41, -22}, {47, -25}, {55, -26}, {60, -29}}}},
    {"JS8", {{{9, -9}, {11, -11}, {13.5, -13.5}, {16.5, -16.5}, {19.5, -19.5}, {23, -23}, {27, -27}, {31.5, -31.5}, {36, -36}, {40.5, -40.5}, {44.5, -44.5}}}},
    {"K7", {{{3, -9}, {5, -10}, {6, -12}, {6, -15}, {7, -18}, {9, -21}, {10, -25}, {12, -28}, {13, -33}, {16, -36}, {17, -40}}}},
    {"K8", {{{5, -13}, {6, -16}, {8, -19}, {10, -23}, {12, -27}, {14, -32}, {16, -38}, {20, -43}, {22, -50}, {25, -56}, {28, -61}}}},
    {"M6", {{{-1, -9}, {-3, -12}, {-4, -15}, {-4, -17}, {-4, -20}, {-5, -24}, {-6, -28}, {-8, -33}, {-8, -37}, {-9, -41}, {-10, -46}}}},
    {"M7", {{{0, -12}, {0, -15}, {0, -18}, {0, -21}, {0, -25}, {0, -30}, {0, -35}, {0, -40}, {0, -46}, {0, -52}, {0, -57}}}},
    {"M8", {{{2, -16}, {1, -21}, {2, -25}, {4, -29}, {5, -34}, {5, -41}, {6, -48}, {8, -55}, {9, -63}, {9, -72}, {11, -78}}}},
    {"N6", {{{-5, -13}, {-7, -16}, {-9, -20}, {-11, -24}, {-12, -28}, {-14, -33}, {-16, -38}, {-20, -45}, {-22, -51}, {-25, -57}, {-26, -62}}}},
    {"N7", {{{-4, -16}, {-4, -19}, {-5, -23}, {-7, -28}, {-8, -33}, {-9, -39}, {-10, -45}, {-12, -52}, {-14, -60}, {-14, -66}, {-16, -73}}}},
    {"P6", {{{-9, -17}, {-12, -21}, {-15, -26}, {-18, -31}, {-21, -37}, {-26, -45}, {-30, -52}, {-36, -61}, {-41, -70}, {-47, -79}, {-51, -87}}}},
    {"P7", {{{-8, -20}, {-9, -24}, {-11, -29}, {-14, -35}, {-17, -42}, {-21, -51}, {-24, -59}, {-28, -68}, {-33, -79}, {-36, -88}, {-41, -98}}}},
    {"R7", {{{-11, -23}, {-13, -28}, {-16, -34}, {-20, -41}, {-25, -50}, {-30, -60}, {-38, -73}, {-48, -88}, {-60, -106}, {-74, -126}, {-87, -144}}}},
}};

// clang-format on

TEST(Fit, GivesTheLimitsThatIsofitsPrints) {
  for (const auto& table :
       {std::pair{kShafts.data(), kShafts.size()}, std::pair{kHoles.data(), kHoles.size()}}) {
    for (std::size_t i = 0; i < table.second; ++i) {
      const PrintedClass& c = table.first[i];
      for (std::size_t k = 0; k < kPrintedEnds.size(); ++k)
        expect_fit(kPrintedEnds[k], c.name, c.limits[k].upper_um, c.limits[k].lower_um);
    }
  }
}

TEST(Fit, KeepsTheWidthWherePublicTablesMisprintIt) {
  expect_fit(150.0, "f6", -43, -68);  // isofits: -43/-48
  expect_fit(8.0, "K6", 2, -7);       // isofits: +2/-6
  expect_fit(350.0, "E7", 182, 125);  // isofits: +185/+125
}

TEST(Fit, GivesTheLimitsThatTheStandardsOwnCorrigendumPrints) {
  // ISO 286-2:1988/Cor.1:2006.
  EXPECT_EQ(fit(350.0, "A13")->upper_mm, 2.090);
  EXPECT_EQ(fit(100.0, "E8")->upper_mm, 0.126);
  EXPECT_EQ(fit(25.0, "R10")->upper_mm, -0.028);
  EXPECT_EQ(fit(300.0, "f9")->lower_mm, -0.186);
}

TEST(Fit, HangsHolesFromPToZcWhereUsefastenerPrints) {
  // usefastener.com, "Values of the fundamental deviations for holes N to ZC, EN ISO 286-1": ES above IT7. 0:
  // none.
  constexpr std::array<const char*, 12> kLetters = {"P", "R", "S", "T",  "U",  "V",
                                                    "X", "Y", "Z", "ZA", "ZB", "ZC"};
  struct Row {
    double end_mm;
    std::array<double, 12> um;
  };
  constexpr std::array<Row, 18> kRows = {{
      {3, {-6, -10, -14, 0, -18, 0, -20, 0, -26, -32, -40, -60}},
      {6, {-12, -15, -19, 0, -23, 0, -28, 0, -35, -42, -50, -80}},
      {10, {-15, -19, -23, 0, -28, 0, -34, 0, -42, -52, -67, -97}},
      {14, {-18, -23, -28, 0, -33, 0, -40, 0, -50, -64, -90, -130}},
      {18, {-18, -23, -28, 0, -33, -39, -45, 0, -60, -77, -108, -150}},
      {24, {-22, -28, -35, 0, -41, -47, -54, -63, -73, -98, -136, -188}},
      {30, {-22, -28, -35, -41, -48, -55, -64, -75, -88, -118, -160, -218}},
      {40, {-26, -34, -43, -48, -60, -68, -80, -94, -112, -148, -200, -274}},
      {50, {-26, -34, -43, -54, -70, -81, -97, -114, -136, -180, -242, -325}},
      {65, {-32, -41, -53, -66, -87, -102, -122, -144, -172, -226, -300, -405}},
      {80, {-32, -43, -59, -75, -102, -120, -146, -174, -210, -274, -360, -480}},
      {100, {-37, -51, -71, -91, -124, -146, -178, -214, -258, -335, -445, -585}},
      {120, {-37, -54, -79, -104, -144, -172, -210, -254, -310, -400, -525, -690}},
      {140, {-43, -63, -92, -122, -170, -202, -248, -300, -365, -470, -620, -800}},
      {160, {-43, -65, -100, -134, -190, -228, -280, -340, -415, -535, -700, -900}},
      {180, {-43, -68, -108, -146, -210, -252, -310, -380, -465, -600, -780, -1000}},
      {200, {-50, -77, -122, -166, -236, -284, -350, -425, -520, -670, -880, -1150}},
      {225, {-50, -80, -130, -180, -258, -310, -385, -470, -575, -740, -960, -1250}},
  }};
  for (const Row& row : kRows) {
    for (std::size_t k = 0; k < kLetters.size(); ++k) {
      const std::string name = std::string(kLetters[k]) + "8";
      if (row.um[k] == 0.0) {
        EXPECT_EQ(fit(row.end_mm, name).error().code, "MDL-FIT") << row.end_mm << name;
      } else {
        expect_fixed(row.end_mm, name, row.um[k]);
      }
    }
  }
}

TEST(Fit, HangsLargerHolesWhereNarayanaPrints) {
  // Narayana, Kannaiah, Reddy, Machine Drawing, table 15.3: ES above IT7, 225 to 500 mm. Misprinted there and
  // different in every other table seen: U of 200 to 225 mm (-256, elsewhere -258) and X of 355 to 400 mm
  // (-650, elsewhere -660).
  constexpr std::array<const char*, 12> kLetters = {"P", "R", "S", "T",  "U",  "V",
                                                    "X", "Y", "Z", "ZA", "ZB", "ZC"};
  struct Row {
    double end_mm;
    std::array<double, 12> um;
  };
  constexpr std::array<Row, 7> kRows = {{
      {250, {-50, -84, -140, -196, -284, -340, -425, -520, -640, -820, -1050, -1350}},
      {280, {-56, -94, -158, -218, -315, -385, -475, -580, -710, -920, -1200, -1550}},
      {315, {-56, -98, -170, -240, -350, -425, -525, -650, -790, -1000, -1300, -1700}},
      {355, {-62, -108, -190, -268, -390, -475, -590, -730, -900, -1150, -1500, -1900}},
      {400, {-62, -114, -208, -294, -435, -530, -660, -820, -1000, -1300, -1650, -2100}},
      {450, {-68, -126, -232, -330, -490, -595, -740, -920, -1100, -1450, -1850, -2400}},
      {500, {-68, -132, -252, -360, -540, -660, -820, -1000, -1250, -1600, -2100, -2600}},
  }};
  for (const Row& row : kRows) {
    for (std::size_t k = 0; k < kLetters.size(); ++k)
      expect_fixed(row.end_mm, std::string(kLetters[k]) + "8", row.um[k]);
  }
  // Its example under the table, and its special case.
  expect_fixed(25.0, "P7", -14);
  expect_fixed(300.0, "M6", -9);
  // Table 15.3: holes up to N.
  expect_fixed(225.0, "B9", 380);
  expect_fixed(280.0, "C11", 300);
  expect_fixed(400.0, "A11", 1350);
  expect_fixed(500.0, "D10", 230);
  expect_fixed(225.0, "J8", 47);
  expect_fixed(500.0, "J6", 33);
  expect_fixed(200.0, "M9", -17);
  expect_fixed(200.0, "N8", -5);  // -31 + 26
  expect_fixed(200.0, "N9", 0);
  expect_fixed(3.0, "N9", -4);
  expect_fixed(450.0, "K8", 29);  // -5 + 34
}

TEST(Fit, HangsShaftsFromAToHWhereTheZccCatalogueAndCobanPrint) {
  // ZCC Cutting Tools, milling catalogue, "Basic deviations value of shaft"; cobanengineering.com,
  // "Calculation of Upper and Lower Deviation For Shaft": the same values. github.com/rustyoldguy/ITRECHNER
  // has cd of 3 mm as -32 in its shafts and 34 in its holes.
  struct Row {
    double end_mm;
    std::array<double, 10> um;  // a b c cd d e ef f fg g
  };
  constexpr std::array<const char*, 10> kLetters = {"a", "b", "c", "cd", "d", "e", "ef", "f", "fg", "g"};
  constexpr std::array<Row, 16> kRows = {{
      {3, {-270, -140, -60, -34, -20, -14, -10, -6, -4, -2}},
      {6, {-270, -140, -70, -46, -30, -20, -14, -10, -6, -4}},
      {10, {-280, -150, -80, -56, -40, -25, -18, -13, -8, -5}},
      {18, {-290, -150, -95, 0, -50, -32, 0, -16, 0, -6}},
      {30, {-300, -160, -110, 0, -65, -40, 0, -20, 0, -7}},
      {40, {-310, -170, -120, 0, -80, -50, 0, -25, 0, -9}},
      {50, {-320, -180, -130, 0, -80, -50, 0, -25, 0, -9}},
      {80, {-360, -200, -150, 0, -100, -60, 0, -30, 0, -10}},
      {120, {-410, -240, -180, 0, -120, -72, 0, -36, 0, -12}},
      {160, {-520, -280, -210, 0, -145, -85, 0, -43, 0, -14}},
      {180, {-580, -310, -230, 0, -145, -85, 0, -43, 0, -14}},
      {225, {-740, -380, -260, 0, -170, -100, 0, -50, 0, -15}},
      {250, {-820, -420, -280, 0, -170, -100, 0, -50, 0, -15}},
      {315, {-1050, -540, -330, 0, -190, -110, 0, -56, 0, -17}},
      {400, {-1350, -680, -400, 0, -210, -125, 0, -62, 0, -18}},
      {500, {-1650, -840, -480, 0, -230, -135, 0, -68, 0, -20}},
  }};
  for (const Row& row : kRows) {
    for (std::size_t k = 0; k < kLetters.size(); ++k) {
      const std::string name = std::string(kLetters[k]) + "9";
      if (row.um[k] == 0.0 && row.end_mm <= 50.0) continue;  // they print the first edition
      if (row.um[k] == 0.0) {
        EXPECT_EQ(fit(row.end_mm, name).error().expected,
                  std::string(kLetters[k]) + " is stated above 0 mm up to 50 mm");
      } else {
        expect_fixed(row.end_mm, name, row.um[k]);
      }
    }
  }
}

TEST(Fit, HangsCdEfAndFgTo50AsTheSecondEditionDoes) {
  // ISO 286-1:2010 with Cor.1:2013, as a public Italian calculator cites it ("cd, ef, fg tabulate fino a 50
  // mm"; ef of 18 to 30 mm printed -25 in 2010, -28 in the corrigendum). Each is the geometric mean of its
  // neighbours, by the first edition's rule, rounded.
  struct Row {
    double end_mm, cd, ef, fg;
  };
  for (const Row& row : {Row{14, -70, -23, -10}, Row{18, -70, -23, -10}, Row{24, -85, -28, -12},
                         Row{30, -85, -28, -12}, Row{40, -100, -35, -15}, Row{50, -100, -35, -15}}) {
    expect_fixed(row.end_mm, "cd9", row.cd);
    expect_fixed(row.end_mm, "ef8", row.ef);
    expect_fixed(row.end_mm, "FG7", -row.fg);
    const auto mean = [&](const char* x, const char* y) {
      return std::sqrt(*shaft_deviation_um(row.end_mm, x, 7) * *shaft_deviation_um(row.end_mm, y, 7));
    };
    EXPECT_NEAR(-row.cd, mean("c", "d"), 2.1);
    EXPECT_NEAR(-row.ef, mean("e", "f"), 0.5);
    EXPECT_NEAR(-row.fg, mean("f", "g"), 0.5);
  }
}

TEST(Fit, HangsShaftsFromMToZcWhereNarayanaPrints) {
  // Table 15.2, ei of all grades.
  expect_fixed(3.0, "m6", 2);
  expect_fixed(14.0, "s7", 28);
  expect_fixed(18.0, "v7", 39);
  expect_fixed(24.0, "u6", 41);
  expect_fixed(30.0, "t6", 41);
  expect_fixed(50.0, "x8", 97);
  expect_fixed(65.0, "y7", 144);
  expect_fixed(80.0, "za8", 274);
  expect_fixed(100.0, "zb9", 445);
  expect_fixed(120.0, "zc10", 690);
  expect_fixed(140.0, "z8", 365);
  expect_fixed(160.0, "u7", 190);
  expect_fixed(180.0, "s6", 108);
  expect_fixed(100.0, "k8", 0);
  expect_fixed(100.0, "k3", 0);
  expect_fixed(100.0, "k4", 3);
  expect_fixed(500.0, "k7", 5);
  expect_fixed(280.0, "j7", -26);
  expect_fixed(450.0, "j6", -20);
  expect_fixed(3.0, "j8", -6);
}

TEST(Fit, HangsBothAbove500WhereTheDmeCataloguePrints) {
  // DME, Mold Bases & Plates, technical reference table 5: fundamental deviations of holes and shafts, IT6 to
  // IT16.
  struct Pair {
    double end_mm;
    std::array<double, 7> um;  // d e f g m n p
  };
  constexpr std::array<Pair, 8> kPairs = {{
      {630, {260, 145, 76, 22, 26, 44, 78}},
      {800, {290, 160, 80, 24, 30, 50, 88}},
      {1000, {320, 170, 86, 26, 34, 56, 100}},
      {1250, {350, 195, 98, 28, 40, 66, 120}},
      {1600, {390, 220, 110, 30, 48, 78, 140}},
      {2000, {430, 240, 120, 32, 58, 92, 170}},
      {2500, {480, 260, 130, 34, 68, 110, 195}},
      {3150, {520, 290, 145, 38, 76, 135, 240}},
  }};
  constexpr std::array<const char*, 7> kLetters = {"d", "e", "f", "g", "m", "n", "p"};
  for (const Pair& p : kPairs) {
    for (std::size_t k = 0; k < 7; ++k) {
      const double away = k < 4 ? 1.0 : -1.0;  // of a hole
      expect_fixed(p.end_mm, upper(kLetters[k]) + "7", away * p.um[k]);
      expect_fixed(p.end_mm, std::string(kLetters[k]) + "7", -away * p.um[k]);
    }
    expect_fixed(p.end_mm, "K7", 0);
    expect_fixed(p.end_mm, "k7", 0);
  }
  struct Single {
    double end_mm, r, s, t, u;
  };
  constexpr std::array<Single, 16> kSingles = {{
      {560, 150, 280, 400, 600},
      {630, 155, 310, 450, 660},
      {710, 175, 340, 500, 740},
      {800, 185, 380, 560, 840},
      {900, 210, 430, 620, 940},
      {1000, 220, 470, 680, 1050},
      {1120, 250, 520, 780, 1150},
      {1250, 260, 580, 840, 1300},
      {1400, 300, 640, 960, 1450},
      {1600, 330, 720, 1050, 1600},
      {1800, 370, 820, 1200, 1850},
      {2000, 400, 920, 1350, 2000},
      {2240, 440, 1000, 1500, 2300},
      {2500, 460, 1100, 1650, 2500},
      {2800, 550, 1250, 1900, 2900},
      {3150, 580, 1400, 2100, 3200},
  }};
  for (const Single& x : kSingles) {
    expect_fixed(x.end_mm, "r6", x.r);
    expect_fixed(x.end_mm, "s7", x.s);
    expect_fixed(x.end_mm, "T7", -x.t);
    expect_fixed(x.end_mm, "U8", -x.u);
  }
}

TEST(Fit, HolesToHMirrorShaftsAndJsIsSymmetrical) {
  for (const double end : kEnds) {
    for (int grade = kFinestGrade; grade <= kCoarsestGrade; ++grade) {
      for (const auto letter : fit_letters()) {
        const auto hole = fit(end, FitClass{letter, true, grade}),
                   shaft = fit(end, FitClass{letter, false, grade});
        if (hole) {
          EXPECT_NEAR(hole->width(), *tolerance_grade(end, grade), 1e-12);
        }
        if (shaft) {
          EXPECT_NEAR(shaft->width(), *tolerance_grade(end, grade), 1e-12);
        }
        if (letter[0] > 'h' && letter != "js") continue;
        EXPECT_EQ(hole.has_value(), shaft.has_value());
        if (!hole) continue;
        EXPECT_EQ(hole->lower_mm, -shaft->upper_mm) << end << letter << grade;
        EXPECT_EQ(hole->upper_mm, -shaft->lower_mm) << end << letter << grade;
        if (letter == "h") {
          EXPECT_EQ(hole->lower_mm, 0.0);
        }
        if (letter == "js") {
          EXPECT_EQ(hole->lower_mm, -hole->upper_mm);
        }
      }
    }
  }
}

TEST(Fit, SamePairsFitAlikeInBothBases) {
  // ISO 286-1: delta makes H7/p6 and P7/h6 the same fit, and H8/m7 and M8/h7: the hole a grade coarser than
  // the shaft; K, M, N to IT8 and P .. ZC to IT7. M6 of 250 to 315 mm is the standard's own exception.
  for (const double end : kEnds) {
    if (end <= 3.0) continue;  // no delta there
    for (const auto letter : fit_letters()) {
      if (letter[0] < 'k') continue;
      const int last = letter == "k" || letter == "m" || letter == "n" ? 8 : 7;
      for (int grade = 4; grade <= last; ++grade) {
        const FitClass shaft{letter, false, grade - 1}, hole{letter, true, grade};
        if (letter == "k" && grade == 4) continue;  // k3 hangs elsewhere
        if (letter == "m" && grade == 6 && end > 250.0 && end <= 315.0) continue;
        const auto a = fit(end, shaft), b = fit(end, hole);
        EXPECT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        // Least clearance in the hole basis, H_n / letter_(n-1), and in the shaft basis.
        const double hole_basis = 0.0 - a->upper_mm, shaft_basis = b->lower_mm - 0.0;
        EXPECT_NEAR(hole_basis, shaft_basis, 1.1e-3) << end << " " << to_text(hole);
        if (grade >= 5) {
          EXPECT_NEAR(hole_basis, shaft_basis, 1e-9) << end << " " << to_text(hole);
        }
      }
    }
  }
}

TEST(Fit, ShaftsGoFromLooseToTightThroughTheAlphabetAndWithSize) {
  for (const double end : kEnds) {
    double before = -1e9;
    for (const auto letter : fit_letters()) {
      if (letter == "js" || letter == "j") continue;
      const auto at = shaft_deviation_um(end, letter, 6);
      if (!at) continue;
      EXPECT_GE(*at, before) << end << letter;
      before = *at;
    }
  }
  for (const auto letter : fit_letters()) {
    if (letter == "js") continue;
    double before = 0.0;
    for (const double end : kEnds) {
      const auto at = shaft_deviation_um(end, letter, 6);
      if (!at) continue;
      EXPECT_GE(std::abs(*at), before) << end << letter;
      before = std::abs(*at);
    }
  }
}

TEST(Fit, RangesIncludeTheirUpperEnd) {
  expect_fit(18.0, "H7", 18, 0);
  expect_fit(18.001, "H7", 21, 0);
  expect_fixed(24.0, "u6", 41);
  expect_fixed(24.001, "u6", 48);
  expect_fixed(500.0, "p6", 68);
  expect_fixed(500.001, "p6", 78);
}

}  // namespace
}  // namespace capstan::model
