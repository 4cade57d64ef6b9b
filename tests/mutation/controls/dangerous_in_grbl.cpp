#include "tests/mutation/lines.h"

// Dangerous in programs of Grbl alone.

namespace capstan::mutation {
namespace {

bool states_length(const std::string& l) { return starts(l, "G43.1 Z"); }

/// The change of a tool for itself: its touch-off in another set-up.
Made without_touch_off(const Emitted& e, Random& r) {
  Lines lines = split(e.text);
  const auto i = pick(lines, r, [&](std::size_t k) {
    if (!is_change(lines[k])) return false;
    const auto before = std::find_if(lines.rend() - static_cast<long>(k), lines.rend(), is_change);
    return before != lines.rend() && *before == lines[k];
  });
  if (!i) return std::nullopt;
  lines.erase(lines.begin() + static_cast<long>(*i));
  return Edit{joined(lines), e.table};
}

/// A new work offset, G54 or G55 here, comes behind the change whose touch-off is to set it.
Made offset_behind_change(const Emitted& e, Random& r) {
  if (holds(e.text, "G43.1")) return std::nullopt;  // lengths are stated
  const auto is_offset = [](const std::string& l) { return l == "G54" || l == "G55"; };
  Lines lines = split(e.text);
  const auto i = pick(lines, r, [&](std::size_t k) {
    if (k < 2 || !is_change(lines[k]) || !is_offset(lines[k - 2])) return false;  // a comment between
    const auto before = std::find_if(lines.rend() - static_cast<long>(k - 2), lines.rend(), is_offset);
    return before == lines.rend() || *before != lines[k - 2];
  });
  if (!i) return std::nullopt;
  const auto change = lines.begin() + static_cast<long>(*i);
  std::rotate(change - 2, change - 1, change + 1);
  return Edit{joined(lines), e.table};
}

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
      {"touch-off of a set-up removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return without_touch_off(e, r); }},
      {"work offset behind its touch-off", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return offset_behind_change(e, r); }},
      {"carriage return within a comment", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_code, [&](const std::string& l) {
           static const char* const kEnded[] = {" (and\rG0 Z-40\rG0 X200 Y200\r)", " ; and\rG0 Z-40"};
           return l + kEnded[r.below(2)];
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
