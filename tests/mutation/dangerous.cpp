#include "tests/mutation/lines.h"

// Dangerous by what the plan says.

namespace capstan::mutation {
std::vector<Class> dangerous_by_plan() {
  return {
      {"rapid down beside the path's end", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) { return k > 15 && is_retract(lines[k]); });
         if (!i) return Made{};
         lines.insert(lines.begin() + static_cast<long>(*i),
                      {"G0 X" + n(r.between(-40, 140)), "G0 Z" + n(-r.between(1, 40))});
         return Made{Edit{joined(lines), e.table}};
       }},
      {"rapid in place of a feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return starts(l, "G1 "); },
             [](std::string l) { return l.replace(1, 1, "0"); });
       }},
      {"feed lower", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cut, 'Z', [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"rapid lower", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(
             e, r, [](const std::string& l) { return starts(l, "G0 "); }, 'Z',
             [&](double v) { return v - r.between(0.02, 20.0); });
       }},
      {"feed elsewhere", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cut, r.below(2) == 0 ? 'X' : 'Y',
                             [&](double v) { return moved(v, r, 0.02, 5.0); });
       }},
      {"plunge inserted", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_cut, [&](const std::string&) { return "G1 Z" + n(-r.between(30, 60)); });
       }},
      {"rapid inserted", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_cut, [&](const std::string&) {
           return "G0 X" + n(r.between(-20, 120)) + " Y" + n(r.between(-20, 120));
         });
       }},
      {"arc as a line", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_arc, [](const std::string& l) {
           std::string out = "G1" + l.substr(2, l.find(" I") - 2);
           return has(l, 'F') ? out + " F" + n(word(l, 'F').value) : out;
         });
       }},
      {"arc the other way", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_arc, [](std::string l) { return l.replace(1, 1, l[1] == '2' ? "3" : "2"); });
       }},
      {"arc twice", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_arc, [](const std::string& l) { return l; });
       }},
      {"increments in place of places", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_cut, [](const std::string&) { return "G91"; });
       }},
      {"more feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cut, 'F', [&](double v) { return v * r.between(1.05, 3.0); });
       }},
      {"another speed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_start, 'S', [&](double v) { return v * r.between(0.3, 0.95); });
       }},
      {"wait for the spindle removed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           return k > 0 && starts(lines[k], "G4 ") && is_start(lines[k - 1]);
         });
         if (!i) return Made{};
         lines.erase(lines.begin() + static_cast<long>(*i));
         return Made{Edit{joined(lines), e.table}};
       }},
      {"wider path tolerance", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return starts(l, "G64"); },
             [&](const std::string& l) {
               switch (r.below(3)) {
                 case 0:
                   return "G64 P" + n(word(l, 'P').value + r.between(0.02, 2.0));
                 case 1:
                   return l + " Q" + n(r.between(0.5, 5.0));
                 default:
                   return std::string("G64");
               }
             });
       }},
      {"tap without step", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return starts(l, "G33.1"); },
             [](const std::string& l) { return "G1 Z" + n(word(l, 'Z').value) + " F750"; });
       }},
      {"another pitch", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(
             e, r, [](const std::string& l) { return starts(l, "G33.1"); }, 'K',
             [&](double v) { return moved(v, r, 0.02, 0.5); });
       }},
  };
}

}  // namespace capstan::mutation
