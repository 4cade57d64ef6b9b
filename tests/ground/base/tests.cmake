capstan_test(base DEPENDS base)
