find_package(SQLite3 REQUIRED)  # to plant faults behind the store's back
capstan_test(casebase DEPENDS casebase mechanics LIBS SQLite::SQLite3 COST 200)
if(TARGET capstan_postgres AND TARGET casebase_test)
  add_dependencies(casebase_test capstan_postgres)
endif()
