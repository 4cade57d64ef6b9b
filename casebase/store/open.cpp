#include <array>

#include "casebase/casebase.h"
#include "casebase/store/server.h"

namespace capstan::casebase {
namespace {

using Open = Result<std::unique_ptr<Store>> (*)(const std::string& rest, Missing missing, Job& job);

Result<std::unique_ptr<Store>> of_server(const std::string& uri, Missing missing, Job& job) {
  return open_server(uri, missing, job);
}

/// A kind of store: what its URIs begin with, and whether its opener gets the URI with that.
struct Kind {
  std::string_view prefix;
  bool whole;
  Open open;
};
constexpr std::array kKinds = {
    Kind{"sqlite:", false,
         [](const std::string& path, Missing missing, Job& job) { return open_sqlite(path, missing, job); }},
    Kind{"postgresql:", true, of_server},
    Kind{"postgres:", true, of_server},
};

tl::unexpected<Diagnostic> no_store(const std::string& uri) {
  return fail(Diagnostic{.code = "CASE-URI",
                         .message = "'" + name_of(uri.substr(0, 200)) + "' names no case base",
                         .expected = "a path, sqlite: and a path, or postgresql://user@host:port/database"});
}

}  // namespace

Result<std::unique_ptr<Store>> open_store(const std::string& uri, Missing missing, Job& job) {
  if (uri.find('\0') != std::string::npos) return no_store(uri);
  for (const Kind& kind : kKinds) {
    if (!uri.starts_with(kind.prefix)) continue;
    const std::string rest = kind.whole ? uri : uri.substr(kind.prefix.size());
    if (rest.empty() || (!kind.whole && rest.find("://") != std::string::npos)) return no_store(uri);
    return kind.open(rest, missing, job);
  }
  if (uri.empty() || uri.find("://") != std::string::npos) return no_store(uri);
  return open_sqlite(uri, missing, job);
}

}  // namespace capstan::casebase
