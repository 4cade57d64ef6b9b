# What is kept fast: the program capstan_kept (./dev bench --check and --take), its test, and a count of the small
# rows' instructions against the table.
set(kept ${CMAKE_CURRENT_LIST_DIR})
add_library(capstan_kept_measure STATIC ${kept}/measure.cpp ${kept}/table.cpp)
target_link_libraries(capstan_kept_measure PUBLIC $<BUILD_INTERFACE:capstan_options> capstan_test_support)
capstan_test(kept LIBS capstan_kept_measure)

if(TARGET capstan_engagement AND TARGET capstan_toolpath AND TARGET capstan_json AND TARGET capstan_casebase)
  add_executable(capstan_kept ${kept}/main.cpp ${kept}/rows.cpp ${kept}/case_pieces.cpp)
  target_link_libraries(capstan_kept PRIVATE capstan_kept_measure capstan::engagement capstan::toolpath
    capstan::json capstan::casebase)
  if(TARGET capstan_exchange)
    add_executable(capstan_work_table ${kept}/work_table.cpp)  # ./dev bench --table
    target_link_libraries(capstan_work_table PRIVATE capstan_kept_measure capstan::exchange capstan::json)
  endif()
  if(NOT CAPSTAN_SANITIZE AND CAPSTAN_WITH_NLOPT)
    add_test(NAME Kept.TakesTheInstructionsThatTheTableSays
      COMMAND capstan_kept --smoke ${kept}/fast.table $<TARGET_FILE:capstan> ${CMAKE_SOURCE_DIR}/examples)
    set_tests_properties(Kept.TakesTheInstructionsThatTheTableSays
      PROPERTIES TIMEOUT 1800 COST 600 SKIP_RETURN_CODE 77)
  endif()
endif()
