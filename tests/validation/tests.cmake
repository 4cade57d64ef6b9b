# What docs/validation.md compares: one library of comparisons, the program that writes the document's figures
# and the data of its plots (./dev validate), and the test that the document says what the program computes.
set(validation ${CMAKE_CURRENT_LIST_DIR})
file(GLOB_RECURSE validation_sources CONFIGURE_DEPENDS ${validation}/*.cpp)
list(FILTER validation_sources EXCLUDE REGEX "_test\\.cpp$|main\\.cpp$")
find_package(yaml-cpp REQUIRED)
add_library(capstan_validation_comparisons STATIC ${validation_sources}
  ${CMAKE_SOURCE_DIR}/tests/files/recognise/mfcad.cpp ${CMAKE_SOURCE_DIR}/tests/files/recognise/planar_step.cpp)
target_link_libraries(capstan_validation_comparisons
  PUBLIC $<BUILD_INTERFACE:capstan_options> capstan_test_support
  PRIVATE capstan::motion capstan::mechanics capstan::optimise capstan::optimise_solvers capstan::engagement
    capstan::verify capstan::service capstan::tooling capstan_mutation capstan_sweep
    capstan_simulated_shop capstan::casebase capstan::recognise capstan::p21 capstan::exchange yaml-cpp)
add_executable(capstan_validation ${validation}/main.cpp)
target_link_libraries(capstan_validation PRIVATE capstan_validation_comparisons)
capstan_test(validation LIBS capstan_validation_comparisons COST 700)

# Records times of late binding: capstan_bind_times FOLDER.
add_executable(capstan_bind_times ${validation}/late/bind_times_main.cpp)
target_link_libraries(capstan_bind_times PRIVATE $<BUILD_INTERFACE:capstan_options> capstan_test_support
  capstan::service)

# Records the times of all plans of the sweep: capstan_catalogue_times FOLDER.
add_executable(capstan_catalogue_times ${validation}/catalogue/catalogue_times_main.cpp)
target_link_libraries(capstan_catalogue_times PRIVATE capstan_validation_comparisons capstan_sweep
  capstan::service)

# Records cycle times on LinuxCNC's simulated machine: capstan_cycle_times FOLDER.
if(TARGET capstan_simulated)
  add_executable(capstan_cycle_times ${validation}/linuxcnc/cycle_times_main.cpp)
  target_link_libraries(capstan_cycle_times PRIVATE capstan_simulated)
  # The same for roughing against FreeCAD's paths: capstan_rival_times FOLDER.
  add_executable(capstan_rival_times ${validation}/linuxcnc/rival_times_main.cpp)
  target_link_libraries(capstan_rival_times PRIVATE capstan_simulated capstan_validation_comparisons)
endif()
