#pragma once

#include <utility>
#include <vector>

#include "planner/files/exchange/ap238/placement/placement.h"
#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/files/exchange/ap238/write/writer.h"
#include "planner/files/exchange/records/records.h"

// Records of a plan beside its nouns (planner/files/exchange/records/records.h) as process properties:
// MACHINING_PROCESS_PROPERTY 'capstan binding', 'capstan cutter', … on the executable concerned, or on the
// main workplan if they concern the whole plan. A property's representation has an item for each field, with
// the field's name; objects are named by their address (addresses.h), never by number.

namespace capstan::exchange::ap238 {

/// The records of a file. Made before the reader runs: their instances are no part of the mapping then.
class Records {
 public:
  explicit Records(Reader& reader);
  /// Puts them into the plan, after everything else was read.
  /// Of a sealed file (seal.h), no value is taken for edited.
  void restore(bool sealed);

 private:
  struct Found {
    std::string kind;
    double number = 0.0;  ///< order within the kind
    Node property;
    std::vector<Node> items;
  };
  void restore_unlisted(const std::vector<Unlisted>& unlisted);
  Reader& reader_;
  std::vector<Found> found_;
};

/// Adds the records of the plan, and of the operations that features do not list, once all objects have
/// instances.
void write_records(Writer& writer, const std::vector<Unlisted>& unlisted);

}  // namespace capstan::exchange::ap238
