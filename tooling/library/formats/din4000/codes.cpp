#include "tooling/library/formats/din4000/codes.h"

#include <array>

namespace capstan::tooling::din4000 {
namespace {

using model::CutterClass;

constexpr std::array kCodes = {
    // Every table of rotating tools alike.
    Code{"", "NSM", "", ""},
    Code{"", "BLD", "", ""},
    Code{"", "B5", "OAL", "mm"},
    Code{"", "C3", "DMM", "mm"},
    Code{"", "C4", "LS", "mm"},
    Code{"", "C31", "TCDMM", ""},
    Code{"", "D6", "RPMX", "1/min"},
    Code{"", "D7", "WT", "kg"},
    Code{"", "F1", "HAND", ""},
    Code{"", "H3", "GRADE", ""},
    Code{"", "H5", "COATING", ""},
    Code{"", "H21", "CNSC", ""},
    Code{"", "H22", "CXSC", ""},
    Code{"", "H4", "", ""},
    Code{"", "H11", "", ""},
    Code{"", "J3", "", ""},
    Code{"", "J21", "", ""},
    Code{"", "J22", "", ""},
    Code{"", "J23", "", ""},
    // Taps.
    Code{"80", "A1", "THFT", ""},
    Code{"80", "A21", "TDZ", "mm"},
    Code{"80", "A3", "TP", "mm"},
    // Drills and countersinks without indexable inserts.
    Code{"81", "A11", "DC", "mm"},
    Code{"81", "B3", "LH", "mm"},
    Code{"81", "B4", "LU", "mm"},
    Code{"81", "B6", "LCF", "mm"},
    Code{"81", "B7", "PL", "mm"},
    Code{"81", "B71", "LF", "mm"},
    Code{"81", "D1", "ZEFF", ""},
    Code{"81", "D3", "FHA", "deg"},
    Code{"81", "E1", "SIG", "deg"},
    // End mills without indexable inserts.
    Code{"82", "A1", "DC", "mm"},
    Code{"82", "A5", "DN", "mm"},
    Code{"82", "B2", "APMX", "mm"},
    Code{"82", "B3", "LH", "mm"},
    Code{"82", "B6", "LCF", "mm"},
    Code{"82", "B71", "LF", "mm"},
    Code{"82", "B9", "LU", "mm"},
    Code{"82", "F21", "PCEDC", ""},
    Code{"82", "F22", "FCEDC", ""},
    Code{"82", "F4", "FHA", "deg"},
    Code{"82", "G1", "RE", "mm"},
};

struct Figure {
  std::string_view table, figure, words;
  std::optional<CutterClass> cutter_class;
};
constexpr std::array kFigures = {
    Figure{"80", "1", "tap with slim shank", CutterClass::kTap},
    Figure{"80", "2", "tap with reinforced shank", CutterClass::kTap},
    Figure{"80", "3", "forming tap with slim shank", CutterClass::kTap},
    Figure{"80", "4", "forming tap with reinforced shank", CutterClass::kTap},
    Figure{"81", "1", "twist drill", CutterClass::kTwistDrill},
    Figure{"81", "6", "spot drill", CutterClass::kSpotDrill},
    Figure{"81", "7", "centre drill", CutterClass::kCenterDrill},
    Figure{"82", "1", "end mill", CutterClass::kEndmill},
    Figure{"82", "2", "slotting and milling cutter", CutterClass::kEndmill},
    Figure{"82", "3", "angle milling cutter", std::nullopt},
    Figure{"82", "4", "angle milling cutter, reversed", std::nullopt},
    Figure{"82", "5", "T-slot cutter", CutterClass::kTSlotMill},
    Figure{"82", "6", "ball nosed milling cutter", CutterClass::kBallEndmill},
    Figure{"82", "7", "die end milling cutter", std::nullopt},
    Figure{"82", "8", "concave profile cutter", std::nullopt},
    Figure{"82", "9", "burr", std::nullopt},
    Figure{"82", "10", "thread milling cutter", CutterClass::kThreadMill},
    Figure{"82", "11", "gouge", std::nullopt},
    Figure{"82", "12", "drill thread milling cutter", std::nullopt},
};

const Figure* find_figure(std::string_view table, std::string_view figure) {
  for (const Figure& f : kFigures)
    if (f.table == table && f.figure == figure) return &f;
  return nullptr;
}

}  // namespace

const Code* find_code(std::string_view table, std::string_view code) {
  const bool known = table == "80" || table == "81" || table == "82";
  for (const Code& c : kCodes)
    if (c.code == code && (c.table == table || (c.table.empty() && (known || c.symbol.empty())))) return &c;
  return nullptr;
}

std::optional<CutterClass> class_of(std::string_view table, std::string_view figure) {
  const Figure* f = find_figure(table, figure);
  return f == nullptr ? std::nullopt : f->cutter_class;
}

std::string_view figure_words(std::string_view table, std::string_view figure) {
  const Figure* f = find_figure(table, figure);
  return f == nullptr ? std::string_view{} : f->words;
}

}  // namespace capstan::tooling::din4000
