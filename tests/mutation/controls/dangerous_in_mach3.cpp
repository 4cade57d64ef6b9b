#include <set>

#include "tests/mutation/lines.h"

// Ways to spoil what Mach3's programs have: the cycles that they share with FANUC's, and what is a setting of
// the control unless the program says it.

namespace capstan::mutation {

std::vector<Class> dangerous_in_mach3() {
  static const std::set<std::string> kShared = {
      "cycle deeper",         "cycle fed from lower", "cycle elsewhere", "cycle with more feed",
      "cycle back to R only", "reamer out by rapid",  "cycle that pecks"};
  std::vector<Class> out;
  for (const Class& c : dangerous_in_fanuc()) {
    if (kShared.contains(c.name)) out.push_back(c);
  }
  out.push_back({"centres of arcs as places", Kind::kDangerous, true, [](const Emitted& e, Random&) {
                   std::string text = e.text;
                   if (text.find("\nG2 ") == std::string::npos && text.find("\nG3 ") == std::string::npos)
                     return Made{};
                   for (std::size_t at = 0; (at = text.find("G91.1", at)) != std::string::npos; ++at)
                     text.replace(at, 5, "G90.1");
                   return Made{Edit{text, e.table}};
                 }});
  out.push_back(
      {"centres of arcs as the setting says", Kind::kDangerous, true, [](const Emitted& e, Random&) {
         std::string text = e.text;
         if (text.find("\nG2 ") == std::string::npos && text.find("\nG3 ") == std::string::npos)
           return Made{};
         for (std::size_t at = 0; (at = text.find(" G91.1", at)) != std::string::npos;) text.erase(at, 6);
         return Made{Edit{text, e.table}};
       }});
  out.push_back({"a code of LinuxCNC alone", Kind::kDangerous, true, [](const Emitted& e, Random& r) {
                   static const char* const kCodes[] = {"G59.1", "G61.1", "G43.1 Z50", "G64 P0.05"};
                   return behind(e, r, is_motion, [&](const std::string&) { return kCodes[r.below(4)]; });
                 }});
  return out;
}

}  // namespace capstan::mutation
