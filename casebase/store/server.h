#pragma once

#include <memory>
#include <string>

#include "casebase/store/store.h"

/// A case base on a server, and what stands for the server while it cannot be reached.
namespace capstan::casebase {

/// The store of a database of PostgreSQL (`postgresql://user@host:port/database`), in its schema `capstan`.
/// Fails  CASE-URI; CASE-LIBRARY capstan-postgres.so is not there, cannot be opened, or is of another build
///        (looked for once in a process); CASE-OFFLINE nobody answers; CASE-OPEN the server answers and lets
///        nobody in, or has no case base and none is to be made; CASE-SCHEMA. Its calls fail CASE-OFFLINE
///        once the server is gone.
[[nodiscard]] Result<std::unique_ptr<Store>> connect_postgres(const std::string& uri, Missing missing,
                                                              Job& job);

/// As `connect_postgres`.
using ConnectServer = Result<std::unique_ptr<Store>> (*)(const std::string& uri, Missing missing, Job& job);

/// The same store, with a local copy of its rows. When the server cannot be reached (CASE-OFFLINE, a
/// warning), the copy stands for it, and what is added waits in the outbox. The next opening that reaches the
/// server adds what waits (CASE-OUTBOX, a note). So, too, where the library is missing (CASE-LIBRARY, a
/// warning), but only for a server that was reached from here before: what is added to one that never was
/// would wait for ever where it is taken for stored.
[[nodiscard]] Result<std::unique_ptr<Store>> open_server(const std::string& uri, Missing missing, Job& job,
                                                         ConnectServer connect = &connect_postgres);

}  // namespace capstan::casebase
