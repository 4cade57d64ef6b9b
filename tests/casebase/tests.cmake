find_package(SQLite3 REQUIRED)  # to plant faults behind the store's back
capstan_test(casebase DEPENDS casebase mechanics LIBS SQLite::SQLite3 COST 200)
