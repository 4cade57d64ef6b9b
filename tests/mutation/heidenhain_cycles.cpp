#include "tests/mutation/heidenhain_lines.h"

// Cycles of Heidenhain's programs spoilt, and what is not dangerous in them.

namespace capstan::mutation {
namespace {

using namespace heidenhain;

std::vector<Class> dangerous_cycles() {
  return {
      {"cycle deeper", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "", "Q201", [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"cycle upwards", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "", "Q201", [](double v) { return -v; });
       }},
      {"cycle on a lower surface", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "", "Q203", [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"cycle with less clearance", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "", "Q200", [&](double v) { return v - r.between(0.02, 0.9); });
       }},
      {"cycle back to a lower plane", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, r.below(2) == 0 ? "200" : "201", "Q204",
                                  [&](double v) { return std::max(0.0, v - r.between(0.02, 20.0)); });
       }},
      {"cycle that pecks", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "200", "Q202", [&](double v) { return v * r.between(0.1, 0.9); });
       }},
      {"cycle with more feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "", "Q206", [&](double v) { return v * r.between(1.05, 3.0); });
       }},
      {"reamer out with more feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "201", "Q208", [&](double v) { return v * r.between(1.05, 3.0); });
       }},
      {"cycle without a parameter", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return removed(e, r, [](const std::string& l) { return starts(l, "  Q20") && l.ends_with('~'); });
       }},
      {"call of a cycle removed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) { return removed(e, r, calls); }},
      {"cycle called twice", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, calls, [](const std::string& l) { return l + "\n" + l; });
       }},
      {"pitch of a tapping cycle", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "207", "Q239", [&](double v) { return v * r.between(1.02, 1.5); });
       }},
      {"left-hand tapping cycle", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, "207", "Q239", [](double v) { return -v; });
       }},
      {"tapping cycle with a parameter of another one", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return line_changed(
             e, r, [](const std::string& l) { return starts(l, "  Q239="); },
             [&](const std::string& l) { return l + "\n  Q403=" + signed_text(r.between(1.1, 4.0)) + " ~"; });
       }},
  };
}

std::vector<Class> not_dangerous_here() {
  return {
      {"coolant", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         static const char* const kOthers[] = {"M9", "M7", "; none", "M8\nM7"};
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           if (lines[k] != "M8") return false;
           while (k > 0 && lines[k - 1] != "M8" && lines[k - 1] != "M9") --k;
           return k == 0 || lines[k - 1] == "M9";
         });
         if (!i) return Made{};
         lines[*i] = kOthers[r.below(4)];
         return Made{Edit{joined(lines), e.table}};
       }},
      {"wait inserted", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return put_behind(e, r, moves, [&] {
           return "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL " + n(r.between(0.1, 20.0));
         });
       }},
      {"wait changed", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return number_changed(
             e, r, [](const std::string& l) { return starts(l, "CYCL DEF 9.1"); }, "DWELL ",
             [&](double v) { return v + r.between(0.05, 10.0); });
       }},
      {"stop inserted", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         static const char* const kStops[] = {"M0", "M1", "STOP"};
         return put_behind(e, r, moves, [&] { return kStops[r.below(3)]; });
       }},
      {"comments", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return line_changed(
             e, r, [](const std::string& l) { return code(l) && !holds(l, "~") && !holds(l, ";"); },
             [&](const std::string& l) {
               return l + (r.below(2) == 0 ? " ;as planned" : "\n* - as planned");
             });
       }},
      {"white space", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, code, [&](const std::string& l) {
           std::string out;
           for (const char c : l) {
             out += c;
             if (c == ' ') out += r.below(2) == 0 ? " " : "\t";
           }
           return out;
         });
       }},
      {"numbers written otherwise", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return line_changed(e, r, moves, [&](const std::string& l) {
           std::string out;
           for (std::size_t i = 0; i < l.size(); ++i) {
             if (l[i] == '+' && i > 0 && l[i - 1] != 'R' && r.below(2) == 0) continue;
             if (l[i] == '+' && i > 0 && l[i - 1] != 'R') {
               out += "+0";
               continue;
             }
             out += l[i];
           }
           return out;
         });
       }},
      {"numbers of blocks", Kind::kBenign, false,
       [](const Emitted& e, Random&) {
         Lines lines = split(e.text);
         long next = 0;
         bool goes_on = false;
         for (std::string& l : lines) {
           const bool ends = !l.ends_with('~');
           if (!goes_on) l.insert(0, std::to_string(next++) + " ");
           goes_on = !ends;
         }
         return Made{Edit{joined(lines), e.table}};
       }},
  };
}

}  // namespace

std::vector<Class> heidenhain_cycles() {
  std::vector<Class> all = dangerous_cycles();
  for (const Class& c : not_dangerous_here()) all.push_back(c);
  return all;
}

}  // namespace capstan::mutation
