#include "tooling/library/formats/item/iso_names.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace capstan::tooling {
namespace {

constexpr std::array kNames = {
    IsoName{"DC", "cutting diameter", ""},
    IsoName{"DCX", "cutting diameter maximum", ""},
    IsoName{"DCN", "cutting diameter minimum", ""},
    IsoName{"DN", "neck diameter", ""},
    IsoName{"LN", "neck length", ""},
    IsoName{"APMX", "depth of cut maximum", ""},
    IsoName{"APMXS", "depth of cut maximum in feed direction side", ""},
    IsoName{"LCF", "length chip flute", ""},
    IsoName{"LU", "usable length", ""},
    IsoName{"LUX", "usable length maximum", ""},
    IsoName{"OAL", "overall length", "71D078EB7C086"},
    IsoName{"LF", "functional length", "71DCD39338974"},
    IsoName{"LPR", "protruding length", "71DCD394BB20E"},
    IsoName{"LH", "head length", ""},
    IsoName{"DMM", "shank diameter", "71EBDBF5060E6"},
    IsoName{"LS", "shank length", ""},
    IsoName{"BD", "body diameter", "71ED6A9AF7D1D"},
    IsoName{"BDX", "body diameter maximum", ""},
    IsoName{"LBX", "body length maximum", ""},
    IsoName{"DF", "flange diameter", ""},
    IsoName{"RE", "corner radius", ""},
    IsoName{"CHW", "corner chamfer width", ""},
    IsoName{"KCH", "corner chamfer angle", ""},
    IsoName{"KAPR", "tool cutting edge angle", ""},
    IsoName{"PSIR", "tool lead angle", ""},
    IsoName{"SIG", "point angle", ""},
    IsoName{"PL", "point length", ""},
    IsoName{"FHA", "flute helix angle", ""},
    IsoName{"ZEFF", "face effective cutting edge count", ""},
    IsoName{"NOF", "flute count", ""},
    IsoName{"PCEDC", "peripheral cutting edge count", ""},
    IsoName{"FCEDC", "face cutting edge count", ""},
    IsoName{"CICT", "cutting item count", ""},
    IsoName{"IC", "inscribed circle diameter", ""},
    IsoName{"BS", "wiper edge length", ""},
    IsoName{"CW", "cutting width", ""},
    IsoName{"CCC", "center cutting capability", ""},
    IsoName{"AZ", "plunge depth maximum", ""},
    IsoName{"RMPX", "ramping angle maximum", ""},
    IsoName{"TDZ", "thread diameter size", ""},
    IsoName{"TP", "thread pitch", ""},
    IsoName{"THFT", "thread form type", ""},
    IsoName{"TCDC", "tolerance class cutting diameter", ""},
    IsoName{"TCDMM", "shank diameter tolerance", ""},
    IsoName{"SDL", "step diameter length", ""},
    IsoName{"STA", "step included angle", ""},
    IsoName{"CNSC", "coolant entry style code", ""},
    IsoName{"CXSC", "coolant exit style code", ""},
    IsoName{"CND", "coolant entry diameter", ""},
    IsoName{"CP", "coolant pressure", ""},
    IsoName{"BMC", "body material code", "71DF1523224D8"},
    IsoName{"SUBSTRATE", "substrate", ""},
    IsoName{"GRADE", "grade", ""},
    IsoName{"COATING", "coating", ""},
    IsoName{"HAND", "hand", "71CF29872F0AB"},
    IsoName{"RPMX", "rotational speed maximum", ""},
    IsoName{"WT", "weight of item", "71CED03C97AAB"},
    IsoName{"CZCMS", "connection size code machine side", "727C2BCCC5596"},
    IsoName{"CZCWS", "connection size code workpiece side", ""},
};

constexpr std::array kAliases = {std::pair{"DCONMS", "DMM"}, std::pair{"DCON", "DMM"},
                                 std::pair{"CCMS", "CZCMS"}, std::pair{"CCWS", "CZCWS"},
                                 std::pair{"ZEFP", "PCEDC"}};

std::string folded(std::string_view s) {
  std::string out;
  for (const char c : s) {
    if (c == ' ' || c == '_' || c == '-') continue;
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  }
  return out;
}

}  // namespace

std::span<const IsoName> iso_names() { return kNames; }

const IsoName* find_symbol(std::string_view symbol) {
  for (const auto& [other, preferred] : kAliases)
    if (symbol == other) symbol = preferred;
  const auto* it = std::ranges::find(kNames, symbol, &IsoName::symbol);
  return it == kNames.end() ? nullptr : &*it;
}

const IsoName* find_bsu(std::string_view code) {
  if (code.empty()) return nullptr;
  const auto* it = std::ranges::find(kNames, code, &IsoName::bsu);
  return it == kNames.end() ? nullptr : &*it;
}

const IsoName* find_preferred_name(std::string_view name) {
  const std::string wanted = folded(name);
  if (wanted.empty()) return nullptr;
  for (const IsoName& n : kNames)
    if (folded(n.name) == wanted) return &n;
  return nullptr;
}

}  // namespace capstan::tooling
