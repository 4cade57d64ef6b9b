capstan_test(json DEPENDS json)
