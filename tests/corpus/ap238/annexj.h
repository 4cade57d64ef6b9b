#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/p21/read/parse.h"

namespace capstan::corpus {

/// `ITS_TOOLPATH [2]: #490, #492, #47` or `ITS_ID: #10, #13, #14 ['New Project']`.
struct NamedAttribute {
  std::string name;          ///< as spelled, without the bracket
  std::string index;         ///< "*", "2", or empty
  std::uint64_t at = 0;      ///< the last instance of the list
  std::uint64_t before = 0;  ///< the one before it
  std::string text;          ///< what stands in the bracket behind, without quotes
  bool has_text = false;
};

/// `Application object: PROJECT (#10)` and the attributes below it.
struct NamedObject {
  std::string name;
  std::uint64_t at = 0;
  std::vector<NamedAttribute> attributes;
};

namespace annexj_detail {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

inline std::string_view trimmed_line(std::string_view s) {
  const auto from = s.find_first_not_of(" *\t\r");
  if (from == std::string_view::npos) return {};
  const auto to = s.find_last_not_of(" *\t\r");
  return s.substr(from, to + 1 - from);
}

inline std::uint64_t last_number(std::string_view s) {
  const auto hash = s.rfind('#');
  std::uint64_t n = 0;
  for (std::size_t i = hash == std::string_view::npos ? s.size() : hash + 1; i < s.size(); ++i) {
    if (s[i] < '0' || s[i] > '9') break;
    n = 10 * n + static_cast<std::uint64_t>(s[i] - '0');
  }
  return n;
}

inline bool attribute_of(std::string_view line, NamedAttribute& out) {
  const auto colon = line.find(": #");
  if (colon == std::string_view::npos) return false;
  std::string_view name = line.substr(0, colon), rest = line.substr(colon + 2);
  if (const auto bracket = name.find(" ["); bracket != std::string_view::npos) {
    out.index = name.substr(bracket + 2, name.size() - bracket - 3);
    name = name.substr(0, bracket);
  }
  out.name = name;
  if (const auto bracket = rest.find('['); bracket != std::string_view::npos && rest.back() == ']') {
    std::string_view text = rest.substr(bracket + 1, rest.size() - bracket - 2);
    if (text.size() >= 2 && text.front() == '\'') text = text.substr(1, text.size() - 2);
    out.text = text;
    out.has_text = true;
    rest = rest.substr(0, bracket);
  }
  out.at = last_number(rest);
  if (const auto hash = rest.rfind('#'); hash != std::string_view::npos) {
    out.before = last_number(rest.substr(0, hash));
  }
  return out.at != 0;
}

inline p21::Value bare(const p21::Value& v) { return v.is(p21::Kind::kTyped) ? v[0] : v; }

// Value and unit of a measure: the last two parameters of the part that has them.
inline p21::Value part_of_measure(const p21::Instance& i) {
  p21::Value out;
  for (std::size_t k = 0; k < i.part_count(); ++k) {
    const auto part = i.part(k);
    const bool measure =
        part.keyword.ends_with("MEASURE_WITH_UNIT") || part.keyword == "MEASURE_REPRESENTATION_ITEM";
    if (measure && part.parameters.size() >= 2) out = part.parameters;
  }
  return out;
}

inline double prefix_factor(const p21::Value& prefix) {
  if (!prefix.is(p21::Kind::kEnumeration)) return 1.0;
  const auto name = prefix.enumeration();
  return name == "MILLI"   ? 1e-3
         : name == "CENTI" ? 1e-2
         : name == "KILO"  ? 1e3
         : name == "MICRO" ? 1e-6
                           : kNone;
}

inline double unit_factor(const p21::File& file, std::uint64_t id, int depth);

inline double measured(const p21::File& file, std::uint64_t id, int depth) {
  const auto i = file.find(id);
  if (!i || depth > 8) return kNone;
  const p21::Value p = part_of_measure(*i);
  if (p.size() < 2) return kNone;
  const p21::Value value = bare(p[p.size() - 2]), unit = p[p.size() - 1];
  if (!value.is_number() || !unit.is(p21::Kind::kReference)) return kNone;
  return value.as_real() * unit_factor(file, unit.reference(), depth + 1);
}

inline double unit_factor(const p21::File& file, std::uint64_t id, int depth) {
  const auto i = file.find(id);
  if (!i || depth > 8) return kNone;
  if (const auto conversion = i->part("CONVERSION_BASED_UNIT")) {
    return measured(file, (*conversion)[1].reference(), depth + 1);
  }
  if (const auto si = i->part("SI_UNIT")) {
    const p21::Value name = (*si)[si->size() - 1];
    const double base = name.enumeration() == "METRE" ? 1000.0 : 1.0;
    return base * prefix_factor((*si)[si->size() - 2]);
  }
  if (const auto derived = i->part("DERIVED_UNIT")) {
    double out = 1.0;
    for (std::size_t k = 0; k < (*derived)[0].size(); ++k) {
      const auto element = file.find((*derived)[0][k].reference());
      if (!element) return kNone;
      out *= std::pow(unit_factor(file, element->parameters()[0].reference(), depth + 1),
                      element->parameters()[1].as_real());
    }
    return out;
  }
  return 1.0;  // counts and ratios
}

}  // namespace annexj_detail

/// The application objects that the comments of a file name, in order. `odd`: lines that say something else.
[[nodiscard]] inline std::vector<NamedObject> named_objects(std::string_view text,
                                                            std::vector<std::string>& odd) {
  constexpr std::string_view kBegin = "Application object: ";
  std::vector<NamedObject> out;
  for (auto open = text.find("/*"); open != std::string_view::npos; open = text.find("/*", open)) {
    const auto close = text.find("*/", open + 2);
    if (close == std::string_view::npos) break;
    std::string_view comment = text.substr(open + 2, close - open - 2);
    open = close + 2;
    if (comment.find(kBegin) == std::string_view::npos) continue;
    while (!comment.empty()) {
      const auto end = std::min(comment.find('\n'), comment.size());
      const std::string_view line = annexj_detail::trimmed_line(comment.substr(0, end));
      comment.remove_prefix(std::min(end + 1, comment.size()));
      if (line.empty()) continue;
      if (line.starts_with(kBegin)) {
        const auto bracket = line.rfind(" (#");
        out.push_back({std::string(line.substr(kBegin.size(), bracket - kBegin.size())),
                       annexj_detail::last_number(line),
                       {}});
        continue;
      }
      NamedAttribute a;
      if (!out.empty() && annexj_detail::attribute_of(line, a)) {
        out.back().attributes.push_back(std::move(a));
      } else {
        odd.emplace_back(line);
      }
    }
  }
  return out;
}

/// A measure's value in mm, rad and s (and their products), by the SI and conversion based units of the file:
/// a reading of its own, so that the reader under test is not asked what it did. Not a number: no measure, or
/// one without a value.
[[nodiscard]] inline double plain_value(const p21::File& file, std::uint64_t measure) {
  return annexj_detail::measured(file, measure, 0);
}

/// Whether the instance is a measure at all.
[[nodiscard]] inline bool is_measure(const p21::File& file, std::uint64_t id) {
  const auto i = file.find(id);
  return i && annexj_detail::part_of_measure(*i).size() >= 2;
}

}  // namespace capstan::corpus
