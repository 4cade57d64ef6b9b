#include "tests/mutation/lines.h"

// Ways to spoil what only Siemens's programs have.

namespace capstan::mutation {
namespace {

/// The parameters of a call, and the line with one of them another.
Lines parameters(const std::string& l) {
  Lines out;
  const std::size_t open = l.find('('), close = l.rfind(')');
  std::string one;
  for (const char c : l.substr(open + 1, close - open - 1)) {
    if (c == ',') {
      out.push_back(one);
      one.clear();
    } else {
      one += c;
    }
  }
  out.push_back(one);
  return out;
}
std::string with_parameter(const std::string& l, std::size_t at, const std::string& value) {
  Lines all = parameters(l);
  while (all.size() <= at) all.emplace_back();
  all[at] = value;
  std::string out = l.substr(0, l.find('(') + 1);
  for (std::size_t i = 0; i < all.size(); ++i) out += (i == 0 ? "" : ",") + all[i];
  return out + ")";
}
template <class F>
Made parameter_changed(const Emitted& e, Random& r, Is is, std::size_t at, F f) {
  return changed(e, r, is, [&](const std::string& l) {
    const double now = parse_double(parameters(l)[at]).value_or(0.0);
    return with_parameter(l, at, n(f(now)));
  });
}

bool is_ream(const std::string& l) { return starts(l, "MCALL CYCLE85("); }
bool is_drill(const std::string& l) { return starts(l, "MCALL CYCLE81("); }
bool is_pecking(const std::string& l) { return starts(l, "MCALL CYCLE83("); }
bool is_smoothing(const std::string& l) { return starts(l, "CYCLE832(0.0"); }

}  // namespace

std::vector<Class> dangerous_in_siemens() {
  return {
      {"cycle deeper", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_cycle, 3, [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"cycle fed from lower", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_cycle, 1, [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"cycle with less clearance", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_cycle, 2, [&](double v) { return v - r.between(0.02, 0.9); });
       }},
      {"cycle back to a lower plane", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_cycle, 0, [&](double v) { return v - r.between(0.02, 20.0); });
       }},
      {"cycle with a relative depth", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_cycle, 4, [&](double) { return r.between(0.5, 60.0); });
       }},
      {"cycle elsewhere", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           return k > 0 && is_cycle(lines[k - 1]) && has(lines[k], 'X') && has(lines[k], 'Y');
         });
         if (!i) return Made{};
         const char letter = r.below(2) == 0 ? 'X' : 'Y';
         lines[*i] = with(lines[*i], letter, moved(word(lines[*i], letter).value, r, 0.02, 5.0));
         return Made{Edit{joined(lines), e.table}};
       }},
      {"modal call not ended", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(
             lines, r, [&](std::size_t k) { return k > 1 && lines[k] == "MCALL" && is_cycle(lines[k - 2]); });
         if (!i) return Made{};
         lines.erase(lines.begin() + static_cast<long>(*i));
         return Made{Edit{joined(lines), e.table}};
       }},
      {"reamer out by rapid", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_ream, [](const std::string& l) {
           const Lines p = parameters(l);
           return "F" + p[6] + "\nMCALL CYCLE82(" + p[0] + "," + p[1] + "," + p[2] + "," + p[3] + ",," +
                  p[5] + ")";
         });
       }},
      {"reamer with more feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_ream, r.below(2) == 0 ? 6 : 7,
                                  [&](double v) { return v * r.between(1.05, 3.0); });
       }},
      {"drill with more feed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           return k + 1 < lines.size() && has(lines[k], 'F') && is_drill(lines[k + 1]);
         });
         if (!i) return Made{};
         lines[*i] = with(lines[*i], 'F', word(lines[*i], 'F').value * r.between(1.05, 3.0));
         return Made{Edit{joined(lines), e.table}};
       }},
      {"cycle that pecks", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_drill, [&](const std::string& l) {
           const Lines p = parameters(l);
           return "MCALL CYCLE83(" + p[0] + "," + p[1] + "," + p[2] + "," + p[3] + ",,," +
                  n(r.between(1.0, 5.0)) + ",0,0,0,1," + (r.below(2) == 0 ? "0" : "1") + ",,1)";
         });
       }},
      {"longer pecks", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_pecking, 5, [&](double v) { return v - r.between(0.02, 8.0); });
       }},
      {"chip broken in place of a cleared hole, or the other way round", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_pecking, 11, [](double v) { return 1.0 - v; });
       }},
      {"pecks that shrink", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_pecking, 7, [&](double) { return r.between(0.5, 3.0); });
       }},
      {"pitch of a tapping cycle", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_tapping, 8, [&](double v) { return v * r.between(1.02, 1.5); });
       }},
      {"left-hand tapping cycle", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_tapping, 8, [&](double v) { return -v; });
       }},
      {"tap at another speed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_tapping, 10, [&](double v) { return v * r.between(1.1, 4.0); });
       }},
      {"tap brought out at another speed", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_tapping, 11, [&](double v) { return v * r.between(1.1, 4.0); });
       }},
      {"retract with frames left on", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_retract, [&](std::string l) {
           return l.replace(l.find("SUPA"), 4, r.below(2) == 0 ? "G53" : "G153");
         });
       }},
      {"tap drawn away by a spindle that turns back", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return parameter_changed(e, r, is_tapping, 6, [](double) { return 4.0; });
       }},
      {"tap without a pitch", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_tapping, [](const std::string& l) { return with_parameter(l, 8, ""); });
       }},
      {"length left on in a retract", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         // Before the first tool none is on.
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           return is_retract(lines[k]) &&
                  std::any_of(lines.begin(), lines.begin() + static_cast<long>(k), sets_length);
         });
         if (!i) return Made{};
         lines[*i].erase(lines[*i].find(" D0"));
         return Made{Edit{joined(lines), e.table}};
       }},
      {"length left out", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, sets_length, [](std::string l) { return l.erase(l.find(" D1"), 3); });
       }},
      {"wider path tolerance", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_smoothing, [&](const std::string& l) {
           switch (r.below(4)) {
             case 0:
               return with_parameter(l, 0, n(*parse_double(parameters(l)[0]) + r.between(0.02, 2.0)));
             case 1:
               return std::string("CYCLE832(0,0,1)");
             case 2:
               return l + "\nG64";
             default:
               return std::string("G641 ADIS=") + n(r.between(0.02, 3.0));
           }
         });
       }},
      {"turns of a helix", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return holds(l, " TURN="); },
             [&](std::string l) {
               const std::size_t at = l.find("TURN=") + 5;
               return l.replace(at, 1, std::to_string(l[at] - '0' + (r.below(2) == 0 ? 1 : -1)));
             });
       }},
      {"variable in place of a number", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_motion, [](std::string l) {
           const std::size_t at = l.find_last_of("XYZ");
           return at == std::string::npos ? l : l.substr(0, at + 1) + "=R1";
         });
       }},
      {"jump", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         static const char* const kJumps[] = {"GOTOF END", "IF R1>0 GOTOB START", "REPEAT LABEL P=3", "L100",
                                              "M17"};
         return behind(e, r, is_motion, [&](const std::string&) { return kJumps[r.below(5)]; });
       }},
  };
}

}  // namespace capstan::mutation
