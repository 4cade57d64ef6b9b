#include "tests/validation/report.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::validation {
namespace {

std::string begin_of(const std::string& name) { return "<!-- begin " + name + " -->\n"; }
std::string end_of(const std::string& name) { return "<!-- end " + name + " -->"; }

std::string line_of(const std::vector<std::string>& cells) {
  std::string out = "|";
  for (const std::string& c : cells) out += " " + c + " |";
  return out + "\n";
}

}  // namespace

std::vector<std::string> lines_of(const Table& table) {
  std::vector<std::string> out;
  for (const auto& row : table.rows) out.push_back(line_of(row));
  return out;
}

std::string markdown(const Table& table) {
  std::string out = line_of(table.head);
  out += "|";
  for (std::size_t i = 0; i < table.head.size(); ++i) out += "---|";
  out += "\n";
  for (const auto& row : table.rows) out += line_of(row);
  return out;
}

std::string columns(const Table& table) {
  std::string out;
  const auto put = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool quote = cells[i].empty() || cells[i].find(' ') != std::string::npos;
      out += (i == 0 ? "" : " ") + (quote ? "\"" + cells[i] + "\"" : cells[i]);
    }
    out += "\n";
  };
  out += "# ";
  put(table.head);
  for (const auto& row : table.rows) put(row);
  return out;
}

std::string standing(const std::string& document, const std::string& name) {
  const auto from = document.find(begin_of(name));
  const auto to = document.find(end_of(name));
  if (from == std::string::npos || to == std::string::npos || to < from) return {};
  const auto start = from + begin_of(name).size();
  return document.substr(start, to - start);
}

std::vector<std::vector<std::string>> cells_of(const std::string& text) {
  std::vector<std::vector<std::string>> out;
  std::vector<std::string> cells(1);
  for (const char c : text) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\n') {
      cells.back() += c;
    } else {
      out.push_back(std::move(cells));
      cells.assign(1, {});
    }
  }
  return out;
}

std::string renewed(const std::string& document, const Comparison& comparison) {
  const auto from = document.find(begin_of(comparison.name));
  const auto to = document.find(end_of(comparison.name));
  if (from == std::string::npos || to == std::string::npos || to < from) return {};
  const auto start = from + begin_of(comparison.name).size();
  return document.substr(0, start) + comparison.text + document.substr(to);
}

std::string percent(double ratio_minus_one, int decimals) {
  const std::string text = fixed(100.0 * ratio_minus_one, decimals);
  return (text.front() == '-' ? "" : "+") + text + " %";
}

Spread spread_of(std::vector<double> errors, double bound) {
  Spread out;
  double square = 0.0;
  for (double& e : errors) {
    square += e * e;
    if (std::abs(e) <= bound) ++out.within;
    if (std::abs(e) > std::abs(out.worst)) out.worst = e;
    e = std::abs(e);
  }
  out.n = static_cast<int>(errors.size());
  if (out.n == 0) return out;
  std::sort(errors.begin(), errors.end());
  const std::size_t n = errors.size();
  out.median = n % 2 == 1 ? errors[n / 2] : 0.5 * (errors[n / 2 - 1] + errors[n / 2]);
  out.rms = std::sqrt(square / static_cast<double>(out.n));
  return out;
}

}  // namespace capstan::validation
