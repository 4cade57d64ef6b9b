capstan_test(app DEPENDS base geometry model p21 exchange motion json optimise mechanics controls casebase service app)
if(TARGET app_test)
  # The command is tested as it is run: as a program.
  add_dependencies(app_test capstan)
  if(TARGET capstan-brep)
    add_dependencies(app_test capstan-brep)
  endif()
  set(everyday "")
  if(TARGET capstan-brep)
    # Parts that the tests plan are made by OpenCASCADE, as capstan-brep reads them.
    find_path(CAPSTAN_OCCT_INCLUDE STEPControl_Reader.hxx PATH_SUFFIXES opencascade)
    add_executable(everyday_parts ${CMAKE_CURRENT_LIST_DIR}/everyday/everyday_parts.cpp)
    target_include_directories(everyday_parts SYSTEM PRIVATE ${CAPSTAN_OCCT_INCLUDE})
    target_link_libraries(everyday_parts PRIVATE TKSTEP TKSTEPBase TKXSBase TKBO TKFillet TKPrim TKShHealing
      TKTopAlgo TKBRep TKGeomBase TKG3d TKMath TKernel)
    add_dependencies(app_test everyday_parts)
    set(everyday "$<TARGET_FILE:everyday_parts>")
  endif()
  # The paths of this build stand in one object: the others are had from the compiler's cache in any folder.
  set(programs ${CMAKE_CURRENT_LIST_DIR}/programs.cpp)
  target_sources(app_test PRIVATE ${programs})
  set_source_files_properties(${programs} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_DEFINITIONS
    "CAPSTAN_COMMAND=\"$<TARGET_FILE:capstan>\";CAPSTAN_PYTHON=\"$<IF:$<TARGET_EXISTS:capstan_python>,${CAPSTAN_PYTHON},python3>\";CAPSTAN_PYTHON_PATH=\"${CMAKE_BINARY_DIR}/python\";CAPSTAN_EVERYDAY_PARTS=\"${everyday}\"")
  if(TARGET capstan_python)
    add_dependencies(app_test capstan_python)
  endif()
endif()
