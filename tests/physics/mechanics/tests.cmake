capstan_test(mechanics DEPENDS mechanics)
