#include "tests/mutation/lines.h"

// The machine does something else, or the same in other words, or LinuxCNC's interpreter says which.

namespace capstan::mutation {
namespace {

Made a_character(const Emitted& e, Random& r) {
  std::string text = e.text;
  const std::size_t first = text.find("\nG21");
  if (first == std::string::npos) return std::nullopt;
  std::size_t at = first + 1 + r.below(text.size() - first - 1);
  for (int tries = 0; tries < 100; ++tries) {
    // Inside a comment nothing is anybody's business but the operator's.
    const std::size_t begin = text.rfind('\n', at) + 1;
    if (text[at] != '\n' && text[begin] != '(') break;
    at = first + 1 + r.below(text.size() - first - 1);
  }
  static const std::string kOthers = "0123456789.- GMXYZIJFS";
  switch (r.below(3)) {
    case 0:
      text.erase(at, 1);
      break;
    case 1:
      text[at] = kOthers[r.below(kOthers.size())];
      break;
    default:
      text.insert(at, 1, kOthers[r.below(kOthers.size())]);
  }
  return Edit{text, e.table};
}

/// `wholes`: letters whose numbers have no decimal point.
std::string written_otherwise(const std::string& l, const std::string& wholes, Random& r) {
  std::string out;
  for (std::size_t i = 0; i < l.size(); ++i) {
    out += l[i];
    const bool word_begins =
        std::isupper(static_cast<unsigned char>(l[i])) != 0 && (i == 0 || l[i - 1] == ' ');
    if (!word_begins) continue;
    std::size_t end = i + 1;
    while (end < l.size() && l[end] != ' ') ++end;
    std::string digits = l.substr(i + 1, end - i - 1);
    if (!parse_double(digits)) {  // a name, MCALL
      out += digits;
      i = end - 1;
      continue;
    }
    const bool number = wholes.find(l[i]) == std::string::npos;
    if (number && !holds(digits, ".")) digits += r.below(2) == 0 ? "." : ".00";
    if (digits.front() != '-' && r.below(2) == 0) digits = (number && r.below(2) == 0 ? "+0" : "0") + digits;
    if (starts(digits, "0.") && digits.size() > 2) digits.erase(0, 1);
    out += digits;
    i = end - 1;
  }
  return out;
}

}  // namespace

std::vector<Class> not_dangerous() {
  return {
      // The machine does something else.
      {"coolant", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         // One that turns the coolant on: a step with the tool of the step before only says it again.
         const auto i = pick(lines, r, [&](std::size_t k) {
           if (lines[k] != "M8") return false;
           while (k > 0 && lines[k - 1] != "M8" && lines[k - 1] != "M9") --k;
           return k == 0 || lines[k - 1] == "M9";
         });
         if (!i) return Made{};
         static const char* const kOthers[] = {"M9", "M7", "", "M8\nM7"};
         lines[*i] = kOthers[r.below(4)];
         return Made{Edit{joined(lines), e.table}};
       }},
      {"coolant off in a cut", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_cut, [](const std::string&) { return "M9"; });
       }},
      {"wait inserted", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion,
                       [&](const std::string&) { return wait_of(e, n(r.between(0.1, 20.0))); });
       }},
      {"wait changed", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return word_changed(
             e, r, [](const std::string& l) { return starts(l, "G4 "); }, is_siemens(e) ? 'F' : 'P',
             [&](double v) { return v + r.between(0.05, 10.0); });
       }},
      {"exact path", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return starts(l, "G64") || starts(l, "CYCLE832(0.0"); },
             [&](const std::string& l) {
               if (is_siemens(e)) return r.below(2) == 0 ? l + "\nG60" : std::string("G60");
               return std::string(r.below(2) == 0 ? "G61" : "G61.1");
             });
       }},
      {"stop inserted", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion, [&](const std::string&) {
           static const char* const kStops[] = {"M0", "M1", "M60"};
           return kStops[r.below(3)];
         });
       }},
      {"feed mode stated anew", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         // F is forgotten: LinuxCNC stops at the next feed.
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           return k > 0 && is_cut(lines[k]) && is_cut(lines[k - 1]) && !has(lines[k], 'F');
         });
         if (!i) return Made{};
         lines.insert(lines.begin() + static_cast<long>(*i), "G94");
         return Made{Edit{joined(lines), e.table}};
       }},
      {"overrides locked", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion, [](const std::string&) { return "M49"; });
       }},
      {"block that may be skipped", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_motion, [](const std::string& l) { return "/" + l; });
       }},
      {"less feed", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cut, 'F', [&](double v) { return v * r.between(0.2, 0.95); });
       }},
      {"tool changed twice", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_change, [](const std::string& l) { return l; });
       }},
      {"rapid higher", Kind::kDifferent, false,
       [](const Emitted& e, Random& r) {
         return word_changed(
             e, r, [](const std::string& l) { return starts(l, "G0 "); }, 'Z',
             [&](double v) { return v + r.between(0.02, 20.0); });
       }},
      // LinuxCNC's interpreter decides.
      {"any character", Kind::kUnknown, false, a_character},
      {"any block removed", Kind::kUnknown, false,
       [](const Emitted& e, Random& r) { return without(e, r, is_code); }},
      {"any block doubled", Kind::kUnknown, false,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_code, [](const std::string& l) { return l; });
       }},
      {"any two blocks exchanged", Kind::kUnknown, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           return k + 1 < lines.size() && is_code(lines[k]) && is_code(lines[k + 1]);
         });
         if (!i) return Made{};
         std::swap(lines[*i], lines[*i + 1]);
         return Made{Edit{joined(lines), e.table}};
       }},
      // The same in other words.
      {"numbers of blocks", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         std::size_t number = r.below(1000);
         for (std::string& l : lines) {
           if (is_code(l) && l.front() != 'N' && l.front() != '/')
             l = "N" + std::to_string(number += 10) + " " + l;
         }
         return Made{Edit{joined(lines), e.table}};
       }},
      {"comments", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_code, [&](const std::string& l) {
           if (is_siemens(e)) return l + (r.below(2) == 0 ? " ;as planned" : ";as \"planned");
           if (e.dialect != "linuxcnc") return r.below(2) == 0 ? l + " (AS PLANNED)" : "(NOW) " + l;
           return r.below(2) == 0   ? l + " (as planned)"
                  : r.below(2) == 0 ? "(now) " + l
                                    : l + " ; as planned";
         });
       }},
      {"white space", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_code, [&](const std::string& l) {
           if (starts(l, "MSG(")) return l;  // the text itself would change
           std::string out;
           for (const char c : l) {
             if (is_siemens(e)) {  // its words stand apart, and hold together
               out += c;
               if (c == ' ') out += r.below(2) == 0 ? " " : "\t";
               continue;
             }
             if (c == ' ' && r.below(2) == 0) continue;
             out += c;
             if (r.below(4) == 0) out += r.below(2) == 0 ? ' ' : '\t';
           }
           return r.below(3) == 0 ? "\n" + out : out;
         });
       }},
      {"small letters", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_code, [](std::string l) {
           for (char& c : l) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
           return l;
         });
       }},
      {"words repeated", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, is_motion);
         if (!i) return Made{};
         static const char* const kModal[] = {"G90", "G21", "G17", "G90 G40", "G40", "G91.1"};
         static const char* const kSiemens[] = {"G90", "G710", "G17", "G90 G40", "G40"};
         if (is_siemens(e)) {
           lines.insert(lines.begin() + static_cast<long>(*i), kSiemens[r.below(5)]);
           return Made{Edit{joined(lines), e.table}};
         }
         const std::size_t kinds = e.dialect == "linuxcnc" ? 6 : 5;  // G91.1 is LinuxCNC's
         lines.insert(lines.begin() + static_cast<long>(*i), kModal[r.below(kinds)]);
         return Made{Edit{joined(lines), e.table}};
       }},
      {"modal word left out", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           const bool machine = holds(lines[k], "SUPA") || holds(lines[k], "D1");
           return k > 0 && is_motion(lines[k]) && !machine && starts(lines[k - 1], lines[k].substr(0, 3));
         });
         if (!i) return Made{};
         lines[*i].erase(0, 3);
         return Made{Edit{joined(lines), e.table}};
       }},
      {"equal numbers", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_code, [&](const std::string& l) {
           if (starts(l, "MSG(")) return l;
           return written_otherwise(l, e.dialect == "linuxcnc" ? "GMTH" : "GMTHSNPLKD", r);
         });
       }},
      {"table: comments, blanks and order", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         Lines rows = split(e.table);
         std::rotate(rows.begin(), rows.begin() + static_cast<long>(r.below(rows.size())), rows.end());
         rows[0].insert(rows[0].find(' '), "  ");
         rows.back() += " checked";
         return Made{Edit{e.text, "; of this shop\n" + joined(rows)}};
       }},
      {"table: equal numbers", Kind::kBenign, false,
       [](const Emitted& e, Random& r) {
         return table_changed(e, r, [&](std::string l) {
           const Word z = word(l, 'Z');
           if (r.below(2) == 0) return l.insert(z.at + z.length, "e0");
           return l.replace(z.at, z.length, n(z.value));
         });
       }},
  };
}

}  // namespace capstan::mutation
