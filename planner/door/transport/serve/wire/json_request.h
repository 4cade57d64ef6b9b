#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::transport {

/// One member of a request's JSON object: its name and what it may be.
struct Member {
  enum class Kind : std::uint8_t { kText, kWhole, kTexts, kValues } kind = Kind::kText;
  const char* name = "";
};

/// A request's JSON object, read: what a member of each kind holds.
struct JsonRequest {
  std::map<std::string, std::string> texts;                           ///< kText
  std::map<std::string, std::uint64_t> wholes;                        ///< kWhole
  std::map<std::string, std::map<std::string, std::string>> objects;  ///< kTexts: of texts; kValues: any,
                                                                      ///< each as JSON
};

/// Reads the object of a request; an empty body is one without members.
///
/// Fails  SERVE-JSON: more than `most` bytes, no JSON, nested deeper than 8, a name twice, a name that is not
///        among `members`, a value of another kind.
[[nodiscard]] Result<JsonRequest> read_json_request(const std::string& body,
                                                    const std::vector<Member>& members, std::size_t most);

}  // namespace capstan::transport
