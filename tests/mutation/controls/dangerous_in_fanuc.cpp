#include "tests/mutation/lines.h"

// Ways to spoil what only the programs of FANUC and Haas have.

namespace capstan::mutation {
namespace {

std::string other_code(std::string l, const std::string& from, const std::string& to) {
  const std::size_t at = l.find(from);
  return at == std::string::npos ? l : l.replace(at, from.size(), to);
}

bool is_pecking(const std::string& l) { return holds(l, " G83 ") || holds(l, " G73 "); }

}  // namespace

std::vector<Class> dangerous_in_fanuc() {
  return {
      {"cycle deeper", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cycle, 'Z', [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"cycle fed from lower", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cycle, 'R', [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"cycle elsewhere", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cycle, r.below(2) == 0 ? 'X' : 'Y',
                             [&](double v) { return moved(v, r, 0.02, 5.0); });
       }},
      {"cycle with more feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cycle, 'F', [&](double v) { return v * r.between(1.05, 3.0); });
       }},
      {"cycle back to R only", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         // Where R is the initial level both are the same.
         return changed(
             e, r, [](const std::string& l) { return is_cycle(l) && !is_tapping(l); },
             [](const std::string& l) { return other_code(l, "G98", "G99"); });
       }},
      {"reamer out by rapid", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return holds(l, " G85 "); },
             [](const std::string& l) { return other_code(l, "G85", "G81"); });
       }},
      {"cycle that pecks", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return holds(l, " G81 ") || holds(l, " G85 "); },
             [&](const std::string& l) {
               return other_code(other_code(l, "G81", "G83"), "G85", "G83") + " Q" + n(r.between(1.0, 5.0));
             });
       }},
      {"longer pecks", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         const char letter = holds(e.text, " Q") ? 'Q' : r.below(2) == 0 ? 'I' : 'K';
         return word_changed(e, r, is_pecking, letter, [&](double v) { return v * r.between(1.1, 2.0); });
       }},
      {"chip broken in place of a cleared hole", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return holds(l, " G83 "); },
             [](const std::string& l) { return other_code(l, "G83", "G73"); });
       }},
      {"pecks left out", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_pecking, [](std::string l) {
           l = other_code(other_code(l, "G83", "G81"), "G73", "G81");
           const std::size_t at = std::min(l.find(" Q"), l.find(" I"));
           return l.erase(at, l.find(" F") - at);
         });
       }},
      {"rigid tapping not called", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         // Haas taps rigidly without.
         return without(e, r, [](const std::string& l) { return starts(l, "M29"); });
       }},
      {"pitch of a tapping cycle", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_tapping, 'F', [&](double v) { return v * r.between(1.02, 1.5); });
       }},
      {"left-hand tapping cycle", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_tapping, [](const std::string& l) { return other_code(l, "G84", "G74"); });
       }},
      {"length without its point", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r,
             [](const std::string& l) {
               const Word x = word(l, 'X');
               return (is_motion(l) || is_cycle(l)) && x.at != std::string::npos && x.value != 0.0 &&
                      holds(l.substr(x.at, x.length), ".");
             },
             [](std::string l) {
               const Word x = word(l, 'X');
               return l.replace(x.at, x.length, trimmed(x.value, 0));
             });
       }},
      {"way home by way of the work", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_retract, [](const std::string&) { return std::string("G90 G28 Z0."); });
       }},
      {"length offset left out", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, sets_length, [](std::string l) {
           const std::size_t at = l.find(" G43");
           return l.erase(at, l.find(" Z") - at);
         });
       }},
      {"length offset alone", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, sets_length, [](const std::string& l) {
           const std::size_t at = l.find("G43"), z = l.find(" Z");
           return l.substr(at, z - at) + "\nG0" + l.substr(z);
         });
       }},
      {"wider path tolerance of G187", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return starts(l, "G187"); },
             [&](const std::string& l) { return with(l, 'E', word(l, 'E').value + r.between(0.02, 2.0)); });
       }},
      {"contour control left on", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion, [](const std::string&) { return "G5.1 Q1"; });
       }},
  };
}

}  // namespace capstan::mutation
