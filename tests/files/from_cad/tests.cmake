capstan_test(from_cad DEPENDS from_cad exchange p21)
if(TARGET capstan-brep)
  add_dependencies(from_cad_test capstan-brep)
endif()
