// What a capstan-postgres.so of another build exports.

#include <cstdlib>

extern "C" {

[[gnu::visibility("default")]] const char* capstan_postgres_identity() { return "0.0.1-of-another-build"; }

/// Its objects are not those of who opens it: it must not be called.
[[gnu::visibility("default")]] void capstan_connect_postgres() { std::abort(); }
}
