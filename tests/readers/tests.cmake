# The readers of tests/fuzz over their seeds, and seeds edited by chance.
find_package(SQLite3 REQUIRED)
capstan_test(readers DEPENDS exchange json controls verify rules casebase tooling workholding transport LIBS SQLite::SQLite3)
target_sources(readers_test PRIVATE ${CMAKE_SOURCE_DIR}/tests/fuzz/readers.cpp)
