#include <algorithm>
#include <filesystem>
#include <optional>

#include "casebase/casebase.h"
#include "casebase/store/postgres/postgres_library.h"
#include "casebase/store/server.h"
#include "planner/ground/base/loading/beside.h"
#include "planner/ground/base/loading/library.h"

namespace capstan::casebase {
namespace {

using Connect = decltype(capstan_connect_postgres);

Result<Connect*> opened() {
  const auto places = places_beside(kPostgresLibrary);
  std::error_code none;
  const auto at = std::find_if(places.begin(), places.end(), [&](const std::string& place) {
    return std::filesystem::exists(place, none);
  });
  if (at == places.end()) {
    std::string list;
    for (const std::string& place : places) list += (list.empty() ? "" : ", ") + place;
    return fail("LIB-OPEN", "it is not there (" + list + ")");
  }
  const auto library = Library::open(*at);
  if (!library) return tl::unexpected(library.error());
  Connect* connect = nullptr;
  if (const Status taken = library->take(kConnectPostgres, connect); !taken)
    return tl::unexpected(taken.error());
  return connect;
}

}  // namespace

Result<std::unique_ptr<Store>> connect_postgres(const std::string& uri, Missing missing, Job& job) {
  static const Result<Connect*> connect = opened();
  const std::string name = name_of(uri);
  if (!connect) {
    return fail(Diagnostic{.code = "CASE-URI",
                           .message = "servers of PostgreSQL are reached through " +
                                      std::string(kPostgresLibrary) + ": " + connect.error().message,
                           .file = name,
                           .hint = "install Capstan with it, and libpqxx (Debian: libpqxx-6.4)"});
  }
  Result<std::unique_ptr<Store>> out;
  (*connect)(uri, name, missing, job, out);
  return out;
}

}  // namespace capstan::casebase
