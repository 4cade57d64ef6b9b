capstan_test(recognise DEPENDS recognise p21)
target_sources(recognise_test PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/planar_step.cpp
  ${CMAKE_CURRENT_LIST_DIR}/mfcad.cpp
  ${CMAKE_CURRENT_LIST_DIR}/changed_brep.cpp)
