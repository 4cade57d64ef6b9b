# An installed Capstan, used by projects that know nothing of this tree. A sanitized library would want its
# consumers sanitized too, so not there.
if(TARGET capstan_facade AND TARGET capstan_late_shared AND TARGET capstan_manual_pages AND NOT CAPSTAN_SANITIZE)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  add_test(NAME Install.HoldsWhatIsPromised
    COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/installed_test.py
      --source ${CMAKE_SOURCE_DIR} --built ${CMAKE_BINARY_DIR} --scratch ${CMAKE_BINARY_DIR}/install-test
      --libdir ${CMAKE_INSTALL_LIBDIR} --libexecdir ${CMAKE_INSTALL_LIBEXECDIR} --version ${PROJECT_VERSION} --cmake ${CMAKE_COMMAND}
      --generator ${CMAKE_GENERATOR} --cxx ${CMAKE_CXX_COMPILER} --cc ${CMAKE_C_COMPILER}
      $<$<TARGET_EXISTS:capstan-brep>:--brep> $<$<TARGET_EXISTS:capstan_postgres>:--postgres>
      $<$<TARGET_EXISTS:capstan_python>:--python=${CAPSTAN_PYTHON_DIR}>
      $<$<TARGET_EXISTS:capstan_python>:--interpreter=${CAPSTAN_PYTHON}>
    COMMAND_EXPAND_LISTS)
  set_tests_properties(Install.HoldsWhatIsPromised PROPERTIES TIMEOUT 300)
endif()
