#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::verify::siemens {

/// A piece of a block: X10, CR=5, T="em10", SUPA, CYCLE81(10,2,1,-18,). Names are in capitals.
struct Item {
  std::string name;
  std::optional<double> value;
  std::optional<std::string> text;  ///< between quotes
  bool assigned = false;            ///< with =
  bool call = false;                ///< with parentheses
  std::vector<std::string> params;  ///< of a call, without blanks around them
};

/// One block taken apart.
struct Line {
  std::vector<Item> items;
  std::optional<std::string> comment;
  std::size_t length = 0;  ///< characters without comment and the line's end
  bool skipped = false;    ///< "/": passed over where the operator says so
  bool percent = false;    ///< the head of a file as it comes over a serial line, "%_N_..."
  std::string fault;       ///< why the rest was not read; empty when all was
  bool unverifiable = false, no_number = false;
};

/// Reuses `out`'s storage.
void split_line(std::string_view text, Line& out);

}  // namespace capstan::verify::siemens
