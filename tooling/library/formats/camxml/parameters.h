#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tooling/library/formats/item/item.h"
#include "tooling/library/formats/xml.h"

namespace capstan::tooling::camxml {

/// A parameter by the name a CAM system gives it.
struct Parameter {
  std::string_view name, symbol;
};

/// `<param name= value=/>` children by name; the first of a name counts.
[[nodiscard]] std::string parameter(const XmlNode& tool, std::string_view name);

/// Adds the parameters that the table knows. Others are kept word for word under their name, and reported
/// unless empty or zero. Lengths in `unit`, angles in degrees. Zero of an optional size means "not given" in
/// these files.
void read_parameters(const XmlNode& tool, std::span<const Parameter> known,
                     std::span<const std::string_view> taken_elsewhere, std::string_view unit,
                     std::string_view system, const Place& place, CatalogueItem& item, ItemGatherer& gatherer,
                     LossReport& report);

/// An XML library read by a `Reader(file, out, job)` whose `read(root)` gives a Status.
template <class Reader>
[[nodiscard]] Result<Imported> read_with(std::string_view bytes, const std::string& file, Job& job) {
  auto root = parse_xml(bytes, file);
  if (!root) return fail(root.error());
  Imported out;
  out.library.source = file;
  Reader reader(file, out, job);
  if (Status s = reader.read(*root); !s) return fail(s.error());
  return out;
}

/// A start value above zero; nothing if it is missing, zero or empty. A text that is no number is a fault of
/// the item.
[[nodiscard]] std::optional<double> positive(std::string_view text, const Place& place,
                                             ItemGatherer& gatherer);

}  // namespace capstan::tooling::camxml
