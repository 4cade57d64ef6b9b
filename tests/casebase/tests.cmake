find_package(SQLite3 REQUIRED)  # to plant faults behind the store's back
capstan_test(casebase DEPENDS casebase mechanics LIBS SQLite::SQLite3 ${CMAKE_DL_LIBS} COST 200)
if(TARGET casebase_test)
  # A library for servers of another build, beside the test program.
  add_library(capstan_other_build MODULE ${CMAKE_CURRENT_LIST_DIR}/store/other_build.cpp)
  target_link_libraries(capstan_other_build PRIVATE $<BUILD_INTERFACE:capstan_options>)
  set_target_properties(capstan_other_build PROPERTIES PREFIX "" OUTPUT_NAME other_build
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  add_dependencies(casebase_test capstan_other_build)
  if(TARGET capstan_postgres)
    add_dependencies(casebase_test capstan_postgres)
  endif()
endif()
