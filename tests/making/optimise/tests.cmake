capstan_test(optimise DEPENDS optimise optimise_solvers)
if(CAPSTAN_WITH_IPOPT AND TARGET optimise_test)
  # What stands for Ipopt's library where that is to fail, beside the test program.
  add_library(capstan_false_ipopt MODULE ${CMAKE_CURRENT_LIST_DIR}/solver/false_ipopt.cpp)
  target_link_libraries(capstan_false_ipopt PRIVATE $<BUILD_INTERFACE:capstan_options>)
  target_include_directories(capstan_false_ipopt SYSTEM PRIVATE ${IPOPT_INCLUDE_DIRS})
  target_compile_options(capstan_false_ipopt PRIVATE ${IPOPT_CFLAGS_OTHER})
  set_target_properties(capstan_false_ipopt PROPERTIES PREFIX "" OUTPUT_NAME false_ipopt
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  add_dependencies(optimise_test capstan_false_ipopt)
endif()
