# The tests of TLS make certificates and are a client of their own.
set(openssl "")
find_package(OpenSSL 3.0 QUIET COMPONENTS SSL Crypto)
if(OPENSSL_FOUND)
  set(openssl OpenSSL::SSL OpenSSL::Crypto)
endif()
capstan_test(transport DEPENDS transport service json exchange LIBS ${openssl})

find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME Serve.TheExampleInPythonBindsThePlateAndSigtermEndsTheServer
  COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/serve/example.py $<TARGET_FILE:capstan> ${CMAKE_SOURCE_DIR})
set_tests_properties(Serve.TheExampleInPythonBindsThePlateAndSigtermEndsTheServer PROPERTIES
  SKIP_RETURN_CODE 77 TIMEOUT 120)
