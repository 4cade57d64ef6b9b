# An installed Capstan, used by a project that knows nothing of this tree. A sanitized library would want its
# consumer sanitized too, so not there.
if(TARGET capstan_facade AND NOT CAPSTAN_SANITIZE)
  add_test(NAME Install.ServesAConsumer
    COMMAND ${CMAKE_COMMAND} -DBUILT=${CMAKE_BINARY_DIR} -DSCRATCH=${CMAKE_BINARY_DIR}/install-test
      -DCONSUMER=${CMAKE_CURRENT_LIST_DIR}/consumer -DVERSION=${PROJECT_VERSION} -DGENERATOR=${CMAKE_GENERATOR}
      -DCOMPILER=${CMAKE_CXX_COMPILER} -P ${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)
  set_tests_properties(Install.ServesAConsumer PROPERTIES TIMEOUT 300)
endif()
