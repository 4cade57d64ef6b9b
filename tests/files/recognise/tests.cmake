capstan_test(recognise DEPENDS recognise p21 exchange)
target_sources(recognise_test PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/planar_step.cpp
  ${CMAKE_CURRENT_LIST_DIR}/mfcad.cpp
  ${CMAKE_CURRENT_LIST_DIR}/blocks.cpp
  ${CMAKE_CURRENT_LIST_DIR}/changed_brep.cpp)
if(TARGET capstan-brep)
  add_dependencies(recognise_test capstan-brep)
endif()
