#include "casebase/casebase.h"
#include "casebase/store/postgres/postgres_library.h"
#include "casebase/store/server.h"
#include "planner/ground/base/loading/beside.h"

namespace capstan::casebase {

Result<std::unique_ptr<Store>> connect_postgres(const std::string& uri, Missing missing, Job& job) {
  static const Result<ConnectPostgres*> connect = connector_of(places_beside(kPostgresLibrary));
  const std::string name = name_of(uri);
  if (!connect) {
    Diagnostic why = connect.error();
    why.file = name;
    return fail(std::move(why));
  }
  Result<std::unique_ptr<Store>> out;
  (*connect)(uri, name, missing, job, out);
  return out;
}

}  // namespace capstan::casebase
