#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tooling/library/formats/item/item.h"

namespace capstan::tooling::din4000 {

/// One tool as a file lists it: the table of DIN 4000 (NSM), the figure within it (BLD), and code -> value in
/// the file's order. XML and CSV carry the same codes.
struct Record {
  std::string table, figure;  ///< "DIN4000-82", "2"
  std::string id, manufacturer;
  std::vector<std::pair<std::string, std::string>> values;
  std::uint64_t line = 0;
};

/// Codes have a meaning within their table only. The known codes of 80 (taps), 81 (drills) and 82 (end mills)
/// become symbols; every other code is kept word for word and reported, never guessed. DIN 4000 measures in
/// mm and degrees; decimals have a comma or a point.
///
/// Source   the codes' meaning: makers' public files read against their own descriptions (length of cut,
/// overall
///          length and shank of the same article in inches), relations within them (B71 = B5 - B7, B7 =
///          height of the point of E1), and public importers that name the same codes alike.
void read_record(const Record& record, const std::string& file, Imported& out, ItemGatherer& gatherer);

}  // namespace capstan::tooling::din4000
