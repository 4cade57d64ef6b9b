capstan_test(model DEPENDS model)
