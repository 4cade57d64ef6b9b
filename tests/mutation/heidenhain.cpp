#include "tests/mutation/heidenhain_lines.h"

// Ways to spoil, or to rewrite, programs of Heidenhain's conversational language. Their blocks are edited
// without their numbers, of which a gap alone would tell.

namespace capstan::mutation {
namespace {

using namespace heidenhain;

/// The step of a line, from its marker to the next or to the program's end.
std::vector<std::pair<std::size_t, std::size_t>> steps(const Lines& lines) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!marks(lines[i]) && lines[i] != "; end") continue;
    if (!out.empty()) out.back().second = i;
    if (marks(lines[i])) out.emplace_back(i, lines.size());
  }
  return out;
}
Made step_edit(const Emitted& e, Random& r, int how) {
  Lines lines = split(e.text);
  const auto all = steps(lines);
  if (all.size() < 2) return std::nullopt;
  const std::size_t k = r.below(all.size() - 1);
  const auto at = [&](std::size_t i) { return lines.begin() + static_cast<long>(i); };
  const Lines one(at(all[k].first), at(all[k].second));
  if (how == 0) {
    std::rotate(at(all[k].first), at(all[k].second), at(all[k + 1].second));
  } else if (how == 1) {
    lines.erase(at(all[k].first), at(all[k].second));
  } else {
    lines.insert(at(all[k].second), one.begin(), one.end());
  }
  return Edit{joined(lines), e.table};
}

Made other_tool(const Emitted& e, Random& r) {
  return line_changed(e, r, changes, [&](const std::string& l) {
    const std::size_t at = std::string("TOOL CALL ").size(), end = l.find(' ', at);
    std::vector<int> pockets;
    for (const auto& c : e.plan.cutters) {
      if (c.pocket > 0 && std::to_string(c.pocket) != l.substr(at, end - at)) pockets.push_back(c.pocket);
    }
    if (pockets.empty()) return l;
    return l.substr(0, at) + std::to_string(pockets[r.below(pockets.size())]) + l.substr(end);
  });
}

Made reversed(const Emitted& e, Random& r, const std::string& to) {
  // A tap may be one for left-hand threads: only the plan can tell.
  Lines lines = split(e.text);
  const auto i = pick(lines, r, [&](std::size_t k) {
    if (!starts_spindle(lines[k])) return false;
    for (std::size_t m = k; m < lines.size() && !marks(lines[m]); ++m) {
      if (starts(lines[m], "CYCL DEF 207")) return false;
    }
    return true;
  });
  if (!i) return std::nullopt;
  lines[*i] = to;
  return Edit{joined(lines), e.table};
}

std::vector<Class> dangerous() {
  return {
      {"rapid across in machine coordinates", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return put_behind(e, r, cuts, [&] {
           return "L X" + signed_text(r.between(0, 400)) + " Y" + signed_text(r.between(0, 300)) +
                  " R0 FMAX M91";
         });
       }},
      {"rapid down in machine coordinates", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return put_behind(e, r, moves,
                           [&] { return "L Z" + signed_text(-r.between(5, 390)) + " R0 FMAX M91"; });
       }},
      {"retract removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return removed(e, r, retracts); }},
      {"retract lowered", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, retracts, [&](const std::string&) {
           return "L Z" + signed_text(-r.between(5, 390)) + " R0 FMAX M91";
         });
       }},
      {"retract in the work's coordinates", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, retracts, [](const std::string& l) { return replaced(l, " M91", ""); });
       }},
      {"spindle reversed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return reversed(e, r, "M4"); }},
      {"spindle not started", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return reversed(e, r, "M9"); }},
      {"spindle stopped before a cut", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, cuts, [](const std::string& l) { return "M5\n" + l; });
       }},
      {"M0 before a cut, which stops the spindle", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, cuts, [](const std::string& l) { return "M0\n" + l; });
       }},
      {"retract by increment", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, retracts, [&](const std::string&) {
           return "L IZ" + signed_text(moved(0.0, r, 0.02, 390.0)) + " R0 FMAX M91";
         });
       }},
      {"speed beyond the machine", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, speeds, "S", [](double v) { return v * 1000.0; });
       }},
      {"feed beyond the machine", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, cuts, "F", [](double v) { return v * 1000.0; });
       }},
      {"unit switched", Kind::kDangerous, true,
       [](const Emitted& e, Random&) {
         std::string text = e.text;
         for (std::size_t at = text.find(" PGM "); at != std::string::npos; at = text.find(" PGM ", at + 1)) {
           const std::size_t end = text.find('\n', at);
           text.replace(text.rfind(" MM", end), 3, " INCH");
         }
         return Made{Edit{text, e.table}};
       }},
      {"another row of the preset table", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = one_of(lines, r, [](const std::string& l) { return starts(l, "  Q339="); });
         if (!i) return Made{};
         lines[*i] = "  Q339=+" + std::to_string(3 + r.below(40)) + " ;DATUM NUMBER";
         return Made{Edit{joined(lines), e.table}};
       }},
      {"shift, turn or mirror of the work", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         static const char* const kShifts[] = {
             "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5", "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+5",
             "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X", "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL1.1",
             "PLANE SPATIAL SPA+0 SPB+5 SPC+0 STAY"};
         return put_behind(e, r, moves, [&] { return kShifts[r.below(5)]; });
       }},
      {"word of an axis that is not there", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, moves, [&](const std::string& l) {
           return l + " " + std::string(1, "ABCUVW"[r.below(6)]) + signed_text(r.between(1, 90));
         });
       }},
      {"jump or call", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         static const char* const kJumps[] = {"CALL LBL 1", "LBL 1", "CALL PGM TNC:\\A.H", "CALL LBL 1 REP2",
                                              "FN 9: IF +Q1 EQU +0 GOTO LBL 1"};
         return put_behind(e, r, moves, [&] { return kJumps[r.below(5)]; });
       }},
      {"parameter in place of a number", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, moves, [](const std::string& l) {
           const std::size_t at = l.find_first_of("XYZ");
           return at == std::string::npos ? l : l.substr(0, at + 1) + "+Q1" + l.substr(l.find(' ', at));
         });
       }},
      {"oversize of a tool", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, changes, [&](const std::string& l) {
           return l + (r.below(2) == 0 ? " DL" : " DR") + signed_text(moved(0.0, r, 0.02, 2.0));
         });
       }},
      {"truncated", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = one_of(lines, r, moves);
         if (!i) return Made{};
         lines.resize(*i);
         return Made{Edit{joined(lines), e.table}};
       }},
      {"another tool loaded", Kind::kDangerous, true, other_tool},
      {"change of tools removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return removed(e, r, changes); }},
      {"steps in another order", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return step_edit(e, r, 0); }},
      {"step removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return step_edit(e, r, 1); }},
      {"step doubled", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return step_edit(e, r, 2); }},
      {"stop to clamp anew removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return removed(e, r, [](const std::string& l) { return l == "M0"; });
       }},
  };
}

std::vector<Class> dangerous_moves() {
  return {
      {"rapid in place of a feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, fed,
                             [](const std::string& l) { return l.substr(0, l.find(" R0")) + " R0 FMAX"; });
       }},
      {"feed lower", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, cuts, "Z", [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"rapid lower", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, rapid, "Z", [&](double v) { return v - r.between(0.02, 20.0); });
       }},
      {"move elsewhere", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, moves, r.below(2) == 0 ? "X" : "Y",
                               [&](double v) { return moved(v, r, 0.02, 5.0); });
       }},
      {"plunge inserted", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return put_behind(e, r, cuts, [&] { return "L Z" + signed_text(-r.between(30, 60)) + " R0"; });
       }},
      {"rapid inserted", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return put_behind(e, r, cuts, [&] {
           return "L X" + signed_text(r.between(-20, 120)) + " Y" + signed_text(r.between(-20, 120)) +
                  " R0 FMAX";
         });
       }},
      {"centre of an arc moved", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(
             e, r, [](const std::string& l) { return starts(l, "CC "); }, r.below(2) == 0 ? "X" : "Y",
             [&](double v) { return moved(v, r, 0.3, 3.0); });
       }},
      {"arc as a line", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return line_changed(
             e, r, [](const std::string& l) { return starts(l, "C "); },
             [](const std::string& l) { return "L" + l.substr(1, l.find(" DR") - 1) + " R0"; });
       }},
      {"arc the other way", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, arc, [](const std::string& l) {
           return holds(l, "DR+") ? replaced(l, "DR+", "DR-") : replaced(l, "DR-", "DR+");
         });
       }},
      {"arc twice", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, arc, [](const std::string& l) { return l + "\n" + l; });
       }},
      {"helix by another angle", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, arc, "IPA", [&](double v) {
           return r.below(2) == 0 ? v + (v > 0.0 ? 360.0 : -360.0) : moved(v, r, 1.0, 90.0);
         });
       }},
      {"helix deeper", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, arc, "IZ", [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"increment in place of a place", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, cuts, [](const std::string& l) {
           const std::size_t at = l.find_first_of("XYZ");
           return at == std::string::npos || l[at - 1] != ' ' ? l : l.substr(0, at) + "I" + l.substr(at);
         });
       }},
      {"more feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, cuts, "F", [&](double v) { return v * r.between(1.05, 3.0); });
       }},
      {"another speed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return number_changed(e, r, speeds, "S", [&](double v) { return v * r.between(0.3, 0.95); });
       }},
      {"wait for the spindle removed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           return k > 0 && starts(lines[k], "CYCL DEF 9.0") && starts_spindle(lines[k - 1]);
         });
         if (!i) return Made{};
         lines.erase(lines.begin() + static_cast<long>(*i), lines.begin() + static_cast<long>(*i) + 2);
         return Made{Edit{joined(lines), e.table}};
       }},
      {"wider path tolerance", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         if (r.below(2) == 0)
           return line_changed(
               e, r, [](const std::string& l) { return starts(l, "CYCL DEF 32.1"); },
               [](const std::string&) { return std::string("CYCL DEF 32.1"); });
         return number_changed(
             e, r, [](const std::string& l) { return starts(l, "CYCL DEF 32.1"); }, "T",
             [&](double v) { return v + r.between(0.02, 2.0); });
       }},
      {"radius compensation", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, fed, [&](const std::string& l) {
           return replaced(l, " R0", r.below(2) == 0 ? " RL" : " RR");
         });
       }},
  };
}

}  // namespace

std::vector<Class> classes_in_heidenhain() {
  std::vector<Class> all = dangerous();
  for (const auto& more : {dangerous_moves(), heidenhain_cycles(), told_otherwise()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace capstan::mutation
