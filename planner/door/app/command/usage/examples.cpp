#include "planner/door/app/command/usage/examples.h"

#include <algorithm>
#include <array>

namespace capstan::app {
namespace {

struct Row {
  std::string_view called, examples;
};

constexpr std::array kRows = {
    Row{"capstan",
        "capstan plan part.p21 -o plan.json -o part.ngc\n"
        "capstan check part.ngc\n"
        "capstan explain plan.json"},
    Row{"capstan plan",
        "capstan plan part.p21 -o plan.json -o part.ngc -o part.tbl\n"
        "capstan plan part.stp --machine mill.yaml --tools tool.tbl --material C45 -o part.ngc\n"
        "capstan plan part.p21 --set 'POCKET*/tool=T5' --limit 'feed<=2000' -o part.ngc -o part.edits.yaml\n"
        "capstan plan part.p21 --edits part.edits.yaml -o part.ngc"},
    Row{"capstan bind",
        "capstan bind plan.stpnc --tools tool.tbl --deadline 200ms -o part.ngc\n"
        "capstan bind plan.json --limit 'feed<=1500' -o part.ngc"},
    Row{"capstan serve", "capstan serve --socket capstan.sock --machine mill.yaml --tools tool.tbl"},
    Row{"capstan check",
        "capstan check plan.json\n"
        "capstan check plan.json part.ngc part.tbl --json"},
    Row{"capstan explain",
        "capstan explain plan.json\n"
        "capstan explain plan.json 3\n"
        "capstan explain plan.json 'POCKET area_rough' feedrate"},
    Row{"capstan inspect",
        "capstan inspect part.p21\n"
        "capstan inspect part.p21 '//round_hole[diameter.theoretical_size > 10]/its_id'"},
    Row{"capstan diff", "capstan diff before.json after.json"},
    Row{"capstan convert", "capstan convert plan.p21 -o plan.stpnc"},
    Row{"capstan tools", "capstan tools list\ncapstan tools import tool.tbl -o tools.yaml"},
    Row{"capstan tools list", "capstan tools list endmill\ncapstan tools list --tools tool.tbl"},
    Row{"capstan tools show", "capstan tools show generic/endmill_3f_short/8"},
    Row{"capstan tools import", "capstan tools import library.csv --unit mm -o tools.yaml"},
    Row{"capstan tools convert", "capstan tools convert library.json -o tool.tbl"},
    Row{"capstan tools export", "capstan tools export -o tools.yaml"},
    Row{"capstan materials", "capstan materials list\ncapstan materials show C45"},
    Row{"capstan materials list", "capstan materials list steel"},
    Row{"capstan materials show", "capstan materials show 1.0503"},
    Row{"capstan machines", "capstan machines list\ncapstan machines show generic_vmc"},
    Row{"capstan machines list", "capstan machines list"},
    Row{"capstan machines show", "capstan machines show generic_vmc"},
    Row{"capstan fixtures", "capstan fixtures list"},
    Row{"capstan fixtures list", "capstan fixtures list vise"},
    Row{"capstan fixtures show", "capstan fixtures show vise_125"},
    Row{"capstan controls", "capstan controls list\ncapstan controls show fanuc"},
    Row{"capstan controls list", "capstan controls list"},
    Row{"capstan controls show", "capstan controls show linuxcnc"},
    Row{"capstan shop", "capstan shop init\ncapstan shop show"},
    Row{"capstan shop init", "capstan shop init\ncapstan shop init machine=mill.yaml tools=tool.tbl -o mill/shop.yaml"},
    Row{"capstan shop show", "capstan shop show\ncapstan shop show --shop mill/shop.yaml"},
    Row{"capstan rules", "capstan rules check --rules my_rules"},
    Row{"capstan rules check", "capstan rules check --rules my_rules"},
    Row{"capstan rules list", "capstan rules list"},
    Row{"capstan cases",
        "capstan cases add cases.db plan.json\ncapstan plan part.p21 --cases cases.db -o plan.json"},
    Row{"capstan cases add", "capstan cases add cases.db cases.csv plan.json"},
    Row{"capstan cases list", "capstan cases list cases.db good"},
    Row{"capstan cases show", "capstan cases show cases.db 3fa9"},
    Row{"capstan cases judge",
        "capstan cases judge cases.db 3fa9 --verdict bad --by 'A. Smith' --reason 'chatter in the corners'"},
    Row{"capstan cases remove",
        "capstan cases remove cases.db 3fa9 --by 'A. Smith' --reason 'wrong material'"},
    Row{"capstan cases export", "capstan cases export cases.db"},
    Row{"capstan cases metric", "capstan cases metric cases.db --learn"},
    Row{"capstan cases tune", "capstan cases tune cases.db plan.json"},
    Row{"capstan cases import",
        "capstan cases import cases.db trace log.txt --plan plan.json --program part.ngc"},
    Row{"capstan cases trace", "capstan cases trace cases.db plan.json --part 17"},
    Row{"capstan cases report", "capstan cases report cases.db -o times.svg"},
    Row{"capstan cases nearest",
        "capstan cases nearest cases.db --operation DRILLING --material C45 --tool carbide/twist_drill "
        "--machine generic_vmc --diameter 8"},
};

}  // namespace

std::string_view examples_of(std::string_view called) {
  const auto at = std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.called == called; });
  return at == kRows.end() ? std::string_view() : at->examples;
}

}  // namespace capstan::app
