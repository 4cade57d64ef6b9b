#pragma once

#include <memory>
#include <string>
#include <vector>

#include "casebase/store/store.h"

/// What is between Capstan and `capstan-postgres.so`, its one library for servers of PostgreSQL. It is opened
/// where a server is named (opened_postgres.cpp): libpqxx, and the encryption and sign-on that libpq brings
/// along, would take a fifth of the start of every command.
namespace capstan::casebase {

/// `connect_postgres` (server.h) of the library; `name` is the URI without its password. Objects pass as they
/// are, so that both sides must be of one build.
using ConnectPostgres = void(const std::string& uri, const std::string& name, Missing missing, Job& job,
                             Result<std::unique_ptr<Store>>& to);
inline constexpr const char* kConnectPostgres = "capstan_connect_postgres";
/// What the library is of: the version, and a sum of this header with all that it includes
/// (cmake/BuildIdentity.cmake). Nothing else of it is called before that is the same here.
using PostgresIdentity = const char*();
inline constexpr const char* kPostgresIdentity = "capstan_postgres_identity";
inline constexpr const char* kPostgresLibrary = "capstan-postgres.so";

/// The function of the first library of `places` that is of this build; no other is called.
/// Fails  CASE-LIBRARY: none is there; else what the first of them lacks: it cannot be opened, or is of
///        another build.
[[nodiscard]] Result<ConnectPostgres*> connector_of(const std::vector<std::string>& places);

}  // namespace capstan::casebase

extern "C" [[gnu::visibility("default")]] capstan::casebase::ConnectPostgres capstan_connect_postgres;
extern "C" [[gnu::visibility("default")]] capstan::casebase::PostgresIdentity capstan_postgres_identity;
