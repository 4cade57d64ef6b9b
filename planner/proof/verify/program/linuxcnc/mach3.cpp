#include <algorithm>
#include <array>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/linuxcnc/interpreter.h"
#include "planner/proof/verify/reader_options.h"

// What Mach3 does otherwise than LinuxCNC: reader.h.

namespace capstan::verify::linuxcnc {
namespace {

/// Codes times ten that LinuxCNC has and Mach3 has not.
constexpr std::array kNotMach3s{331, 382, 431, 591, 592, 593, 611};

}  // namespace

Interpreter::Interpreter(const model::Machine& machine) {
  ways_.mach3 = true;
  ways_.unit_of_p_s = option(machine, "dwell") == "milliseconds" ? 0.001 : 1.0;
  ways_.tolerance_mm = std::max(0.0, machine.control.path_tolerance_mm);
  ways_.longest_line = static_cast<std::size_t>(option_number(machine, "line_length"));
  tolerance_ = naive_ = ways_.tolerance_mm;
  builders_codes(option(machine, "shop_codes"), "");
}

void Interpreter::mach3_rules(const Line& l, const BlockSaid& s) {
  if (l.semicolon) fault(33, "CHK-SYNTAX", "';' begins no comment of Mach3: write it between ( and )");
  bool arc = motion_ == 20 || motion_ == 30;
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i];
    arc = g == 20 || g == 30 || (arc && g != 0 && g != 10);
    if (g == 901 || g == 911) arcs_stated_ = true;
    const std::string code = "G" + plain(0.1 * g);
    if (std::find(kNotMach3s.begin(), kNotMach3s.end(), g) != kNotMach3s.end())
      fault(33, "CHK-CODE", code + " is none of Mach3's");
    if (g == 730 || g == 830)
      fault(26, "CHK-UNVERIFIABLE",
            code +
                " is not followed: where Mach3 is fed again above the last peck is one of its settings; "
                "write the pecks as moves",
            true);
    if (g == 840)
      fault(22, "CHK-TAP-FEED", "G84: Mach3 does not hold spindle and feed in step; mill the thread");
  }
  for (int i = 0; i < s.m_count; ++i) {
    if (s.m[i] == 600) fault(33, "CHK-CODE", "M60 is none of Mach3's; state M0");
  }
  if (arc && (s.is('I') || s.is('J')) && !arcs_stated_) {
    fault(23, "CHK-ARC",
          "an arc by its centre before G91.1 or G90.1: whether I and J count from the start is a setting of "
          "Mach3; state G91.1 before it");
    arcs_stated_ = true;
  }
}

}  // namespace capstan::verify::linuxcnc
