#include "tooling/library/formats/linuxcnc/linuxcnc.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "planner/ground/base/number.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/words/comment_words.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling {
namespace {

constexpr std::string_view kAxes = "XYZABCUVW";  // in the order they are written
constexpr std::string_view kAfter = "DIJQ";
constexpr std::size_t kLongestLine = 4096;
constexpr const char* kUnitKey = "linuxcnc.mm_per_unit";

struct Line {
  MachineEntry entry;
  std::string diameter;  ///< as spelled; empty: none
  bool has_tool = false;
};

class Reader {
 public:
  Reader(const std::string& file, const FormatOptions& options, Job& job)
      : file_(file),
        mm_per_unit_(options.mm_per_unit.value_or(1.0)),
        unit_assumed_(!options.mm_per_unit),
        job_(job) {
    if (!options.mm_per_unit) {
      job_.note("TBL-UNIT", file + ": a tool table does not state its unit; taken as millimetres");
      out_.report.derived.push_back(
          {"", "unit", "a tool table does not state its unit; taken as millimetres"});
    }
  }

  Result<Imported> read(std::string_view text) {
    out_.library.source = file_;
    out_.library.kept.emplace_back(kUnitKey, shortest(mm_per_unit_));
    while (!text.empty() && faults_.size() < 100) {
      const auto end = text.find('\n');
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++number_;
      if (line.size() > kLongestLine)
        refuse("TBL-SYNTAX", "a line longer than " + std::to_string(kLongestLine) + " bytes", "a tool table");
      else if (auto l = parse(line))
        take(*std::move(l));
    }
    if (!empty_.empty())
      job_.warn("TBL-EMPTY", file_ + ": " + std::to_string(empty_.size()) +
                                 " tools have no diameter and are not used, " + empty_.front() +
                                 (empty_.size() > 1 ? " to " + empty_.back() : ""));
    if (auto d = tell(std::move(faults_), job_)) return fail(*std::move(d));
    out_.report.tools = out_.library.entries.size();
    return std::move(out_);
  }

 private:
  void refuse(std::string code, std::string message, std::string expected,
              std::string hint = "correct the line") {
    faults_.push_back(fault_at({file_, number_, ""}, std::move(code), std::move(message), std::move(expected),
                               std::move(hint)));
  }

  std::optional<Line> parse(std::string_view text) {
    Line out;
    if (const auto semicolon = text.find(';'); semicolon != std::string_view::npos) {
      out.entry.comment = trimmed_text(text.substr(semicolon + 1));
      text = text.substr(0, semicolon);
    }
    std::string seen;
    for (text = trimmed_text(text); !text.empty(); text = trimmed_text(text)) {
      const std::string_view word = text.substr(0, text.find_first_of(" \t"));
      text.remove_prefix(word.size());
      const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
      const bool known = std::string_view("TPXYZABCUVWDIJQ").find(letter) != std::string_view::npos;
      const auto value = number_from(word.substr(1), {file_, number_, ""});
      if (!known || !value) {
        refuse("TBL-SYNTAX",
               "'" + std::string(word.substr(0, 40)) + "' is not a letter of a tool table with a number" +
                   (known && !value ? ": " + value.error().message : ""),
               "T, P, an axis, D, I, J or Q and a decimal number");
        return std::nullopt;
      }
      if (seen.find(letter) != std::string::npos) {
        refuse("DATA-DUPLICATE", std::string("the letter ") + letter + " is given twice", "each letter once");
        return std::nullopt;
      }
      seen.push_back(letter);
      if (!put(letter, *value, word, out)) return std::nullopt;
    }
    if (!out.has_tool) {
      if (!seen.empty()) refuse("TBL-SYNTAX", "a line without a tool number", "T and a number");
      return std::nullopt;
    }
    return out;
  }

  bool put(char letter, double value, std::string_view word, Line& out) {
    if (letter == 'T' || letter == 'P') {
      const double least = letter == 'T' ? 1.0 : 0.0;
      if (value != std::floor(value) || value < least || value > kMostToolNumber) {
        refuse("TOOL-NUMBER",
               std::string(word) + (letter == 'T' ? " is no tool number" : " is no pocket number"),
               "a whole number from " + trimmed(least, 0) + " to " + std::to_string(kMostToolNumber));
        return false;
      }
      if (letter == 'P') {
        out.entry.pocket = static_cast<int>(value);
      } else {
        out.entry.number = static_cast<int>(value);
        out.has_tool = true;
      }
      return true;
    }
    if (letter == 'D') {
      out.diameter = trimmed_text(word.substr(1));
      if (out.diameter.starts_with('+')) out.diameter.erase(0, 1);
      if (value < 0.0) {
        refuse("TOOL-VALUE", "T" + std::to_string(out.entry.number) + ": the diameter is negative",
               "a diameter of at least 0");
        return false;
      }
    }
    out.entry.offsets.emplace_back(letter, value);
    return true;
  }

  void take(Line line) {
    MachineEntry& e = line.entry;
    const std::string name = "T" + std::to_string(e.number);
    const auto [at, fresh] = lines_.emplace(e.number, number_);
    if (!fresh) {
      refuse("TOOL-NUMBER",
             "tool number " + std::to_string(e.number) + " is given twice, first in line " +
                 std::to_string(at->second),
             "each tool number once", "give one of the tools another number");
      return;
    }
    const double d = diameter_of(e);
    if (unit_told_) return;
    if (unit_assumed_ && (says_fraction(e.comment, d) || says_millimetres(e.comment, d * kMmPerInch))) {
      refuse("TBL-UNIT",
             name + " has a diameter of " + trimmed(d, 5) + ", taken as mm, and its comment '" + e.comment +
                 "' gives the size that it has in inches",
             "one unit",
             "capstan tools import " + file_ +
                 " --unit inch -o tools.yaml and plan with tools.yaml; --unit mm when the comment is wrong");
      unit_told_ = true;  // of the other lines it would be said again
      return;
    }
    if (d == 0.0) {
      empty_.push_back(name);
      out_.report.dropped.push_back({name, "", "no diameter: kept as a line of the table only"});
    } else {
      const bool inches = mm_per_unit_ == kMmPerInch;
      auto dc = property_from("DC", line.diameter, inches ? "in" : "mm", "the tool table's D",
                              {file_, number_, name});
      if (!dc) {
        faults_.push_back(dc.error());
        return;
      }
      add_item(name, e, *std::move(dc), inches);
      e.assembly = name;
    }
    if (!e.pocket) e.pocket = e.number;  // a tool table lists the tools in the machine
    out_.library.entries.push_back(std::move(e));
  }

  /// True if a comment states the diameter as a fraction ("1/4 end mill" beside 0.25), which means inches.
  static bool says_fraction(std::string_view comment, double d) {
    for (auto at = comment.find('/'); at != std::string_view::npos; at = comment.find('/', at + 1)) {
      const auto digit = [&](std::size_t k) {
        return k < comment.size() && comment[k] >= '0' && comment[k] <= '9';
      };
      std::size_t from = at, to = at + 1;
      while (from > 0 && digit(from - 1)) --from;
      while (digit(to)) ++to;
      const auto a = parse_double(comment.substr(from, at - from));
      const auto b = parse_double(comment.substr(at + 1, to - at - 1));
      if (a && b && *b > 0.0 && *a < *b && std::abs(*a / *b - d) <= 0.01 * d && d > 0.0) return true;
    }
    return false;
  }

  /// True if a comment states that diameter in mm: "10 mm end mill".
  static bool says_millimetres(std::string_view comment, double d) {
    for (auto at = comment.find("mm"); at != std::string_view::npos; at = comment.find("mm", at + 2)) {
      std::size_t to = at, from = 0;
      while (to > 0 && comment[to - 1] == ' ') --to;
      for (from = to;
           from > 0 && ((comment[from - 1] >= '0' && comment[from - 1] <= '9') || comment[from - 1] == '.');)
        --from;
      const auto stated = parse_double(comment.substr(from, to - from));
      // As far apart as three decimals of an inch leave them.
      if (stated && *stated > 0.0 && d > 0.0 && std::abs(*stated - d) <= 0.01 * d) return true;
    }
    return false;
  }

  static double diameter_of(const MachineEntry& e) {
    for (const auto& [letter, value] : e.offsets)
      if (letter == 'D') return value;
    return 0.0;
  }

  void add_item(const std::string& name, const MachineEntry& e, Property dc, bool inches) {
    CatalogueItem item;
    item.id = name;
    item.description = e.comment;
    item.kind = e.comment;
    item.inches = inches;
    item.cutter_class = class_from_words(e.comment);
    const double diameter = dc.number.value_or(0.0);
    item.properties.push_back(std::move(dc));
    const auto derived = [&](Property p, std::string_view why) {
      p.state = ValueState::kDerived;
      p.source = why;
      out_.report.derived.push_back({name, p.symbol, std::string(why)});
      item.properties.push_back(std::move(p));
    };
    if (!item.cutter_class) {
      out_.report.dropped.push_back(
          {name, "class", "no word of its comment '" + e.comment + "' names a kind of tool"});
      item.kept.emplace_back("left out", "no word of its comment '" + e.comment +
                                             "' names a kind of tool (end mill, drill, tap, ...)");
    } else {
      const CommentWords w = words_of_comment(e.comment, *item.cutter_class, diameter, mm_per_unit_);
      derived(text_property("CLASS", model::to_text(*item.cutter_class), ""), kOfComment);
      if (w.substrate) derived(text_property("SUBSTRATE", model::to_text(*w.substrate), ""), kOfComment);
      if (w.teeth > 0) derived(number_property("ZEFF", w.teeth, "", ValueState::kDerived, ""), kOfComment);
      const std::pair<const char*, double> sizes[] = {{"TP", w.sizes.pitch_mm},
                                                      {"RE", w.sizes.corner_radius_mm},
                                                      {"SIG", w.sizes.point_angle_rad},
                                                      {"DCN", w.sizes.tip_mm}};
      for (const auto& [symbol, value] : sizes)
        if (value > 0.0)
          derived(number_property(symbol, value, std::string_view(symbol) == "SIG" ? "deg" : "mm",
                                  ValueState::kDerived, ""),
                  kOfComment);
    }
    ToolAssembly a;
    a.id = a.item = name;
    out_.library.items.push_back(std::move(item));
    out_.library.assemblies.push_back(std::move(a));
  }

  const std::string& file_;
  double mm_per_unit_;
  bool unit_assumed_, unit_told_ = false;
  Job& job_;
  Imported out_;
  std::uint64_t number_ = 0;
  std::map<int, std::uint64_t> lines_;
  std::vector<std::string> empty_;
  std::vector<Diagnostic> faults_;
};

class Writer {
 public:
  Writer(const ToolLibrary& library, const FormatOptions& options) : l_(library) {
    const std::string* kept = find_kept(library.kept, kUnitKey);
    const auto of_source = kept != nullptr ? parse_double(*kept) : std::nullopt;
    from_mm_per_unit_ = of_source.value_or(1.0);
    mm_per_unit_ = options.mm_per_unit.value_or(from_mm_per_unit_);
  }

  Exported write() {
    for (const auto& i : l_.items) items_.emplace(i.id, &i);
    for (const auto& a : l_.assemblies) assemblies_.emplace(a.id, &a);
    for (const auto& e : l_.entries)
      if (e.number > 0) taken_.emplace(e.number, &e);
    std::map<std::string, bool> written;
    for (const auto& e : l_.entries) {
      if (!e.assembly.empty()) written[e.assembly] = true;
      entry(e);
    }
    for (const auto& a : l_.assemblies)
      if (!written.contains(a.id)) unplaced(a.id);
    std::map<std::string, bool> assembled;
    for (const auto& a : l_.assemblies) assembled[a.item] = true;
    for (const auto& i : l_.items)
      if (!assembled.contains(i.id)) unplaced(i.id);
    if (!l_.holders.empty()) drop("", "holders", "a tool table has no place for holders");
    if (!l_.instances.empty()) drop("", "instances", "a tool table has no place for stock and life");
    for (const auto& [path, text] : l_.kept)
      if (path != kUnitKey) drop("", path, "a tool table has no place for it");
    return std::move(out_);
  }

 private:
  void drop(const std::string& who, std::string field, std::string why) {
    out_.report.dropped.push_back({who, std::move(field), std::move(why)});
  }
  [[nodiscard]] std::string unit() const { return mm_per_unit_ == kMmPerInch ? "in" : "mm"; }

  void unplaced(const std::string& id) {
    while (taken_.contains(next_)) ++next_;
    MachineEntry e;
    e.number = next_++;
    e.assembly = id;
    out_.report.derived.push_back(
        {id, "T", "it had no tool number; T" + std::to_string(e.number) + " is taken"});
    entry(e);
  }

  void entry(MachineEntry e) {
    const auto a = assemblies_.find(e.assembly);
    const std::string item_id = a != assemblies_.end() ? a->second->item : e.assembly;
    const auto i = items_.find(item_id);
    const CatalogueItem* item = i != items_.end() ? i->second : nullptr;
    if (const auto at = taken_.find(e.number);
        e.number <= 0 || (at != taken_.end() && at->second->assembly != e.assembly)) {
      const std::string why = e.number <= 0
                                  ? "it had no tool number"
                                  : "T" + std::to_string(e.number) + " is that of " + at->second->assembly;
      while (taken_.contains(next_)) ++next_;
      e.number = next_++;
      out_.report.derived.push_back({e.assembly, "T", why + "; T" + std::to_string(e.number) + " is taken"});
    }
    std::string line = "T" + std::to_string(e.number) + " P" + std::to_string(e.pocket.value_or(e.number));
    const double factor = from_mm_per_unit_ / mm_per_unit_;
    const auto offset = [&e](char letter) -> std::optional<double> {
      for (const auto& [l, v] : e.offsets)
        if (l == letter) return v;
      return std::nullopt;
    };
    for (const char axis : kAxes) {
      auto v = offset(axis);
      const bool linear = std::string_view("ABC").find(axis) == std::string_view::npos;
      // To a billionth, so that 107.95 does not become 107.94999999999999.
      if (v && linear && factor != 1.0) v = rounded(*v * factor, 9);
      // The table's length is that from the gage line.
      if (axis == 'Z' && !v && a != assemblies_.end() && a->second->functional_length_mm)
        v = parse_double(spelled(*a->second->functional_length_mm, mm_per_unit_));
      if (v) line += " " + std::string(1, axis) + shortest(*v);
    }
    for (const char letter : kAfter) {
      if (letter == 'D') {
        const Property* dc = item != nullptr ? find(item->properties, "DC") : nullptr;
        if (dc != nullptr && dc->number)
          line += " D" + spelled_in(*dc, unit());
        else if (const auto d = offset('D'))
          line += " D" + shortest(factor == 1.0 ? *d : rounded(*d * factor, 9));
      } else if (const auto v = offset(letter)) {
        line += " " + std::string(1, letter) + shortest(*v);
      }
    }
    const std::string comment = with_sizes(comment_of(e, item), item);
    out_.bytes += line + (comment.empty() ? "" : " ;" + comment) + "\n";
    ++out_.report.tools;
    if (item != nullptr) told(*item, comment, e.assembly);
  }

  /// The words from which the class is found when the table is read again.
  std::string comment_of(const MachineEntry& e, const CatalogueItem* item) {
    std::string out = e.comment;
    if (out.empty() && item != nullptr) out = item->description;
    for (char& c : out)
      if (c == '\n' || c == '\r' || c == ';') c = ' ';
    out = trimmed_text(out);
    if (item == nullptr || !item->cutter_class || class_from_words(out) == item->cutter_class) return out;
    std::string words(model::to_text(*item->cutter_class));
    std::replace(words.begin(), words.end(), '_', ' ');
    const std::string with = out.empty() ? words : words + ", " + out;
    return class_from_words(with) == item->cutter_class ? with : out;
  }

  /// Adds sizes that the comment does not state yet, in words that are read again.
  std::string with_sizes(std::string comment, const CatalogueItem* item) const {
    if (item == nullptr || !item->cutter_class) return comment;
    const double dc = number_of(*item, "DC").value_or(0.0);
    const auto add = [&](const char* symbol, double CommentSizes::*size, const auto& words) {
      const auto v = number_of(*item, symbol);
      if (!v || *v <= 0.0) return;
      const auto says = [&](const std::string& text) {
        return std::abs(sizes_of_words(text, *item->cutter_class, dc, mm_per_unit_).*size - *v) < 1e-4;
      };
      const std::string with = comment + (comment.empty() ? "" : ", ") + words(*v);
      if (!says(comment) && says(with)) comment = with;
    };
    const auto mm = [](double v) { return trimmed(v, 5) + " mm"; };
    add("TP", &CommentSizes::pitch_mm, [&](double v) { return "pitch " + mm(v); });
    add("RE", &CommentSizes::corner_radius_mm, [&](double v) { return "R" + mm(v); });
    add("SIG", &CommentSizes::point_angle_rad,
        [](double v) { return trimmed(v / kRadPerDegree, 4) + " deg included"; });
    add("DCN", &CommentSizes::tip_mm, [&](double v) { return "tip " + mm(v); });
    return comment;
  }

  bool said(const Property& p, const CatalogueItem& item, const std::string& comment) const {
    if (!item.cutter_class || !p.number) return false;
    const auto s =
        sizes_of_words(comment, *item.cutter_class, number_of(item, "DC").value_or(0.0), mm_per_unit_);
    const double v = p.symbol == "TP"    ? s.pitch_mm
                     : p.symbol == "RE"  ? s.corner_radius_mm
                     : p.symbol == "SIG" ? s.point_angle_rad
                     : p.symbol == "DCN" ? s.tip_mm
                                         : 0.0;
    return v > 0.0 && std::abs(v - *p.number) < 1e-4;
  }

  void told(const CatalogueItem& item, const std::string& comment, const std::string& who) {
    if (item.cutter_class && class_from_words(comment) != item.cutter_class)
      drop(who, "class",
           "no words of a comment tell the class " + std::string(model::to_text(*item.cutter_class)));
    std::string fields;
    for (const Property& p : item.properties) {
      if (p.symbol == "DC" || p.symbol == "CLASS" || p.state == ValueState::kDerived) continue;
      if (said(p, item, comment)) continue;
      fields += (fields.empty() ? "" : " ") + p.symbol;
    }
    if (!fields.empty()) drop(who, fields, "a tool table has no place for these");
    if (!item.presets.empty()) drop(who, "presets", "a tool table has no place for start values");
    std::vector<std::string> rest;  // "presets.0.guid" and the like are reported once, as "presets"
    for (const auto& [path, text] : item.kept) {
      std::string stem = path.substr(0, path.find_first_of(".#"));
      if (stem != "left out" && std::find(rest.begin(), rest.end(), stem) == rest.end())
        rest.push_back(std::move(stem));
    }
    std::string stems;
    for (const std::string& stem : rest) stems += (stems.empty() ? "" : " ") + stem;
    if (!stems.empty()) drop(who, stems, "what its source keeps there has no place in a tool table");
  }

  const ToolLibrary& l_;
  double from_mm_per_unit_ = 1.0, mm_per_unit_ = 1.0;
  Exported out_;
  std::map<std::string, const CatalogueItem*> items_;
  std::map<std::string, const ToolAssembly*> assemblies_;
  std::map<int, const MachineEntry*> taken_;
  int next_ = 1;
};

bool recognises(std::string_view bytes, std::string_view) { return looks_like_tool_table(bytes); }

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& options,
                      Job& job) {
  return Reader(file, options, job).read(bytes);
}

Result<Exported> write(const ToolLibrary& library, const FormatOptions& options, Job&) {
  return Writer(library, options).write();
}

}  // namespace

bool looks_like_tool_table(std::string_view text) {
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string_view line = trimmed_text(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line[0] == ';' || line[0] == '#') continue;
    const auto is_number = [](char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+'; };
    return line.size() > 1 && (line[0] == 'T' || line[0] == 't') && is_number(line[1]);
  }
  return false;
}

const Format& linuxcnc_format() {
  static const Format kFormat{
      "linuxcnc", "LinuxCNC or PathPilot tool table (.tbl)", {".tbl"}, &recognises, &read, &write};
  return kFormat;
}

}  // namespace capstan::tooling
