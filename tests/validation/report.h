#pragma once

#include <string>
#include <utility>
#include <vector>

namespace capstan::validation {

/// A table of the document: every cell is text already.
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// A table as Markdown.
[[nodiscard]] std::string markdown(const Table& table);

/// How much of a comparison is computed. A sample takes a share of the time of those that plan many parts.
enum class Extent { kWhole, kSample };

/// What one comparison came to: `text` is what stands in the document between the markers
/// `<!-- begin NAME -->` and `<!-- end NAME -->`; `data` are the files (name, content) that its plots read.
struct Comparison {
  std::string name;
  std::string text = {};
  /// Of a sample: the lines that it has computed, each of which the whole text has, too. `text` is empty
  /// then.
  std::vector<std::string> lines = {};
  std::string headline = {};  ///< the figure that says most, for the table at the head of the document
  std::vector<std::pair<std::string, std::string>> data = {};
  std::string skipped = {};  ///< why there is nothing; empty: there is
};

/// The rows of a table as the lines of its Markdown.
[[nodiscard]] std::vector<std::string> lines_of(const Table& table);

/// Columns for gnuplot: blanks between them, quotes around cells with a blank.
[[nodiscard]] std::string columns(const Table& table);

/// Cells of a record: rows end with line feeds, commas between cells, no quotes. What follows the last line
/// feed is no row.
[[nodiscard]] std::vector<std::vector<std::string>> cells_of(const std::string& text);

/// The document with the comparison's text between its markers; empty when the markers are missing.
[[nodiscard]] std::string renewed(const std::string& document, const Comparison& comparison);

/// What stands between the markers now; empty when they are missing.
[[nodiscard]] std::string standing(const std::string& document, const std::string& name);

/// "3.2 %" of a ratio minus one, with its sign.
[[nodiscard]] std::string percent(double ratio_minus_one, int decimals = 1);

/// Median and largest by amount of some relative errors, and how many are within a bound.
struct Spread {
  int n = 0, within = 0;
  double median = 0.0, worst = 0.0, rms = 0.0;
};
[[nodiscard]] Spread spread_of(std::vector<double> errors, double bound);

}  // namespace capstan::validation
