capstan_test(exchange DEPENDS base geometry model p21 exchange)
# What of the helper knows no OpenCASCADE; and the helper itself, where it is built.
target_sources(exchange_test PRIVATE ${CMAKE_SOURCE_DIR}/planner/files/exchange/brep/helper/senses.cpp)
if(TARGET capstan-brep)
  add_dependencies(exchange_test capstan-brep)
endif()
