#include "tests/mutation/lines.h"

// Dangerous in any program.

namespace capstan::mutation {
namespace {

/// Lines of the steps, as a half-open range; the last step ends before the comment (end).
std::vector<std::pair<std::size_t, std::size_t>> steps(const Lines& lines) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!is_marker(lines[i]) && lines[i] != "(end)" && lines[i] != "(END)" && lines[i] != ";end") continue;
    if (!out.empty()) out.back().second = i;
    if (is_marker(lines[i])) out.emplace_back(i, lines.size());
  }
  return out;
}

Made other_tool(const Emitted& e, Random& r) {
  Lines lines = split(e.text);
  const auto i = pick(lines, r, is_change);
  if (!i) return std::nullopt;
  std::vector<int> pockets;
  const std::string now = lines[*i].substr(1, lines[*i].find(' ') - 1);
  for (const auto& c : e.plan.cutters) {
    if (c.pocket > 0 && std::to_string(c.pocket) != now) pockets.push_back(c.pocket);
  }
  if (pockets.empty()) return std::nullopt;
  const std::string t = std::to_string(pockets[r.below(pockets.size())]);
  lines[*i] = "T" + t + " M6";
  for (std::size_t k = *i + 1; k < lines.size() && !is_change(lines[k]); ++k) {
    const std::size_t at = (lines[k] + " ").find("G43 H" + now + " ");
    if (at != std::string::npos) lines[k].replace(at, 5 + now.size(), "G43 H" + t);
  }
  return Edit{joined(lines), e.table};
}

Made step_edit(const Emitted& e, Random& r, int how) {
  Lines lines = split(e.text);
  const auto all = steps(lines);
  if (all.size() < 2) return std::nullopt;
  const std::size_t k = r.below(all.size() - 1);
  const auto at = [&](std::size_t i) { return lines.begin() + static_cast<long>(i); };
  const Lines one(at(all[k].first), at(all[k].second));
  if (how == 0) {  // with the next one in front
    std::rotate(at(all[k].first), at(all[k].second), at(all[k + 1].second));
  } else if (how == 1) {
    lines.erase(at(all[k].first), at(all[k].second));
  } else {
    lines.insert(at(all[k].second), one.begin(), one.end());
  }
  return Edit{joined(lines), e.table};
}

}  // namespace

std::vector<Class> dangerous_in_any() {
  return {
      {"rapid across in machine coordinates", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_cut, [&](const std::string&) {
           return "G53 G0 X" + n(r.between(0, 400)) + " Y" + n(r.between(0, 300));
         });
       }},
      {"rapid down in machine coordinates", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion,
                       [&](const std::string&) { return "G53 G0 Z" + n(-r.between(5, 390)); });
       }},
      {"retract removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return without(e, r, is_retract); }},
      {"retract lowered", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_retract,
                        [&](const std::string&) { return "G53 G0 Z" + n(-r.between(5, 390)); });
       }},
      {"retract in the work's coordinates", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_retract, [](std::string l) {
           const std::string word = holds(l, "SUPA ") ? "SUPA " : "G53 ";
           return l.erase(l.find(word), word.size());
         });
       }},
      {"spindle reversed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         // A tap may be one for left-hand threads: only the plan can tell.
         Lines lines = split(e.text);
         const auto i = pick(lines, r, [&](std::size_t k) {
           if (!is_start(lines[k])) return false;
           for (std::size_t m = k; m < lines.size() && !is_marker(lines[m]); ++m) {
             if (is_tapping(lines[m])) return false;
           }
           return true;
         });
         if (!i) return Made{};
         lines[*i].replace(lines[*i].find(" M"), 3, " M4");
         return Made{Edit{joined(lines), e.table}};
       }},
      {"spindle not started", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_start, [](const std::string& l) { return l.substr(0, l.find(" M")); });
       }},
      {"spindle stopped before a cut", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, is_cut);
         if (!i) return Made{};
         lines.insert(lines.begin() + static_cast<long>(*i), "M5");
         return Made{Edit{joined(lines), e.table}};
       }},
      {"speed beyond the machine", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_start, 'S', [](double v) { return v * 1000.0; });
       }},
      {"feed beyond the machine", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, is_cut, 'F', [](double v) { return v * 1000.0; });
       }},
      {"length offset of another tool", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return word_changed(e, r, sets_length, is_siemens(e) ? 'D' : 'H',
                             [&](double v) { return v + 1.0 + static_cast<double>(r.below(5)); });
       }},
      {"no length offset", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, sets_length, [&](const std::string&) {
           if (is_siemens(e)) return r.below(2) == 0 ? "D0" : "D0 F100";
           return r.below(2) == 0 ? "G49" : "G43 H0";
         });
       }},
      {"unit switched", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto all = steps(lines);
         if (all.empty()) return Made{};
         const auto& [first, last] = all[r.below(all.size())];
         const auto i = pick(lines, r, [&, f = first, l = last](std::size_t k) {
           return k > f && k < l &&
                  (starts(lines[k], "G21") || holds(lines[k], " G710") || is_motion(lines[k]));
         });
         if (!i) return Made{};
         if (starts(lines[*i], "G21")) {
           lines[*i].replace(0, 3, "G20");
         } else if (const std::size_t at = lines[*i].find("G710"); at != std::string::npos) {
           lines[*i].replace(at, 4, r.below(2) == 0 ? "G700" : "G70");
         } else if (is_siemens(e)) {
           lines.insert(lines.begin() + static_cast<long>(*i), r.below(2) == 0 ? "G700" : "G70");
         } else {
           lines.insert(lines.begin() + static_cast<long>(*i), "G20");
         }
         return Made{Edit{joined(lines), e.table}};
       }},
      {"another work offset", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(
             e, r, [](const std::string& l) { return l == "G54" || l == "G55"; },
             [&](const std::string&) { return "G5" + std::to_string(6 + r.below(4)); });
       }},
      {"centre of an arc moved", Kind::kDangerous, false,
       [](const Emitted& e, Random& r) {
         return word_changed(
             e, r, [](const std::string& l) { return is_arc(l) && !has(l, 'R'); },
             r.below(2) == 0 ? 'I' : 'J', [&](double v) { return moved(v, r, 0.3, 3.0); });
       }},
      {"word of an axis that is not there", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return changed(e, r, is_motion, [&](const std::string& l) {
           return l + " " + std::string(1, "ABCUVW"[r.below(6)]) + n(r.between(1, 90));
         });
       }},
      {"G4 with words of axes", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion,
                       [&](const std::string&) { return wait_of(e, "0.5 X") + n(r.between(-50, 50)); });
       }},
      {"shift of the work", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         static const char* const kShifts[] = {"G92 X", "G10 L2 P1 X", "G10 L20 P1 Z", "G52 X", "G92 Z"};
         static const char* const kSiemens[] = {"TRANS X", "ATRANS Z", "G58 X", "G59 Z", "$P_UIFR[1,Z,TR]="};
         const auto& shifts = is_siemens(e) ? kSiemens : kShifts;
         return behind(e, r, is_motion,
                       [&](const std::string&) { return shifts[r.below(5)] + n(r.between(1, 50)); });
       }},
      {"way over a reference point", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion, [&](const std::string&) {
           if (is_siemens(e)) return r.below(2) == 0 ? "G74 Z1=0" : "G75 Z=0";
           return r.below(2) == 0 ? "G28" : "G30";
         });
       }},
      {"% in the middle", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return behind(e, r, is_motion, [](const std::string&) { return "%"; });
       }},
      {"truncated", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         Lines lines = split(e.text);
         const auto i = pick(lines, r, is_motion);
         if (!i) return Made{};
         lines.resize(*i);
         return Made{Edit{joined(lines), e.table}};
       }},
      {"another tool loaded", Kind::kDangerous, true, other_tool},
      {"change of tools removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return without(e, r, is_change); }},
      {"steps in another order", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return step_edit(e, r, 0); }},
      {"step removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return step_edit(e, r, 1); }},
      {"step doubled", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) { return step_edit(e, r, 2); }},
      {"stop to clamp anew removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return without(e, r, [](const std::string& l) { return l == "M0"; });
       }},
      {"table: no length", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return table_changed(e, r, [](std::string l) {
           const auto z = l.find(" Z");
           return l.erase(z, l.find(' ', z + 1) - z);
         });
       }},
      {"table: another length", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return table_changed(e, r, [&](const std::string& l) {
           return with(l, 'Z', moved(word(l, 'Z').value, r, 0.5, 60.0));
         });
       }},
      {"table: length with an exponent", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return table_changed(e, r, [&](std::string l) {
           const Word z = word(l, 'Z');
           return l.insert(z.at + z.length, r.below(2) == 0 ? "e1" : "E-1");
         });
       }},
      {"table: offset across", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return table_changed(e, r, [&](std::string l) {
           return l.insert(l.find(" Z"), " " + std::string(1, "XY"[r.below(2)]) + n(r.between(0.5, 20)));
         });
       }},
      {"table: row removed", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return table_changed(e, r, [](const std::string&) { return std::string(); });
       }},
      {"table: row that LinuxCNC cannot read", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         return table_changed(e, r, [&](std::string l) {
           const auto at = r.below(2) == 0 ? l.find(" P") : l.find(" Z");
           switch (r.below(3)) {
             case 0:
               return l.erase(at, 1);
             case 1:
               l[at] = '\t';
               return l;
             default:
               return l.insert(at + 2, " ");
           }
         });
       }},
      {"table: two tools in one pocket", Kind::kDangerous, true,
       [](const Emitted& e, Random& r) {
         Lines rows = split(e.table);
         if (rows.size() < 2) return Made{};
         const std::size_t i = r.below(rows.size()), k = (i + 1 + r.below(rows.size() - 1)) % rows.size();
         rows[i] = with(rows[i], 'P', word(rows[k], 'P').value);
         return Made{Edit{e.text, joined(rows)}};
       }},
  };
}

}  // namespace capstan::mutation
