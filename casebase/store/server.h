#pragma once

#include <memory>
#include <string>

#include "casebase/store/store.h"

/// A case base on a server, and what stands for the server while it cannot be reached.
namespace capstan::casebase {

/// The store of a database of PostgreSQL (`postgresql://user@host:port/database`), in its schema `capstan`.
/// Fails  CASE-URI; CASE-OFFLINE nobody answers; CASE-OPEN the server answers and lets nobody in, or has no
///        case base and none is to be made; CASE-SCHEMA. Its calls fail CASE-OFFLINE once the server is gone.
[[nodiscard]] Result<std::unique_ptr<Store>> connect_postgres(const std::string& uri, Missing missing,
                                                              Job& job);

/// The same store, with a local copy of its rows. When the server cannot be reached (CASE-OFFLINE, a
/// warning), the copy stands for it, and what is added waits in the outbox. The next opening that reaches the
/// server adds what waits (CASE-OUTBOX, a note).
[[nodiscard]] Result<std::unique_ptr<Store>> open_server(const std::string& uri, Missing missing, Job& job);

}  // namespace capstan::casebase
