#include "casebase/casebase.h"
#include "casebase/store/server.h"

namespace capstan::casebase {

Result<std::unique_ptr<Store>> connect_postgres(const std::string& uri, Missing, Job&) {
  return fail(Diagnostic{.code = "CASE-URI",
                         .message = "this program was built without PostgreSQL",
                         .file = name_of(uri),
                         .hint = "build it where libpqxx is found (Debian: libpqxx-dev)"});
}

}  // namespace capstan::casebase
