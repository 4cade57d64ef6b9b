// From the faces of CAD parts to plans: recognition against labels, tolerances against what the files state,
// and the plans that record_plans.py recorded.

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "planner/files/exchange/brep/read_pmi.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/files/recognise/mfcad.h"
#include "tests/files/recognise/planar_step.h"
#include "tests/support/corpus.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using testing::kMfcadClasses;
using testing::kNoMfcadClass;

/// By testing::MfcadClass.
constexpr std::array<const char*, kMfcadClasses> kClasses = {
    "chamfer",         "triangular passage",       "rectangular passage",      "six-sided passage",
    "triangular slot", "rectangular through slot", "rectangular through step", "two-sided through step",
    "slanted step",    "triangular pocket",        "rectangular pocket",       "six-sided pocket",
    "blind slot",      "triangular blind step",    "rectangular blind step",   "stock"};
constexpr std::array<const char*, 2> kHalves = {"seen", "held"};

/// 32-bit FNV-1a of a part's name, as record_plans.py halves the parts.
std::size_t half_of(const std::string& name) {
  std::uint32_t h = 2166136261U;
  for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 16777619U;
  return h % 2;
}

std::string of(std::size_t n, std::size_t all) { return std::to_string(n) + " of " + std::to_string(all); }

struct Labelled {
  std::array<std::array<std::size_t, kMfcadClasses + 1>, kMfcadClasses> confusion{};
  std::size_t parts = 0, right = 0;
};

/// Recognition of the labelled parts, by halves; empty: there are none.
std::array<Labelled, 2> labelled(const std::string& folder) {
  std::array<Labelled, 2> out;
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".step") stems.push_back(entry.path().stem().string());
  }
  std::sort(stems.begin(), stems.end());
  for (const std::string& stem : stems) {
    Labelled& half = out[half_of(stem)];
    const auto brep = testing::read_planar_step(testing::slurp(folder + "/" + stem + ".step"));
    const auto labels = testing::mfcad_labels(testing::slurp(folder + "/" + stem + ".labels.json"));
    const auto classes = testing::mfcad_classes(brep, recognise::recognise(brep));
    bool right = true;
    for (std::size_t f = 0; f < classes.size(); ++f) {
      const auto label = static_cast<std::size_t>(labels.at(std::stoul(brep.faces[f].name)));
      const auto found = static_cast<std::size_t>(classes[f] == kNoMfcadClass ? kMfcadClasses : classes[f]);
      ++half.confusion[label][found];
      right = right && label == found;
    }
    ++half.parts;
    half.right += right ? 1 : 0;
  }
  return out;
}

/// Of each class how many faces are recognised as it, and as what the others are.
Table confusion(const std::array<Labelled, 2>& halves, std::size_t& right, std::size_t& all) {
  Table out{{"class of the label", "half seen", "half held", "recognised as another class"}, {}};
  for (std::size_t label = 0; label < kClasses.size(); ++label) {
    std::vector<std::string> cells{kClasses[label]};
    std::string others;
    for (const Labelled& half : halves) {
      std::size_t faces = 0;
      for (std::size_t found = 0; found < half.confusion[label].size(); ++found) {
        const std::size_t n = half.confusion[label][found];
        faces += n;
        if (n == 0 || found == label) continue;
        others += (others.empty() ? "" : ", ") + std::to_string(n) + " " +
                  (found < kClasses.size() ? kClasses[found] : "none");
      }
      right += half.confusion[label][label];
      all += faces;
      cells.push_back(of(half.confusion[label][label], faces));
    }
    cells.push_back(others.empty() ? "none" : others);
    out.rows.push_back(std::move(cells));
  }
  return out;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// The tolerances of NIST's parts that are read, of those that the keywords of the files count.
Table stated(const std::string& folder) {
  Table out{{"file", "sizes and distances", "geometric tolerances", "datums", "of these without a face"}, {}};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().string().find("ap242") != std::string::npos) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& path : files) {
    const std::string text = testing::slurp(path.string());
    Job job;
    const auto file = p21::parse(text, path.filename().string(), {}, job);
    if (!file) continue;
    const exchange::Pmi p = exchange::read_pmi(*file);
    const auto faceless =
        std::count_if(p.sizes.begin(), p.sizes.end(), [](const auto& s) { return s.faces.empty(); }) +
        std::count_if(p.zones.begin(), p.zones.end(),
                      [](const auto& z) { return z.faces.empty() && !z.whole; });
    out.rows.push_back(
        {path.stem().string(),
         of(p.sizes.size(), count_of(text, "DIMENSIONAL_SIZE(") + count_of(text, "DIMENSIONAL_LOCATION(")),
         of(p.zones.size(), count_of(text, "_TOLERANCE('")),
         of(p.datums.size(), count_of(text, "=DATUM(") + count_of(text, "= DATUM(")),
         std::to_string(faceless)});
  }
  return out;
}

/// A row of the record, by the names of its columns.
using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::string& record) {
  const auto cells = cells_of(record);
  std::vector<Row> out;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    Row row;
    for (std::size_t k = 0; k < cells[i].size() && k < cells[0].size(); ++k) row[cells[0][k]] = cells[i][k];
    out.push_back(std::move(row));
  }
  return out;
}

/// As record_plans.py names what came of a part, in words.
const std::vector<std::pair<std::string, std::string>>& outcomes() {
  static const std::vector<std::pair<std::string, std::string>> kAll = {
      {"whole", "whole"},          {"in_part", "in part"}, {"none", "no feature"},
      {"unsafe", "check refuses"}, {"time", "over time"},  {"refused", "file refused"}};
  return kAll;
}

Table by_outcome(const std::vector<Row>& rows) {
  Table out{{"parts", "number"}, {}};
  for (const auto& [name, words] : outcomes()) out.head.push_back(words);
  for (const auto& [set, half, size, words] :
       {std::array{"nist", "all", "x1", "NIST, files in the record"},
        std::array{"mfcad", "seen", "x10", "MFCAD times ten, half seen"},
        std::array{"mfcad", "held", "x10", "MFCAD times ten, half held"},
        std::array{"mfcad", "seen", "x1", "MFCAD as drawn, half seen"},
        std::array{"mfcad", "held", "x1", "MFCAD as drawn, half held"}}) {
    const auto of_it = [&](const Row& r) {
      return r.at("set") == set && r.at("half") == half && r.at("size") == size;
    };
    const auto all = std::count_if(rows.begin(), rows.end(), of_it);
    if (all == 0) continue;
    std::vector<std::string> cells{words, std::to_string(all)};
    for (const auto& [name, text] : outcomes())
      cells.push_back(std::to_string(std::count_if(
          rows.begin(), rows.end(), [&](const Row& r) { return of_it(r) && r.at("outcome") == name; })));
    out.rows.push_back(std::move(cells));
  }
  return out;
}

/// The parts that planning reads, one by one.
Table one_by_one(const std::vector<Row>& rows) {
  Table out{{"part", "outcome", "features", "their faces", "on the raw piece", "groups left over",
             "stays, mm³", "cut into the part, mm³", "overlap, %", "CPU, s"},
            {}};
  for (const Row& r : rows) {
    if (r.at("size") == "x1" && r.at("set") == "mfcad") continue;
    const auto words = std::find_if(outcomes().begin(), outcomes().end(),
                                    [&](const auto& o) { return o.first == r.at("outcome"); });
    std::vector<std::string> cells{r.at("part") + (r.at("set") == "mfcad" ? ", " + r.at("half") : ""),
                                   words == outcomes().end() ? r.at("outcome") : words->second};
    for (const char* column :
         {"features", "faces", "raw", "left", "stays_mm3", "gouged_mm3", "overlap", "cpu_s"})
      cells.push_back(r.at(column));
    out.rows.push_back(std::move(cells));
  }
  return out;
}

std::string whole(const std::vector<Row>& rows, const std::string& set, const std::string& half) {
  std::size_t all = 0, n = 0;
  for (const Row& r : rows) {
    if (r.at("set") != set || (!half.empty() && r.at("half") != half)) continue;
    if (set == "mfcad" && r.at("size") != "x10") continue;
    ++all;
    n += r.at("outcome") == "whole" ? 1 : 0;
  }
  return of(n, all);
}

}  // namespace

Comparison recognition(const std::string& corpus, const std::string& record) {
  Comparison out{.name = "recognition"};
  const std::string mfcad = corpus + "/cad/mfcad", nist = corpus + "/cad/nist";
  if (corpus.empty() || !std::filesystem::exists(mfcad) || !std::filesystem::exists(nist)) {
    out.skipped = "the corpus is absent";
    return out;
  }
  const auto text = read_file(record);
  if (!text) {
    out.skipped = "no record of plans: " + text.error().message;
    return out;
  }
  const auto halves = labelled(mfcad);
  std::size_t right = 0, faces = 0;
  const Table matrix = confusion(halves, right, faces);
  const auto rows = rows_of(*text);
  std::string parts;
  for (std::size_t i = 0; i < halves.size(); ++i)
    parts += (i == 0 ? "" : ", ") + of(halves[i].right, halves[i].parts) + " of the half " + kHalves[i];
  out.text = "Recognition against labels: " + of(right, faces) + " faces; parts wholly right: " + parts +
             ".\n\n" + markdown(matrix) + "\nPlans by outcome:\n\n" + markdown(by_outcome(rows)) +
             "\nPlans one by one:\n\n" + markdown(one_by_one(rows)) +
             "\nTolerances read, of those that the files' keywords count:\n\n" + markdown(stated(nist));
  out.headline = of(right, faces) + " faces as labelled; planned whole: NIST " + whole(rows, "nist", "") +
                 " files in the record, MFCAD ten times as large " + whole(rows, "mfcad", "held") +
                 " of the half held, " + whole(rows, "mfcad", "seen") + " of the half seen";
  return out;
}

}  // namespace capstan::validation
