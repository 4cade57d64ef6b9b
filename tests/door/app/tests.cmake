capstan_test(app DEPENDS base geometry model p21 exchange motion json optimise mechanics controls casebase service app)
if(TARGET app_test)
  # The command is tested as it is run: as a program.
  add_dependencies(app_test capstan)
  if(TARGET capstan-brep)
    add_dependencies(app_test capstan-brep)
  endif()
  target_compile_definitions(app_test PRIVATE CAPSTAN_COMMAND="$<TARGET_FILE:capstan>")
endif()
