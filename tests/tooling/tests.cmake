find_package(SQLite3 REQUIRED)
capstan_test(tooling DEPENDS tooling LIBS SQLite::SQLite3)
