#include "tooling/library/records/check.h"

#include <cmath>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"

namespace capstan::tooling {
namespace {

constexpr double kSlackMm = 1e-6;

class Checker {
 public:
  Checker(const ToolLibrary& library, const std::string& file) : l_(library), file_(file) {}

  std::vector<Diagnostic> all() {
    std::set<std::string> items, instances, holders, assemblies;
    for (const CatalogueItem& i : l_.items) {
      id(items, i.id, "tool");
      item(i);
    }
    for (const Holder& h : l_.holders) {
      id(holders, h.id, "holder");
      holder(h);
    }
    for (const ToolInstance& i : l_.instances) {
      id(instances, i.id, "piece");
      names(items, i.item, i.id, "tool");
    }
    for (const ToolAssembly& a : l_.assemblies) {
      id(assemblies, a.id, "assembly");
      names(items, a.item, a.id, "tool");
      names(instances, a.instance, a.id, "piece");
      names(holders, a.holder, a.id, "holder");
      assembly(a);
    }
    for (const MachineEntry& e : l_.entries)
      names(assemblies, e.assembly, "T" + std::to_string(e.number), "assembly");
    return std::move(out_);
  }

 private:
  void say(const char* code, std::string message, const std::string& path, std::string expected = {}) {
    out_.push_back({.code = code,
                    .message = std::move(message),
                    .file = file_,
                    .path = path,
                    .expected = std::move(expected),
                    .hint = "correct the entry in the library"});
  }
  void id(std::set<std::string>& taken, const std::string& value, const char* what) {
    if (value.empty()) say("TOOL-ID", std::string("a ") + what + " has no id", "");
    if (!taken.insert(value).second)
      say("TOOL-ID", "the id '" + value + "' is given twice", value, "ids that differ");
  }
  void names(const std::set<std::string>& there, const std::string& value, const std::string& who,
             const char* what) {
    if (!value.empty() && !there.contains(value))
      say("TOOL-RECORD", std::string("it names the ") + what + " '" + value + "', which is not there", who);
  }

  void item(const CatalogueItem& i) {
    const std::string who = i.description.empty() ? i.id : i.description;
    for (const Property& p : i.properties) {
      if (p.number && !std::isfinite(*p.number))
        say("TOOL-VALUE", p.symbol + " is not a finite number", who, "a decimal number");
    }
    const auto dc = number_of(i, "DC");
    if (dc && *dc <= 0.0 && i.cutter_class)
      say("TOOL-VALUE", "the cutting diameter DC is " + trimmed(*dc, 4), who, "a diameter above zero");
    if (dc && *dc <= 0.0) return;
    within(i, who, "RE", dc ? std::optional(0.5 * *dc) : std::nullopt, "half the diameter");
    const auto oal = number_of(i, "OAL");
    if (!oal || *oal <= 0.0) return;
    for (const char* symbol : {"APMX", "LCF", "LU", "LN", "LPR"})
      within(i, who, symbol, oal, "the overall length OAL");
  }
  void within(const CatalogueItem& i, const std::string& who, const char* symbol, std::optional<double> most,
              const char* what) {
    const auto v = number_of(i, symbol);
    if (!v || !most || *v <= *most + kSlackMm) return;
    const bool flutes = std::string_view(symbol) == "APMX" || std::string_view(symbol) == "LCF";
    say("TOOL-VALUE",
        (flutes ? std::string("the flutes are longer than the tool: ") : std::string()) + symbol + " is " +
            mm_text(*v, 4) + ", more than " + what + ", " + mm_text(*most, 4),
        who, "at most " + mm_text(*most, 4));
  }
  void assembly(const ToolAssembly& a) {
    if (a.stick_out_mm && (!std::isfinite(*a.stick_out_mm) || *a.stick_out_mm < 0.0))
      say("TOOL-VALUE", "the stick-out is " + trimmed(*a.stick_out_mm, 4) + " mm", a.id, "a length");
    if (a.functional_length_mm && (!std::isfinite(*a.functional_length_mm) || *a.functional_length_mm < 0.0))
      say("TOOL-VALUE", "the length is " + trimmed(*a.functional_length_mm, 4) + " mm", a.id, "a length");
  }
  void holder(const Holder& h) {
    const std::string who = h.description.empty() ? h.id : h.description;
    for (std::size_t k = 0; k < h.segments.size(); ++k) {
      const auto& s = h.segments[k];
      const bool good = std::isfinite(s.height_mm) && std::isfinite(s.lower_diameter_mm) &&
                        std::isfinite(s.upper_diameter_mm) && s.height_mm >= 0.0 &&
                        s.lower_diameter_mm >= 0.0 && s.upper_diameter_mm >= 0.0;
      if (!good)
        say("TOOL-VALUE", "segment " + std::to_string(k + 1) + " of the holder is negative or not finite",
            who, "heights and diameters of at least 0");
    }
  }

  const ToolLibrary& l_;
  const std::string& file_;
  std::vector<Diagnostic> out_;
};

}  // namespace

std::vector<Diagnostic> check_library(const ToolLibrary& library, const std::string& file) {
  return Checker(library, file).all();
}

}  // namespace capstan::tooling
