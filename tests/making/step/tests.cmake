capstan_test(step DEPENDS step)
