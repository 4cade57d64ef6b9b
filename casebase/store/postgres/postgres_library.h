#pragma once

#include <memory>
#include <string>

#include "casebase/store/store.h"

/// What is between Capstan and `capstan-postgres.so`, its one library for servers of PostgreSQL. It is opened
/// where a server is named (opened_postgres.cpp): libpqxx, and the encryption and sign-on that libpq brings
/// along, would take a fifth of the start of every command.
namespace capstan::casebase {

/// `connect_postgres` (server.h) of the library; `name` is the URI without its password. What it makes is of
/// the same build: objects pass as they are.
using ConnectPostgres = void(const std::string& uri, const std::string& name, Missing missing, Job& job,
                             Result<std::unique_ptr<Store>>& to);
inline constexpr const char* kConnectPostgres = "capstan_connect_postgres";
inline constexpr const char* kPostgresLibrary = "capstan-postgres.so";

}  // namespace capstan::casebase

extern "C" [[gnu::visibility("default")]] capstan::casebase::ConnectPostgres capstan_connect_postgres;
