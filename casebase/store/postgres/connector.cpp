#include <filesystem>
#include <optional>

#include "casebase/store/postgres/postgres_library.h"
#include "planner/ground/base/loading/library.h"

namespace capstan::casebase {
namespace {

constexpr const char* kThisBuild = CAPSTAN_POSTGRES_IDENTITY;

tl::unexpected<Diagnostic> lacking(const std::string& why, const std::string& remedy) {
  return fail(Diagnostic{
      .code = "CASE-LIBRARY",
      .message = "servers of PostgreSQL are reached through " + std::string(kPostgresLibrary) + ": " + why,
      .hint = remedy + "; a server that runs (capstan serve) looks for it once: start it again"});
}

Result<ConnectPostgres*> connector_in(const std::string& place) {
  const auto library = Library::open(place);
  if (!library) return lacking(library.error().message, "install libpqxx (Debian: libpqxx-6.4)");
  decltype(&capstan_postgres_identity) identity = nullptr;
  const char* said = library->take(kPostgresIdentity, identity) ? identity() : nullptr;
  const std::string other = said != nullptr ? said : "which states none";
  if (other != kThisBuild) {
    return lacking(
        place + " is of another build (" + other + ") than what opens it (" + kThisBuild + ")",
        "install the command, libcapstan.so and " + std::string(kPostgresLibrary) + " of one build");
  }
  decltype(&capstan_connect_postgres) connect = nullptr;
  if (const Status taken = library->take(kConnectPostgres, connect); !taken)
    return lacking(taken.error().message, "install Capstan again");
  return connect;
}

}  // namespace

Result<ConnectPostgres*> connector_of(const std::vector<std::string>& places) {
  std::error_code none;
  std::optional<Diagnostic> first;
  std::string list;
  for (const std::string& place : places) {
    list += (list.empty() ? "" : ", ") + place;
    if (!std::filesystem::exists(place, none)) continue;
    const auto connect = connector_in(place);
    if (connect) return connect;
    if (!first) first = connect.error();
  }
  if (first) return fail(*std::move(first));
  return lacking("it is not there (" + list + ")",
                 "install Capstan with it, and libpqxx (Debian: libpqxx-6.4)");
}

}  // namespace capstan::casebase
