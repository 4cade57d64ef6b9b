# OpenCASCADE reads the geometry of what we write. Needs libocct-data-exchange-dev; without it, and with
# -DCAPSTAN_OCCT=OFF, the tests say that they are skipped.
option(CAPSTAN_OCCT "test the geometry of written STEP files with OpenCASCADE where it is installed" ON)
capstan_test(occt DEPENDS base geometry model p21 exchange service)
find_path(CAPSTAN_OCCT_INCLUDE STEPControl_Reader.hxx PATH_SUFFIXES opencascade)
find_library(CAPSTAN_OCCT_TKSTEP TKSTEP)
if(CAPSTAN_OCCT AND CAPSTAN_OCCT_INCLUDE AND CAPSTAN_OCCT_TKSTEP AND NOT CAPSTAN_SANITIZE)
  add_executable(occt_shapes ${CMAKE_CURRENT_LIST_DIR}/occt_shapes.cpp)
  target_include_directories(occt_shapes SYSTEM PRIVATE ${CAPSTAN_OCCT_INCLUDE})
  target_link_libraries(occt_shapes PRIVATE TKSTEP TKSTEPBase TKXSBase TKTopAlgo TKBRep TKG3d TKMath TKernel)
  add_dependencies(occt_test occt_shapes)
  target_compile_definitions(occt_test PRIVATE CAPSTAN_OCCT_SHAPES="$<TARGET_FILE:occt_shapes>")
endif()
