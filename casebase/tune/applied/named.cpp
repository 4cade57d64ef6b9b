#include "casebase/tune/applied/named.h"

#include <algorithm>

namespace capstan::casebase::tune {

std::string short_id(std::string_view id) {
  constexpr std::size_t kShown = 12;
  return std::string(id.substr(0, kShown));
}

std::string named(const std::vector<std::string>& cases) {
  std::string out;
  const std::size_t shown = std::min(cases.size(), kCasesNamed);
  for (std::size_t i = 0; i < shown; ++i) out += (i == 0 ? "" : ", ") + cases[i];
  if (shown < cases.size()) out += " and " + std::to_string(cases.size() - shown) + " more";
  return out;
}

std::string with_outcome(const Case& c, const std::string& observed, bool doubted) {
  const bool judged = c.observed.verdict != Verdict::kUnknown;
  std::string out =
      short_id(c.id) + " (" + (judged ? std::string(to_text(c.observed.verdict)) : "not judged");
  if (!observed.empty()) out += ", " + observed;
  return out + (doubted ? ", doubted)" : ")");
}

}  // namespace capstan::casebase::tune
