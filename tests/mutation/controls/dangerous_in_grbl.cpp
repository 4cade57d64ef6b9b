#include "tests/mutation/lines.h"

// Dangerous in programs of Grbl alone.

namespace capstan::mutation {
namespace {

bool states_length(const std::string& l) { return starts(l, "G43.1 Z"); }

}  // namespace

std::vector<Class> dangerous_in_grbl() {
  return {
      {"length of another tool", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, states_length, 'Z', [&](double v) { return moved(v, r, 0.5, 60.0); });
       }},
      // The one before the first change is a precaution: behind the change it stands again.
      {"retract behind the first marker removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return without(e, r, [](const std::string& l) { return is_retract(l); });
       }},
      {"length taken away", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, states_length, [](const std::string&) { return std::string("G49"); });
       }},
      {"character that is a command", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_code, [&](const std::string& l) {
           static const char* const kCommands[] = {"!", "~", "?", "\x18", "\x85"};
           return l + " (" + kCommands[r.below(5)] + ")";
         });
       }},
      {"code of another control", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         static const char* const kCodes[] = {"G43 H1", "G64 P0.05", "G81 Z-5 R2 F100", "G41 D1", "G98"};
         return behind(e, r, is_motion, [&](const std::string&) { return std::string(kCodes[r.below(5)]); });
       }},
  };
}

}  // namespace capstan::mutation
