capstan_test(geometry DEPENDS geometry)
