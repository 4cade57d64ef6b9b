capstan_test(p21 DEPENDS p21)
target_sources(p21_test PRIVATE ${CMAKE_SOURCE_DIR}/tests/fuzz/p21_fuzz.cpp)
