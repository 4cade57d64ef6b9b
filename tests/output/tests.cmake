capstan_test(output DEPENDS output)
