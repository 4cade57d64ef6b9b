# The tree looked at as text: who includes whom, how long a file is, what must not be said.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
function(capstan_python_test name script)
  add_test(NAME Architecture.${name}
    COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${script} ${ARGN})
  set_tests_properties(Architecture.${name} PROPERTIES TIMEOUT 60)
endfunction()
capstan_python_test(IncludesFollowTheTable include_direction.py ${CMAKE_SOURCE_DIR})
capstan_python_test(PlantedIncludesAreNamed include_direction_test.py)
capstan_python_test(FilesStayShort file_length.py ${CMAKE_SOURCE_DIR})
capstan_python_test(TextIsPublic public_text.py ${CMAKE_SOURCE_DIR})
capstan_python_test(MissingCorpusTestsAreNoticed corpus_ran_test.py)
capstan_python_test(TypesStandOnce unique_types.py ${CMAKE_SOURCE_DIR})
capstan_python_test(PlantedTypesAreNamed unique_types_test.py)
